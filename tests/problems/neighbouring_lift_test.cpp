// A lift built beside another that differs in one key, against the same lift built alone.
#include <catch2/catch.hpp>

#include "problems/case.h"
#include "sim/operation.h"
#include "sim/simulate.h"

namespace stillhook {
namespace {

struct Lift {
  Model model;
  Operation operation;
};

Lift alone(const Case& c) {
  Model model = build_model(c.specification);
  Operation operation = build_operation(model);
  return {std::move(model), std::move(operation)};
}

Lift beside(const Case& c, const Lift& other) {
  Model model = build_model_like(c.specification, other.model);
  Operation operation = build_operation_like(model, other.model, other.operation);
  return {std::move(model), std::move(operation)};
}

/// Largest distance of a body or drive between two operations' static poses, m.
double apart(const Operation& a, const Operation& b) {
  REQUIRE(a.static_poses.size() == b.static_poses.size());
  double worst = 0.0;
  for (std::size_t p = 0; p < a.static_poses.size(); ++p) {
    for (std::size_t i = 0; i < a.static_poses[p].bodies.size(); ++i)
      worst = std::max(worst, (a.static_poses[p].bodies[i].p - b.static_poses[p].bodies[i].p).norm());
    for (std::size_t d = 0; d < a.static_poses[p].drives.size(); ++d)
      worst = std::max(worst, std::abs(a.static_poses[p].drives[d] - b.static_poses[p].drives[d]));
  }
  return worst;
}

std::string box() { return std::string(STILLHOOK_SOURCE_DIR) + "/problems/box_installation.toml"; }

TEST_CASE("Keys that no equilibrium depends on leave every static pose as it is, to the last bit", "[neighbour]") {
  const Case c = read_case(box());
  const Lift base = alone(c);
  for (const char* key :
       {"bodies.crane.hydrodynamics.critical_fraction_roll", "bodies.crane.hydrodynamics.added_mass_factor",
        "bodies.crane.hydrodynamics.radiation_factor", "wires.hoist_port.damping_ratio",
        "sea.states.paper_table1.amplitude_m", "sea.states.paper_table1.heading_deg",
        "contacts.load_on_barge.damping_kN_s_per_m", "taglines.tagline_port.time_constant_s"}) {
    const Lift changed = beside(with_values(c, {{key, 1.1 * key_value(c, key)}}), base);
    CAPTURE(key);
    CHECK(apart(changed.operation, base.operation) == 0.0);
  }
}

TEST_CASE("A lift built beside another stands where it stands when built alone", "[neighbour]") {
  const Case c = read_case(box());
  const Lift base = alone(c);
  // Nothing here lands within the operation but the load on its support, where friction remembers the way.
  for (const auto& [key, moves] :
       std::vector<std::pair<std::string, double>>{{"moorings.crane_bow_port.pretension_kN", 1e-3},
                                                   {"moorings.barge_bow_port.stiffness_kN_per_m", 0.0},
                                                   {"wires.luffing_port.axial_stiffness_kN", 1e-5},
                                                   {"wires.hoist_port.axial_stiffness_kN", 1e-5},
                                                   {"taglines.*.pretension_kN", 1e-5},
                                                   {"bodies.load.mass_t", 1e-3},
                                                   {"bodies.crane.cog_m.0", 1e-3},
                                                   {"operation.phases.hoist_up.moves.hoist.goal.value_m", 1e-3}}) {
    const Case d = with_values(c, {{key, 1.001 * key_value(c, key)}});
    const Lift cold = alone(d), warm = beside(d, base);
    CAPTURE(key, apart(cold.operation, base.operation), apart(cold.operation, warm.operation));
    CHECK(apart(cold.operation, base.operation) >= moves);  // the key matters
    // Goals are reached within 1e-10 of theirs; equilibria within rounding, which soft coordinates (a mooring of 60 s
    // on 20,000 t) make 1e-9 m of.
    CHECK(apart(cold.operation, warm.operation) < 1e-8);
  }
}

TEST_CASE("A lift built beside another has its own wire", "[neighbour]") {
  const std::string file = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";
  const Lift base = alone(read_case(file));
  const Case longer = read_case(file, {{"wires.fall.unstretched_length_m", "18.1"}});
  const Lift cold = alone(longer), warm = beside(longer, base);
  CHECK(warm.model.initial_lengths()[0] == 18.1);
  CHECK(warm.model.initial_state().body[1].p_WC.z() ==
        Approx(base.model.initial_state().body[1].p_WC.z() - 0.1).margin(1e-3));
  CHECK(apart(cold.operation, warm.operation) < 1e-8);
}

TEST_CASE("Phases that cannot begin before the end of a run are left out", "[neighbour]") {
  const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml");
  const Model model = build_model(c.specification);
  const Operation whole = build_operation(model);
  REQUIRE(whole.phases.size() == 3);
  const double first = whole.phases[0].duration;
  CHECK(build_operation(model, first).phases.size() == 1);
  CHECK(build_operation(model, first + 0.01).phases.size() == 2);
  CHECK(build_operation(model, 1e6).phases.size() == 3);
  const Operation some = build_operation(model, first + 0.01);
  REQUIRE(some.equilibria.size() == 3);
  REQUIRE(some.static_poses.size() == 3);
  CHECK(apart(some, [&] {
          Operation cut = whole;
          cut.static_poses.resize(3);
          return cut;
        }()) == 0.0);
}

TEST_CASE("A part of an operation begins at rest where the part before it ends", "[neighbour][part]") {
  const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml",
                           {{"sea.active", "calm"}});
  const Model model = build_model(c.specification);
  const Operation whole = build_operation(model);
  const Trajectory all = simulate(model, whole);
  const auto run_of = [&](const OperationPart& part) {
    const SystemState start = start_of(whole, part);
    RunOptions options;
    options.from = &start;
    return simulate(model, part_of(whole, part), options);
  };
  const auto series = [](const Trajectory& run, const char* channel) {
    return run.values[static_cast<std::size_t>(run.find(channel))];
  };
  // In calm water the lift is still at rest when the hoisting begins: both runs show the same from there.
  const Trajectory hoisting = run_of({1, 0.0});
  REQUIRE(hoisting.status == RunStatus::completed);
  REQUIRE(hoisting.phases.size() == 2);
  CHECK(hoisting.time.back() == Approx(whole.phases[1].duration).margin(0.2));
  const auto first = static_cast<std::size_t>(std::lround(all.phases[1].start / 0.2));
  for (const char* channel : {"load.z", "load.x", "fall.tension"}) {
    const std::vector<double> a = series(all, channel), b = series(hoisting, channel);
    for (std::size_t i = 0; i < b.size() && first + i < a.size(); ++i) {
      CAPTURE(channel, i);
      CHECK(b[i] == Approx(a[first + i]).epsilon(1e-6));  // Newton's tolerance
    }
  }
  // Held at its end, nothing moves.
  const Trajectory held = run_of({1, 20.0});
  REQUIRE(held.status == RunStatus::completed);
  CHECK(held.time.back() == Approx(20.0));
  const double z = held.static_poses[2].bodies[1].p.z();
  for (const double v : series(held, "load.z")) CHECK(v == Approx(z).margin(1e-6));
}

}  // namespace
}  // namespace stillhook
