// What the reference lift costs: real time factors, the parts of a step, threads, memory. A program to run by hand on a
// quiet machine: stillhook_bench [case.toml]. Every figure is a ratio within one run, or belongs to one.
#include <fmt/core.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "problems/scenarios.h"
#include "sim/simulate.h"
#include "tests/bench/memory_requests.h"
#include "tests/bench/step_parts.h"

using namespace stillhook;

namespace {

constexpr double kMiddle = 700.0, kSpan = 100.0;  // s: while the booms turn, the load hangs and both taglines pull
constexpr double kShort = 200.0;                  // s, for what need not run to the end
constexpr double kLongPeriod = 30.0;              // s

Specification in_sea(const Case& c, const std::string& sea) {
  ScenarioSpec scenario;
  scenario.name = scenario.sea = sea;
  return in_scenario(c.specification, scenario);
}

/// A sea that the hulls' coefficients do not reach is lengthened: the work of a step depends on the number of its
/// components alone.
Model model_in(const Case& c, const std::string& sea, double duration) {
  Specification spec = in_sea(c, sea);
  if (duration > 0.0) spec.solver.max_duration = duration;
  try {
    return build_model(spec);
  } catch (const SpecificationError& error) {
    fmt::print("  {}: {}\n  measured with a peak period of {:.0f} s instead\n", sea, error.what(), kLongPeriod);
    for (SeaStateSpec& state : spec.sea.states)
      if (state.name == sea) state.peak_period = kLongPeriod;
    return build_model(spec);
  }
}

void print_real_time(const Case& c, const std::string& sea, double duration) {
  const Model model = model_in(c, sea, duration);
  const Operation operation = build_operation(model);
  const double begin = thread_seconds();
  const Trajectory run = simulate(model, operation);
  const double spent = thread_seconds() - begin;
  const double steps = static_cast<double>(run.steps);
  fmt::print(
      "  {:<14}{:8.1f} s simulated {:7.0f} x real time {:6.1f} us a step, {:.2f} residuals, {:.4f} factorisations\n",
      sea, run.time.back(), run.time.back() / spent, 1e6 * spent / steps, static_cast<double>(run.residuals) / steps,
      static_cast<double>(run.factorisations) / steps);
}

void print_preparation(const Case& c, const std::string& sea) {
  const Specification spec = in_sea(c, sea);
  const double begin = thread_seconds();
  const Model model = build_model(spec);
  const double built = thread_seconds();
  const Operation operation = build_operation(model);
  const double planned = thread_seconds();
  simulate(model, operation);
  const double run = thread_seconds() - planned;
  fmt::print("  before a run, as shares of the run: model {:.3f}, operation {:.3f}\n", (built - begin) / run,
             (planned - built) / run);
}

void print_parts(const Case& c, const std::string& sea) {
  const Model model = model_in(c, sea, 0.0);
  StepCosts costs = measure_step(model, build_operation(model), kMiddle, kSpan);
  fmt::print("\nA step in {} around t = {:.0f} s: {:.1f} dense LU factorisations of {} x {}\n", sea, kMiddle,
             costs.step / costs.dense_lu, costs.size, costs.size);
  fmt::print("  ({:.2f} residuals and {:.4f} factorisations a step)\n", costs.residuals, costs.factorisations);
  std::ranges::sort(costs.parts, [](const PartCost& a, const PartCost& b) { return a.per_step > b.per_step; });
  for (const PartCost& part : costs.parts)
    fmt::print("  {:<40}{:6.1f} %\n", part.part, 100.0 * part.per_step / costs.step);
}

struct Spent {
  double wall = 1e9, processor = 1e9;  // s
};

/// The least of some rounds, wall time and processor time of all threads.
void run_scenarios(const Model& model, const Operation& operation, int threads, int scenarios, Spent& least) {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int i = 0; i < scenarios; ++i) simulate(model, operation);
  least.processor = std::min(least.processor, static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
  least.wall = std::min(least.wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

void print_threads(const Case& c, const std::string& sea) {
  constexpr int kScenarios = 8, kRounds = 5;
  const Model model = model_in(c, sea, kShort);
  const Operation operation = build_operation(model);
  Spent one, two;
  for (int round = 0; round < kRounds; ++round) {
    run_scenarios(model, operation, 1, kScenarios, one);
    run_scenarios(model, operation, 2, kScenarios, two);
  }
  fmt::print("\n{} equal scenarios on two threads ({} processors here): {:.2f} times as fast as on one by the clock\n",
             kScenarios, omp_get_num_procs(), one.wall / two.wall);
  // What the threads cost one another; the clock also shows what else the machine has to do.
  fmt::print("  {:.2f} times by the processor time that they need\n", 2.0 * one.processor / two.processor);
}

#ifdef STILLHOOK_COUNTS_MEMORY
void print_requests(const Case& c, const std::string& sea) {
  const Model model = model_in(c, sea, 0.0);
  const Operation operation = build_operation(model);
  long last = memory_requests, intervals = 0, silent = 0, requests = 0;
  RunOptions options;
  options.record = false;
  options.progress = [&](double, double) {
    const long now = memory_requests;
    ++intervals;
    if (now == last) ++silent;
    requests += now - last;
    last = now;
    return true;
  };
  const Trajectory run = simulate(model, operation, options);
  fmt::print("\nRequests for memory without samples: {} in {} steps, none in {} of {} intervals of 5 s\n", requests,
             run.steps, silent, intervals);
  fmt::print("  ({} phases open and {} contacts begin and end in the others)\n", run.phases.size(),
             run.contacts.size());
}
#endif

}  // namespace

int main(int argc, char** argv) {
  try {
    const Case c = read_case(argc > 1 ? argv[1] : STILLHOOK_SOURCE_DIR "/problems/box_installation.toml");
    fmt::print("{}, step {} s, one core, processor time\n", c.name, c.specification.solver.time_step);
    for (const SeaStateSpec& sea : c.specification.sea.states)
      print_real_time(c, sea.name, sea.type == SeaStateSpec::Type::regular ? 0.0 : kShort);
    const std::string first = c.specification.sea.states.front().name;
    print_preparation(c, first);
    for (const SeaStateSpec& sea : c.specification.sea.states) print_parts(c, sea.name);
    print_threads(c, first);
#ifdef STILLHOOK_COUNTS_MEMORY
    print_requests(c, first);
#endif
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("\nPeak memory {:.0f} MB\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
