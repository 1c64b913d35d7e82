#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "planner/cli/run_files.h"
#include "planner/verbs/plan/pareto.h"
#include "planner/verbs/plan/plan_results.h"
#include "planner/verbs/verbs.h"
#include "results/archive.h"
#include "results/judgement.h"

namespace stillhook {
namespace {

void rebuild_run(const RunFolder& folder, const Case& c, const std::string& statement) {
  Trajectory trajectory = open_archive(folder.history());
  // The archive of a run does not depend on machine and day; how long it took, and when, is in the summary, if the run
  // came so far.
  std::string date;
  if (std::filesystem::exists(folder.summary())) {
    const Summary summary = read_summary(folder.summary());
    trajectory.wall = summary.wall;
    date = summary.date;
  }
  RunResult run = judged(c.specification, std::move(trajectory), c.limits);
  run.date = date;
  if (run.trajectory.status == RunStatus::interrupted) spdlog::warn("{}", run.trajectory.message);
  write_run_report(folder, run, prepare_run(c, c.specification), c, statement);
}

void rebuild_plan(const RunFolder& folder, const Case& c, const std::string& statement) {
  const Evaluator evaluator(c);
  EvaluationStore store(folder.store(), store_identity(c), evaluator.problem());
  const PlanResult result = replay_plan(evaluator, store);
  if (!result.has_plan()) throw UsageError(folder.path() + ": its search has found no plan to report");
  const std::size_t governing = governing_scenario(evaluator, result.search.best);
  const Case planned = evaluator.case_at(result.search.best_x);
  RunResult run =
      judged(specification_at(evaluator, result.search.best_x, governing), open_archive(folder.history()), c.limits);
  // The folder holds the history of one scenario; what was decided over all of them is in its summary.
  if (std::filesystem::exists(folder.summary())) {
    const Summary summary = read_summary(folder.summary());
    run.metrics = summary.metrics;
    run.limits = summary.limits;
    run.warnings = summary.warnings;
    run.date = summary.date;
  } else {
    run.metrics = deciding_metrics(evaluator, result.search.best);
    run.limits = deciding_limits(evaluator, result.search.best);
  }
  SearchSection search = search_section(evaluator, result, SearchSection::kNone);
  if (std::filesystem::exists(folder.front_store())) {
    const Evaluator of_front = front_evaluator(evaluator, result.baseline, nullptr);
    EvaluationStore front_store(folder.front_store(), front_identity(c), of_front.problem());
    search.pareto = front_drawing(replay_front(of_front, result, front_store));
  }
  Judgement judgement;
  if (std::filesystem::exists(folder.judgement()))
    judgement = read_judgement(folder.judgement());
  else if (c.plan.certify > 0 || c.plan.gradient_algorithm != "none")
    spdlog::warn("the rebuilt report has no certificate and no sensitivities: {} is missing (`plan --resume` makes it)",
                 folder.judgement());
  search.sensitivities = judgement.sensitivities;
  search.certificate = judgement.certificate;
  search.certificate_kept = judgement.certificate_kept;
  write_run_report(folder, run, prepare_run(planned, run.specification), planned, statement, &search,
                   {history_note(evaluator, governing)}, judgement.tables);
}

class ReportVerb final : public Verb {
 public:
  std::string name() const override { return "report"; }
  std::string help() const override { return "Rebuild the report of a run folder"; }
  void add_options(VerbOptions& o) override {
    o.add_run_folder("Folder that simulate or plan has written");
    o.add_messages("No messages but errors");
  }
  int run(const CommonOptions& options) override;
};

int ReportVerb::run(const CommonOptions& options) {
  if (!std::filesystem::exists(options.input)) throw UsageError(options.input + ": there is no such folder");
  const RunFolder folder(options.input, RunFolder::Mode::read);
  for (const std::string& file : {folder.case_file(), folder.history()})
    if (!std::filesystem::exists(file))
      throw UsageError(file + ": is missing, this is not the folder of a finished run");
  const Case c = read_case(folder.case_file());
  const std::string statement = statement_of(folder.case_file());
  if (std::filesystem::exists(folder.store()))
    rebuild_plan(folder, c, statement);
  else
    rebuild_run(folder, c, statement);
  fmt::print("{}\n", folder.report());
  return kDone;
}

}  // namespace

std::unique_ptr<Verb> report_verb() { return std::make_unique<ReportVerb>(); }

}  // namespace stillhook
