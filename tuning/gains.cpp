#include "tuning/gains.h"

#include <algorithm>
#include <cmath>

#include "problems/scenarios.h"
#include "sim/simulate.h"

namespace stillhook {
namespace {

/// Kp and Kd of all lines together, up to gains that ask for the full pull at two degrees, or two degrees a second.
std::vector<VariableSpec> usual_gains(const Case& c) {
  double pull = 0.0;
  for (const TaglineSpec& line : c.specification.taglines) pull = std::max(pull, line.tension_max);
  const double kN = pull / 1000.0;
  return {
      {"taglines.*.kp_kN_per_deg", 0.0, std::max(0.5 * kN, 1.2 * key_value(c, "taglines.*.kp_kN_per_deg")), false},
      {"taglines.*.kd_kN_s_per_deg", 0.0, std::max(2.0 * kN, 1.2 * key_value(c, "taglines.*.kd_kN_s_per_deg")), false}};
}

void draw_map(const Evaluator& evaluator, const Eigen::VectorXd& at, const TuningOptions& options, GainTuning& result) {
  const int n = evaluator.base().tune.map;
  const auto& variables = evaluator.base().plan.variables;
  if (n < 2 || variables.size() < 2) return;
  const auto grid = [n](const VariableSpec& v) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(v.lower + (v.upper - v.lower) * i / (n - 1));
    return values;
  };
  result.map.x = grid(variables[0]);
  result.map.y = grid(variables[1]);
  result.map.objective = result.map.violation =
      Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (options.stop && options.stop->load()) return;
      Eigen::VectorXd x = at;
      x[0] = result.map.x[static_cast<std::size_t>(j)];
      x[1] = result.map.y[static_cast<std::size_t>(i)];
      const Evaluation e = evaluator.evaluate(x);
      result.simulations += static_cast<double>(evaluator.scenarios().size());
      if (e.usable) {
        result.map.objective(i, j) = e.objective;
        result.map.violation(i, j) = e.violation();
      }
      if (options.progress) options.progress("map", (i * n + j + 1.0) / (n * n));
    }
}

struct LineUse {
  double saturated = 0.0, speed = 0.0, pull = 0.0;
};

std::vector<LineUse> use_of_lines(const Specification& specification, const Trajectory& run) {
  std::vector<LineUse> uses;
  for (const TaglineSpec& line : specification.taglines) {
    LineUse use;
    const auto largest = [&](const char* quantity) {
      double value = 0.0;
      const int c = run.find(line.name + quantity);
      for (const auto& phase : run.extremes)
        value = std::max({value, std::abs(phase[static_cast<std::size_t>(c)].min),
                          std::abs(phase[static_cast<std::size_t>(c)].max)});
      return value;
    };
    use.speed = largest(".line_speed");
    use.pull = largest(".command");
    const auto& saturated = run.values[static_cast<std::size_t>(run.find(line.name + ".saturated"))];
    for (const double s : saturated) use.saturated += s / static_cast<double>(saturated.size());
    uses.push_back(use);
  }
  return uses;
}

std::vector<WinchDemand> winch_demands(const Evaluator& evaluator, const Case& tuned, const TuningOptions& options) {
  std::vector<WinchDemand> demands;
  for (const TaglineSpec& line : tuned.specification.taglines) {
    WinchDemand d;
    d.line = line.name;
    d.speed_limit = line.speed_max;
    d.pull_limit = line.tension_max;
    demands.push_back(d);
  }
  const std::vector<ScenarioSpec>& scenarios = evaluator.scenarios();
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    if (options.stop && options.stop->load()) break;
    const Specification real = in_scenario(tuned.specification, scenarios[s]);
    Specification ideal = real;
    for (TaglineSpec& line : ideal.taglines) {
      line.speed_max = 0.0;
      line.tension_max *= 1e3;
    }
    const auto uses = [](const Specification& specification) {
      const Model model = build_model(specification);
      return use_of_lines(specification, simulate(model, build_operation(model)));
    };
    const std::vector<LineUse> got = uses(real), wanted = uses(ideal);
    for (std::size_t k = 0; k < demands.size(); ++k) {
      demands[k].saturated += got[k].saturated / static_cast<double>(scenarios.size());
      demands[k].speed_wanted = std::max(demands[k].speed_wanted, wanted[k].speed);
      demands[k].pull_wanted = std::max(demands[k].pull_wanted, wanted[k].pull);
    }
    if (options.progress) options.progress("winches", (s + 1.0) / static_cast<double>(scenarios.size()));
  }
  return demands;
}

}  // namespace

Case tuning_case(const Case& c) {
  if (std::none_of(c.specification.taglines.begin(), c.specification.taglines.end(),
                   [](const TaglineSpec& line) { return line.active; }))
    throw CaseError(c.file + ": there is no active tagline to tune");
  if (c.plan.objective.empty())
    throw CaseError(c.file + ": [plan.objective] has no terms: there is nothing to tune for");
  Case tuned = c;
  tuned.plan.variables = c.tune.variables.empty() ? usual_gains(c) : c.tune.variables;
  return tuned;
}

GainTuning tune_gains(const Evaluator& evaluator, const TuningOptions& options) {
  GainTuning result;
  const TuneSpec& tune = evaluator.base().tune;
  result.start = result.gains = evaluator.baseline();
  const double scenarios = static_cast<double>(evaluator.scenarios().size());

  Evaluation best;
  Eigen::VectorXd best_x;
  SearchProblem smooth = evaluator.smooth_problem({});
  smooth.evaluate_with_gradient = [&](const Eigen::VectorXd& x) {
    const Evaluation e = evaluator.evaluate_smooth(x, {}, true);
    if (!e.interrupted) {
      const Evaluation as_is = evaluator.aggregated(evaluator.outcomes(e));
      if (best_x.size() == 0 || better(as_is, best, 0.0)) {
        best = as_is;
        best_x = x;
      }
    }
    return e;
  };
  smooth.evaluate = smooth.evaluate_with_gradient;
  SolveOptions with;
  with.solver = tune.algorithm;
  with.evaluations = tune.evaluations;
  with.seed = static_cast<unsigned long>(evaluator.base().plan.seed);
  with.x_tolerance = 1e-3;  // of the range: a gain is set to no more than that
  with.should_stop = [&] { return options.stop && options.stop->load(); };
  with.progress = [&](const SearchProgress& p) {
    if (options.progress) options.progress(p.stage, static_cast<double>(p.evaluations) / p.budget);
  };
  if (const std::string fault = solve_fault(smooth, with); !fault.empty()) throw CaseError("tune.algorithm: " + fault);
  result.report = solve(smooth, with);
  result.simulations += kGradientCharge * scenarios * result.report.evaluations;

  result.baseline = evaluator.evaluate(result.start);
  result.tuned = result.baseline;
  result.simulations += 2.0 * scenarios;
  if (best_x.size() > 0) {
    const Evaluation tuned = evaluator.evaluate(best_x);
    if (better(tuned, result.baseline, 0.0)) {
      result.tuned = tuned;
      result.gains = best_x;
      result.improved = true;
    }
  }
  if (result.report.status == SearchStatus::interrupted) return result;
  const Case tuned = evaluator.case_at(result.gains);
  if (options.progress) options.progress("swing", 0.0);
  result.before = swing_modes(evaluator.base().specification);
  result.after = swing_modes(tuned.specification);
  result.winches = winch_demands(evaluator, tuned, options);
  draw_map(evaluator, result.gains, options, result);
  return result;
}

}  // namespace stillhook
