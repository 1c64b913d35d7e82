// The reference lift's linear response at 45 and 135 deg in the paper's two waves, load hanging, against estimates made
// with another frequency-domain panel method for isolated hulls.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <ostream>

#include "sim/response.h"
#include "tests/validation/reference_lift.h"

namespace stillhook {
namespace {

constexpr double kGravity = 9.80665, kDegree = std::numbers::pi / 180.0;

struct Wave {
  double amplitude, frequency;  // m, rad/s
};
constexpr Wave kSmall{0.2, 0.571}, kLarge{1.0, 0.628};

/// Amplitudes over both headings and, of a pair, both sides.
struct Range {
  double least = 1e9, most = 0.0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

std::ostream& operator<<(std::ostream& out, const Range& range) { return out << range.least << " to " << range.most; }

struct Estimates {
  Range roll, tip, sway, relative;  // deg, m, m, m/s
  Range pendulum;                   // 1, the load's motion over that of a pendulum on the same tips
};

const ReferenceLift& lift() {
  static const ReferenceLift l;
  return l;
}

/// The load's horizontal motion on tips that move by `tips`: fore and aft the falls and the load turn, a double pendulum
/// with a massless link; athwart the two falls stay parallel and the load rolls as its tips do, the centre 5 m below
/// the eyes: a simple one. Closed forms, nothing of the lift but the length of its falls.
Eigen::Vector2cd hung_from(const Eigen::Vector3cd& tips, Complex roll, double frequency) {
  const double l = lift().pose("even_keel_unloaded_a_hanging").values.at("hoist_port.length"), d = 5.0;
  const double m = 1e6, I = 1.66667e7, w2 = frequency * frequency;
  Eigen::Matrix2d M, K;
  M << m * l * l, m * l * d, m * l * d, m * d * d + I;
  K << m * kGravity * l, 0.0, 0.0, m * kGravity * d;
  const Eigen::Vector2d turned = (K - w2 * M).inverse() * Eigen::Vector2d(m * l * w2, m * d * w2);
  const double r = w2 * l / kGravity;
  return {tips.x() * (1.0 + l * turned[0] + d * turned[1]), (tips.y() + r * d * roll) / (1.0 - r) + d * roll};
}

Estimates estimates(const Wave& wave) {
  const StaticPose& equilibrium = lift().pose("even_keel_unloaded_a_hanging");
  const Model& model = lift().model;
  const LinearResponse linear(model, lift().state(equilibrium));
  const int crane = model.body_index("crane");
  Estimates e;
  for (const double heading : {45.0 * kDegree, 135.0 * kDegree}) {
    const ResponseAmplitude response = linear.at(wave.frequency, heading);
    e.roll.add(wave.amplitude * std::abs(response.body[crane](3)) / kDegree);
    // Of points: the crest passes the world's origin at t = 0 for all of them.
    const auto motion = [&](const std::string& name, const Vector3& point) -> Eigen::Vector3cd {
      const int body = model.body_index(name);
      const Pose& at = lift().body(equilibrium, name);
      const Vector3 arm = at.R * (point - model.specification().bodies[body].cog);
      return response.body[body].head<3>() -
             cross_matrix(arm).cast<Complex>() * (at.R.cast<Complex>() * response.body[body].tail<3>());
    };
    Eigen::Vector3cd hook = Eigen::Vector3cd::Zero();  // middle of the tips
    for (const char* boom : {"boom_port", "boom_starboard"}) {
      const Eigen::Vector3cd tip = motion(boom, Vector3(105.0, 0.0, 0.0));
      hook += 0.5 * tip;
      e.tip.add(wave.amplitude * std::abs(tip.z()));
    }
    const Vector3 above_load(lift().tip(equilibrium).x(), 0.0, 0.0);
    const Eigen::Vector3cd deck = motion("barge", lift().body(equilibrium, "barge").inverse() * above_load);
    e.relative.add(wave.amplitude * wave.frequency * std::abs(hook.z() - deck.z()));
    const Eigen::Vector3cd load = motion("load", Vector3::Zero());
    e.sway.add(wave.amplitude * load.head<2>().norm());
    const Eigen::Vector2cd hung = hung_from(hook, response.body[model.body_index("load")](3), wave.frequency);
    for (int axis = 0; axis < 2; ++axis) e.pendulum.add(std::abs(load[axis] / hung[axis]));
  }
  return e;
}

}  // namespace

TEST_CASE("linear estimates of the reference lift, load hanging", "[validation][slow]") {
  const Estimates small = estimates(kSmall), large = estimates(kLarge);
  INFO("roll " << small.roll << ", " << large.roll << " deg; tip " << small.tip << ", " << large.tip << " m; sway "
               << small.sway << ", " << large.sway << " m; relative " << small.relative << ", " << large.relative
               << " m/s; pendulum " << small.pendulum << ", " << large.pendulum);
  // Estimates to 10 %: the ranges over heading and side.
  CHECK(small.tip.least == Approx(0.33).epsilon(0.1));
  CHECK(small.tip.most == Approx(0.53).epsilon(0.1));
  CHECK(large.tip.least == Approx(2.0).epsilon(0.1));
  CHECK(large.tip.most == Approx(2.8).epsilon(0.1));
  const auto quasi_static = [](const Wave& wave, double tip) {
    return wave.frequency * wave.frequency * tip / kGravity;
  };
  CHECK(quasi_static(kSmall, small.tip.least) == Approx(0.011).epsilon(0.1));
  CHECK(quasi_static(kSmall, small.tip.most) == Approx(0.017).epsilon(0.1));
  CHECK(quasi_static(kLarge, large.tip.least) == Approx(0.08).epsilon(0.1));
  CHECK(quasi_static(kLarge, large.tip.most) == Approx(0.11).epsilon(0.1));
  CHECK(large.relative.most == Approx(1.4).epsilon(0.1));
  // Not met within 10 %: docs/validation.md says why. The estimate of roll has its period at 10.15 s, where these waves
  // are; the lift's is 8.5 s, and roll is less.
  CHECK(small.roll.most < 0.49);
  CHECK(large.roll.most < 3.2);
  // One degree of freedom with the period that both found, 8.5 s, and moments about the height of the centre of gravity
  // with the load in the tips gives 0.25 and 1.5 deg (docs/validation.md): the whole lift is within a tenth, as is the
  // moment's height.
  CHECK(small.roll.most == Approx(0.25).epsilon(0.1));
  CHECK(large.roll.most == Approx(1.5).epsilon(0.12));
  CHECK(small.roll.least > 0.2);
  CHECK(large.roll.least > 1.3);
  // Sway 0.4 and 1.9 to 2.3 m "plus start-up swing": 12 to 20 % below. Relative velocity 0.23 m/s, for a place on the barge
  // that the estimate does not name: 0.15 to 0.18 m/s under the hook, 0.10 to 0.25 m/s over the barge's breadth.
  CHECK(small.sway.most == Approx(0.4).epsilon(0.15));
  CHECK(large.sway.most == Approx(2.1).epsilon(0.2));
  CHECK(small.relative.most == Approx(0.23).epsilon(0.25));
  // Whatever the tips do, the load hangs from them as a pendulum: the closed form leaves out that the crane yaws under
  // the load (the two falls are not quite parallel then) and the trim, some tenths of a per cent each.
  for (const Range& ratio : {small.pendulum, large.pendulum}) {
    CHECK(ratio.least == Approx(1.0).margin(0.02));
    CHECK(ratio.most == Approx(1.0).margin(0.02));
  }
}

}  // namespace stillhook
