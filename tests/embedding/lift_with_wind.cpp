// Runs a lift with a force element that stillhook does not have: a steady wind force on the load.
//
// A load of 100 t hangs on one wire from a fixed point. At rest the fall then makes the angle arctan(F / (m g)) with the
// vertical, and the load lies off by (pendulum length) sin(angle). The pendulum length is the stretched wire and the
// distance from the lifting eye to the centre of gravity, on which the force acts.
#include <cmath>
#include <cstdio>
#include <sim/element_site.h>
#include <sim/multibody/force_element.h>
#include <stillhook.h>

namespace {

constexpr char kCase[] = R"(
name = "wind_on_a_hanging_load"

[[bodies]]
name = "load"
mass_t = 100.0
inertia_t_m2 = [400.0, 400.0, 400.0]
position_m = [0.0, 0.0, 10.0]

[[wires]]
name = "fall"
role = "hoist"
from = "world"
point_from_m = [0.0, 0.0, 40.0]
to = "load"
point_to_m = [0.0, 0.0, 4.0]
axial_stiffness_kN = 200000.0
slack_m = 0.0

[[operation.phases]]
name = "hang"
stage = "hanging"
duration_s = 20.0
)";

class SteadyWind : public stillhook::ForceElement {
 public:
  SteadyWind(int body, double force) : ForceElement("wind"), body_(body), force_(force) {}

  void add_forces(const stillhook::Instant&, double, stillhook::Memory, stillhook::ForceSum& out) const override {
    out.add(body_, {force_, 0.0, 0.0}, {0.0, 0.0, 0.0});
  }
  void add_jacobian(const stillhook::Instant&, double, stillhook::Memory, stillhook::JacobianSum&) const override {}
  double potential_energy(const stillhook::Instant& now, stillhook::Memory) const override {
    return -force_ * now.body[body_].p_WC.x();
  }
  std::vector<stillhook::Channel> channels() const override { return {{"wind.force", "N", "steady wind force"}}; }
  void measure(const stillhook::Instant&, stillhook::Memory, std::span<double> out) const override { out[0] = force_; }

 private:
  int body_;
  double force_;
};

}  // namespace

int main() {
  const double force = 50e3, weight = 100e3 * 9.80665;
  try {
    stillhook::Lift lift = stillhook::Lift::parse(kCase, "wind.toml");
    lift.add([=](const stillhook::ElementSite& site) {
      return std::make_unique<const SteadyWind>(site.body("load"), force);
    });
    const stillhook::LiftRun run = lift.simulate();
    const double tension = std::hypot(force, weight), angle = std::atan2(force, weight);
    const double slack_length = run.series("fall.unstretched").back();
    const double length = slack_length * (1.0 + tension / 200e6) + 4.0;
    const double off = run.series("load.x").back(), expected = length * std::sin(angle);
    std::printf("stillhook %s: %s, load %.6f m off, by hand %.6f m; tension %.3f N, by hand %.3f N\n",
                stillhook::library_version().c_str(), run.status().c_str(), off, expected,
                run.series("fall.tension").back(), tension);
    // The equilibrium is found to 1e-6 of the largest weight, which moves the load by less than a tenth of a millimetre.
    const bool right = std::abs(off - expected) < 1e-4 && std::abs(run.series("fall.tension").back() - tension) < 10.0 &&
                       run.series("wind.force").back() == force;
    return run.status() == "completed" && right ? 0 : 1;
  } catch (const stillhook::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
