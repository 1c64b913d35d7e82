// One task of a campaign: the search of one column, gone on with from what former attempts have left.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "planner/campaign/campaign_folder.h"

namespace stillhook {

struct WorkerOptions {
  int threads = 1;  // runs at once
  const std::atomic<bool>* stop = nullptr;
};

/// True if the task is done; false if it was stopped, by `stop` or by a file `cancel` in the folder. Runs in which two
/// attempts were ended by a signal are recorded as crashed and left out; those in which one was run alone first. Throws
/// CaseError when the lift cannot be built, FileError for the folder.
bool run_task(const Campaign& campaign, std::size_t task, const WorkerOptions& options);

}  // namespace stillhook
