#include "tests/bench/step_parts.h"

#include <ctime>
#include <functional>
#include <map>
#include <stdexcept>

#include "sim/multibody/hht.h"
#include "sim/operation_clock.h"
#include "sim/recorder.h"

namespace stillhook {
namespace {

/// Processor time of one call, s: the least of five rounds, which others on the machine disturbed least.
double cost_of(const std::function<void()>& call) {
  double best = 1e9;
  int repeats = 1;
  for (int round = 0; round < 5;) {
    const double begin = thread_seconds();
    for (int i = 0; i < repeats; ++i) call();
    const double spent = thread_seconds() - begin;
    if (spent < 0.002) {
      repeats *= 2;
      continue;
    }
    best = std::min(best, spent / repeats);
    ++round;
  }
  return best;
}

std::string part_of(const Specification& spec, const std::string& element) {
  if (element.ends_with(".hydrostatics")) return "hydrostatics";
  if (element.ends_with(".hydrodynamics")) return "hydrodynamics";
  std::string section;
  for_each_element_kind([&](const auto& kind) {
    for (const auto& entry : spec.*kind.entries)
      if (entry.name == element) section = kind.section;
  });
  if (!section.empty()) return section;
  return "joint drives";
}

/// The loop of simulate(), with its parts in reach.
class OpenRun {
 public:
  OpenRun(const Model& model, const Operation& operation)
      : model_(model),
        h_(model.specification().solver.time_step),
        state(model.initial_state()),
        stepper(model.system(),
                {model.specification().solver.hht_alpha, model.specification().solver.newton_tolerance}),
        board(model),
        recorder(model, board, false, out),
        clock_(operation),
        drives_(model.specification().drives.size()) {
    stepper.start(state);
    clock_.advance(0.0, recorder);
  }
  void run_to(double t) {
    while (state.t < t - 0.5 * h_) {
      ++steps;
      clock_.foresee(steps * h_);
      clock_.drives_at(steps * h_, drives_);
      if (!stepper.step(state, h_, drives_)) throw std::runtime_error("the lift diverges before its middle");
      clock_.advance(state.t, recorder);
      state.phase = clock_.phase();
      note();
    }
  }
  void note() {
    board.measure(state, stepper.workspace(), state.phase, true);
    recorder.add(state.t, h_, state.phase, false);
  }

 private:
  const Model& model_;
  double h_;

 public:
  Trajectory out;
  SystemState state;
  HhtStepper stepper;
  ChannelBoard board;
  Recorder recorder;
  long steps = 0;

 private:
  OperationClock clock_;
  std::vector<DriveState> drives_;
};

}  // namespace

double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

StepCosts measure_step(const Model& model, const Operation& operation, double middle, double span) {
  const MultibodySystem& system = model.system();
  const double h = model.specification().solver.time_step;
  OpenRun run(model, operation);
  run.run_to(middle);
  const long steps = run.steps, residuals = run.stepper.residuals(), factorisations = run.stepper.factorisations();
  const double begin = thread_seconds();
  run.run_to(middle + span);
  const double count = static_cast<double>(run.steps - steps);
  StepCosts costs;
  costs.step = (thread_seconds() - begin) / count;
  costs.residuals = static_cast<double>(run.stepper.residuals() - residuals) / count;
  costs.factorisations = static_cast<double>(run.stepper.factorisations() - factorisations) / count;

  SystemState& state = run.state;
  SystemWorkspace& work = run.stepper.workspace();
  const std::vector<double> memory = state.element_state;
  std::map<std::string, double> parts;
  std::vector<double> values(run.board.channels().size());
  for (int e = 0; e < static_cast<int>(system.elements.size()); ++e) {
    const ForceElement& element = *system.elements[e];
    double& part = parts[part_of(model.specification(), element.name())];
    const Memory m = system.memory(e, state, work);
    part += cost_of([&] { element.begin_step(state.instant(), h, m); });
    part += costs.residuals * cost_of([&] { element.add_forces(state.instant(), h, m, work.forces); });
    part += costs.factorisations * cost_of([&] { element.add_jacobian(state.instant(), h, m, work.jacobian); });
    part += cost_of([&] { element.end_step(state.instant(), h, m); });
    state.element_state = memory;
    const std::size_t channels = run.board.element_offset(e + 1) - run.board.element_offset(e);
    parts["channels: " + part_of(model.specification(), element.name())] += cost_of([&] {
      element.measure(state.instant(), m, {values.data(), channels});
    });
  }
  const double all_channels = cost_of([&] { run.board.measure(state, work, state.phase, true); });
  double of_elements = 0.0;
  for (const auto& [name, cost] : parts)
    if (name.starts_with("channels: ")) of_elements += cost;
  parts["channels: bodies, joints, sea"] = std::max(0.0, all_channels - of_elements);
  parts["extremes and contacts"] = cost_of([&] { run.recorder.add(state.t, h, state.phase, false); });

  const int n = system.coordinates(), rows = system.constraints();
  MatrixX C_q;
  VectorX C;
  parts["constraints"] = costs.residuals * cost_of([&] {
                           system.constraint_jacobian(state, C_q);
                           system.constraint_values(state, C);
                         });
  costs.size = n + rows;
  MatrixX J = MatrixX::Random(costs.size, costs.size);
  J.diagonal().array() += costs.size;  // as regular as any
  VectorX b = VectorX::Random(costs.size), x = b;
  Eigen::PartialPivLU<MatrixX> lu(costs.size);
  costs.dense_lu = cost_of([&] { lu.compute(J); });
  parts["LU factorisation"] = costs.factorisations * costs.dense_lu;
  parts["back substitution"] = costs.residuals * cost_of([&] { x = lu.solve(b); });

  double sum = 0.0;
  for (const auto& [name, cost] : parts) {
    costs.parts.push_back({name, cost});
    sum += cost;
  }
  costs.parts.push_back({"other", costs.step - sum});
  return costs;
}

}  // namespace stillhook
