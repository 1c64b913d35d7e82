#include "planner/verbs/plan/plan.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <filesystem>

#include "planner/cli/run_files.h"
#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/plan/certify.h"
#include "planner/verbs/plan/pareto.h"
#include "planner/verbs/plan/plan_results.h"
#include "planner/verbs/plan/sensitivity.h"
#include "planner/verbs/verbs.h"
#include "planner/version.h"
#include "results/judgement.h"

namespace stillhook {
namespace {

void check_algorithms(const Evaluator& evaluator) {
  const std::string fault = search_fault(evaluator.problem(), search_options(evaluator.base().plan));
  if (!fault.empty()) throw CaseError("plan: " + fault);
}

std::string progress_text(const SearchProgress& p) {
  const std::string best = !p.best->usable             ? "none yet"
                           : p.best->violation() > 0.0 ? fmt::format("{:.4f}, a limit is violated", p.best->objective)
                                                       : fmt::format("{:.4f}", p.best->objective);
  return fmt::format("{}: evaluation {} of {}, best {}", p.stage, p.evaluations, p.budget, best);
}

/// The plan in every scenario, one after the other in the list, several at a time.
std::vector<RunResult> run_scenarios(const Evaluator& evaluator, const Eigen::VectorXd& x) {
  const Case planned = evaluator.case_at(x);
  std::vector<RunResult> runs(evaluator.scenarios().size());
  std::vector<std::exception_ptr> errors(runs.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < runs.size(); ++i) {
    try {
      runs[i] = run_lift(prepare_run(planned, specification_at(evaluator, x, i)), evaluator.base().limits);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return runs;
}

/// Scenarios share most of what must be known.
void add_new(std::vector<std::string>& warnings, const std::vector<std::string>& more) {
  for (const std::string& warning : more)
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
}

/// Everything about the finished (or interrupted) search that goes into the folder and on the screen.
class Conclusion {
 public:
  Conclusion(const VerbRun& verb, const Evaluator& evaluator, const PlanResult& result,
             const std::optional<TracedFront>& front)
      : verb_(verb),
        folder_(verb.folder()),
        evaluator_(evaluator),
        result_(result),
        wall_(verb.wall()),
        search_(search_section(evaluator, result, wall_)) {
    if (!front) return;
    search_.pareto = front_drawing(*front);
    summary_of_front_ = front_summary(*front);
  }

  int finish() {
    if (result_.interrupted)
      describe_best();
    else if (result_.has_plan())
      run_best();
    else
      summary_.message = "no evaluation could be completed; the last said: " + result_.search.best.message;
    summary_.case_name = evaluator_.base().name;
    summary_.verb = "plan";
    summary_.program_version = kVersion;
    summary_.date = verb_.date();
    summary_.wall = wall_;
    add_search(evaluator_, result_, summary_);
    if (certificate_) summary_.certificate = certificate_summary(*certificate_);
    summary_.pareto = summary_of_front_;
    verb_.conclude(summary_json(summary_));
    if (verb_.prints()) print();
    return exit_code();
  }

 private:
  /// After an interruption there is no time to simulate: what the search itself knows.
  void describe_best() {
    summary_.status = RunStatus::interrupted;
    summary_.message = result_.search.evaluations == 0 ? "interrupted before the first evaluation was complete"
                                                       : "interrupted; --resume goes on from here";
    summary_.limits = deciding_limits(evaluator_, result_.search.best);
  }

  void run_best() {
    const Eigen::VectorXd& x = result_.search.best_x;
    std::vector<RunResult> runs = run_scenarios(evaluator_, x);
    const std::size_t governing = governing_scenario(evaluator_, result_.search.best);
    const Case planned = evaluator_.case_at(x);
    std::vector<std::vector<LimitCheck>> limits;
    std::vector<Metrics> metrics;
    std::vector<std::string> warnings;
    for (const RunResult& r : runs) {
      limits.push_back(r.limits);
      metrics.push_back(r.metrics);
      add_new(warnings, r.warnings);
    }
    RunResult run = std::move(runs[governing]);
    // What the page says of the cost is the search's; that of this one run is kept nowhere, so a rebuilt page lacks it.
    run.trajectory.wall = 0.0;
    run.limits = deciding_limits(evaluator_, limits);
    run.metrics = deciding_metrics(evaluator_, metrics, run.limits, governing);
    run.warnings = warnings;
    run.date = verb_.date();
    summary_ = summary_of(run, planned, "plan");
    write_history(folder_, run, planned, "plan");
    const Judgement judgement = judged_plan(x);
    std::filesystem::remove(folder_.judgement());  // of an earlier plan, before --resume
    if (!judgement.empty()) write_or_refuse([&] { write_judgement(judgement, folder_.judgement()); });
    search_.sensitivities = judgement.sensitivities;
    search_.certificate = judgement.certificate;
    search_.certificate_kept = judgement.certificate_kept;
    write_run_report(folder_, run, prepare_run(planned, run.specification), planned, verb_.statement(), &search_,
                     {history_note(evaluator_, governing)}, judgement.tables);
  }

  /// Sensitivities where the case follows gradients, certification where it asks for it.
  Judgement judged_plan(const Eigen::VectorXd& x) {
    Judgement judgement;
    const PlanSpec& plan = evaluator_.base().plan;
    if (plan.certify > 0) {
      spdlog::info("running plan and baseline in {} fresh conditions",
                   plan.certify * static_cast<int>(std::max<std::size_t>(1, plan.scenarios.size())));
      certificate_ = certify(evaluator_, x, &verb_.stop());
      judgement.tables = certificate_tables(*certificate_);
      judgement.certificate = certificate_sentence(*certificate_);
      judgement.certificate_kept = keeps_hard_limits(*certificate_);
    }
    if (plan.gradient_algorithm != "none") {
      const PlanSensitivities sensitivities = plan_sensitivities(evaluator_, x);
      if (!sensitivities.valid)
        summary_.warnings.push_back("the derivatives at the plan are not usable: no sensitivities");
      if (sensitivities.valid) {
        judgement.sensitivities = sensitivity_table(evaluator_, sensitivities);
        judgement.tables.push_back(price_table(sensitivities));
      }
    }
    return judgement;
  }

  void print() const {
    if (result_.search.evaluations > 0) fmt::print("{}\n", search_text(search_));
    if (certificate_) fmt::print("{}\n", certificate_text(*certificate_));
    if (summary_of_front_) fmt::print("{}\n", front_text(*summary_of_front_));
    if (result_.has_plan()) fmt::print("Plan: {}\n", folder_.plan());
    if (result_.has_plan() && !result_.interrupted) fmt::print("Report: {}\n", folder_.report());
  }

  int exit_code() const {
    if (result_.interrupted) {
      spdlog::warn("{}", summary_.message);
      return kInterrupted;
    }
    if (result_.search.feasible) return kDone;
    if (result_.has_plan())
      spdlog::warn("no plan within the limits was found; the plan written is the one that violates them the least");
    else
      spdlog::warn("no plan was found: {}", summary_.message);
    return kLimitViolated;
  }

  const VerbRun& verb_;
  const RunFolder& folder_;
  const Evaluator& evaluator_;
  const PlanResult& result_;
  double wall_;
  SearchSection search_;
  std::optional<Certificate> certificate_;
  std::optional<ParetoSummary> summary_of_front_;
  Summary summary_;
};

class PlanVerb final : public Verb {
 public:
  std::string name() const override { return "plan"; }
  std::string help() const override { return "Search for a better operation: plan, comparison, report"; }
  void add_options(VerbOptions& o) override;
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override {
    return {{"plan.toml", "The case with the plan in it."},
            {"evaluations.sqlite", "Every evaluation of the search, from which --resume goes on."},
            {"evaluations.sqlite-wal", "What SQLite keeps beside it while the search runs,"},
            {"evaluations.sqlite-shm", "and shares."},
            {"front.sqlite", "The same for a Pareto front."},
            {"front.sqlite-wal", "What SQLite keeps beside it,"},
            {"front.sqlite-shm", "and shares."},
            {"judgement.json", "Certificate, sensitivities and prices of the limits, for a report made again."}};
  }

 private:
  Case load(const CommonOptions& options) const;
  std::optional<TracedFront> front(const VerbRun& verb, const Evaluator& evaluator, PlanResult& result,
                                   Progress& progress) const;

  std::optional<int> evaluations_;
  std::optional<double> time_budget_;  // s
  bool resume_ = false;
};

void PlanVerb::add_options(VerbOptions& o) {
  o.add_case();
  o.add_folder();
  o.add_seed("Seed of the search");
  o.add({.name = "--evaluations",
         .target = &evaluations_,
         .operand = "N",
         .help = "Budget of evaluations",
         .range = std::pair(1.0, 1000000.0)});
  o.add({.name = "--time-budget",
         .target = &time_budget_,
         .operand = "S",
         .help = "Wall time for the search in s; the random search beside it may take as long again",
         .positive = true});
  o.add({.name = "--resume",
         .target = &resume_,
         .operand = "",
         .help = "Go on with the search that the folder holds",
         .excludes = "--force"});
}

Case PlanVerb::load(const CommonOptions& options) const {
  std::vector<Override> more;
  if (options.seed) more.push_back({"plan.seed", std::to_string(*options.seed)});
  if (evaluations_) more.push_back({"plan.evaluations", std::to_string(*evaluations_)});
  if (time_budget_) more.push_back({"plan.time_budget_s", fmt::format("{:.17g}", *time_budget_)});
  return load_case(options, more);
}

std::optional<TracedFront> PlanVerb::front(const VerbRun& verb, const Evaluator& evaluator, PlanResult& result,
                                           Progress& progress) const {
  const Case& c = evaluator.base();
  if (c.plan.pareto.first.empty() || result.interrupted || !result.has_plan()) return std::nullopt;
  const Evaluator of_front = front_evaluator(evaluator, result.baseline, &verb.stop());
  EvaluationStore store(verb.folder().front_store(), front_identity(c), of_front.problem());
  PlanOptions tracing;
  tracing.stop = &verb.stop();
  tracing.progress = [&](const SearchProgress& p) { progress.update(1.0, "front: " + progress_text(p)); };
  TracedFront traced = trace_front(of_front, result, store, tracing);
  if (traced.interrupted) result.interrupted = true;
  return traced;
}

int PlanVerb::run(const CommonOptions& options) {
  VerbRun verb(name(), options);
  const Case c = load(options);
  const Evaluator evaluator(c, &verb.stop());
  check_algorithms(evaluator);
  // A baseline that cannot be built is a fault of the case; only the points of a search are graded.
  print_warnings(scenario_warnings(evaluator, c, verb.panel_progress()));

  const RunFolder& folder = verb.open(c, resume_ ? std::optional(RunFolder::Mode::resume) : std::nullopt);
  EvaluationStore store(folder.store(), store_identity(c), evaluator.problem());
  if (resume_) spdlog::info("{} evaluations are in the store", store.size());
  verb.keep_case(c);

  Progress progress = verb.progress();
  PlanOptions with;
  with.stop = &verb.stop();
  with.progress = [&](const SearchProgress& p) {
    // The random sample takes as many evaluations as the search.
    const double half = p.stage == "random search" ? 0.5 : 0.0;
    progress.update(half + 0.5 * p.evaluations / p.budget, progress_text(p));
  };
  with.improved = [&](const Eigen::VectorXd& x) { verb.write_case(folder.plan(), evaluator.case_at(x)); };
  PlanResult result = solve_plan(evaluator, store, with);
  const std::optional<TracedFront> traced = front(verb, evaluator, result, progress);
  progress.clear();
  return Conclusion(verb, evaluator, result, traced).finish();
}

}  // namespace

std::unique_ptr<Verb> plan_verb() { return std::make_unique<PlanVerb>(); }

}  // namespace stillhook
