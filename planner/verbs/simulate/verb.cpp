#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "planner/cli/run_files.h"
#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/verbs.h"

namespace stillhook {
namespace {

/// --seed chooses the waves, and with them the gusts: it is the seed of the active sea, if that is irregular, else that
/// of the gusts.
Case load_with_sea_seed(const CommonOptions& options) {
  Case c = load_case(options);
  if (!options.seed) return c;
  const SeaSpec& sea = c.specification.sea;
  for (const SeaStateSpec& state : sea.states)
    if (state.name == sea.active && state.seeded())
      return load_case(options, {{"sea.states." + sea.active + ".seed", std::to_string(*options.seed)}});
  if (c.specification.wind.seeded())
    return load_case(options, {{"wind.seed", std::to_string(*options.seed)}});
  throw UsageError("--seed: the active sea \"" + sea.active + "\" is not irregular, it has no seed, and the wind has no gusts");
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

class SimulateVerb final : public Verb {
 public:
  std::string name() const override { return "simulate"; }
  std::string help() const override { return "Run the operation once: metrics, limits, report"; }
  void add_options(VerbOptions& o) override {
    o.add_case();
    o.add_folder();
    o.add_seed("Seed of the active irregular sea and the gusts");
  }
  int run(const CommonOptions& options) override {
    VerbRun verb(name(), options);
    const Case c = load_with_sea_seed(options);
    const PreparedRun prepared = prepare_run(c, c.specification, verb.panel_progress());
    print_warnings(prepared.warnings);
    const RunFolder& folder = verb.open(c);
    verb.keep_case(c);
    Progress progress = verb.progress();
    ArchiveStream archive(folder.history(), archive_title(c.specification, c, name()));
    const auto tell = [&](double t, double t_end) {
      progress.update(t_end > 0.0 ? t / t_end : 0.0, fmt::format("{:.0f} of {:.0f} s simulated", t, t_end));
    };
    RunResult run = run_lift(prepared, c.limits, &verb.stop(), tell, &archive);
    run.date = verb.date();
    progress.clear();
    const Summary summary = summary_of(run, c, name());
    write_run_report(folder, run, prepared, c, verb.statement());
    verb.conclude(summary_json(summary));
    if (verb.prints()) print_run(summary, folder);
    if (run.metrics.status == RunStatus::failed) spdlog::error("failed: {}", run.metrics.message);
    if (run.trajectory.status == RunStatus::diverged) spdlog::error("{}", run.trajectory.message);
    if (run.trajectory.status == RunStatus::interrupted)
      spdlog::warn("interrupted: the folder holds the part that ran");
    return exit_code(run);
  }
  std::vector<RunFile> files() const override {
    return {
        {"history.nc",
         "Every channel over time, phases, contacts: NetCDF-4 following CF-1.8. Written while the run goes on; what a "
         "killed run leaves can be read up to its last 100 s and says that it is incomplete."}};
  }
};

}  // namespace

std::unique_ptr<Verb> simulate_verb() { return std::make_unique<SimulateVerb>(); }

}  // namespace stillhook
