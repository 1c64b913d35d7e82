// [[rigging]] in a case: the bodies and wires that it becomes, what is refused, and a double pendulum.
#include <catch2/catch.hpp>
#include <cmath>

#include "problems/case.h"
#include "sim/modes.h"
#include "sim/operation.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

/// 300 t, hardly larger than a point, 12 m below a hook of 20 t on 60 m of wire.
std::string hung(const std::string& rigging) {
  return R"(name = "hung"
[[bodies]]
name = "load"
mass_t = 300.0
gyration_m = [0.05, 0.05, 0.05]
position_m = [0.0, 0.0, -72.0]
[[wires]]
name = "fall"
role = "hoist"
from = "world"
to = "hook"
axial_stiffness_kN = 1.0e8
damping_ratio = 0.0
damping_mass_t = 300.0
unstretched_length_m = 60.0
)" + rigging +
         R"(
[operation]
load = "load"
[[operation.phases]]
name = "wait"
duration_s = 10.0
)";
}

const std::string kFour = R"(
[[rigging]]
name = "hook"
load = "load"
block_mass_t = 20.0
block_size_m = [0.1, 0.1, 0.1]
slings = [
  { name = "a", to_m = [1.0, 1.0, 0.0], length_m = 12.083045973594572, axial_stiffness_kN = 1.0e8 },
  { name = "b", to_m = [-1.0, 1.0, 0.0], length_m = 12.083045973594572, axial_stiffness_kN = 1.0e8 },
  { name = "c", to_m = [-1.0, -1.0, 0.0], length_m = 12.083045973594572, axial_stiffness_kN = 1.0e8 },
  { name = "d", to_m = [1.0, -1.0, 0.0], length_m = 12.083045973594572, axial_stiffness_kN = 1.0e8 },
]
)";

Case case_of(const std::string& text) { return read_case_text(text, "rigged.toml", "."); }

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

}  // namespace

TEST_CASE("a hook and a load below it are a double pendulum", "[rigging]") {
  const Case c = case_of(hung(kFour));
  REQUIRE(c.specification.bodies.size() == 2);
  REQUIRE(c.specification.wires.size() == 5);
  CHECK(c.specification.bodies[1].position.z() == Approx(-60.0).margin(1e-4));
  const Model model = build_model(c.specification);
  // 16.950 and 1.5932 s: points of 20 and 300 t on 60 and 12 m, in closed form. The load's own inertia is 2e-5 of it.
  double slow = 0.0, fast = 1e9;
  for (const Mode& mode : natural_modes(model, model.initial_state())) {
    const double T = mode.period;
    if (T > 10.0 && T < 100.0) slow = T;
    if (T > 1.0 && T < 3.0) fast = std::min(fast, T);
  }
  CHECK(slow == Approx(16.9502).epsilon(1e-3));
  CHECK(fast == Approx(1.5932).epsilon(1e-3));
}

TEST_CASE("keys of rigging lead to its bodies and wires, and can be varied", "[rigging]") {
  const Case c = case_of(hung(kFour));
  CHECK(key_value(c, "rigging.hook.block_mass_t") == 20.0);
  const Case changed =
      with_values(c, {{"rigging.hook.block_mass_t", 30.0}, {"rigging.hook.slings.b.length_error_mm", 0.2}});
  CHECK(changed.specification.bodies[1].mass == 30e3);
  CHECK(changed.specification.wires[2].unstretched_length == Approx(12.083045973594572 + 2e-4));
  // The document keeps the entry: read again it is the same lift.
  const Case again = case_of(resolved_text(changed));
  CHECK(again.specification.bodies.size() == 2);
  CHECK(again.specification.wires[2].unstretched_length == changed.specification.wires[2].unstretched_length);
}

TEST_CASE("a model's complaint about a sling names the entry of the rigging", "[rigging]") {
  const Case c = case_of(hung(kFour));
  const CaseError error = located(c, SpecificationError("wires.b", "axial_stiffness", "is too small"));
  CHECK_THAT(error.what(), Contains("[rigging.hook.slings.b] axial_stiffness: is too small"));
  CHECK_THAT(error.what(), Contains("rigged.toml:24:73"));
}

TEST_CASE("rigging that cannot be is refused with its key", "[rigging]") {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      case_of(text);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "";
  };
  const std::string good = hung(kFour);
  const std::string soft = "axial_stiffness_kN = 1.0e5";
  std::string elastic = good;
  for (std::size_t at; (at = elastic.find("axial_stiffness_kN = 1.0e8 }")) != std::string::npos;)
    elastic.replace(at, std::string("axial_stiffness_kN = 1.0e8").size(), soft);
  CHECK(refusal(elastic).empty());
  // Slings stretch by 9 cm under the load. One that is four times that too long hangs slack, and so does the one
  // opposite.
  const std::string b = "{ name = \"b\", to_m = [-1.0, 1.0, 0.0], length_m = 12.083045973594572";
  const std::string slack = replaced(elastic, b, b + ", length_error_mm = 500.0");
  CHECK_THAT(refusal(slack),
             Contains("[rigging.hook.slings.b] length_m: leaves the sling slack with the load hanging") &&
                 Contains("may_be_slack = true"));
  CHECK(refusal(replaced(slack, "load = \"load\"\nblock", "load = \"load\"\nmay_be_slack = true\nblock")).empty());
  // Sling b 1 m too short.
  CHECK_THAT(refusal(replaced(elastic, b, "{ name = \"b\", to_m = [-1.0, 1.0, 0.0], length_m = 1.0")),
             Contains("[rigging.hook.slings."));
  // 1.4 m out on 1.8 m: 39 deg.
  std::string flat = elastic;
  for (std::size_t at; (at = flat.find("length_m = 12.083045973594572")) != std::string::npos;)
    flat.replace(at, std::string("length_m = 12.083045973594572").size(), "length_m = 1.8");
  CHECK_THAT(refusal(flat), Contains("deg to the horizontal, at least 45.0 by sling_angle_min_deg"));
  CHECK(
      refusal(replaced(flat, "load = \"load\"\nblock", "load = \"load\"\nsling_angle_min_deg = 30.0\nblock")).empty());
  // Names that others have: two bodies of one name would be one in every result.
  CHECK_THAT(refusal(replaced(good, "name = \"hook\"\nload", "name = \"load\"\nload")),
             Contains("[rigging.load] name: \"load\" is the name of another body already"));
  CHECK_THAT(refusal(replaced(good, "name = \"c\"", "name = \"fall\"")),
             Contains("[rigging.hook.slings.fall] name: \"fall\" is the name of another wire already"));
  CHECK_THAT(refusal(replaced(good, "load = \"load\"\nblock", "load = \"laod\"\nblock")),
             Contains("there is no body \"laod\", did you mean \"load\"?"));
  CHECK_THAT(refusal(replaced(good, "to_m = [1.0, 1.0, 0.0],", "to_m = [1.0, 1.0, 0.0], from_m = [0.0, 0.0, 0.0],")),
             Contains("[rigging.hook.slings.a] from_m: belongs to a sling from a spreader"));
  CHECK_THAT(refusal(hung(R"(
[[rigging]]
name = "hook"
load = "load"
block_mass_t = 20.0
slings = [{ name = "a", to_m = [0.0, 0.0, 0.0], length_m = 12.0, axial_stiffness_kN = 1.0e5 }]
)")),
             Contains("[rigging.hook] slings: must be two at least, got 1"));
}

}  // namespace stillhook
