#include "planner/verbs/check/static_tables.h"

#include <fmt/format.h>

#include "planner/verbs/check/crane_table.h"
#include "planner/verbs/check/flow_tables.h"
#include "planner/verbs/check/hinge_table.h"
#include "planner/verbs/check/mooring_tables.h"
#include "planner/verbs/check/natural_periods.h"
#include "planner/verbs/check/sea_tables.h"
#include "planner/text_number.h"
#include "planner/verbs/check/vessel_statics.h"
#include "sim/drive_unit.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

Vector3 world_point(const Model& model, const StaticPose& pose, const std::string& body, const Vector3& p_B) {
  const int index = model.body_index(body);
  return index == kWorld ? p_B : pose.bodies[static_cast<std::size_t>(index)] * p_B;
}

double value_of(const StaticPose& pose, const std::string& channel) {
  const auto found = pose.values.find(channel);
  return found == pose.values.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

ReportTable place_table(const Model& model, const std::vector<StaticPose>& poses) {
  const Specification& spec = model.specification();
  ReportTable table;
  table.title = "Load and hoist points";
  table.note = "Positions in the world, m: reference point of the load, upper ends of the hoist wires.";
  table.header = {"pose"};
  for (const char* axis : {"x", "y", "z"}) table.header.push_back(fmt::format("{} {}", spec.operation.load, axis));
  for (const WireSpec& wire : spec.wires)
    if (wire.role == WireSpec::Role::hoist)
      for (const char* axis : {"x", "z"}) table.header.push_back(fmt::format("{} tip {}", wire.name, axis));
  for (const StaticPose& pose : poses) {
    std::vector<std::string> row = {pose.name};
    const Vector3 load = world_point(model, pose, spec.operation.load, spec.operation.load_reference);
    for (const double v : load) row.push_back(cell(v, 2));
    for (const WireSpec& wire : spec.wires) {
      if (wire.role != WireSpec::Role::hoist) continue;
      const Vector3 tip = world_point(model, pose, wire.from, wire.point_from);
      row.push_back(cell(tip.x(), 2));
      row.push_back(cell(tip.z(), 2));
    }
    table.rows.push_back(row);
  }
  return table;
}

ReportTable wire_table(const Model& model, const std::vector<StaticPose>& poses, const std::string& title,
                       const std::string& note, const ChannelKind<WireSpec>& channel, double unit, int decimals) {
  ReportTable table;
  table.title = title;
  table.note = note;
  table.header = {"pose"};
  for (const WireSpec& wire : model.specification().wires) table.header.push_back(wire.name);
  for (const StaticPose& pose : poses) {
    std::vector<std::string> row = {pose.name};
    for (const WireSpec& wire : model.specification().wires)
      row.push_back(cell(value_of(pose, channel.of(wire)) / unit, decimals));
    table.rows.push_back(row);
  }
  return table;
}

/// The unit a drive is shown in, its factor from SI, and the factor for its speed.
struct DriveUnit {
  std::string travel, speed;
  double travel_factor = 1.0, speed_factor = 60.0;
};

DriveUnit unit_of(const Model& model, const DriveSpec& drive) {
  switch (drive_motion(model.specification(), drive)) {
    case DriveMotion::share:
      return {"%", "%/min", 100.0, 6000.0};
    case DriveMotion::angle:
      return {"deg", "deg/s", 1.0 / kDegree, 1.0 / kDegree};  // as its keys do
    case DriveMotion::length:
      break;
  }
  return {"m", "m/min"};
}

}  // namespace

std::vector<ReportTable> static_tables(const Model& model, const Operation& operation) {
  const std::vector<NamedEquilibrium> equilibria = all_equilibria(model, operation);
  std::vector<StaticPose> poses;
  for (const NamedEquilibrium& e : equilibria) poses.push_back(static_pose(model, e.state, e.name));
  std::vector<ReportTable> tables = sea_tables(model);
  for (ReportTable& table : flow_tables(model)) tables.push_back(std::move(table));
  if (!model.specification().operation.load.empty()) tables.push_back(place_table(model, poses));
  for (ReportTable& table : vessel_tables(model, poses)) tables.push_back(std::move(table));
  for (ReportTable& table : crane_tables(model, poses)) tables.push_back(std::move(table));
  if (ReportTable angles = hinge_table(model, poses); angles.header.size() > 1) tables.push_back(std::move(angles));
  for (ReportTable& table : period_tables(model, equilibria)) tables.push_back(std::move(table));
  for (ReportTable& table : mooring_tables(model)) tables.push_back(std::move(table));
  if (model.specification().wires.empty()) return tables;
  const double tonne = 1000.0 * model.specification().sea.gravity;
  tables.push_back(wire_table(model, poses, "Wire tensions", "In t: the force that holds this mass.",
                              wire_channels::tension, tonne, 1));
  tables.push_back(wire_table(model, poses, "Wire lengths", "Stretched, in m.", wire_channels::length, 1.0, 2));
  return tables;
}

ReportTable phase_table(const Model& model, const Operation& operation) {
  ReportTable table;
  table.title = "Phases";
  table.note = "Without waiting for events. Travel is hauled in (+) or paid out (-).";
  table.header = {"phase", "start s", "duration s", "drive", "travel", "peak speed", "waits for"};
  double start = 0.0;
  for (const Phase& phase : operation.phases) {
    const bool waits = phase.wait_for.type != EventSpec::Type::none;
    std::vector<std::string> row = {phase.name, cell(start, 1), cell(phase.duration, 1)};
    if (phase.moves.empty()) row.insert(row.end(), {"-", "", ""});
    for (std::size_t i = 0; i < phase.moves.size(); ++i) {
      const Move& move = phase.moves[i];
      const DriveSpec& drive = model.specification().drives[static_cast<std::size_t>(move.drive)];
      const DriveUnit unit = unit_of(model, drive);
      if (i > 0) row = {"", "", ""};
      row.push_back(drive.name);
      row.push_back(fmt::format("{} {}", cell(move.profile.travel() * unit.travel_factor, 3), unit.travel));
      row.push_back(fmt::format("{} {}", cell(move.profile.peak_rate() * unit.speed_factor, 3), unit.speed));
      if (i == 0 && waits) row.push_back("clear of " + phase.wait_for.contact);
      table.rows.push_back(row);
    }
    if (phase.moves.empty()) {
      if (waits) row.push_back("clear of " + phase.wait_for.contact);
      table.rows.push_back(row);
    }
    start += phase.duration;
  }
  for (std::vector<std::string>& row : table.rows) row.resize(table.header.size());
  return table;
}

}  // namespace stillhook
