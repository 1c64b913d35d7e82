#include "results/export.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "results/files.h"
#include "results/metrics_reference.h"
#include "results/summary.h"
#include "tests/results/synthetic_lift.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;

namespace {

Trajectory small_run() {
  Trajectory run;
  run.channels = {{"load.x", "m", ""}, {"load.roll", "rad", ""}, {"a,\"b\"", "1", ""}};
  run.time = {0.0, 0.1, 0.2};
  run.values = {{1.0 / 3.0, 4.9406564584124654e-324, -0.0}, {std::nan(""), 1e300, 2.0}, {1, 2, 3}};
  return run;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("CSV: units in the header, every digit, nothing where there is no number", "[export]") {
  const Trajectory run = small_run();
  const TemporaryFolder folder;
  const std::string path = folder / "history.csv";
  write_csv({run, {0, 1, 2}, {}}, path);
  CHECK(text_of(path) ==
        "time [s],load.x [m],load.roll [rad],\"a,\"\"b\"\" [1]\"\n"
        "0,0.3333333333333333,,1\n"
        "0.1,5e-324,1e+300,2\n"
        "0.2,-0,2,3\n");
}

TEST_CASE("channels are chosen by patterns, in the order of the run", "[export]") {
  const Trajectory run = small_run();
  CHECK(matching_channels(run, {}) == std::vector<std::size_t>{0, 1, 2});
  CHECK(matching_channels(run, {"load.*"}) == std::vector<std::size_t>{0, 1});
  CHECK(matching_channels(run, {"load.roll", "load.x"}) == std::vector<std::size_t>{0, 1});
  CHECK_THROWS_WITH(matching_channels(run, {"load.*", "hook.*"}), Catch::Contains("hook.*"));
}

TEST_CASE("exports take the place of a file only when they are complete", "[export]") {
  const Trajectory run = small_run();
  const TemporaryFolder folder;
  const std::string path = folder / "history";
  write_file(path, "good");
  std::filesystem::create_symlink("/dev/full", path + ".part-" + std::to_string(::getpid()));
  CHECK_THROWS_WITH(write_csv({run, {0}, {}}, path), Catch::Contains("No space left"));
  CHECK(text_of(path) == "good");
  CHECK_THROWS_WITH(write_xlsx({run, {0}, {}}, folder / "nowhere/h.xlsx"), Catch::Contains("does not exist"));
  std::filesystem::create_directory(path + ".part-" + std::to_string(::getpid()));
  CHECK_THROWS_AS(write_xlsx({run, {0}, {}}, path), FileError);
  CHECK(text_of(path) == "good");
}

TEST_CASE("a history longer than a sheet is refused with advice", "[export]") {
  Trajectory run;
  run.channels = {{"x", "m", ""}};
  run.time.assign(1048576, 0.0);
  run.values = {run.time};
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(write_xlsx({run, {0}, {}}, folder / "h.xlsx"), Catch::Contains("--csv"));
}

TEST_CASE("a summary reads back", "[summary]") {
  const truth::SyntheticLift lift;
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  Summary summary = summarise(lift.specification, lift.trajectory, metrics, check_limits(lift.limits, metrics));
  summary.verb = "simulate";
  summary.program_version = "1.2.3";
  summary.warnings = {"mind the gap"};
  const TemporaryFolder folder;
  const std::string path = folder / "summary.json";
  write_summary(summary, path);
  CHECK(summary_json(read_summary(path)) == text_of(path));
  write_file(path, "{}");
  CHECK_THROWS_WITH(read_summary(path), Catch::Contains("is not the summary of a run"));
  CHECK_THROWS_AS(read_summary(folder / "none.json"), FileError);
}

TEST_CASE("docs/summary.md lists the metrics", "[docs]") {
  // Written by `stillhook schema --metrics`.
  CHECK_THAT(text_of(std::string(STILLHOOK_SOURCE_DIR) + "/docs/summary.md"),
             Catch::EndsWith(metric_reference_markdown()));
}
