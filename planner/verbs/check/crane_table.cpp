#include "planner/verbs/check/crane_table.h"

#include <fmt/core.h>

#include <cmath>

#include "planner/text_number.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kTonneOfForce = 1e3 * kStandardGravity;

double hook_load(const StaticPose& pose, const std::vector<std::string>& wires) {
  double sum = 0.0;
  for (const std::string& wire : wires)
    if (const auto found = pose.values.find(wire_channels::tension.of(wire)); found != pose.values.end())
      sum += found->second;
  return sum;
}

Vector3 mean_place(const Model& model, const StaticPose& pose, const std::vector<PlaceOnBody>& places) {
  Vector3 sum = Vector3::Zero();
  for (const PlaceOnBody& place : places) {
    const int index = model.body_index(place.body);
    sum += index == kWorld ? place.point : pose.bodies[static_cast<std::size_t>(index)] * place.point;
  }
  return sum / static_cast<double>(places.size());
}

ReportTable table_of_crane(const Model& model, const std::vector<StaticPose>& poses, const std::string& crane,
                           const CraneCurveSpec& curve) {
  const Specification& spec = model.specification();
  const std::vector<std::string> wires = hoist_wires_of(spec, crane);
  const CraneReach reach = crane_reach(spec, crane);
  ReportTable table;
  table.title = "Use of " + crane;
  table.note = fmt::format(
      "By its curve {}, in calm water; radius from the slewing axis, or the boom's hinge, to the hook. DAF left: the "
      "amplification that would use up the capacity.",
      curve.name);
  if (curve.basis == CraneCurveSpec::Basis::static_load)
    table.note += " The curve bounds the load at rest: its maker has taken the amplification off.";
  table.header = {"pose", "radius m", "hook load t", "capacity t", "use %", "DAF left"};
  for (const StaticPose& pose : poses) {
    const double radius = (mean_place(model, pose, reach.hooks) - mean_place(model, pose, reach.axes)).head<2>().norm();
    const double load = hook_load(pose, wires);
    const double capacity = capacity_at(curve, radius);
    const bool inside = std::isfinite(capacity);
    table.rows.push_back({pose.name, cell(radius, 2), cell(load / kTonneOfForce, 1),
                          inside ? cell(capacity / kTonneOfForce, 1) : "outside",
                          inside ? cell(100.0 * load / capacity, 1) : "-",
                          inside && load > 0.0 ? cell(capacity / load, 2) : "-"});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> crane_tables(const Model& model, const std::vector<StaticPose>& poses) {
  std::vector<ReportTable> tables;
  for (const std::string& crane : cranes_with_curves(model.specification()))
    if (const CraneCurveSpec* curve = curve_of(model.specification(), crane))
      tables.push_back(table_of_crane(model, poses, crane, *curve));
  return tables;
}

}  // namespace stillhook
