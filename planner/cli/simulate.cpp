#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "planner/cli/commands.h"
#include "planner/cli/hydro_progress.h"
#include "planner/cli/interrupt.h"
#include "planner/cli/progress.h"
#include "planner/cli/run_files.h"
#include "planner/cli/tables.h"
#include "planner/document_control.h"
#include "results/files.h"

namespace stillhook {
namespace {

/// --seed chooses the waves: it is the seed of the active sea, if that is irregular.
Case load_with_sea_seed(const CommonOptions& options) {
  Case c = load_case(options);
  if (!options.seed) return c;
  using Type = SeaStateSpec::Type;
  const SeaSpec& sea = c.specification.sea;
  for (const SeaStateSpec& state : sea.states)
    if (state.name == sea.active && (state.type == Type::jonswap || state.type == Type::pierson_moskowitz))
      return load_case(options, {{"sea.states." + sea.active + ".seed", std::to_string(*options.seed)}});
  throw UsageError("--seed: the active sea \"" + sea.active + "\" is not irregular, it has no seed");
}

int exit_code(const RunResult& run) {
  switch (run.metrics.status) {
    case RunStatus::completed:
      return run.passed() ? kDone : kLimitViolated;
    case RunStatus::failed:
      return kLimitViolated;
    case RunStatus::interrupted:
      return kInterrupted;
    case RunStatus::diverged:
      return kNumericalFailure;
    case RunStatus::not_run:
      break;
  }
  return kBug;
}

void print_run(const Summary& summary, const RunFolder& folder) {
  fmt::print("{}: {} in {}, {:.0f} s simulated in {:.2f} s ({:.0f} times real time)\n\n{}\n{}\n{}\nReport: {}\n",
             summary.case_name, status_name(summary.status), summary.sea.empty() ? "calm water" : "sea " + summary.sea,
             summary.simulated, summary.wall, summary.simulated / summary.wall, metrics_text(summary.metrics),
             limits_text(summary.limits), verdict_text(summary.metrics, summary.limits), folder.report());
}

}  // namespace

int run_simulate(const CommonOptions& options) {
  const std::atomic<bool>& stop = catch_interrupts();
  const std::string date = date_now();
  const Case c = load_with_sea_seed(options);
  const std::string statement = statement_of(options.input);
  const PreparedRun prepared = prepare_run(c, c.specification, panel_method_progress(options.quiet, &stop));
  print_warnings(prepared.warnings);
  const RunFolder folder(folder_path(options, c, "simulate"),
                         options.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh);
  write_or_refuse([&] { write_file(folder.case_file(), case_text(c, statement)); });

  Progress progress = stderr_progress(options.quiet);
  ArchiveStream archive(folder.history(), archive_title(c.specification, c, "simulate"));
  const auto tell = [&](double t, double t_end) {
    progress.update(t_end > 0.0 ? t / t_end : 0.0, fmt::format("{:.0f} of {:.0f} s simulated", t, t_end));
  };
  RunResult run = run_lift(prepared, c.limits, &stop, tell, &archive);
  run.date = date;
  progress.clear();
  const Summary summary = summary_of(run, c, "simulate");
  write_run_report(folder, run, prepared, c, statement);
  write_or_refuse([&] { write_summary(summary, folder.summary()); });  // last: its presence says that all is there

  if (options.json)
    fmt::print("{}\n", summary_json(summary));
  else if (!options.quiet)
    print_run(summary, folder);
  if (run.metrics.status == RunStatus::failed) spdlog::error("failed: {}", run.metrics.message);
  if (run.trajectory.status == RunStatus::diverged) spdlog::error("{}", run.trajectory.message);
  if (run.trajectory.status == RunStatus::interrupted) spdlog::warn("interrupted: the folder holds the part that ran");
  return exit_code(run);
}

}  // namespace stillhook
