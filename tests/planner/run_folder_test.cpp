#include "planner/run_folder.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <optional>

#include "planner/version.h"

using namespace stillhook;
namespace fs = std::filesystem;
using Mode = RunFolder::Mode;

namespace {

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "stillhook-folder-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

void touch(const fs::path& file) { std::ofstream(file) << "x"; }

}  // namespace

TEST_CASE("a run folder is made, and never overwritten without being asked") {
  const Folder temp;
  const std::string run = (temp.path / "runs" / "lift-plan").string();
  std::optional<RunFolder> first(std::in_place, run + "/", Mode::fresh);
  CHECK(fs::is_directory(run));
  CHECK(first->summary() == run + "/summary.json");
  first.reset();
  const RunFolder fresh(run, Mode::read);
  CHECK_NOTHROW(RunFolder(run, Mode::fresh));  // still empty
  touch(fresh.case_file());
  touch(fresh.store());
  touch(fresh.store() + "-wal");
  touch(fs::path(run) / "notes.txt");
  CHECK_THROWS_WITH(RunFolder(run, Mode::fresh), Catch::Contains("--force"));
  CHECK_NOTHROW(RunFolder(run, Mode::resume));
  CHECK(fs::exists(fresh.store()));
  RunFolder(run, Mode::replace);
  CHECK_FALSE(fs::exists(fresh.case_file()));
  CHECK_FALSE(fs::exists(fresh.store()));
  CHECK_FALSE(fs::exists(fresh.store() + "-wal"));
  CHECK(fs::exists(fs::path(run) / "notes.txt"));  // not ours
}

TEST_CASE("folders that are no runs are left alone") {
  const Folder temp;
  touch(temp.path / "thesis.tex");
  CHECK_THROWS_AS(RunFolder(temp.path.string(), Mode::replace), UsageError);
  CHECK(fs::exists(temp.path / "thesis.tex"));
  CHECK_THROWS_WITH(RunFolder((temp.path / "thesis.tex").string(), Mode::fresh), Catch::Contains("is a file"));
  CHECK_THROWS_WITH(RunFolder((temp.path / "nothing").string(), Mode::resume), Catch::Contains("nothing to resume"));
  CHECK_THROWS_AS(RunFolder("/proc/stillhook", Mode::fresh), UsageError);
}

TEST_CASE("one run at a time writes into a folder, and a killed one leaves no lock") {
  const Folder temp;
  const std::string run = (temp.path / "run").string();
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t other = fork();
  REQUIRE(other >= 0);
  if (other == 0) {
    const RunFolder held(run, Mode::fresh);
    touch(held.case_file());
    if (write(ready[1], "x", 1) != 1) _exit(1);
    while (true) pause();
  }
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  for (const Mode mode : {Mode::fresh, Mode::replace, Mode::resume}) {
    CHECK_THROWS_WITH(RunFolder(run, mode), Catch::Contains("another run is writing into this folder, process " +
                                                            std::to_string(other)) &&
                                                Catch::Contains("--out"));
    CHECK(fs::exists(run + "/case.toml"));  // nothing was removed
  }
  CHECK_NOTHROW(RunFolder(run, Mode::read));  // export and report go on working
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
  CHECK_NOTHROW(RunFolder(run, Mode::replace));
  CHECK_FALSE(fs::exists(run + "/case.toml"));
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("the program's version is the build's") {
  std::ifstream in(std::string(STILLHOOK_SOURCE_DIR) + "/CMakeLists.txt");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  CHECK_THAT(text, Catch::Contains(std::string("project(stillhook VERSION ") + kVersion + " "));
}
