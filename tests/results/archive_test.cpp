#include "results/archive.h"

#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "results/files.h"
#include "results/metrics.h"
#include "results/netcdf_file.h"
#include "results/summary.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

/// A folder of its own with a space and non-ASCII letters in its name, removed at the end.
struct Folder {
  fs::path path;
  Folder() {
    static int count = 0;
    path =
        fs::temp_directory_path() / ("stillhook prøve " + std::to_string(::getpid()) + "-" + std::to_string(count++));
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::string file(const char* name) const { return (path / name).string(); }
  std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {})); }
};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same_bits(x, y); });
}

}  // namespace

TEST_CASE("a trajectory comes back from its archive bit for bit") {
  truth::SyntheticLift lift;
  Trajectory& run = lift.trajectory;
  run.values[3][7] = -0.0;
  run.values[4][9] = std::nan("");
  run.values[5][11] = 4.9406564584124654e-324;  // the smallest there is
  run.message = "";
  run.static_poses[2].values.erase("hoist_port.tension");  // poses need not have the same values
  run.static_poses[3].drives.pop_back();
  run.extremes[1][2].max = -std::numeric_limits<double>::infinity();
  const Folder folder;
  const std::string path = folder.file("history.nc");
  write_archive(run, {"Box installation — «test»", "stillhook 0.1.0", "calm"}, path);
  CHECK(folder.entries() == 1);  // nothing temporary stays behind
  const Trajectory back = read_archive(path);

  CHECK(back.status == run.status);
  CHECK(back.message == run.message);
  CHECK(back.steps == run.steps);
  CHECK(same_bits(back.time, run.time));
  REQUIRE(back.channels.size() == run.channels.size());
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    CHECK(back.channels[c].name == run.channels[c].name);
    CHECK(back.channels[c].unit == run.channels[c].unit);
    CHECK(back.channels[c].description == run.channels[c].description);
    CHECK(same_bits(back.values[c], run.values[c]));
  }
  REQUIRE(back.phases.size() == run.phases.size());
  for (std::size_t p = 0; p < run.phases.size(); ++p) {
    CHECK(back.phases[p].name == run.phases[p].name);
    CHECK(back.phases[p].stage == run.phases[p].stage);
    CHECK(back.phases[p].end == run.phases[p].end);
    for (std::size_t c = 0; c < run.channels.size(); ++c) {
      const Extreme &a = back.extremes[p][c], &b = run.extremes[p][c];
      REQUIRE((same_bits(a.min, b.min) && same_bits(a.max, b.max) && a.t_min == b.t_min && a.t_max == b.t_max));
    }
  }
  REQUIRE(back.contacts.size() == run.contacts.size());
  for (std::size_t i = 0; i < run.contacts.size(); ++i) {
    const ContactEvent &a = back.contacts[i], &b = run.contacts[i];
    CHECK(a.contact == b.contact);
    CHECK(a.role == b.role);
    CHECK(a.phase == b.phase);
    CHECK(a.place == b.place);
    CHECK((a.start == b.start && a.end == b.end && a.approach_speed == b.approach_speed &&
           a.peak_force == b.peak_force && a.impulse == b.impulse));
  }
  REQUIRE(back.static_poses.size() == run.static_poses.size());
  for (std::size_t i = 0; i < run.static_poses.size(); ++i) {
    const StaticPose &a = back.static_poses[i], &b = run.static_poses[i];
    CHECK(a.name == b.name);
    CHECK(same_bits(a.drives, b.drives));
    CHECK(a.values == b.values);
    REQUIRE(a.bodies.size() == b.bodies.size());
    for (std::size_t k = 0; k < b.bodies.size(); ++k)
      CHECK((a.bodies[k].R == b.bodies[k].R && a.bodies[k].p == b.bodies[k].p));
  }
}

TEST_CASE("metrics computed from an archive are the metrics of the run") {
  const truth::SyntheticLift lift;
  const Folder folder;
  write_archive(lift.trajectory, {"t", "s", "w"}, folder.file("history.nc"));
  const Metrics a = compute_metrics(lift.specification, lift.trajectory),
                b = compute_metrics(lift.specification, read_archive(folder.file("history.nc")));
  const auto json = [&](const Metrics& m) {
    return summary_json(summarise(lift.specification, lift.trajectory, m, {}));
  };
  CHECK(json(a) == json(b));
}

TEST_CASE("an empty run and one without samples can be archived") {
  const Folder folder;
  write_archive(Trajectory{}, {"", "", ""}, folder.file("empty.nc"));
  const Trajectory empty = read_archive(folder.file("empty.nc"));
  CHECK(empty.status == RunStatus::not_run);
  CHECK(empty.channels.empty());
  const truth::SyntheticLift bare(false);
  write_archive(bare.trajectory, {"t", "s", "w"}, folder.file("bare.nc"));
  const Trajectory back = read_archive(folder.file("bare.nc"));
  CHECK(back.time.empty());
  CHECK(back.extremes.size() == bare.trajectory.extremes.size());
}

TEST_CASE("the archive is CF: conventions, one time axis with units, valid names without collisions") {
  Trajectory run;
  run.channels = {
      {"a.b", "m", "first"}, {"a_b", "N", ""}, {"time", "1", ""}, {"3rd", "rad", ""}, {"phase_name", "1", ""}};
  run.time = {0.0, 0.5};
  run.values.assign(5, {1.0, 2.0});
  const Folder folder;
  write_archive(run, {"title", "source", "sea"}, folder.file("h.nc"));
  const NetcdfFile file(folder.file("h.nc"), NetcdfFile::Mode::read, "h.nc");
  CHECK(file.text(NC_GLOBAL, "Conventions") == "CF-1.8");
  CHECK(file.text(file.find("time"), "units") == "s");
  CHECK(file.text(file.find("a_b"), "units") == "m");
  CHECK(file.text(file.find("a_b_2"), "channel") == "a_b");
  CHECK(file.text(file.find("c_3rd"), "channel") == "3rd");
  CHECK(file.text(file.find("a_b"), "long_name") == "first");
  CHECK(read_archive(folder.file("h.nc")).channels[4].name == "phase_name");
}

TEST_CASE("texts of an archive have a fixed length and a checksum, and may hold any letters") {
  truth::SyntheticLift lift;
  lift.trajectory.phases[1].name = "übergabe — «prøve»";
  lift.trajectory.phases[2].name = "";
  const Folder folder;
  write_archive(lift.trajectory, {"t", "s", "w"}, folder.file("h.nc"));
  const NetcdfFile file(folder.file("h.nc"), NetcdfFile::Mode::read, "h.nc");
  int variables = 0, texts = 0;
  file.check(nc_inq_nvars(file.id(), &variables), "variables");
  for (int v = 0; v < variables; ++v) {
    nc_type type = NC_NAT;
    int checksum = NC_NOCHECKSUM;
    file.check(nc_inq_vartype(file.id(), v, &type), "type");
    CHECK(type != NC_STRING);
    if (type != NC_CHAR) continue;
    ++texts;
    file.check(nc_inq_var_fletcher32(file.id(), v, &checksum), "checksum");
    CHECK(checksum == NC_FLETCHER32);
  }
  CHECK(texts == 8);  // three of channels, phases, two of contacts, poses, values at rest
  const Trajectory back = read_archive(folder.file("h.nc"));
  CHECK(back.phases[1].name == lift.trajectory.phases[1].name);
  CHECK(back.phases[2].name.empty());
}

TEST_CASE("texts of variable length, as archives had them before, are still read") {
  const Folder folder;
  {
    NetcdfFile file(folder.file("old.nc"), NetcdfFile::Mode::create, "old.nc");
    const int dimension = file.define_dimension("channel", 2);
    const int variable = file.define("channel_name", NC_STRING, {dimension}, "name");
    std::array<const char*, 2> names = {"load.x", ""};
    file.check(nc_put_var_string(file.id(), variable, names.data()), "texts");
    file.close();
  }
  const NetcdfFile file(folder.file("old.nc"), NetcdfFile::Mode::read, "old.nc");
  CHECK(file.texts("channel_name", 2) == std::vector<std::string>{"load.x", ""});
  CHECK_THROWS_WITH(file.texts("channel_name", 3), Catch::Contains("old.nc") && Catch::Contains("channel_name"));
}

TEST_CASE("what is not an archive is refused by name") {
  const Folder folder;
  write_file(folder.file("text.nc"), "not netcdf");
  CHECK_THROWS_WITH(read_archive(folder.file("text.nc")),
                    Catch::Contains("text.nc") && Catch::Contains("cannot be read"));
  CHECK_THROWS_WITH(read_archive(folder.file("none.nc")), Catch::Contains("no such file"));
  { NetcdfFile other(folder.file("other.nc"), NetcdfFile::Mode::create, "other.nc"); }
  CHECK_THROWS_WITH(read_archive(folder.file("other.nc")), Catch::Contains("not the archive of a stillhook run"));
}

TEST_CASE("a failed write leaves the good old file and nothing else") {
  const Folder folder;
  const std::string path = folder.file("summary.json");
  write_file(path, "good");
  {
    PendingFile pending(path);
    std::ofstream(pending.temporary()) << "half of it";
    // Not committed: the process was interrupted here.
  }
  CHECK(text_of(path) == "good");
  CHECK(folder.entries() == 1);
  write_file(path, "better");
  CHECK(text_of(path) == "better");
  CHECK_THROWS_WITH(write_file(folder.file("nowhere/summary.json"), "x"), Catch::Contains("does not exist"));
  fs::create_directories(folder.path / "taken");
  CHECK_THROWS_AS(write_file(folder.file("taken"), "x"), std::runtime_error);  // a folder has the name
  CHECK(folder.entries() == 2);
}

TEST_CASE("a full disk is reported and the old file stays") {
  // /dev/full answers every write with "no space left"; the temporary name is a link to it.
  if (!fs::exists("/dev/full")) return;
  const Folder folder;
  const std::string path = folder.file("report.html");
  write_file(path, "good");
  fs::create_symlink("/dev/full", path + ".part-" + std::to_string(::getpid()));
  CHECK_THROWS_WITH(write_file(path, std::string(100000, 'x')), Catch::Contains("No space left on device"));
  CHECK(text_of(path) == "good");
  CHECK(folder.entries() == 1);
}
