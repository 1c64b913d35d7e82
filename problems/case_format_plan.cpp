// Limits, the search and the tuning.
#include "problems/case_format.h"

namespace stillhook {
namespace {

const Table& objective_table() {
  static const Table table = [] {
    using S = ObjectiveTerm;
    TableOf<S> t("plan.objective", "One term, weight * metric / scale, under the metric's name.");
    t.number("weight", &S::weight, unit::one, any_value(), "Weight.");
    t.number("scale", &S::scale, unit::one, positive(), "A step of this size in the metric's unit counts as 1.");
    return t.build();
  }();
  return table;
}

const Table& variable_table() {
  static const Table table = [] {
    using S = VariableSpec;
    TableOf<S> t(
        "plan.variables",
        "A numeric key that the search may change, by its dotted key; entries of arrays by name, `*` for all of them.");
    t.number("min", &S::lower, unit::one, any_value(), "Lower bound, in the key's unit.").require();
    t.number("max", &S::upper, unit::one, any_value(), "Upper bound.").require();
    t.boolean("logarithmic", &S::logarithmic, "Search over its logarithm.");
    t.number("start", &S::start, unit::one, any_value(),
             "A guess, in the key's unit. The search begins from the case as it is and from the point of all guesses.")
        .absent("the case's own value");
    return t.build();
  }();
  return table;
}

const Table& scenario_table() {
  static const Table table = [] {
    using S = ScenarioSpec;
    TableOf<S> t("plan.scenarios", "A condition that every plan is evaluated in: a sea state with changes.");
    t.name("name", &S::name, "Name.");
    t.text("sea", &S::sea, "Sea state.").names(Reference::sea_state).require();
    t.number("heading_deg", &S::heading, unit::deg, Range{-360.0, 360.0, false}, "Heading instead of the state's.")
        .absent("the state's");
    t.number("phase_deg", &S::phase, unit::deg, any_value(), "Phase instead of the state's, regular waves.")
        .absent("the state's");
    t.integer("seed", &S::seed, Range{0, 2147483647, false}, "Seed instead of the state's, of irregular waves and of gusts that follow them.")
        .absent("the state's");
    t.integer("seeds", &S::seeds, Range{1, 10000, false}, "Irregular waves and gusts: so many seeds, from `seed` on.");
    t.integer("phases", &S::phases, Range{1, 1000, false},
              "Regular waves: so many phases, evenly spaced from `phase_deg` on.");
    t.number("weight", &S::weight, unit::one, positive(),
             "Weight in the mean over scenarios, of all its seeds together.");
    return t.build();
  }();
  return table;
}

const Table& pareto_table() {
  static const Table table = [] {
    using S = ParetoSpec;
    TableOf<S> t(
        "plan.pareto",
        "The front between two metrics that cannot both be had, traced when the plan is found; smaller is better "
        "in both, and each counts with its largest value over the scenarios.");
    t.text("first", &S::first, "Metric whose limit is moved along the front.").require();
    t.text("second", &S::second, "Metric that is minimised.").require();
    t.integer("points", &S::points, Range{2, 1000, false}, "Points of the front, its two ends included.");
    t.integer("evaluations", &S::evaluations, Range{2, 100000, false}, "Budget of evaluations for each point.");
    return t.build();
  }();
  return table;
}

}  // namespace

const Table& limit_table() {
  static const Table table = [] {
    using S = LimitSpec;
    TableOf<S> t("limits", "A limit on a metric, under the metric's name.");
    t.number("max", &S::max, unit::one, any_value(), "Largest value allowed, in the metric's unit.").absent("none");
    t.number("min", &S::min, unit::one, any_value(), "Smallest value allowed.").absent("none");
    t.text("source", &S::source, "Where the number comes from; printed in every report.").require();
    t.number("share", &S::share, unit::one, between(0.0, 0.5),
             "Share of a search's scenarios that may break it; the verdict on one run knows no such share.");
    t.boolean("hard", &S::hard, "A violation fails the lift; otherwise it is a warning.");
    return t.build();
  }();
  return table;
}

const Table& plan_table() {
  static const Table table = [] {
    using S = PlanSpec;
    TableOf<S> t("plan",
                 "The search: minimise the objective over the variables, within the limits, in every scenario.");
    t.map("objective", &S::objective, &ObjectiveTerm::metric, &objective_table, "Terms, by metric.");
    t.map("variables", &S::variables, &VariableSpec::key, &variable_table, "Design variables, by key.");
    t.tables("scenarios", &S::scenarios, "name", &scenario_table, "Scenarios.").absent("sea.active alone");
    t.choice<decltype(&S::aggregate), S::Aggregate>(
        "aggregate", &S::aggregate,
        {{"mean", S::Aggregate::mean}, {"worst", S::Aggregate::worst}, {"tail", S::Aggregate::tail}},
        "Of the objective over scenarios: mean, the worst one, or the mean "
        "of a worst share of them (CVaR). Limits hold in each.");
    t.number("tail_share", &S::tail_share, unit::one, between(0.01, 1.0), "Share of the scenarios that the tail is.")
        .only_when("aggregate", {"tail"});
    t.text("global_algorithm", &S::global_algorithm,
           "Algorithm of the first part, of NLopt: `isres`, `orig_direct`, `orig_direct_l`; without hard limits also "
           "`crs2`, "
           "`esch`, `direct`, `direct_l`; or `none`.");
    t.text("local_algorithm", &S::local_algorithm,
           "Algorithm of the second part, of NLopt: `cobyla`; without hard limits also `bobyqa`, `sbplx`, "
           "`neldermead`; or `none`.");
    t.number("global_share", &S::global_share, unit::one, between(0.0, 1.0),
             "Share of the evaluations for the first part.");
    t.integer("evaluations", &S::evaluations, Range{1, 1000000, false}, "Budget of evaluations.");
    t.text(
        "gradient_algorithm", &S::gradient_algorithm,
        "Algorithm of a stage before the first part that follows exact gradients of smooth metrics: `slsqp`, `ipopt`, "
        "`ccsaq`, `mma`, `lbfgs`; or `none`.");
    t.integer("gradient_evaluations", &S::gradient_evaluations, Range{1, 100000, false},
              "Budget of that stage, points with gradient.");
    t.boolean("random_search", &S::random_search,
              "After the search, a random search with as many evaluations, for comparison.");
    t.integer("certify", &S::certify, Range{0, 100000, false},
              "The finished plan is tried in so many fresh seeds (or wave phases) of each scenario; 0 = not.");
    t.table("pareto", &S::pareto, &pareto_table, "A front between two metrics.").absent("none");
    t.number("time_budget_s", &S::time_budget, unit::s, positive(), "Wall time; gives up reproducibility.")
        .absent("none");
    t.integer("seed", &S::seed, Range{0, 2147483647, false}, "Seed of the search.");
    return t.build();
  }();
  return table;
}

const Table& tune_table() {
  static const Table table = [] {
    using S = TuneSpec;
    TableOf<S> t("tune", "Tuning of tagline gains: the plan's objective, limits and scenarios over few variables.");
    t.map("variables", &S::variables, &VariableSpec::key, &variable_table, "Gains to be tuned, by key.")
        .absent("kp and kd of all taglines together");
    t.text("algorithm", &S::algorithm,
           "Algorithm: with exact gradients `slsqp`, `ipopt`, `ccsaq`, `mma`; without `cobyla`; or `auto`.");
    t.integer("evaluations", &S::evaluations, Range{1, 100000, false}, "Budget of points.");
    t.text("phase", &S::phase, "This phase alone, begun at rest.")
        .names(Reference::phase)
        .absent("the whole operation");
    t.text("pose", &S::pose, "Instead: at rest in the pose that this phase ends in.")
        .names(Reference::phase)
        .absent("the whole operation");
    t.number("hold_s", &S::hold, unit::s, positive(), "How long in that pose.");
    t.boolean("schedule", &S::schedule,
              "Whether factors on the gains over the fall length are tuned too, after the gains.");
    t.integer("map", &S::map, Range{0, 200, false},
              "Points along each side of a map of the objective over the first two variables; 0 = no map.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
