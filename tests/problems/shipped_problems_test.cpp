// Every shipped problem reads, stands still where it says, has a pose at the end of each phase, and runs.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "problems/evaluator.h"
#include "problems/scenarios.h"
#include "sim/hull/mesh/mesh_file.h"
#include "sim/operation.h"
#include "sim/simulate.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> shipped_problems() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(std::string(STILLHOOK_SOURCE_DIR) + "/problems"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string problem(const std::string& name) {
  return std::string(STILLHOOK_SOURCE_DIR) + "/problems/" + name + ".toml";
}

double degrees(double radians) { return radians * 180.0 / M_PI; }

/// Value of a channel in the pose at the end of a phase.
double at_end(const Operation& operation, const std::string& phase, const std::string& channel) {
  for (const StaticPose& pose : operation.static_poses)
    if (pose.name == phase) return pose.values.at(channel);
  FAIL("no phase " + phase);
  return 0.0;
}

}  // namespace

TEST_CASE("the shipped problems are the three of the documentation") {
  std::vector<std::string> names;
  for (const std::string& file : shipped_problems()) names.push_back(fs::path(file).stem().string());
  CHECK(names == std::vector<std::string>{"box_installation", "jacket_installation", "manifold_installation"});
}

TEST_CASE("every shipped problem starts where it stands, and every phase ends in a static pose") {
  for (const std::string& file : shipped_problems()) {
    INFO(file);
    const Case c = read_case(file);
    CHECK(c.name == fs::path(file).stem());
    CHECK(!c.limits.empty());
    const Model model = build_model(c.specification);
    const Operation operation = build_operation(model);
    REQUIRE(operation.static_poses.size() == c.specification.operation.phases.size() + 1);
    const StaticPose& start = operation.static_poses.front();
    for (const BodySpec& body : c.specification.bodies) {
      INFO(body.name);
      const auto& values = start.values;
      // 1 cm and 0.01 deg: the drafts and penetrations that a case states are rounded to that.
      CHECK(values.at(body.name + ".z") == Approx(body.position.z()).margin(0.01));
      CHECK(values.at(body.name + ".x") == Approx(body.position.x()).margin(0.01));
      const Matrix3& R = start.bodies[model.body_index(body.name)].R;
      const Vector3 turned = log_rotation(rotation_from(body.attitude).transpose() * R);
      CHECK(degrees(turned.norm()) < 0.01);
    }
    for (const WireSpec& wire : c.specification.wires)
      for (std::size_t i = 0; i < operation.static_poses.size(); ++i) {
        INFO(wire.name << " at the end of " << operation.static_poses[i].name);
        const double tension = operation.static_poses[i].values.at(wire.name + ".tension");
        const bool holds_a_boom = wire.role != WireSpec::Role::hoist;
        if (holds_a_boom) CHECK(tension > 0.0);  // a hoist wire may be just taut on deck, a boom would fall
        if (wire.tension_max > 0.0) CHECK(tension < wire.tension_max);
        if (wire.breaking_load > 0.0) CHECK(tension < wire.breaking_load / 4.0);  // safety factor in calm water
      }
  }
}

TEST_CASE("every shipped problem can be planned: objective, variables in bounds, scenarios") {
  for (const std::string& file : shipped_problems()) {
    INFO(file);
    const Evaluator evaluator(read_case(file));  // throws for a baseline outside its bounds, an unknown scenario ...
    CHECK(evaluator.scenarios().size() == 2);
    CHECK(evaluator.baseline().size() >= 5);
    CHECK(evaluator.constraints().size() >= 5);
    for (const ScenarioSpec& scenario : evaluator.scenarios()) {
      INFO(scenario.name);
      CHECK_NOTHROW(build_model(in_scenario(evaluator.base().specification, scenario)));
    }
  }
}

TEST_CASE("every shipped problem runs 30 s in its sea and stays near its static pose") {
  for (const std::string& file : shipped_problems()) {
    INFO(file);
    const Case c = read_case(file, {{"solver.max_duration_s", "30"}});
    const Model model = build_model(c.specification);
    const Trajectory run = simulate(model, build_operation(model));
    INFO(run.message);
    CHECK(run.status == RunStatus::completed);
    CHECK(run.duration() == Approx(30.0).margin(0.2));  // one output interval
    for (const BodySpec& body : c.specification.bodies) {
      const int channel = run.find(body.name + ".z");
      REQUIRE(channel >= 0);
      // Waves of at most 1 m significant height lift no body by 2 m: more would be an instability.
      for (const double z : run.values[channel]) REQUIRE(std::abs(z - run.values[channel].front()) < 2.0);
    }
  }
}

TEST_CASE("the manifold hangs lighter in water by the water that its mesh displaces") {
  const Case c = read_case(problem("manifold_installation"));
  const SeaSpec& sea = c.specification.sea;
  const std::string hulls = std::string(STILLHOOK_SOURCE_DIR) + "/problems/hulls/";
  const double volume = properties_of(read_mesh(hulls + "manifold_14x10x6.obj")).volume;
  CHECK(volume == Approx(63.248));  // by hand: mudmats 19.6, posts 13.184, top beams 11.264, header 19.2 m3
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  const auto hook_load = [&](const std::string& phase) {
    return at_end(operation, phase, "hoist_port.tension") + at_end(operation, phase, "hoist_starboard.tension");
  };
  // 0.5 %: the taglines pull with 20 kN, down before and up after, and the falls lean by a degree.
  const double weight = 300e3 * sea.gravity;
  CHECK(hook_load("lower_to_surface") == Approx(weight).epsilon(0.005));
  CHECK(hook_load("hold") == Approx(weight - sea.density * sea.gravity * volume).epsilon(0.01));
  CHECK(at_end(operation, "hold", "manifold.z") == Approx(-30.0).margin(1e-3));
}

TEST_CASE("the jacket hangs upright between its falls and comes to stand on the sea bed") {
  const Case c = read_case(problem("jacket_installation"));
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  for (const char* phase :
       {"load_transfer", "hoist_up", "rotate_backstays", "rotate_booms", "hoist_down", "lower_in_water"}) {
    INFO(phase);
    CHECK(at_end(operation, phase, "hoist_port.tension") ==
          Approx(at_end(operation, phase, "hoist_starboard.tension")).epsilon(1e-6));  // symmetric about y = 0
    CHECK(std::abs(degrees(at_end(operation, phase, "jacket.pitch"))) < 1.0);
  }
  // The feet stand on the sea bed, pressed in by at most the static penetration of the whole weight, 9 cm.
  CHECK(at_end(operation, "set_down", "jacket.z") < -25.0);
  CHECK(at_end(operation, "set_down", "jacket.z") > -25.09);
  CHECK(at_end(operation, "set_down", "hoist_port.tension") == Approx(500e3).epsilon(1e-3));
  // Above the barge until it has left: no pickup force in any pose after the transfer.
  CHECK(at_end(operation, "hoist_up", "jacket_on_barge.force") == 0.0);
}
