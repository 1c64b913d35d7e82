// A force element that hangs on two drives: a winch and a compensator in series with it.
#include <catch2/catch.hpp>
#include <memory>

#include "sim/element_site.h"
#include "sim/lifting/line.h"
#include "sim/operation.h"
#include "sim/tangent.h"

namespace stillhook {
namespace {

/// A line from the world whose length two drives shorten. It pushes as well as it pulls; nothing here makes it push.
class SeriesLine final : public ForceElement {
 public:
  SeriesLine(BodyPoint from, BodyPoint to, double stiffness, double length, std::array<int, 2> drives)
      : ForceElement("series"), from_(from), to_(to), stiffness_(stiffness), length_(length), drives_(drives) {}

  std::span<const int> drives() const override { return drives_; }
  bool same_as(const ForceElement& other) const override {
    const auto* line = dynamic_cast<const SeriesLine*>(&other);
    return line && line->stiffness_ == stiffness_ && line->length_ == length_ && line->drives_ == drives_;
  }
  void add_forces(const Instant& now, double, Memory, ForceSum& out) const override {
    const LineMotion line = line_motion(from_, to_, now);
    add_line_forces(from_, to_, now, line, tension(line, now), out);
  }
  void add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const override {
    const LineMotion line = line_motion(from_, to_, now);
    add_line_jacobian(from_, to_, now, line, tension(line, now), stiffness_, damping(), out);
  }

 private:
  double damping() const { return 0.02 * stiffness_; }  // per s
  double tension(const LineMotion& line, const Instant& now) const {
    const DriveState &a = now.drive[drives_[0]], &b = now.drive[drives_[1]];
    return stiffness_ * (line.length - length_ + a.position + b.position) + damping() * (line.rate + a.rate + b.rate);
  }

  BodyPoint from_, to_;
  double stiffness_, length_;
  std::array<int, 2> drives_;
};

/// A load of 10 t hangs 20 m below the origin; the winch hauls in 4 m at `winch_speed`, the compensator gives 1 m at its own.
struct Lift {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Operation> operation;

  Lift(double winch_speed, double compensator_speed) {
    Specification spec;
    spec.name = "two drives";
    BodySpec load;
    load.name = "load";
    load.mass = 1.0e4;
    load.inertia = 1.0e4 * Matrix3::Identity();
    load.position = Vector3(0.5, 0.0, -20.0);
    spec.bodies = {load};
    for (const char* name : {"winch", "compensator"}) {
      DriveSpec drive;
      drive.name = name;
      spec.drives.push_back(drive);
    }
    spec.own_elements.push_back([](const ElementSite& site) -> std::unique_ptr<const ForceElement> {
      return std::make_unique<SeriesLine>(site.point("world", Vector3::Zero()), site.point("load", Vector3(0.0, 0.0, 0.5)),
                                          4.0e6, 19.3, std::array<int, 2>{site.drive("winch"), site.drive("compensator")});
    });
    PhaseSpec phase;
    phase.name = "hoist";
    phase.duration = 30.0;
    MoveSpec winch, compensator;
    winch.drive = "winch";
    winch.speed = winch_speed;
    winch.travel = 4.0;
    winch.profile.ramp = 2.0;
    compensator.drive = "compensator";
    compensator.speed = compensator_speed;
    compensator.travel = -1.0;
    compensator.delay = 3.0;
    compensator.profile.ramp = 2.0;
    phase.moves = {winch, compensator};
    spec.operation.load = "load";
    spec.operation.phases = {phase};
    spec.solver.static_start = false;  // it swings
    spec.solver.newton_tolerance = 1e-11;
    model = std::make_shared<const Model>(build_model(spec));
    operation = std::make_shared<const Operation>(build_operation(*model));
  }
};

}  // namespace

TEST_CASE("a run and its derivatives know both drives of an element", "[tangent][drives]") {
  constexpr double kWinch = 0.4, kCompensator = 0.15, kWidth = 1e-4;  // m/s
  const Lift lift(kWinch, kCompensator);
  RunOptions options;
  const Trajectory run = simulate(*lift.model, *lift.operation, options);
  const int z = run.find("load.z");
  REQUIRE(z >= 0);
  // Both have moved: at the end the load hangs on 16.3 m of line and W/k of stretch, 0.5 m below its end, but for a swing
  // of 1.4 degrees; at the start the line was stretched by 0.2 m.
  const double hanging = -(19.3 - 3.0 + 1e4 * 9.80665 / 4.0e6 + 0.5);
  CHECK(run.values[z].back() == Approx(hanging).margin(0.01));

  std::vector<LiftTwin> twins;
  std::vector<std::array<Trajectory, 2>> runs;
  for (int drive = 0; drive < 2; ++drive) {
    LiftTwin twin;
    std::array<Trajectory, 2> sides;
    twin.width = kWidth;
    for (int side = 0; side < 2; ++side) {
      const double by = (side - 0.5) * kWidth;
      const Lift other(kWinch + (drive == 0 ? by : 0.0), kCompensator + (drive == 1 ? by : 0.0));
      twin.model[side] = other.model;
      twin.operation[side] = other.operation;
      sides[side] = simulate(*other.model, *other.operation, options);
    }
    twins.push_back(twin);
    runs.push_back(std::move(sides));
  }
  Tangents tangents;
  TangentOptions wanted;
  wanted.channels = {"load.z", "load.x"};
  const Trajectory with = simulate_with_tangents(*lift.model, *lift.operation, options, twins, wanted, tangents);
  REQUIRE(tangents.valid);
  for (std::size_t c = 0; c < wanted.channels.size(); ++c)
    for (int j = 0; j < 2; ++j) {
      const auto& [low, high] = runs[j];
      const int channel = low.find(wanted.channels[c]);
      const VectorX exact = tangents.values[c].col(j);
      REQUIRE(low.time.size() == high.time.size());
      REQUIRE(static_cast<std::size_t>(exact.size()) == low.time.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < low.time.size(); ++i)
        worst = std::max(worst, std::abs((high.values[channel][i] - low.values[channel][i]) / kWidth - exact[i]));
      INFO(wanted.channels[c] << " by the speed of drive " << j << ": largest " << exact.cwiseAbs().maxCoeff());
      REQUIRE(exact.cwiseAbs().maxCoeff() > 1e-3);
      // Differences of the width's square, 1e-8 of the third derivative, and Newton's tolerance over the width.
      CHECK(worst < 1e-5 * exact.cwiseAbs().maxCoeff());
    }
}

}  // namespace stillhook
