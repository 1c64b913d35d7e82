#include "planner/run_folder.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

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
  const RunFolder fresh(run + "/", Mode::fresh);
  CHECK(fs::is_directory(run));
  CHECK(fresh.summary() == run + "/summary.json");
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

TEST_CASE("the program's version is the build's") {
  std::ifstream in(std::string(STILLHOOK_SOURCE_DIR) + "/CMakeLists.txt");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  CHECK_THAT(text, Catch::Contains(std::string("project(stillhook VERSION ") + kVersion + " "));
}
