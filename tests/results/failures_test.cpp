// Runs that no lift would come through.
#include "results/failures.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "results/deck_corners.h"
#include "results/limits.h"
#include "results/metrics.h"
#include "results/summary.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using truth::SyntheticLift;
using Catch::Matchers::Contains;

namespace {

void raise(SyntheticLift& lift, const std::string& channel, std::size_t phase, double value) {
  Trajectory& run = lift.trajectory;
  const auto c = static_cast<std::size_t>(run.find(channel));
  run.extremes[phase][c].max = value;
  run.extremes[phase][c].t_max = run.phases[phase].start + 12.3;
}

}  // namespace

TEST_CASE("a sound run has nothing that ends it", "[failures]") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.status == RunStatus::completed);
  CHECK(m.message.empty());
}

TEST_CASE("a wire above its breaking load fails the run, kept limits or not", "[failures]") {
  SyntheticLift lift;
  raise(lift, "stay_port.tension", 3, 2.0 * 51.9e6);  // between two samples, as a snap is
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.status == RunStatus::failed);
  CHECK_THAT(m.message, Contains("wire stay_port parts at 432.3 s in turn") && Contains("2 times its breaking load"));
  CHECK(m.failed_at == 432.3);
  CHECK_FALSE(within_limits(m, {}));
  const Summary summary = summarise(lift.specification, lift.trajectory, m, {});
  CHECK_THAT(summary_json(summary), Contains("\"status\": \"failed\"") && Contains("\"within_limits\": false"));
}

TEST_CASE("a vessel beyond 30 deg has capsized, one below has not", "[failures]") {
  SyntheticLift lift;
  raise(lift, "crane.roll", 2, 0.99 * kCapsized);
  CHECK(compute_metrics(lift.specification, lift.trajectory).status == RunStatus::completed);
  raise(lift, "crane.roll", 2, 1.01 * kCapsized);
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.status == RunStatus::failed);
  CHECK_THAT(m.message, Contains("crane capsizes at 132.3 s in hoist_up: it heels by up to 30.3 deg"));
}

TEST_CASE("a deck under water at rest fails the run", "[failures]") {
  SyntheticLift lift;
  // Deck at +3.5 m, 23 m from the centre line: an angle of 10 deg has its edge at 3.5 cos - 23 sin = -0.55 m.
  lift.trajectory.static_poses[3].bodies[0] = Pose{rotation_from({10.0 / 57.29577951308232, 0.0, 0.0}), Vector3::Zero()};
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.status == RunStatus::failed);
  CHECK_THAT(m.message, Contains("crane has no freeboard at 420.0 s") && Contains("0.55 m under water"));
}

TEST_CASE("the deck of a mesh hull under water fails the run as that of a box does, what lies lower does not", "[failures]") {
  // The hull of the crane as a file, a box like it: deck edges at 3.5 m, 23 m from the centre line.
  const std::string file = (std::filesystem::temp_directory_path() / ("stillhook_deck_" + std::to_string(::getpid()) + ".obj")).string();
  std::ofstream(file) << "v -55 -23 -4\nv 55 -23 -4\nv 55 23 -4\nv -55 23 -4\nv -55 -23 3.5\nv 55 -23 3.5\nv 55 23 3.5\n"
                         "v -55 23 3.5\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  SyntheticLift lift;
  HullSpec& hull = lift.specification.bodies[0].hull;
  hull.shape = HullSpec::Shape::mesh;
  hull.mesh_file = file;
  CHECK(deck_corners(hull).size() == 4);  // not those of the bottom
  CHECK(compute_metrics(lift.specification, lift.trajectory).status == RunStatus::completed);
  // 10 deg: 3.5 cos 10 deg - 23 sin 10 deg = -0.55 m. In every pose the bottom is under water, which is no fault.
  lift.trajectory.static_poses[3].bodies[0] = Pose{rotation_from({10.0 / 57.29577951308232, 0.0, 0.0}), Vector3::Zero()};
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.status == RunStatus::failed);
  CHECK_THAT(m.message, Contains("crane has no freeboard at 420.0 s") && Contains("0.55 m under water"));
  std::filesystem::remove(file);
}

TEST_CASE("a load that swings out of the crane's reach fails the run", "[failures]") {
  SyntheticLift lift;
  Trajectory& run = lift.trajectory;
  auto& x = run.values[static_cast<std::size_t>(run.find("hoist_port.offset_x"))];
  const auto& length = run.values[static_cast<std::size_t>(run.find("hoist_port.length"))];
  const std::size_t slack = 400, carrying = 1500;  // 80 s: the load waits on the barge; 300 s
  x[slack] = 0.8 * length[slack];                  // asin(0.8) = 53 deg
  CHECK(compute_metrics(lift.specification, run).status == RunStatus::completed);
  x[carrying] = 0.8 * length[carrying];
  const Metrics m = compute_metrics(lift.specification, run);
  CHECK(m.status == RunStatus::failed);
  CHECK_THAT(m.message, Contains("at 300.0 s in hoist_up") && Contains("stands 53 deg from the vertical"));
}
