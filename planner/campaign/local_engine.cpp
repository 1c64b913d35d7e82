#include "planner/campaign/local_engine.h"

#include <fmt/core.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <thread>

#include "planner/cli/commands.h"

namespace stillhook {
namespace {

constexpr int kFailuresToGiveUp = 3;  // in a row, without a new result
constexpr std::chrono::milliseconds kPoll{100};

/// From outside (a cluster's scheduler, too little memory) or of the program's own making.
bool of_its_own_making(int signal) {
  return signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE || signal == SIGILL ||
         signal == SIGTRAP || signal == SIGSYS;
}

struct State {
  TaskOutcome outcome;
  int failures = 0;
  std::size_t results = 0;
};

class Children {
 public:
  Children(const std::vector<std::size_t>& tasks, const LocalEngine& engine) : engine_(engine) {
    for (const std::size_t task : tasks) {
      states_.emplace_back().outcome.task = task;
      states_.back().results = engine_.results(task);
      waiting_.push_back(states_.size() - 1);
    }
    std::reverse(waiting_.begin(), waiting_.end());  // taken from the end
  }

  std::vector<TaskOutcome> run() {
    while (!running_.empty() || (!waiting_.empty() && !stopping_)) {
      while (!stopping_ && !waiting_.empty() && static_cast<int>(running_.size()) < engine_.jobs) start();
      while (reap()) {
      }
      if (!stopping_ && engine_.stop()) tell_to_end();
      std::this_thread::sleep_for(kPoll);
    }
    std::vector<TaskOutcome> outcomes;
    for (const State& state : states_) outcomes.push_back(state.outcome);
    return outcomes;
  }

 private:
  void start() {
    const std::size_t index = waiting_.back();
    waiting_.pop_back();
    State& state = states_[index];
    ++state.outcome.attempts;
    std::vector<std::string> words = engine_.command(state.outcome.task);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t parent = getpid(), child = fork();
    if (child < 0) {
      fail(state, 1, fmt::format("no process can be started: {}", std::strerror(errno)));
      return;
    }
    if (child > 0) {
      running_[child] = index;
      return;
    }
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(kInterrupted);  // the parent was gone before it could be asked for that
    execv(argv[0], argv.data());
    _exit(127);
  }

  bool reap() {
    int status = 0;
    for (const auto& [child, index] : running_) {  // each by its number: other children are not ours to wait for
      const pid_t ended = waitpid(child, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) continue;
      const std::size_t of = index;
      running_.erase(child);
      judge(of, ended < 0 ? 0 : status);
      return true;
    }
    return false;
  }

  void judge(std::size_t index, int status) {
    State& state = states_[index];
    if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) {
      state.outcome.end = TaskOutcome::End::done;
      return;
    }
    if (stopping_) return;
    const bool by_signal = WIFSIGNALED(status);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (!by_signal && code != kInterrupted) {
      fail(state, code,
           code == 127 ? "the worker cannot be started" : fmt::format("its worker ended with code {}", code));
      return;
    }
    if (by_signal && of_its_own_making(WTERMSIG(status))) engine_.crashed(state.outcome.task, WTERMSIG(status));
    const std::size_t results = engine_.results(state.outcome.task);
    state.failures = results > state.results ? 1 : state.failures + 1;
    state.results = results;
    if (state.failures >= kFailuresToGiveUp) {
      fail(state, code,
           fmt::format("its worker was ended {} times without a new result, at last by {}", state.failures,
                       by_signal ? strsignal(WTERMSIG(status)) : "a request to end"));
      return;
    }
    waiting_.push_back(index);  // at once: its lift is the one that is known best
  }

  static void fail(State& state, int code, std::string message) {
    state.outcome.end = TaskOutcome::End::failed;
    state.outcome.code = code;
    state.outcome.message = std::move(message);
  }

  void tell_to_end() {
    stopping_ = true;
    for (const auto& [child, index] : running_) kill(child, SIGTERM);
  }

  const LocalEngine& engine_;
  std::vector<State> states_;
  std::vector<std::size_t> waiting_;
  std::map<pid_t, std::size_t> running_;
  bool stopping_ = false;
};

}  // namespace

std::vector<TaskOutcome> run_tasks(const std::vector<std::size_t>& tasks, const LocalEngine& engine) {
  return Children(tasks, engine).run();
}

}  // namespace stillhook
