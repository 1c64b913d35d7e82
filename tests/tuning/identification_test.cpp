// Fits to runs that the test simulates with known values.
#include "tuning/identification.h"

#include <catch2/catch.hpp>

#include "tests/tuning/buoy.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

const std::string kAddedMass = "bodies.buoy.hydrodynamics.added_mass_t.2";
const std::string kLinear = "bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.2";
const std::string kQuadratic = "bodies.buoy.hydrodynamics.quadratic_damping_kN_s2_per_m2.2";
const Vector6 kRest = Vector6::Zero();

Vector6 lifted(double z) { return (Vector6() << 0.0, 0.0, z, 0.0, 0.0, 0.0).finished(); }

const FitEstimate& estimate(const Identification& r, const std::string& key) {
  for (const FitEstimate& e : r.estimates)
    if (e.spec.key == key) return e;
  throw std::runtime_error("no estimate of " + key);
}

bool warns(const Identification& r, const std::string& part) {
  return std::any_of(r.warnings.begin(), r.warnings.end(),
                     [&](const std::string& w) { return w.find(part) != std::string::npos; });
}

const std::string kFree = "free_body = \"buoy\"\nfree = \"z, vz\"\n";

TEST_CASE("added mass, linear and quadratic damping come back from a noisy decay", "[fit]") {
  const TemporaryFolder folder;
  const Case truth = case_of(buoy_text());
  const std::string file = folder.write("decay.csv", measured(truth, {{"buoy.z", 0.01}}, lifted(1.5), 60.0, 7));
  const std::string wrong = R"(
[fit]
)" + parameter(kAddedMass, 100.0, 2000.0, "start = 900.0") +
                            parameter(kLinear, 0.0, 500.0, "start = 20.0") +
                            parameter(kQuadratic, 0.0, 1000.0, "start = 400.0") +
                            record("decay", file, "decay", kFree) + column("buoy.z", "m");
  const Identification r = identify(case_of(buoy_text() + wrong));
  INFO(r.message);
  REQUIRE(r.usable);
  CHECK(r.trusted);
  for (const auto& [key, value] : {std::pair{kAddedMass, 600.0}, {kLinear, 60.0}, {kQuadratic, 150.0}}) {
    const FitEstimate& e = estimate(r, key);
    INFO(key << " " << e.value << " +- " << e.sd);
    CHECK(std::abs(e.value - value) < 3.5 * e.sd);  // one of 2,000 estimates is further off
    CHECK(e.sd < 0.1 * value);
  }
  CHECK(estimate(r, kAddedMass).unit == "t");
  REQUIRE(r.records.size() == 1);
  CHECK(r.records[0].channels[0].rms_after == Approx(0.01).epsilon(0.15));  // what was put in
  CHECK(r.records[0].own.size() == 2);
  CHECK(std::abs(r.records[0].own[0].value - 1.5) < 4.0 * r.records[0].own[0].sd);
  CHECK(r.records[0].channels[0].correlation_time < 1.5);
  // The fitted case has the estimates.
  CHECK(key_value(fitted_case(case_of(buoy_text() + wrong), r), kAddedMass) == estimate(r, kAddedMass).value);
}

TEST_CASE("a decay gives its own start values", "[fit]") {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("decay.csv", measured(case_of(buoy_text()), {{"buoy.z", 0.005}}, lifted(1.5), 60.0, 7));
  // The case starts from values that are far off.
  const Case c = case_of(buoy_text() + "[fit]\n" + parameter(kAddedMass, 100.0, 2000.0) + parameter(kLinear, 0.0, 500.0) +
                             parameter(kQuadratic, 0.0, 1000.0) + record("decay", file, "decay", kFree) +
                             column("buoy.z", "m"),
                         {{kAddedMass, "250.0"}, {kLinear, "20.0"}, {kQuadratic, "0.0"}});
  const Identification r = identify(c);
  REQUIRE(r.trusted);
  const FitEstimate& e = estimate(r, kAddedMass);
  CHECK(e.started_from == "the p-q line of decay");
  CHECK(e.start == Approx(600.0).epsilon(0.1));  // the line is of first order; the hull is a wall-sided box
  CHECK(std::abs(e.value - 600.0) < 4.0 * e.sd);
  REQUIRE(r.records[0].decays.size() == 1);
  CHECK(r.records[0].decays[0].measured.period == Approx(r.records[0].decays[0].simulated.period).epsilon(0.005));
}

TEST_CASE("several runs together: decay, waves, static pull; sensor offset", "[fit]") {
  const TemporaryFolder folder;
  const Case truth = case_of(buoy_text());
  const Case waves = case_of(buoy_text(), {{"sea.active", "swell"}});
  const std::string decay = folder.write("decay.csv", measured(truth, {{"buoy.z", 0.01}}, lifted(1.0), 40.0, 1));
  const std::string swell =
      folder.write("swell.csv", measured(waves, {{"buoy.z", 0.01}, {"buoy.x", 0.01}}, kRest, 60.0, 2));
  // The same springs pull harder at one end: where the buoy stands tells their stiffness.
  const Case pulled = case_of(buoy_text(), {{"moorings.spring_0.pretension_kN", "90.0"}});
  const std::string pull = folder.write("pull.csv", measured(pulled, {{"buoy.x", 0.002}}, kRest, 10.0, 3));
  const std::string stiffness = "moorings.*.stiffness_kN_per_m", amplitude = "sea.states.swell.amplitude_m";
  const Case c = case_of(
      buoy_text() + "[fit]\n" + parameter(kAddedMass, 100.0, 2000.0, "start = 800.0") +
      parameter(stiffness, 5.0, 60.0, "start = 28.0") + parameter(amplitude, 0.1, 1.0, "start = 0.3") +
      record("decay", decay, "decay", kFree) + column("buoy.z", "m", "estimate_offset = true") +
      record("swell", swell, "regular", "sea = \"swell\"") + column("buoy.z", "m") + column("buoy.x", "m") +
      record("pull", pull, "static", "[[fit.records.settings]]\nkey = \"moorings.spring_0.pretension_kN\"\nvalue = \"90.0\"") +
      column("buoy.x", "m"));
  const Identification r = identify(c);
  for (const std::string& w : r.warnings) UNSCOPED_INFO(w);
  REQUIRE(r.trusted);
  for (const auto& [key, value] : {std::pair{kAddedMass, 600.0}, {stiffness, 20.0}, {amplitude, 0.4}}) {
    const FitEstimate& e = estimate(r, key);
    INFO(key << " " << e.value << " +- " << e.sd);
    CHECK(std::abs(e.value - value) < 4.0 * e.sd);
  }
  REQUIRE(r.cross.size() == 2);  // not the static one
  for (const LeftOut& left : r.cross) CHECK(left.ratio < 1.5);
  CHECK(r.records[0].own.back().name == "zero of buoy.z");
  CHECK(std::abs(r.records[0].own.back().value) < 4.0 * r.records[0].own.back().sd);
}

TEST_CASE("multiple shooting finds its way where single shooting does not", "[fit][multiple][slow]") {
  const TemporaryFolder folder;
  const std::string stiffness = "moorings.*.stiffness_kN_per_m";
  // 27 periods that hardly die out: a stiffness that is 10 % off is out of phase by one and a half of them at the end.
  const std::vector<Override> stiff = {{stiffness, "200.0"},
                                       {"bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.0", "4.0"}};
  const std::string file = folder.write("surge.csv", measured(case_of(buoy_text(), stiff), {{"buoy.x", 0.02}},
                                                              (Vector6() << 4.0, 0, 0, 0, 0, 0).finished(), 300.0, 5));
  const auto fit_from = [&](double start, const std::string& shooting) {
    return identify(case_of(buoy_text() + "[fit]\nshooting = \"" + shooting + "\"\nsegments = 12\n" +
                            parameter(stiffness, 10.0, 1000.0, fmt::format("start = {:.10}", start)) +
                            record("surge", file, "decay", "free_body = \"buoy\"\nfree = \"x, vx\"\n") +
                            column("buoy.x", "m"),
                            stiff));
  };
  // 70 % too low to 100 % too high.
  for (const double start : {60.0, 120.0, 300.0, 400.0}) {
    const Identification r = fit_from(start, "multiple");
    INFO("from " << start << ": " << r.message);
    REQUIRE(r.trusted);
    CHECK(estimate(r, stiffness).value == Approx(200.0).epsilon(0.01));
  }
  int lost = 0;
  for (const double start : {60.0, 400.0}) {
    const Identification r = fit_from(start, "single");
    if (!r.trusted || std::abs(estimate(r, stiffness).value - 200.0) > 10.0) ++lost;
  }
  CHECK(lost > 0);
}

TEST_CASE("added mass and stiffness are not told apart by a decay, and the test that would is named", "[fit]") {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "surge.csv",
      measured(case_of(buoy_text()), {{"buoy.x", 0.01}}, (Vector6() << 3.0, 0, 0, 0, 0, 0).finished(), 120.0, 5));
  const Identification r =
      identify(case_of(buoy_text() + "[fit]\n" + parameter("moorings.*.stiffness_kN_per_m", 5.0, 60.0, "start = 22.0") +
                       parameter("bodies.buoy.hydrodynamics.added_mass_t.0", 50.0, 1500.0, "start = 350.0") +
                       record("surge", file, "decay", "free_body = \"buoy\"\n") + column("buoy.x", "m")));
  REQUIRE(r.usable);
  CHECK(warns(r, "static pull"));
}

TEST_CASE("a parameter at its bound has no interval, the others one of their own", "[fit]") {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("decay.csv", measured(case_of(buoy_text()), {{"buoy.z", 0.01}}, lifted(1.5), 60.0, 9));
  const Identification r =
      identify(case_of(buoy_text() + "[fit]\n" + parameter(kAddedMass, 100.0, 590.0, "start = 500.0") +
                       parameter(kLinear, 0.0, 500.0) + record("decay", file, "decay", kFree) + column("buoy.z", "m"),
                       {{kAddedMass, "550.0"}}));
  REQUIRE(r.usable);
  CHECK(estimate(r, kAddedMass).at_bound);
  CHECK(std::isnan(estimate(r, kAddedMass).low));
  CHECK(estimate(r, kLinear).sd > 0.0);
  CHECK(warns(r, "held at its bound 590"));
}

TEST_CASE("a parameter that no record shows is said to be so", "[fit]") {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("decay.csv", measured(case_of(buoy_text()), {{"buoy.z", 0.01}}, lifted(1.0), 40.0, 9));
  const Identification r = identify(
      case_of(buoy_text() + "[fit]\n" + parameter(kAddedMass, 100.0, 2000.0) +
              parameter("bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.1", 1.0, 100.0) +
              record("decay", file, "decay", kFree) + column("buoy.z", "m")));
  CHECK(estimate(r, "bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.1").no_influence);
  CHECK(warns(r, "no record shows it"));
}

TEST_CASE("bad data never give a confident fit", "[fit][bad_input]") {
  const TemporaryFolder folder;
  const auto fit = [&](const std::string& text, const std::string& more, const std::string& columns,
                       const std::string& kind = "decay", const std::vector<Override>& overrides = {}) {
    return identify(case_of(buoy_text() + "[fit]\n" + parameter(kAddedMass, 100.0, 2000.0) + parameter(kLinear, 0.0, 500.0) +
                                record("run", folder.write("run.csv", text), kind, more) + columns,
                            overrides));
  };
  const Case truth = case_of(buoy_text());
  const Vector6 heeled = (Vector6() << 0, 0, 0, 0.15, 0, 0).finished();
  SECTION("radians said to be degrees, seen from the rate") {
    const std::string text = measured(truth, {{"buoy.roll", 0.0}, {"buoy.wx", 0.0}}, heeled, 40.0, 1);
    CHECK_THROWS_WITH(fit(text, "free_body = \"buoy\"", column("buoy.roll", "rad") + column("buoy.wx", "deg/s")),
                      Contains("a factor 57.3 too small, as radians taken for degrees"));
  }
  SECTION("radians said to be degrees, seen from the waves") {
    const Case waves = case_of(buoy_text(), {{"sea.active", "swell"}});
    const std::string text = measured(waves, {{"buoy.pitch", 0.0}}, kRest, 60.0, 1);
    CHECK_THROWS_WITH(fit(text, "sea = \"swell\"", column("buoy.pitch", "deg"), "regular"),
                      Contains("a factor 57.3 too small, as radians taken for degrees"));
  }
  SECTION("a record of another case") {
    const Case other = case_of(buoy_text(), {{"sea.active", "chop"}});
    const std::string text = measured(other, {{"buoy.z", 0.0}}, kRest, 90.0, 1);
    const Identification r = fit(text, kFree, column("buoy.z", "m"), "decay", {{"fit.iterations", "6"}});
    CHECK_FALSE(r.trusted);
    CHECK(warns(r, "it is no run of this case"));
  }
  SECTION("a record longer than the operation, nothing to fit") {
    CHECK_THROWS_WITH(identify(case_of(buoy_text())), Contains("[fit.parameters] is empty"));
    CHECK_THROWS_WITH(identify(case_of(buoy_text() + "[fit]\n" + parameter(kLinear, 0.0, 500.0))),
                      Contains("[[fit.records]] is empty"));
  }
  SECTION("a free body that no channel shows, an unknown coordinate") {
    const std::string text = measured(truth, {{"buoy.buoyancy", 0.0}}, lifted(1.0), 40.0, 1);
    CHECK_THROWS_WITH(fit(text, "free_body = \"buoy\"", column("buoy.buoyancy", "N")),
                      Contains("no measured channel shows how buoy moves"));
    CHECK_THROWS_WITH(fit(text, "free_body = \"buoy\"\nfree = \"z, rol\"", column("buoy.buoyancy", "N")),
                      Contains("there is no coordinate \"rol\", did you mean \"roll\"?"));
  }
}

}  // namespace
}  // namespace stillhook
