#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"
#include "problems/search/solvers.h"
#include "results/metrics.h"

namespace stillhook {
namespace {

class PlanCheck {
 public:
  PlanCheck(const Case& c, const Node& root, Findings& findings) : case_(c), root_(root), findings_(findings) {}

  void run() {
    for (const LimitSpec& limit : case_.limits) check_limit(limit);
    for (const ObjectiveTerm& term : case_.plan.objective)
      wants_metric("plan.objective." + as_step(term.metric), term.metric);
    check_plan_as_a_whole();
    check_pareto();
    check_algorithm("global_algorithm", case_.plan.global_algorithm, true);
    check_algorithm("local_algorithm", case_.plan.local_algorithm, false);
    for (const VariableSpec& variable : case_.plan.variables) check_variable(variable);
    for (const ScenarioSpec& scenario : case_.plan.scenarios) check_scenario(scenario);
  }

 private:
  void report(const std::string& entry, const std::string& key, const std::string& sentence) {
    findings_.add(position_of_key(root_, entry, key), entry, key, sentence);
  }

  void wants_metric(const std::string& entry, const std::string& metric) {
    if (metric_exists(metric, case_.specification)) return;
    report(entry, "", fmt::format("there is no metric \"{}\" in this lift{}", metric, metrics_instead(metric)));
  }

  /// The nearest names; without one all that belong to no element.
  std::string metrics_instead(const std::string& metric) const {
    const std::vector<std::string> names = metric_names(case_.specification);
    if (const auto near = nearest(metric, names)) return fmt::format(", did you mean \"{}\"?", *near);
    std::vector<std::string> some;
    const std::string first_word = metric.substr(0, metric.find_first_of("._"));
    for (const std::string& name : names)
      if (name.find(first_word) != std::string::npos) some.push_back(name);
    if (some.empty())
      for (const std::string& name : names)
        if (name.find('.') == std::string::npos) some.push_back(name);
    return fmt::format("; there are {} (`stillhook schema --metrics` explains all)", fmt::join(some, ", "));
  }

  void check_limit(const LimitSpec& limit) {
    const std::string entry = "limits." + as_step(limit.metric);
    wants_metric(entry, limit.metric);
    if (!limit.max && !limit.min) report(entry, "", "needs max, min or both");
    if (limit.max && limit.min && *limit.min > *limit.max)
      report(entry, "min", fmt::format("must be at most max {:.6g}, got {:.6g}", *limit.max, *limit.min));
  }

  void check_plan_as_a_whole() {
    const bool has_variables = !case_.plan.variables.empty(), has_terms = !case_.plan.objective.empty();
    if (has_variables && !has_terms) report("plan", "objective", "has no terms: there is nothing to minimise");
    if (has_terms && !has_variables) report("plan", "variables", "has no keys: there is nothing to search over");
  }

  void check_pareto() {
    const ParetoSpec& p = case_.plan.pareto;
    if (p.first.empty() && p.second.empty()) return;  // absent, or refused already
    const std::string entry = "plan.pareto";
    if (p.first == p.second) report(entry, "second", "is the first metric: a front needs two");
    for (const auto& [key, metric] : {std::pair("first", p.first), std::pair("second", p.second)}) {
      if (metric.empty()) continue;
      wants_metric(entry, metric);
      if (better_when_larger(metric))
        report(entry, key,
               fmt::format("is better when larger; a front is drawn of metrics that are better when smaller, "
                           "got \"{}\"",
                           metric));
    }
    if (case_.plan.variables.empty()) report(entry, "first", "needs [plan.variables]: there is nothing to search over");
  }

  void check_algorithm(const std::string& key, const std::string& name, bool global) {
    if (name == "none") return;
    const bool constrained = std::any_of(case_.limits.begin(), case_.limits.end(),
                                         [](const LimitSpec& limit) { return limit.hard && (limit.max || limit.min); });
    if (const std::string fault = algorithm_fault(name, global, {.inequalities = constrained}); !fault.empty())
      report("plan", key, fault);
  }

  void check_variable(const VariableSpec& v) {
    const std::string entry = "plan.variables." + as_step(v.key);
    if (v.logarithmic && !(v.lower > 0.0))
      report(entry, "min", fmt::format("must be > 0 for a logarithmic variable, got {:.6g}", v.lower));
    if (v.start && !(v.lower <= *v.start && *v.start <= v.upper))
      report(entry, "start", fmt::format("must lie in [{:.6g}, {:.6g}], got {:.6g}", v.lower, v.upper, *v.start));
    check_varied_key({entry, v.key, v.lower, v.upper, std::nullopt}, root_, findings_);
  }

  void check_scenario(const ScenarioSpec& scenario) {
    const std::string entry = "plan.scenarios." + scenario.name;
    for (const SeaStateSpec& state : case_.specification.sea.states) {
      if (state.name != scenario.sea) continue;
      const bool regular = state.type == SeaStateSpec::Type::regular;
      if (scenario.phase && !regular) report(entry, "phase_deg", "has a meaning only with a regular sea");
      if (scenario.seed && !state.seeded() && !case_.specification.wind.follows_seed())
        report(entry, "seed", "has a meaning only with an irregular sea, or with gusts that have no seed of their own");
      if (scenario.heading && !state.has_heading() && state.type != SeaStateSpec::Type::calm)
        report(entry, "heading_deg", "has a meaning only with a sea of one direction, and " + state.name + " has several");
    }
  }

  const Case& case_;
  const Node& root_;
  Findings& findings_;
};

}  // namespace

void check_plan(const Case& c, const Node& root, Findings& findings) { PlanCheck(c, root, findings).run(); }

}  // namespace stillhook
