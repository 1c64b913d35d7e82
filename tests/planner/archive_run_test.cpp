// What a run leaves on the disk when all goes well, when it is killed, and when the disk does not play along.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <sstream>
#include <thread>

#include "results/archive.h"
#include "tests/planner/program.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

/// A run with the program's files limited to so many bytes, as on a full disk.
Result run_on_full_disk(const Folder& folder, const std::vector<std::string>& arguments, rlim_t bytes) {
  rlimit before = {};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit limited = {bytes, before.rlim_max};
  const auto handler = signal(SIGXFSZ, SIG_IGN);  // the write then fails as it does on a full disk
  REQUIRE(setrlimit(RLIMIT_FSIZE, &limited) == 0);
  const Result result = run(folder, arguments);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  return result;
}

std::size_t temporary_files(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    count += entry.path().filename().string().find(".part-") != std::string::npos;
  return count;
}

/// What a child has computed, s.
double processor_seconds(pid_t child) {
  clockid_t clock;
  timespec used{};
  REQUIRE(clock_getcpuclockid(child, &clock) == 0);
  REQUIRE(clock_gettime(clock, &used) == 0);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

TEST_CASE("simulate: kill -9 at any moment leaves a history that can be read, reported and exported", "[archive]") {
  const Folder folder;
  std::size_t longest = 0;
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    const std::string name = "s" + std::to_string(i), history = folder / (name + "/history.nc");
    const pid_t child =
        start(folder, {"simulate", kCase, "--out", name, "--quiet", "--set",
                       "operation.phases.settle.duration_s=100000", "--set", "solver.output_interval_s=5"});
    for (int k = 0; k < 6000 && !fs::exists(history); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    REQUIRE(fs::exists(history));
    // There are dozens of syncs a second: the kill falls into one now and then. In the child's processor time, so that the
    // last run gets far on a busy machine too.
    const double enough = processor_seconds(child) + 0.05 + 0.03 * i * i;
    for (int k = 0; k < 6000 && processor_seconds(child) < enough; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, SIGKILL);
    CHECK(finish(folder, child).code == -SIGKILL);
    const Trajectory left = read_archive(history);
    CHECK(left.status == RunStatus::interrupted);
    CHECK_THAT(left.message, Catch::Contains("incomplete"));
    for (std::size_t k = 1; k < left.time.size(); ++k) REQUIRE(left.time[k] > left.time[k - 1]);
    for (const std::vector<double>& values : left.values)
      for (const double value : values) REQUIRE(std::isfinite(value));
    CHECK_FALSE(fs::exists(folder / (name + "/summary.json")));
    longest = std::max(longest, left.time.size());
  }
  CHECK(longest > 100);
  const Result report = run(folder, {"report", "s5"});
  CHECK(report.code == 0);
  CHECK_THAT(report.err, Catch::Contains("incomplete"));
  CHECK_THAT(content(folder / "s5/report.html"), Catch::Contains("interrupted"));
  CHECK(run(folder, {"export", "s5", "--csv", "--channels", "load.z"}).code == 0);
  CHECK(run(folder, {"export", "s5", "--xlsx", "--channels", "load.z"}).code == 0);
}

TEST_CASE("export: CSV holds the samples to the last digit", "[export]") {
  const Folder folder;
  // Spaces and letters beyond ASCII, in the folder and in the case's path.
  const std::string out = "kjøring nr 1", file = folder / "løft – nr 1.toml";
  fs::copy_file(kCase, file);
  REQUIRE(run(folder, {"simulate", file, "--out", out}).code == 0);
  CHECK(run(folder, {"report", out}).out == out + "/report.html\n");
  CHECK(run(folder, {"export", out}).code == 2);
  CHECK(run(folder, {"export", out, "--csv", "--xlsx"}).code == 2);
  CHECK(run(folder, {"export", "nowhere", "--csv"}).code == 2);
  CHECK(run(folder, {"export", out, "--xlsx", "--out", "-"}).code == 2);
  const Result wrong = run(folder, {"export", out, "--csv", "--channels", "hook*"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Catch::Contains("hook*"));
  const Result first = run(folder, {"export", out, "--csv"});
  CHECK(first.code == 0);
  CHECK(first.out == out + "/history.csv\n");
  CHECK(run(folder, {"export", out, "--csv"}).code == 2);  // exists
  CHECK(run(folder, {"export", out, "--csv", "--force"}).code == 0);
  const Result piped = run(folder, {"export", out, "--csv", "--out", "-"});
  CHECK(piped.out == content(folder / (out + "/history.csv")));

  const Trajectory history = read_archive(folder / (out + "/history.nc"));
  std::istringstream lines(piped.out);
  std::string line;
  std::getline(lines, line);
  CHECK_THAT(line, Catch::StartsWith("time [s],barge.x [m],"));
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    REQUIRE(std::getline(lines, line));
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    REQUIRE(std::stod(cell) == history.time[i]);
    for (const std::vector<double>& values : history.values) {
      std::getline(cells, cell, ',');
      REQUIRE(std::stod(cell) == values[i]);
    }
  }
  // A new run in the folder takes the exports of the old one away.
  REQUIRE(run(folder, {"simulate", kCase, "--out", out, "--force"}).code == 0);
  CHECK_FALSE(fs::exists(folder / (out + "/history.csv")));
}

TEST_CASE("the same run leaves the same history, byte for byte", "[archive]") {
  const Folder folder;
  REQUIRE(run(folder, {"simulate", kCase, "--out", "a"}).code == 0);
  REQUIRE(run(folder, {"simulate", kCase, "--out", "b"}).code == 0);
  CHECK(content(folder / "a/history.nc") == content(folder / "b/history.nc"));
}

TEST_CASE("a full disk is said so, and never costs a good file", "[archive]") {
  const Folder folder;
  REQUIRE(run(folder, {"simulate", kCase, "--out", "good"}).code == 0);
  const std::string report = content(folder / "good/report.html"), history = content(folder / "good/history.nc");
  // Room for the case, not for the growing archive; then for that, but not for the report.
  for (const rlim_t bytes : {20000, 200000}) {
    CAPTURE(bytes);
    const std::string name = "full" + std::to_string(bytes);
    const Result result = run_on_full_disk(folder, {"simulate", kCase, "--out", name}, bytes);
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Catch::Contains(name + "/") && Catch::Contains("cannot be written"));
    CHECK(temporary_files(folder / name) == 0);
    CHECK_FALSE(fs::exists(folder / (name + "/summary.json")));
  }
  for (const char* verb : {"report", "export"}) {
    std::vector<std::string> arguments = {verb, "good"};
    if (arguments[0] == "export") arguments.push_back("--csv");
    const Result result = run_on_full_disk(folder, arguments, 20000);
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Catch::Contains("cannot be written"));
    CHECK(temporary_files(folder / "good") == 0);
  }
  CHECK(run_on_full_disk(folder, {"export", "good", "--xlsx"}, 20000).code == 2);
  CHECK(content(folder / "good/report.html") == report);
  CHECK(content(folder / "good/history.nc") == history);
  CHECK_FALSE(fs::exists(folder / "good/history.csv"));
  CHECK_FALSE(fs::exists(folder / "good/history.xlsx"));
}

TEST_CASE("a read-only folder is refused with a sentence", "[archive]") {
  const Folder folder;
  REQUIRE(run(folder, {"simulate", kCase, "--out", "good"}).code == 0);
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  // Permissions do not bind the superuser; what binds everybody is a file system that takes no folders.
  const std::string where = geteuid() == 0 ? "/proc/run" : "locked/run";
  const Result result = run(folder, {"simulate", kCase, "--out", where});
  CHECK(result.code == 2);
  CHECK_THAT(result.err, Catch::Contains(where));
  const Result exported = run(folder, {"export", "good", "--csv", "--out", where + ".csv"});
  CHECK(exported.code == 2);
  CHECK_THAT(exported.err, Catch::Contains(where + ".csv"));
  fs::permissions(folder / "locked", fs::perms::owner_all);
}
