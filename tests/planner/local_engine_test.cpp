// Child processes that end well, fail, crash, are killed and are told to end: shell commands in place of workers.
#include <signal.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <map>

#include "planner/campaign/local_engine.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

/// Every task is a shell script; what it has done is lines in a file.
struct Shell {
  Folder folder;
  std::map<std::size_t, std::string> scripts;
  std::map<std::size_t, std::vector<int>> marks;
  int asked = 0, stop_after = -1;  // calls of stop()

  std::string done(std::size_t task) const { return folder / ("done" + std::to_string(task)); }
  std::size_t results(std::size_t task) const {
    std::ifstream in(done(task));
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    return lines;
  }
  std::vector<TaskOutcome> go(int jobs) {
    LocalEngine engine;
    engine.jobs = jobs;
    engine.command = [&](std::size_t task) {
      return std::vector<std::string>{"/bin/sh", "-c",
                                      "cd " + folder.path.string() + "; D=" + done(task) + "; " + scripts[task]};
    };
    engine.results = [&](std::size_t task) { return results(task); };
    engine.crashed = [&](std::size_t task, int signal) { marks[task].push_back(signal); };
    engine.stop = [&] { return stop_after >= 0 && asked++ >= stop_after; };
    std::vector<std::size_t> tasks;
    for (const auto& [task, script] : scripts) tasks.push_back(task);
    return run_tasks(tasks, engine);
  }
};

using End = TaskOutcome::End;

TEST_CASE("The engine tries crashed and killed tasks again, and gives up those that get nowhere", "[campaign]") {
  Shell shell;
  shell.scripts[0] = "echo x >> $D";
  shell.scripts[1] = "exit 2";                                                               // bad input: no second try
  shell.scripts[2] = "[ -f $D ] && { echo x >> $D; exit 0; }; echo x >> $D; kill -SEGV $$";  // crashes once
  shell.scripts[3] = "[ -f $D ] && exit 0; echo x >> $D; kill -KILL $$";                     // is killed once
  shell.scripts[4] = "echo y >> tries4; kill -SEGV $$";                                      // always crashes
  shell.scripts[5] = "echo x >> $D; [ $(wc -l < $D) -lt 5 ] && kill -KILL $$; exit 0";       // killed often, gets on
  for (const int jobs : {1, 3}) {
    Shell own;
    own.scripts = shell.scripts;
    const std::vector<TaskOutcome> outcomes = own.go(jobs);
    REQUIRE(outcomes.size() == 6);
    CHECK(outcomes[0].end == End::done);
    CHECK(outcomes[1].end == End::failed);
    CHECK(outcomes[1].code == 2);
    CHECK(outcomes[1].attempts == 1);
    CHECK(outcomes[2].end == End::done);
    CHECK(own.marks[2] == std::vector<int>{SIGSEGV});
    CHECK(outcomes[3].end == End::done);
    CHECK(own.marks[3].empty());
    CHECK(outcomes[4].end == End::failed);
    CHECK(outcomes[4].attempts == 3);
    CHECK(own.marks[4].size() == 3);
    CHECK_THAT(outcomes[4].message, Catch::Contains("3 times without a new result"));
    CHECK(outcomes[5].end == End::done);
    CHECK(outcomes[5].attempts == 5);
  }
}

TEST_CASE("Children that are told to end do so before the engine returns", "[campaign]") {
  Shell shell;
  for (std::size_t task = 0; task < 3; ++task) shell.scripts[task] = "echo $$ > pid$PPID.$$; exec sleep 60";
  shell.stop_after = 3;
  const std::vector<TaskOutcome> outcomes = shell.go(2);
  for (const TaskOutcome& outcome : outcomes) CHECK(outcome.end == End::stopped);
  int started = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shell.folder.path)) {
    ++started;
    CHECK(kill(static_cast<pid_t>(std::stol(content(entry.path().string()))), 0) != 0);  // none is left
  }
  CHECK(started == 2);
  CHECK(outcomes[2].attempts == 0);
}

TEST_CASE("A program that is not there is told", "[campaign]") {
  LocalEngine engine;
  engine.command = [](std::size_t) { return std::vector<std::string>{"/no/such/program"}; };
  engine.results = [](std::size_t) { return std::size_t{0}; };
  engine.crashed = [](std::size_t, int) {};
  engine.stop = [] { return false; };
  const std::vector<TaskOutcome> outcomes = run_tasks({4}, engine);
  CHECK(outcomes[0].end == End::failed);
  CHECK_THAT(outcomes[0].message, Catch::Contains("cannot be started"));
}

}  // namespace
}  // namespace stillhook
