#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "planner/cli/commands.h"
#include "planner/cli/hydro_progress.h"
#include "planner/cli/interrupt.h"
#include "planner/cli/progress.h"
#include "planner/cli/tables.h"
#include "planner/document_control.h"
#include "planner/plan_results.h"
#include "planner/tune_report.h"
#include "results/files.h"

namespace stillhook {
namespace {

void print_tuning(const Evaluator& evaluator, const GainTuning& result, const std::vector<std::string>& left_out) {
  if (const std::string scope = tuning_scope(evaluator); !scope.empty()) fmt::print("{}\n", scope);
  if (!left_out.empty())
    fmt::print("Left out, because this part of the operation does not have it: {}\n", fmt::join(left_out, ", "));
  fmt::print("{}\n\n{}", tuning_verdict(result), table_text(gain_table(evaluator, result)));
  if (result.schedule) fmt::print("\n{}\n", schedule_verdict(result));
  for (const ReportTable& table : {schedule_table(result), swing_table(result), winch_table(result)})
    if (!table.rows.empty()) fmt::print("\n{}", table_text(table));
}

}  // namespace

int run_tune(const CommonOptions& options, const TuneArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string date = date_now();
  const std::atomic<bool>& stop = catch_interrupts();
  std::vector<Override> more;
  if (options.seed) more.push_back({"plan.seed", std::to_string(*options.seed)});
  if (arguments.evaluations) more.push_back({"tune.evaluations", std::to_string(*arguments.evaluations)});
  if (arguments.map) more.push_back({"tune.map", std::to_string(*arguments.map)});
  if (!arguments.phase.empty()) more.push_back({"tune.phase", "\"" + arguments.phase + "\""});
  if (!arguments.pose.empty()) more.push_back({"tune.pose", "\"" + arguments.pose + "\""});
  if (arguments.hold) more.push_back({"tune.hold_s", fmt::format("{}", *arguments.hold)});
  if (arguments.schedule) more.push_back({"tune.schedule", "true"});
  const Case c = load_case(options, more);
  const std::string statement = statement_of(options.input);
  std::vector<std::string> left_out;
  const Evaluator evaluator(tuning_case(c, &left_out), &stop);
  // A baseline that cannot be built is a fault of the case; only the points of a search are graded.
  const std::vector<std::string> gaps = scenario_warnings(evaluator, c, panel_method_progress(options.quiet, &stop));
  print_warnings(gaps);
  const RunFolder folder(folder_path(options, c, "tune"),
                         options.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh);
  write_or_refuse([&] { write_file(folder.case_file(), case_text(c, statement)); });
  Progress progress = stderr_progress(options.quiet);
  TuningOptions with;
  with.stop = &stop;
  with.progress = [&](const std::string& stage, double share) { progress.update(share, "tune: " + stage); };
  const GainTuning result = tune_gains(evaluator, with);
  progress.clear();

  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  Summary summary = tuning_summary(evaluator, result, wall.count());
  const std::vector<std::string> found = summary.warnings;
  summary.warnings.insert(summary.warnings.begin(), gaps.begin(), gaps.end());
  summary.date = date;
  const bool interrupted = summary.status == RunStatus::interrupted;
  const bool scheduled = result.schedule && result.schedule->worth_it;
  const Case tuned = scheduled ? *result.schedule->scheduled : evaluator.case_at(result.gains);
  if (result.improved || scheduled) write_or_refuse([&] { write_file(folder.tuned(), case_text(tuned, statement)); });
  const DocumentControl control = document_control(c, date, folder.case_file());
  if (!interrupted)
    write_or_refuse([&] { write_file(folder.report(), tuning_report(evaluator, result, control, summary.warnings)); });
  write_or_refuse([&] { write_summary(summary, folder.summary()); });
  print_warnings(found);
  if (options.json) {
    fmt::print("{}\n", summary_json(summary));
  } else if (!options.quiet) {
    print_tuning(evaluator, result, left_out);
    if (result.improved || scheduled) fmt::print("\nTuned case: {}\n", folder.tuned());
    if (!interrupted) fmt::print("Report: {}\n", folder.report());
  }
  if (interrupted) {
    spdlog::warn("interrupted; the best gains so far are kept");
    return kInterrupted;
  }
  if (summary.status == RunStatus::failed) return kLimitViolated;
  if (!result.baseline.usable && !result.tuned.usable) return kNumericalFailure;
  return result.tuned.violation() > 0.0 ? kLimitViolated : kDone;
}

}  // namespace stillhook
