// history.nc while a run goes on: what is left when the process is killed, and what comes out at the end.
#include "results/archive_stream.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "results/files.h"
#include "tests/results/synthetic_lift.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

const ArchiveTitle kTitle = {"A lift", "stillhook test", "calm", "test"};

/// Hands the samples of a trajectory to a sink as a simulation does, until a time: phases and contacts appear when they
/// begin and end.
void play(const Trajectory& whole, SampleSink& sink, Trajectory& run, double until, std::size_t expected) {
  run.channels = whole.channels;
  run.static_poses = whole.static_poses;
  SampleForecast forecast;
  forecast.interval = whole.time[1] - whole.time[0];
  forecast.expected = expected;
  for (const PhaseRecord& phase : whole.phases) forecast.phases.push_back({phase.name, phase.stage, 0.0, 0.0, false});
  sink.open(run, forecast);
  std::vector<double> values(whole.channels.size());
  for (std::size_t i = 0; i < whole.time.size() && whole.time[i] <= until; ++i) {
    const double t = whole.time[i];
    while (run.phases.size() < whole.phases.size() && whole.phases[run.phases.size()].start <= t) {
      if (!run.phases.empty()) run.phases.back().end = whole.phases[run.phases.size()].start;
      run.extremes.push_back(whole.extremes[run.phases.size()]);
      run.phases.push_back(whole.phases[run.phases.size()]);
    }
    while (run.contacts.size() < whole.contacts.size() && whole.contacts[run.contacts.size()].end <= t)
      run.contacts.push_back(whole.contacts[run.contacts.size()]);
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = whole.values[c][i];
    sink.add(run, t, values);
  }
}

/// Plays the run in a process of its own that is killed at a time.
void play_and_kill(const Trajectory& whole, const std::string& path, double until, std::size_t expected) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ArchiveStream stream(path, kTitle);
    Trajectory run;
    play(whole, stream, run, until, expected);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

std::string bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a killed run leaves its archive up to the last 100 s, and it says that it is incomplete", "[archive]") {
  const truth::SyntheticLift lift;
  const Trajectory& whole = lift.trajectory;
  const TemporaryFolder folder;
  // 960 s in all. With 50 samples expected the file has to grow more than once.
  for (const auto& [until, expected] : {std::pair{99.0, 4801}, {250.0, 4801}, {731.0, 4801}, {940.0, 50}}) {
    CAPTURE(until, expected);
    const std::string path = folder / "history.nc";
    fs::remove(path);
    play_and_kill(whole, path, until, static_cast<std::size_t>(expected));
    const Trajectory left = read_archive(path);
    CHECK(left.status == RunStatus::interrupted);
    CHECK_THAT(left.message, Catch::Contains("incomplete"));
    const double reached = left.time.empty() ? 0.0 : left.time.back();
    CHECK(reached >= until - 100.0);
    CHECK(reached <= until);
    REQUIRE(left.channels.size() == whole.channels.size());
    for (std::size_t c = 0; c < whole.channels.size(); ++c) {
      REQUIRE(left.values.size() == (left.time.empty() ? 0 : whole.channels.size()));
      for (std::size_t i = 0; i < left.time.size(); ++i) REQUIRE(left.values[c][i] == whole.values[c][i]);
    }
    if (reached == 0.0) continue;
    // Phases that had begun, the last of them until now; contacts that had ended.
    REQUIRE_FALSE(left.phases.empty());
    CHECK(left.phases.back().start <= reached);
    CHECK(left.phases.back().end == reached);
    CHECK(left.phases.back().name == whole.phases[left.phases.size() - 1].name);
    std::size_t ended = 0;
    for (const ContactEvent& event : whole.contacts) ended += event.end <= reached;
    REQUIRE(left.contacts.size() == ended);
    for (std::size_t i = 0; i < ended; ++i) {
      CHECK(left.contacts[i].contact == whole.contacts[i].contact);
      CHECK(left.contacts[i].phase == whole.contacts[i].phase);
      CHECK(left.contacts[i].role == whole.contacts[i].role);
      CHECK(left.contacts[i].impulse == whole.contacts[i].impulse);
      CHECK(left.contacts[i].place == whole.contacts[i].place);
    }
    CHECK(left.static_poses.size() == whole.static_poses.size());
  }
}

TEST_CASE("the finished stream is the archive of the run, byte for byte", "[archive]") {
  const truth::SyntheticLift lift;
  const TemporaryFolder folder;
  const std::string streamed = folder / "streamed.nc", written = folder / "written.nc";
  ArchiveStream stream(streamed, kTitle);
  Trajectory run;
  play(lift.trajectory, stream, run, 1e9, 1000);
  run.status = lift.trajectory.status;
  run.message = lift.trajectory.message;
  run.phases = lift.trajectory.phases;
  run.extremes = lift.trajectory.extremes;
  run.contacts = lift.trajectory.contacts;
  run.steps = lift.trajectory.steps;
  run.residuals = lift.trajectory.residuals;
  run.factorisations = lift.trajectory.factorisations;
  stream.finish(run);
  write_archive(lift.trajectory, kTitle, written);
  CHECK(bytes(streamed) == bytes(written));
  CHECK(folder.files() == 2);  // nothing temporary stays

  // The samples stay in the file, and metrics find them there.
  CHECK(run.values.empty());
  CHECK(run.time == lift.trajectory.time);
  const Metrics a = compute_metrics(lift.specification, run), b = compute_metrics(lift.specification, lift.trajectory);
  REQUIRE(a.items.size() == b.items.size());
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    CHECK(a.items[i].name == b.items[i].name);
    CHECK(a.items[i].value == b.items[i].value);
  }
}

TEST_CASE("a stream that cannot be written says so and leaves what was there", "[archive]") {
  const truth::SyntheticLift lift;
  const TemporaryFolder folder;
  ArchiveStream stream(folder / "nowhere/history.nc", kTitle);
  Trajectory run;
  CHECK_THROWS_WITH(play(lift.trajectory, stream, run, 1e9, 100), Catch::Contains("does not exist"));
  // The final write fails: the growing file is still there and can be read.
  const std::string path = folder / "history.nc";
  {
    ArchiveStream growing(path, kTitle);
    Trajectory second;
    play(lift.trajectory, growing, second, 1e9, 5000);
    fs::create_directory(path + ".part-" + std::to_string(::getpid()));
    CHECK_THROWS_AS(growing.finish(second), FileError);
    fs::remove(path + ".part-" + std::to_string(::getpid()));
  }
  CHECK(read_archive(path).time.size() == lift.trajectory.time.size());
}

TEST_CASE("a run that will not fit on the disk is refused before it begins, and a long one takes its place as it goes",
          "[archive]") {
  const truth::SyntheticLift lift;
  const TemporaryFolder folder;
  const std::string path = folder / "history.nc";
  {  // 1e13 samples of 8 bytes and more are 80 TB for each channel: more than any disk that this test will see.
    ArchiveStream stream(path, kTitle);
    Trajectory run;
    try {
      play(lift.trajectory, stream, run, 1e9, 10'000'000'000'000);
      FAIL("a run of 1e13 samples was begun");
    } catch (const FileError& error) {
      const std::string said = error.what();
      CAPTURE(said);
      CHECK_THAT(said, Catch::Contains(path));
      CHECK_THAT(said, Catch::Contains("solver.output_interval_s, 0.2 s here"));
      CHECK_THAT(said, Catch::Contains("solver.max_duration_s"));
      CHECK_THAT(said, Catch::Contains("planned to last 2e+12 s"));
    }
    CHECK(folder.files() == 0);
  }
  // A million samples of these channels are some hundred MB, of which the run uses a two-hundredth part: the file is
  // of 64 MB of samples and a little more (phases, 4096 contacts), and grows when it must. It comes out whole.
  ArchiveStream stream(path, kTitle);
  Trajectory run;
  REQUIRE(lift.trajectory.channels.size() * 8e6 > 100e6);
  play(lift.trajectory, stream, run, 1e9, 1'000'000);
  CHECK(fs::file_size(path) < 70'000'000);
  stream.finish(run);
  CHECK(run.time == lift.trajectory.time);
}
