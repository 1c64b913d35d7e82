#include "planner/campaign/task_worker.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "planner/campaign/parts.h"
#include "planner/operability/column_lift.h"

namespace stillhook {
namespace {

constexpr int kCrashesToGiveUp = 2;

class TaskWorker {
 public:
  TaskWorker(const Campaign& campaign, std::size_t task, const WorkerOptions& options)
      : campaign_(campaign),
        task_(task),
        options_(options),
        keys_(campaign.identity, task),
        known_(read_parts(campaign.folder, campaign.identity, task)),
        column_(campaign.plan.rules_of(task), cells_of(campaign.plan.criteria, campaign.plan.phases.size()),
                targets_of(campaign.plan.criteria, campaign.plan.phases)),
        part_(campaign.folder, task) {}

  bool run() {
    while (!column_.done()) {
      const std::vector<RunWanted> round = column_.wanted();
      std::vector<RunWanted> alone, missing;
      for (const RunWanted& wanted : round) {
        if (known_.runs.contains(wanted)) continue;
        (crashes(wanted) > 0 ? alone : missing).push_back(wanted);
      }
      for (const RunWanted& wanted : alone)
        if (!run_one(wanted)) return false;
      if (!run_together(missing)) return false;
      for (const RunWanted& wanted : round) tell(known_.runs.at(wanted));
    }
    return true;
  }

 private:
  int crashes(const RunWanted& wanted) const {
    const auto found = known_.crashes.find(keys_.key(wanted));
    return found == known_.crashes.end() ? 0 : found->second;
  }

  bool stopped() const {
    return (options_.stop && options_.stop->load()) || std::filesystem::exists(cancel_path(campaign_.folder));
  }

  /// False if it was stopped before it ended.
  bool run_one(const RunWanted& wanted) {
    if (stopped()) return false;
    const std::string key = keys_.key(wanted);
    PartRun run;
    run.at = wanted;
    if (crashes(wanted) >= kCrashesToGiveUp) {
      part_.crashed(key, wanted);
      run.crashed = true;
    } else {
      part_.begin(key);
      const auto begin = std::chrono::steady_clock::now();
      std::optional<LiftValues> lift = this->lift().run(wanted.seed, wanted.height, options_.stop);
      if (!lift) return false;
      const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      part_.result(key, wanted, *lift, wall);
      run.lift = std::move(*lift);
      run.wall = wall;
    }
#pragma omp critical(stillhook_task_worker)
    known_.runs.emplace(wanted, std::move(run));
    return true;
  }

  bool run_together(const std::vector<RunWanted>& missing) {
    if (missing.empty()) return true;
    lift();  // built before there are threads
    std::vector<std::exception_ptr> errors(missing.size());
    std::vector<char> complete(missing.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(options_.threads) if (options_.threads > 1)
    for (std::size_t i = 0; i < missing.size(); ++i) {
      try {
        complete[i] = run_one(missing[i]) ? 1 : 0;
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
    return std::all_of(complete.begin(), complete.end(), [](char c) { return c != 0; });
  }

  void tell(const PartRun& run) {
    ColumnRun told{run.at, run.crashed, {}};
    if (!run.crashed) told.use = uses_of(run.lift, campaign_.plan.criteria, campaign_.plan.phases_alone);
    column_.tell(told);
  }

  /// Built when the first run is needed: a task that is complete takes no time.
  const ColumnLift& lift() {
    if (!lift_) lift_.emplace(campaign_.lift, campaign_.plan, task_);
    return *lift_;
  }

  const Campaign& campaign_;
  std::size_t task_;
  WorkerOptions options_;
  RunKeys keys_;
  TaskParts known_;
  Column column_;
  PartWriter part_;
  std::optional<ColumnLift> lift_;
};

}  // namespace

bool run_task(const Campaign& campaign, std::size_t task, const WorkerOptions& options) {
  return TaskWorker(campaign, task, options).run();
}

}  // namespace stillhook
