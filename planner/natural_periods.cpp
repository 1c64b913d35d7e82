#include "planner/natural_periods.h"

#include <algorithm>
#include <cmath>

#include "planner/text_number.h"
#include "sim/modes.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

bool ends_a_phase(const OperationSpec& operation, const std::string& pose) {
  return std::any_of(operation.phases.begin(), operation.phases.end(),
                     [&](const PhaseSpec& p) { return p.name == pose; });
}

SystemState state_in(const Model& model, const StaticPose& pose) {
  SystemState state = model.initial_state();
  for (std::size_t i = 0; i < state.body.size(); ++i) {
    state.body[i].R_WB = pose.bodies[i].R;
    state.body[i].p_WC = pose.bodies[i] * model.system().bodies[i].cog;
  }
  for (std::size_t i = 0; i < state.drive.size(); ++i) state.drive[i].position = pose.drives[i];
  state.element_state.clear();  // friction holds where the pose stands
  solve_static(model, state, {}, pose.name);
  return state;
}

ReportTable table_of(const Model& model, int body, const std::vector<StaticPose>& poses,
                     const std::vector<std::vector<Mode>>& modes) {
  ReportTable table;
  table.title = "Natural periods of " + model.system().bodies[body].name;
  table.note =
      "In s: of the mode in which the coordinate has the largest share of its energy; without taglines and damping.";
  table.header = {"pose", "x", "y", "z", "roll", "pitch", "yaw"};
  for (std::size_t p = 0; p < poses.size(); ++p) {
    std::vector<std::string> row = {poses[p].name};
    for (int c = 0; c < 6; ++c) {
      const double period = period_of(modes[p], body, c);
      row.push_back(std::isfinite(period) ? cell(period, 2) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<ReportTable> period_tables(const Model& model, const std::vector<StaticPose>& poses) {
  const Specification& spec = model.specification();
  const ModalAnalysis analysis(model);
  std::vector<StaticPose> kept;
  std::vector<std::vector<Mode>> modes;
  for (const StaticPose& pose : poses) {
    if (ends_a_phase(spec.operation, pose.name)) continue;
    kept.push_back(pose);
    modes.push_back(analysis.at(state_in(model, pose)));
  }
  std::vector<ReportTable> tables;
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    if (spec.bodies[i].hull.shape != HullSpec::Shape::none || spec.bodies[i].name == spec.operation.load)
      tables.push_back(table_of(model, static_cast<int>(i), kept, modes));
  return tables;
}

}  // namespace stillhook
