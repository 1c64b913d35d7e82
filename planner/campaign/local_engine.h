// Runs tasks as child processes of this one, so many at a time. A child that a signal ends is started again: what it
// had done is in its parts. A signal of its own making (a crash) leaves a mark, by which the next attempt knows the
// run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace stillhook {

struct LocalEngine {
  int jobs = 1;
  /// The words of the command of a task, the program first.
  std::function<std::vector<std::string>(std::size_t task)> command;
  /// How many results a task has: a task that is ended three times without a new one is given up.
  std::function<std::size_t(std::size_t task)> results;
  /// Called for a signal of the child's own making, before the next attempt.
  std::function<void(std::size_t task, int signal)> crashed;
  /// Asked about ten times a second; true: children are told to end, and no more are started.
  std::function<bool()> stop;
};

struct TaskOutcome {
  enum class End { done, failed, stopped };
  std::size_t task = 0;
  End end = End::stopped;
  int code = 0;         // exit code of a task that failed
  int attempts = 0;     // in this run of the engine
  std::string message;  // why it failed
};

/// In the order of the tasks. No child is left when it returns; should this process be killed, the system tells its
/// children to end.
std::vector<TaskOutcome> run_tasks(const std::vector<std::size_t>& tasks, const LocalEngine& engine);

}  // namespace stillhook
