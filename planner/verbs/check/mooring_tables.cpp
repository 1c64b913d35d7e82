#include "planner/verbs/check/mooring_tables.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/text_number.h"
#include "sim/lifting/mooring.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

const Mooring* line_of(const Model& model, const MooringSpec& spec) {
  const int index = model.element_index(spec.name);
  return dynamic_cast<const Mooring*>(model.system().elements[static_cast<std::size_t>(index)].get());
}

std::string place(const Vector3& p) {
  return fmt::format("{}, {}, {}", cell(p.x(), 1), cell(p.y(), 1), cell(p.z(), 1));
}

ReportTable line_table(const Model& model) {
  ReportTable table;
  table.title = "Mooring lines";
  table.note =
      "At the start. Places in the world, m; tensions at the fairlead, kN; the anchor of a linear line stands for its "
      "direction only.";
  table.header = {"line", "body", "fairlead x, y, z", "anchor x, y, z", "distance m", "tension kN", "horizontal kN"};
  const std::map<std::string, double> values = channel_values(model, model.initial_state());
  for (const MooringSpec& spec : model.specification().moorings) {
    const Mooring* line = line_of(model, spec);
    const BodyPoint& at = line->options().fairlead;
    const BodyKinematics& body = model.initial_state().body[static_cast<std::size_t>(at.body)];
    const Vector3 fairlead = body.p_WC + body.R_WB * at.c_B;
    table.rows.push_back({spec.name, spec.body, place(fairlead), place(line->anchor()),
                          cell((line->anchor() - fairlead).head<2>().norm(), 1),
                          cell(values.at(mooring_channels::tension.of(spec)) / 1e3, 1),
                          cell(values.at(mooring_channels::horizontal_tension.of(spec)) / 1e3, 1)});
  }
  return table;
}

/// Stiffness that the lines alone give all bodies at the start: -dQ/dxi, N/m and N m/rad.
MatrixX mooring_stiffness(const Model& model) {
  const MultibodySystem& system = model.system();
  const SystemState& state = model.initial_state();
  JacobianSum sum(static_cast<int>(system.bodies.size()));
  const Instant now{state.t, state.body, state.drive, 0};
  for (const MooringSpec& spec : model.specification().moorings) {
    const Mooring* line = line_of(model, spec);
    std::vector<double> memory(static_cast<std::size_t>(line->state_size())),
        scratch(static_cast<std::size_t>(line->scratch_size()));
    line->start(now, {memory, scratch});
    line->add_jacobian(now, 0.0, {memory, scratch}, sum);
  }
  return -sum.stiffness();
}

ReportTable restoring_table(const Model& model) {
  ReportTable table;
  table.title = "Mooring stiffness";
  table.note =
      "Of all lines of a body together at the start, along its own x and y and about the vertical through its centre "
      "of gravity.";
  table.header = {"body", "lines", "surge kN/m", "sway kN/m", "yaw kN m/deg"};
  const MatrixX K = mooring_stiffness(model);
  const Specification& spec = model.specification();
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    int lines = 0;
    for (const MooringSpec& line : spec.moorings) lines += line.body == spec.bodies[i].name ? 1 : 0;
    if (lines == 0) continue;
    const Matrix6 own = K.block<6, 6>(6 * static_cast<int>(i), 6 * static_cast<int>(i));
    const Matrix3& R_WB = model.initial_state().body[i].R_WB;
    const Vector3 surge = Vector3(R_WB(0, 0), R_WB(1, 0), 0.0).normalized(), sway = Vector3::UnitZ().cross(surge);
    const Vector3 up_B = R_WB.transpose() * Vector3::UnitZ();
    table.rows.push_back({spec.bodies[i].name, std::to_string(lines),
                          cell(surge.dot(own.topLeftCorner<3, 3>() * surge) / 1e3, 1),
                          cell(sway.dot(own.topLeftCorner<3, 3>() * sway) / 1e3, 1),
                          cell(up_B.dot(own.bottomRightCorner<3, 3>() * up_B) * kDegree / 1e3, 1)});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> mooring_tables(const Model& model) {
  if (model.specification().moorings.empty()) return {};
  return {line_table(model), restoring_table(model)};
}

}  // namespace stillhook
