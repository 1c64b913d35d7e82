#include "planner/operability/column_lift.h"

#include <algorithm>

#include "sim/simulate.h"

namespace stillhook {
namespace {

Specification specification_in(const Case& c, const OperabilityPlan& plan, std::size_t column, int seed,
                               double height) {
  Specification specification = c.specification;
  specification.sea.active = plan.sea;
  for (SeaStateSpec& state : specification.sea.states) {
    if (state.name != plan.sea) continue;
    state.significant_height = height;
    state.peak_period = plan.columns[column].peak_period;
    state.heading = plan.columns[column].heading;
    state.seed = plan.seed(seed);
  }
  return specification;
}

int phase_index(const Specification& specification, const std::string& name) {
  const auto& phases = specification.operation.phases;
  const auto at = std::find_if(phases.begin(), phases.end(), [&](const PhaseSpec& p) { return p.name == name; });
  return static_cast<int>(at - phases.begin());
}

RunOptions options_with(const std::atomic<bool>* stop) {
  RunOptions options;
  options.progress = [stop](double, double) { return !(stop && stop->load()); };
  return options;
}

}  // namespace

ColumnLift::ColumnLift(const Case& c, const OperabilityPlan& plan, std::size_t column, const HydroProgress& progress)
    : case_(c),
      plan_(plan),
      column_(column),
      base_(prepare_run(c,
                        specification_in(c, plan, column, 0, std::min(plan.rules.guess, plan.columns[column].highest)),
                        progress)) {}

Model ColumnLift::model_in(int seed, double height) const {
  try {
    return build_model_like(specification_in(case_, plan_, column_, seed, height), base_.model);
  } catch (const SpecificationError& error) {
    throw located(case_, error);
  }
}

void ColumnLift::check_seed(int seed) const {
  model_in(seed, std::min(plan_.rules.guess, plan_.columns[column_].highest));
}

std::optional<LiftValues> ColumnLift::run(int seed, double height, const std::atomic<bool>* stop) const {
  const Model model = model_in(seed, height);
  const Operation operation = build_operation_like(model, base_.model, base_.operation);
  RunOptions options = options_with(stop);
  if (!plan_.phases_alone) {
    const Trajectory run = simulate(model, operation, options);
    if (run.status == RunStatus::interrupted) return std::nullopt;
    return values_of(compute_metrics(model.specification(), run), run, plan_.criteria, plan_.phases);
  }
  LiftValues all;
  for (std::size_t p = 0; p < plan_.phases.size(); ++p) {
    const OperationPart part{phase_index(model.specification(), plan_.phases[p]), 0.0};
    const SystemState start = start_of(operation, part);
    options.from = &start;
    const Trajectory run = simulate(model, part_of(operation, part), options);
    if (run.status == RunStatus::interrupted) return std::nullopt;
    merge_phase(all, compute_metrics(model.specification(), run), plan_.criteria, plan_.phases, p);
  }
  return all;
}

}  // namespace stillhook
