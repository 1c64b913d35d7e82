// The shipped lifts that enter the water, in still water and to their end: what the falls carry through the surface, how
// hard the feet meet the sea bed, what stands on them. Every number by hand from the drawings of the hulls and the case.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "planner/run.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665, kRho = 1025.0;

/// A shipped lift without waves, without taglines, which would pull at the falls.
struct StillRun {
  explicit StillRun(const std::string& problem, const std::string& state) {
    const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/problems/" + problem + ".toml",
                             {{"sea.active", "\"" + state + "\""}, {"sea.states." + state + ".amplitude_m", "1e-6"},
                              {"taglines.*.active", "false"}});
    const PreparedRun prepared = prepare_run(c, c.specification);
    run = simulate(prepared.model, prepared.operation);
    INFO(run.message);
    REQUIRE(run.status == RunStatus::completed);
  }
  const std::vector<double>& of(const std::string& channel) const {
    const int c = run.find(channel);
    REQUIRE(c >= 0);
    return run.values[static_cast<std::size_t>(c)];
  }
  const PhaseRecord& phase(const std::string& name) const {
    for (const PhaseRecord& p : run.phases)
      if (p.name == name) return p;
    throw std::runtime_error("no phase " + name);
  }
  double hook_load(std::size_t i) const { return of("hoist_port.tension")[i] + of("hoist_starboard.tension")[i]; }
  /// Calls f(sample) within a phase, `from` and `to` s inside its ends.
  template <class F>
  void within(const std::string& name, double from, double to, F f) const {
    const PhaseRecord& p = phase(name);
    int samples = 0;
    for (std::size_t i = 0; i < run.time.size(); ++i)
      if (run.time[i] >= p.start + from && run.time[i] <= p.end - to) f(i), ++samples;
    CHECK(samples > 10);
  }
  Trajectory run;
};

/// Volume of the manifold below a surface `depth` over its base, m3: mudmats, posts, header, top beams, as boxes.
double manifold_volume(double depth) {
  struct Part {
    double area, from, to;  // m2, m over the base
  };
  constexpr Part kParts[] = {{98.0, 0.0, 0.2}, {2.56, 0.25, 5.4}, {19.2, 1.0, 2.0}, {20.48, 5.45, 6.0}};
  double volume = 0.0;
  for (const Part& p : kParts) volume += p.area * std::clamp(depth - p.from, 0.0, p.to - p.from);
  return volume;
}

}  // namespace

TEST_CASE("the manifold goes through the surface: the falls lose what it displaces, and take no snap", "[validation][slow]") {
  CHECK(manifold_volume(7.0) == Approx(63.248).epsilon(1e-4));
  const StillRun still("manifold_installation", "regular");
  const double weight = 300e3 * kG;
  // Lowered at 0.2 m/s against 126 kN s2/m2 of drag, 5 kN; the falls lean by a degree with the vessel's trim, 2e-4.
  const double drag = 126e3 * 0.2 * 0.2, most = 0.01 * weight;
  double least = weight, worst = 0.0;
  still.within("splash_zone", 8.0, 8.0, [&](std::size_t i) {
    const double depth = -still.of("manifold.z")[i];
    const double expected = weight - kRho * kG * manifold_volume(depth) - (depth > 0.2 ? drag : 0.0);
    worst = std::max(worst, std::abs(still.hook_load(i) - expected));
    least = std::min(least, still.hook_load(i));
  });
  CAPTURE(worst, least);
  // A hundredth of the weight: the mudmats take 200 kN within a second, and the vessel and its falls answer.
  CHECK(worst < most);
  CHECK(least > weight - kRho * kG * 63.248 - drag - most);
  double sum = 0.0, depth = 0.0;
  int samples = 0;
  still.within("hold", 10.0, 0.0, [&](std::size_t i) { sum += still.hook_load(i), depth -= still.of("manifold.z")[i], ++samples; });
  CHECK(sum / samples == Approx(weight - kRho * kG * 63.248).epsilon(0.001));
  CHECK(depth / samples == Approx(30.0).margin(0.01));
}

TEST_CASE("the jacket comes to stand on the sea bed: touch at the winch's speed, the weight less water and falls on its feet",
          "[validation][slow]") {
  const StillRun still("jacket_installation", "wind_sea");
  const double weight = 900e3 * kG;
  // Four legs with the section of a tube of 1.8 m at every height, 25 m of them under water.
  const double water = kRho * kG * 4.0 * 0.25 * std::acos(-1.0) * 1.8 * 1.8 * 25.0;
  // 1 %: the drag at 2 m/min, and the heave of the vessel that the load leaves.
  still.within("lower_in_water", 60.0, 20.0, [&](std::size_t i) {
    const double share = std::clamp(-still.of("jacket.z")[i] / 25.0, 0.0, 1.0);
    REQUIRE(std::abs(still.hook_load(i) - (weight - share * water)) < 0.01 * weight);
  });
  const ContactEvent* touch = nullptr;
  for (const ContactEvent& e : still.run.contacts)
    if (e.contact == "jacket_on_sea_bed" && !touch) touch = &e;
  REQUIRE(touch);
  CHECK(touch->phase == "set_down");
  // 0.5 m/min: the fastest foot adds what the jacket rocks at by then.
  const double winch = 0.5 / 60.0;
  CAPTURE(touch->approach_speed, touch->peak_force);
  CHECK(touch->approach_speed > 0.8 * winch);
  CHECK(touch->approach_speed < 3.0 * winch);

  double force = 0.0, falls = 0.0, z = 0.0;
  int samples = 0;
  still.within("hold", 30.0, 0.0, [&](std::size_t i) {
    force += still.of("jacket_on_sea_bed.force")[i];
    falls += still.hook_load(i);
    z += still.of("jacket.z")[i];
    ++samples;
  });
  force /= samples, falls /= samples, z /= samples;
  CAPTURE(force, falls, z);
  // The goal of the last move, in calm water; 2 % is a quarter of a millimetre of the falls.
  CHECK(falls == Approx(2.0 * 500e3).epsilon(0.02));
  CHECK(force + falls == Approx(weight - water).epsilon(0.002));  // Newton; the feet are pressed in by a centimetre
  CHECK(z == Approx(-25.0 - force / 1e8).margin(0.001));          // 1e5 kN/m, all feet together
  CHECK(still.of("jacket_on_barge.force").back() == 0.0);
}
