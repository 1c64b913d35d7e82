#include "planner/verbs/check/natural_periods.h"

#include <cmath>

#include "planner/text_number.h"
#include "sim/modes.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

SystemState state_in(const Model& model, const StaticPose& pose) {
  SystemState state = model.initial_state();
  for (std::size_t i = 0; i < state.body.size(); ++i) {
    state.body[i].R_WB = pose.bodies[i].R;
    state.body[i].p_WC = pose.bodies[i] * model.system().bodies[i].cog;
  }
  for (std::size_t i = 0; i < state.drive.size(); ++i) state.drive[i].position = pose.drives[i];
  state.element_state.clear();  // friction holds where the pose stands
  solve_static(model, state, {}, "poses." + pose.name);
  return state;
}

// A small oscillation turns friction round before it slips: every contact sticks where its body stands, also one that
// slid there on the way.
SystemState gripping(const Model& model, SystemState state) {
  state.t = -1.0;  // s: before the waves start
  SystemWorkspace work = model.system().make_workspace();
  model.system().start_elements(state, work);
  model.system().settle_elements(state, work);
  return state;
}

ReportTable table_of(const Model& model, int body, const std::vector<NamedEquilibrium>& equilibria,
                     const std::vector<std::vector<Mode>>& modes) {
  ReportTable table;
  table.title = "Natural periods of " + model.system().bodies[body].name;
  table.note =
      "In s: of the mode in which the coordinate has the largest share of its energy; without taglines and damping. At "
      "the end of a phase with its contacts.";
  table.header = {"pose", "x", "y", "z", "roll", "pitch", "yaw"};
  for (std::size_t p = 0; p < equilibria.size(); ++p) {
    std::vector<std::string> row = {equilibria[p].name};
    for (int c = 0; c < 6; ++c) {
      const double period = period_of(modes[p], body, c);
      row.push_back(std::isfinite(period) ? cell(period, 2) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<NamedEquilibrium> all_equilibria(const Model& model, const Operation& operation) {
  std::vector<NamedEquilibrium> all;
  for (std::size_t p = 0; p < operation.equilibria.size(); ++p)
    all.push_back({operation.static_poses[p].name, operation.equilibria[p]});
  for (const StaticPose& pose : solve_poses(model)) all.push_back({pose.name, state_in(model, pose)});
  return all;
}

std::vector<ReportTable> period_tables(const Model& model, const std::vector<NamedEquilibrium>& equilibria) {
  const Specification& spec = model.specification();
  const ModalAnalysis analysis(model);
  std::vector<std::vector<Mode>> modes;
  for (const NamedEquilibrium& e : equilibria) modes.push_back(analysis.at(gripping(model, e.state), false));
  std::vector<ReportTable> tables;
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    if (spec.bodies[i].floats() || spec.bodies[i].name == spec.operation.load)
      tables.push_back(table_of(model, static_cast<int>(i), equilibria, modes));
  return tables;
}

}  // namespace stillhook
