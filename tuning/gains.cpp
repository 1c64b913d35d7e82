#include "tuning/gains.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "problems/case_key.h"
#include "problems/scenarios.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"
#include "sim/simulate.h"
#include "tuning/meeting_keys.h"

namespace stillhook {
namespace {

/// Kp and Kd of all lines together, up to gains that ask for the full pull at two degrees, or two degrees a second.
std::vector<VariableSpec> usual_gains(const Case& c) {
  double pull = 0.0;
  for (const TaglineSpec& line : c.specification.taglines) pull = std::max(pull, line.tension_max);
  const double kN = pull / 1000.0;
  return {
      {"taglines.*.kp_kN_per_deg", 0.0, std::max(0.5 * kN, 1.2 * key_value(c, "taglines.*.kp_kN_per_deg")), false, {}},
      {"taglines.*.kd_kN_s_per_deg", 0.0, std::max(2.0 * kN, 1.2 * key_value(c, "taglines.*.kd_kN_s_per_deg")), false, {}}};
}

/// Gains within the bounds that [plan.variables] sets for them: outside, no case can be read, neither a point of the
/// search nor the tuned case. A variable with a guess of its own may have its value in the case anywhere.
void keep_within_plan(const Case& c, std::vector<VariableSpec>& gains) {
  for (VariableSpec& gain : gains)
    for (const VariableSpec& planned : c.plan.variables) {
      if (planned.start || !may_meet(gain.key, planned.key)) continue;
      gain.lower = std::max(gain.lower, planned.lower);
      gain.upper = std::min(gain.upper, planned.upper);
      if (!(gain.lower < gain.upper))
        throw CaseError(fmt::format(
            "{}: [tune.variables.\"{}\"] and [plan.variables.\"{}\"] have no range in common; widen one of them", c.file,
            gain.key, planned.key));
    }
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
    const auto largest = [&](const ChannelKind<TaglineSpec>& quantity) {
      double value = 0.0;
      const int c = run.find(quantity.of(line));
      for (const auto& phase : run.extremes) {
        const Extreme& e = phase[static_cast<std::size_t>(c)];
        if (e.min <= e.max)
          value = std::max({value, std::abs(e.min), std::abs(e.max)});  // a phase of no length has none
      }
      return value;
    };
    use.speed = largest(tagline_channels::line_speed);
    use.pull = largest(tagline_channels::command);
    const auto& saturated = run.values[static_cast<std::size_t>(run.find(tagline_channels::saturated.of(line)))];
    for (const double s : saturated) use.saturated += s / static_cast<double>(saturated.size());
    uses.push_back(use);
  }
  return uses;
}

Trajectory run_part(const Specification& specification, const OperationPart& part) {
  const Model model = build_model(specification);
  const Operation operation = build_operation(model);
  if (part.whole()) return simulate(model, operation);
  const SystemState start = start_of(operation, part);
  RunOptions options;
  options.from = &start;
  return simulate(model, part_of(operation, part), options);
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
    const auto uses = [&](const Specification& specification) {
      return use_of_lines(specification, run_part(specification, evaluator.base().plan.part));
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

OperationPart part_to_tune(const Case& c) {
  const TuneSpec& tune = c.tune;
  if (tune.phase.empty() && tune.pose.empty()) return {};
  if (!tune.phase.empty() && !tune.pose.empty())
    throw CaseError(c.file + ": [tune] phase and pose: one of them, not both");
  const std::string& name = tune.pose.empty() ? tune.phase : tune.pose;
  const std::vector<PhaseSpec>& phases = c.specification.operation.phases;
  const auto at = std::find_if(phases.begin(), phases.end(), [&](const PhaseSpec& p) { return p.name == name; });
  if (at == phases.end()) throw CaseError(c.file + ": [tune] there is no phase '" + name + "'");
  return {static_cast<int>(at - phases.begin()), tune.pose.empty() ? 0.0 : tune.hold};
}

/// Removes objective terms and limits that this part of the operation never produces.
std::vector<std::string> leave_out(Case& c) {
  const Evaluator trial(c);
  const std::vector<ScenarioOutcome> outcomes = trial.outcomes(trial.evaluate(trial.baseline()));
  for (const ScenarioOutcome& o : outcomes)
    if (o.status != RunStatus::completed) throw CaseError(c.file + ": the part to be tuned does not run: " + o.message);
  std::vector<std::string> names;
  const auto missing = [&](const std::string& metric) {
    const bool none = std::any_of(outcomes.begin(), outcomes.end(),
                                  [&](const ScenarioOutcome& o) { return !std::isfinite(trial.metric_of(o, metric)); });
    if (none && std::find(names.begin(), names.end(), metric) == names.end()) names.push_back(metric);
    return none;
  };
  std::erase_if(c.plan.objective, [&](const ObjectiveTerm& term) { return missing(term.metric); });
  std::erase_if(c.limits, [&](const LimitSpec& limit) { return limit.hard && missing(limit.metric); });
  if (c.plan.objective.empty())
    throw CaseError(c.file + ": no term of [plan.objective] has a value in the part to be tuned");
  return names;
}

struct Best {
  SearchReport report;
  Eigen::VectorXd x;  // the best by the metrics as they are; empty if none
};

/// The smooth problem with exact gradients; what counts in the end are the metrics as they are.
Best search(const Evaluator& evaluator, const TuneSpec& tune, const std::string& stage, const TuningOptions& options) {
  Best best;
  Evaluation at_best;
  SearchProblem smooth = evaluator.smooth_problem({});
  smooth.evaluate_with_gradient = [&](const Eigen::VectorXd& x) {
    const Evaluation e = evaluator.evaluate_smooth(x, {}, true);
    if (!e.interrupted) {
      const Evaluation as_is = evaluator.aggregated(evaluator.outcomes(e));
      if (best.x.size() == 0 || better(as_is, at_best, 0.0)) {
        at_best = as_is;
        best.x = x;
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
    if (options.progress) options.progress(stage + p.stage, static_cast<double>(p.evaluations) / p.budget);
  };
  if (const std::string fault = solve_fault(smooth, with); !fault.empty()) throw CaseError("tune.algorithm: " + fault);
  best.report = solve(smooth, with);
  return best;
}

/// Shortest and longest fall of the taglines while the load hangs on connected lines, m.
std::pair<double, double> fall_range(const Case& c, const OperationPart& part) {
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  const auto& lines = c.specification.taglines;
  const auto line = std::find_if(lines.begin(), lines.end(), [](const TaglineSpec& t) { return t.active; });
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  bool connected = line->active_from.empty();
  for (std::size_t p = 0; p < operation.phases.size(); ++p) {
    connected = connected || operation.phases[p].name == line->active_from;
    if (!connected || operation.phases[p].stage != PhaseSpec::Stage::hanging) continue;
    if (!part.whole() && static_cast<int>(p) != part.phase) continue;
    for (const std::size_t pose : {p, p + 1}) {
      if (part.hold > 0.0 && pose == p) continue;
      const double length = operation.static_poses[pose].values.at(wire_channels::length.of(line->wire));
      low = std::min(low, length);
      high = std::max(high, length);
    }
  }
  return {low, high};
}

GainSchedule tune_schedule(const Evaluator& evaluator, const GainTuning& pair, const TuningOptions& options,
                           double& simulations) {
  constexpr double kChange = 1.02;  // of the fall length that is worth a schedule
  constexpr double kWorth = 0.01;   // of the objective
  GainSchedule s;
  const Case tuned = evaluator.case_at(pair.gains);
  const auto [low, high] = fall_range(tuned, evaluator.base().plan.part);
  if (!(high > kChange * low)) {
    s.message = "the falls hardly change their length while the lines act: there is nothing to schedule";
    return s;
  }
  std::vector<Override> overrides = tuned.overrides;
  for (const TaglineSpec& line : tuned.specification.taglines)
    overrides.push_back({"taglines." + line.name + ".gain_schedule",
                         "[{ name = \"short\", fall_m = " + std::to_string(low) +
                             " }, { name = \"long\", fall_m = " + std::to_string(high) + " }]"});
  Case scheduled = read_case_text(tuned.text, tuned.file, tuned.directory, overrides);
  scheduled.plan = evaluator.base().plan;
  scheduled.limits = evaluator.base().limits;
  scheduled.plan.variables.clear();
  for (const char* point : {"short", "long"})
    for (const char* gain : {"kp_factor", "kd_factor"})
      scheduled.plan.variables.push_back(
          {std::string("taglines.*.gain_schedule.") + point + "." + gain, 0.2, 5.0, false, {}});
  const Evaluator with(scheduled, evaluator.scenarios(), options.stop);
  const Best best = search(with, evaluator.base().tune, "schedule, ", options);
  simulations += static_cast<double>(evaluator.scenarios().size()) * (kGradientCharge * best.report.evaluations + 1.0);
  const Eigen::VectorXd x = best.x.size() > 0 ? best.x : with.baseline();
  s.evaluation = with.evaluate(x);
  s.points = {{"short", low, x[0], x[1]}, {"long", high, x[2], x[3]}};
  s.worth_it = s.evaluation.usable && s.evaluation.violation() <= std::max(0.0, pair.tuned.violation()) &&
               s.evaluation.objective < pair.tuned.objective - kWorth * std::abs(pair.tuned.objective);
  s.scheduled = with.case_at(x);
  return s;
}

}  // namespace

Case tuning_case(const Case& c, std::vector<std::string>* left_out) {
  if (std::none_of(c.specification.taglines.begin(), c.specification.taglines.end(),
                   [](const TaglineSpec& line) { return line.active; }))
    throw CaseError(c.file + ": there is no active tagline to tune");
  if (c.plan.objective.empty())
    throw CaseError(c.file + ": [plan.objective] has no terms: there is nothing to tune for");
  Case tuned = c;
  tuned.plan.variables = c.tune.variables.empty() ? usual_gains(c) : c.tune.variables;
  keep_within_plan(c, tuned.plan.variables);
  tuned.plan.part = part_to_tune(c);
  if (!tuned.plan.part.whole()) {
    const std::vector<std::string> names = leave_out(tuned);
    if (left_out) *left_out = names;
  }
  return tuned;
}

GainTuning tune_gains(const Evaluator& evaluator, const TuningOptions& options) {
  GainTuning result;
  const TuneSpec& tune = evaluator.base().tune;
  result.start = result.gains = evaluator.baseline();
  const double scenarios = static_cast<double>(evaluator.scenarios().size());

  const Best best = search(evaluator, tune, "", options);
  result.report = best.report;
  result.simulations += kGradientCharge * scenarios * result.report.evaluations;

  result.baseline = evaluator.evaluate(result.start);
  result.tuned = result.baseline;
  result.simulations += 2.0 * scenarios;
  if (best.x.size() > 0) {
    const Evaluation tuned = evaluator.evaluate(best.x);
    if (better(tuned, result.baseline, 0.0)) {
      result.tuned = tuned;
      result.gains = best.x;
      result.improved = true;
    }
  }
  if (result.report.status == SearchStatus::interrupted) return result;
  const Case tuned = evaluator.case_at(result.gains);
  if (options.progress) options.progress("swing", 0.0);
  SwingOptions swing;
  swing.phase = evaluator.base().plan.part.phase;
  result.before = swing_modes(evaluator.base().specification, swing);
  result.after = swing_modes(tuned.specification, swing);
  result.winches = winch_demands(evaluator, tuned, options);
  if (tune.schedule && result.tuned.usable)
    result.schedule = tune_schedule(evaluator, result, options, result.simulations);
  draw_map(evaluator, result.gains, options, result);
  return result;
}

}  // namespace stillhook
