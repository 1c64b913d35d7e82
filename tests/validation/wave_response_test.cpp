// The reference lift, load hanging, in the paper's small wave from two sides: what the run does against the linear
// response of its pose. The two share the bodies and the hulls' coefficients and nothing of how they are used: the run
// integrates nonlinear buoyancy, wires and the memory of the waves over time, the other solves one complex system at
// one frequency.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/response.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/validation/reference_lift.h"

using namespace stillhook;

namespace {

constexpr int kPeriods = 40;  // of the wave, at the end of the run: the load swings freely at half the wave's frequency
const char* const kChannels[6] = {".x", ".y", ".z", ".roll", ".pitch", ".yaw"};

constexpr double kLoad = 1e6;  // kg

/// The lift up to the hoisted load, which then waits; without taglines, which are not linear. With the load over to the
/// crane the barge rides a tenth higher than its coefficients and the crane deeper: both roads take the pressure of the
/// wave on the hull as it floats then, and the diffraction of the draft that the coefficients were computed for.
Specification waiting(double heading) {
  Specification s = reference_case().specification;
  for (const BodySpec& body : s.bodies)
    if (body.name == "load") REQUIRE(body.mass == Approx(kLoad));
  s.taglines.clear();
  std::erase_if(s.contacts, [](const ContactSpec& c) { return c.role == ContactSpec::Role::target; });
  s.poses.clear();
  s.operation.phases.resize(3);
  PhaseSpec hold;
  hold.name = "waiting";
  hold.duration = 560.0;
  s.operation.phases.push_back(hold);
  for (SeaStateSpec& state : s.sea.states)
    if (state.name == "paper_table1") state.heading = heading;
  return s;
}

/// Amplitude of a channel at frequency w over the last periods of the run, under a Hann window: of the free swing, 18
/// bins away, less than a thousandth leaks in.
double amplitude(const Trajectory& run, const std::string& name, double w) {
  const int c = run.find(name);
  REQUIRE(c >= 0);
  const std::vector<double>& value = run.values[static_cast<std::size_t>(c)];
  const double to = run.time.back(), from = to - kPeriods * 2.0 * std::numbers::pi / w;
  const auto weight = [&](double t) { return t < from ? 0.0 : 1.0 - std::cos(2.0 * std::numbers::pi * (t - from) / (to - from)); };
  double total = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i) total += weight(run.time[i]), mean += weight(run.time[i]) * value[i];
  mean /= total;
  Complex sum = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i)
    sum += weight(run.time[i]) * (value[i] - mean) * std::polar(1.0, w * run.time[i]);
  return 2.0 * std::abs(sum) / total;
}

/// Complex displacement of a point of a body along W, crest at the origin of W.
Eigen::Vector3cd of_point(const ReferenceLift& lift, const StaticPose& pose, const ResponseAmplitude& response, const std::string& body,
                          const Vector3& point) {
  const auto b = static_cast<std::size_t>(lift.model.body_index(body));
  const Pose& at = pose.bodies[b];
  const Vector3 arm = at.R * (point - lift.model.specification().bodies[b].cog);
  return response.body[b].head<3>() - cross_matrix(arm).cast<Complex>() * (at.R.cast<Complex>() * response.body[b].tail<3>());
}

/// Amplitude of a hoist wire's tension per metre of wave, N: its stiffness times what the linear motions stretch it by.
Complex tension(const ReferenceLift& lift, const StaticPose& pose, const ResponseAmplitude& response, const std::string& name) {
  for (const WireSpec& wire : lift.model.specification().wires)
    if (wire.name == name) {
      const Vector3 along = (lift.body(pose, wire.to) * wire.point_to - lift.body(pose, wire.from) * wire.point_from).normalized();
      const Eigen::Vector3cd apart = of_point(lift, pose, response, wire.to, wire.point_to) -
                                     of_point(lift, pose, response, wire.from, wire.point_from);
      return wire.axial_stiffness / pose.values.at(name + ".unstretched") * along.cast<Complex>().dot(apart);
    }
  FAIL("no wire " << name);
  return 0.0;
}

}  // namespace

TEST_CASE("the reference lift with its load on the hook moves in a small wave as its linear response says", "[validation][slow]") {
  const double heading = GENERATE(45.0, 135.0) * kDegree;
  const Specification spec = waiting(heading);
  const ReferenceLift lift(spec);
  const Operation operation = build_operation(lift.model);
  const Trajectory run = simulate(lift.model, operation);
  CAPTURE(heading / kDegree, run.message);
  REQUIRE(run.status == RunStatus::completed);
  const SeaStateSpec& sea = *std::ranges::find(spec.sea.states, spec.sea.active, &SeaStateSpec::name);
  REQUIRE(sea.type == SeaStateSpec::Type::regular);
  const StaticPose& pose = operation.static_poses.back();
  const LinearResponse linear(lift.model, lift.state(pose));
  const ResponseAmplitude response = linear.at(sea.frequency, heading);

  for (const std::string body : {"crane", "barge", "load", "boom_port", "boom_starboard"}) {
    const auto expected = linear.motion(response, lift.model.body_index(body), Vector3::Zero());
    // The turns of a steep boom are no roll, pitch and yaw.
    for (int i = 0; i < (body.starts_with("boom") ? 3 : 6); ++i) {
      const double found = amplitude(run, body + kChannels[i], sea.frequency);
      // 2 % of the largest of translations or turns: the sea's amplitude is small, so the square of the motions is not
      // felt, and the step of 0.05 s takes (w h)^2 / 12 = 7e-5.
      const double most = sea.amplitude * expected.segment(i < 3 ? 0 : 3, 3).cwiseAbs().maxCoeff();
      CAPTURE(body, kChannels[i], found, sea.amplitude * std::abs(expected[i]), most);
      CHECK(std::abs(found - sea.amplitude * std::abs(expected[i])) < 0.02 * most);
    }
  }
  Complex both = 0.0;
  for (const std::string wire : {"hoist_port", "hoist_starboard"}) {
    const Complex T = sea.amplitude * tension(lift, pose, response, wire);
    both += T;
    const double found = amplitude(run, wire + ".tension", sea.frequency);
    CAPTURE(wire, found, std::abs(T));
    CHECK(found == Approx(std::abs(T)).epsilon(0.02));
  }
  // Together they accelerate the load: m w^2 z, whatever the wires' law.
  const double z = amplitude(run, "load.z", sea.frequency);
  CHECK(std::abs(both) == Approx(kLoad * sea.frequency * sea.frequency * z).epsilon(0.02));
}
