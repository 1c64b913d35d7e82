#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "planner/campaign/local_engine.h"
#include "planner/campaign/parts.h"
#include "planner/cli/verb_run.h"
#include "planner/operability/column_lift.h"
#include "planner/verbs/operability/operability_files.h"
#include "planner/verbs/operability/operability_output.h"
#include "planner/verbs/operability/operability_tables.h"
#include "planner/verbs/verbs.h"

namespace stillhook {
namespace {

/// Removes what a former campaign has left in the folder.
void clear_campaign(const std::string& folder) {
  std::error_code error;
  std::filesystem::remove(cancel_path(folder), error);
  std::vector<std::filesystem::path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(parts_path(folder), error))
    if (entry.path().extension() == ".jsonl" || entry.path().extension() == ".crash") parts.push_back(entry.path());
  for (const auto& part : parts) std::filesystem::remove(part, error);
  std::filesystem::remove(parts_path(folder), error);
}

/// A limit that a completed lift has no value for would be broken at every height.
void check_values(const Case& c, const OperabilityPlan& plan, const LiftValues& trial) {
  if (trial.status != RunStatus::completed) return;
  for (std::size_t k = 0; k + 1 < plan.criteria.size(); ++k) {
    if (!std::isnan(trial.values[k][0])) continue;
    const std::string sentence =
        fmt::format("limits.{}: has no value in {}", plan.criteria[k].metric,
                    plan.phases_alone ? "the phases that are simulated" : "a run of this lift");
    if (!plan.phases_alone) throw CaseError(c.file + ": " + sentence + ": take the limit out, or make it a soft one");
    spdlog::warn("{}: it is not judged", sentence);
  }
}

/// What a lift refuses depends on its waves: the longest, and of the shortest every seed of the first look, are built
/// before any work is done.
void build_at_ends(const Case& c, const OperabilityPlan& plan, const VerbRun& verb) {
  ColumnLift(c, plan, plan.columns.size() - 1, verb.panel_progress());
  const ColumnLift shortest(c, plan, 0, verb.panel_progress());
  for (int seed = 0; seed < plan.rules.looks.front() && !verb.stop(); ++seed) shortest.check_seed(seed);
}

CostEstimate timed_run(const Case& c, const OperabilityPlan& plan, const VerbRun& verb, int jobs) {
  const std::size_t middle = plan.column_at[plan.peak_periods.size() / 2][plan.headings.size() / 2];
  const ColumnLift lift(c, plan, middle, verb.panel_progress());
  build_at_ends(c, plan, verb);
  print_warnings(lift.warnings());
  CostEstimate cost;
  cost.column = plan.columns[middle];
  cost.height = std::min(plan.rules.guess, cost.column.highest);
  cost.jobs = jobs;
  const auto begin = std::chrono::steady_clock::now();
  const auto values = lift.run(0, cost.height, &verb.stop());
  if (!values) return cost;
  cost.run_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  check_values(c, plan, *values);
  const std::string key(64, '0');
  cost.bytes_a_run = result_line(key, {0, cost.height}, *values, cost.run_s).size() + key.size() + 14;
  return cost;
}

class OperabilityVerb final : public Verb {
 public:
  std::string name() const override { return "operability"; }
  std::string help() const override {
    return "Limiting sea states of a lift by period, heading and phase, with their confidence";
  }
  void add_options(VerbOptions& o) override;
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override {
    return {{"operability.csv", "Limits by period, heading and phase: what weather takes as LIMITS."},
            {"operability.nc", "The same, and where every seed breaks, as NetCDF (CF-1.8)."},
            {"manifest.json", "Of a campaign: program, case and tasks; its runs are in parts/."}};
  }

 private:
  Campaign begun(VerbRun& verb, const Case& c, const OperabilityPlan& plan) const;
  std::vector<TaskOutcome> work(const Campaign& campaign, const VerbRun& verb) const;
  int conclude(const VerbRun& verb, const OperabilityStudy& study, const std::vector<TaskOutcome>& outcomes) const;
  int jobs() const { return jobs_.value_or(omp_get_num_procs()); }

  bool dry_run_ = false, resume_ = false;
  std::optional<int> jobs_;
};

void OperabilityVerb::add_options(VerbOptions& o) {
  o.add_case();
  o.add({"--dry-run", &dry_run_, "", "Print tasks, runs, core-hours and disk, from one timed run, and stop"});
  o.add({.name = "--jobs",
         .target = &jobs_,
         .operand = "N",
         .help = "Processes at once (default: all cores); results do not depend on it",
         .range = std::pair(1.0, 1024.0)});
  o.add({"--resume", &resume_, "", "Go on with the campaign that the folder holds"});
  o.add({"--out", &o.common().out, "DIR", "Folder to write into (default runs/<case>-operability)"});
  o.add_force("Replace the run that the folder holds");
}

Campaign OperabilityVerb::begun(VerbRun& verb, const Case& c, const OperabilityPlan& plan) const {
  const RunFolder& folder = resume_ ? verb.open(c, RunFolder::Mode::resume) : verb.open(c);
  const std::string manifest = manifest_text(c, plan, case_text(c, verb.statement()));
  if (resume_) {
    const Campaign stored = read_campaign(folder.path());
    if (const std::string difference = manifest_difference(stored.manifest, manifest); !difference.empty())
      throw UsageError(folder.path() + ": " + difference);
    std::error_code error;
    std::filesystem::remove(cancel_path(folder.path()), error);
  } else {
    clear_campaign(folder.path());
    verb.keep_case(c);
    verb.write(manifest_path(folder.path()), manifest);
  }
  return open_campaign(folder.path());
}

std::vector<TaskOutcome> OperabilityVerb::work(const Campaign& campaign, const VerbRun& verb) const {
  const std::size_t tasks = campaign.plan.columns.size();
  const int threads = std::max(1, jobs() / static_cast<int>(tasks));
  const double expected = static_cast<double>(tasks) * runs_expected(campaign.plan.rules).least;
  Progress progress = verb.progress();
  auto next_count = std::chrono::steady_clock::now();
  LocalEngine engine;
  engine.jobs = jobs();
  engine.command = [&](std::size_t task) {
    return std::vector<std::string>{"/proc/self/exe",     "worker",    campaign.folder,         "--task",
                                    std::to_string(task), "--threads", std::to_string(threads), "--quiet"};
  };
  engine.results = [&](std::size_t task) { return count_results(campaign.folder, task); };
  engine.crashed = [&](std::size_t task, int signal) {
    spdlog::warn("{}: a worker was ended by signal {}; it is tried again", column_text(campaign.plan.columns[task]),
                 signal);
    mark_crash(campaign.folder, task, signal);
  };
  engine.stop = [&] {
    if (const auto now = std::chrono::steady_clock::now(); now >= next_count) {
      next_count = now + std::chrono::seconds(1);
      const std::size_t runs = count_results(campaign.folder);
      progress.update(std::min(0.99, static_cast<double>(runs) / expected), fmt::format("operability: {} runs", runs));
    }
    return verb.stop().load() || std::filesystem::exists(cancel_path(campaign.folder));
  };
  std::vector<std::size_t> missing;
  const Collected had = collect(campaign);
  for (std::size_t task = 0; task < tasks; ++task)
    if (!had.columns[task].complete) missing.push_back(task);
  std::vector<TaskOutcome> outcomes = run_tasks(missing, engine);
  progress.clear();
  return outcomes;
}

int OperabilityVerb::conclude(const VerbRun& verb, const OperabilityStudy& study,
                              const std::vector<TaskOutcome>& outcomes) const {
  int code = operability_exit(study);
  bool stopped = false;
  for (const TaskOutcome& outcome : outcomes) {
    stopped = stopped || outcome.end == TaskOutcome::End::stopped;
    if (outcome.end != TaskOutcome::End::failed) continue;
    spdlog::error("{}: {}", column_text(study.plan().columns[outcome.task]), outcome.message);
    code = outcome.code == kBadInput || outcome.code == kNumericalFailure ? outcome.code : static_cast<int>(kBug);
  }
  if (stopped) {
    verb.conclude(operability_summary(study, {}, "interrupted", verb.date(), verb.wall()));
    spdlog::warn("interrupted with {} runs done; go on with --resume", study.collected.runs);
    return kInterrupted;
  }
  const std::vector<std::string> files = write_operability_files(study, verb.date());
  verb.conclude(operability_summary(study, files, "completed", verb.date(), verb.wall()));
  print_warnings(study.warnings);
  if (verb.prints()) print_operability(study, files);
  return code;
}

int OperabilityVerb::run(const CommonOptions& options) {
  VerbRun verb(name(), options);
  const Case c = load_case(options);
  const OperabilityPlan plan = operability_plan(c);
  if (!resume_) {
    // The hull's coefficients are computed here, once for all workers.
    const CostEstimate cost = timed_run(c, plan, verb, jobs());
    if (verb.stop()) return kInterrupted;
    if (verb.prints()) fmt::print("{}\n", cost_text(plan, cost));
    if (dry_run_ && options.json) fmt::print("{}", cost_json(plan, cost));
  }
  if (dry_run_) return kDone;
  Campaign campaign = begun(verb, c, plan);
  const std::vector<TaskOutcome> outcomes = work(campaign, verb);
  return conclude(verb, study_of(std::move(campaign)), outcomes);
}

}  // namespace

std::unique_ptr<Verb> operability_verb() { return std::make_unique<OperabilityVerb>(); }

}  // namespace stillhook
