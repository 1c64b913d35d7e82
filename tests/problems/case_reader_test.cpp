// What a case says arrives in the structs in SI; keys from outside lead where they should.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <catch2/catch.hpp>

#include "problems/case.h"
#include "problems/case_format.h"
#include "problems/schema.h"

namespace stillhook {
namespace {

const std::string kRoot = STILLHOOK_SOURCE_DIR;
const std::string kBox = kRoot + "/problems/box_installation.toml";
const std::string kCases = kRoot + "/tests/problems/cases/";
constexpr double kPi = 3.14159265358979323846;

// Conversions are one product each: a few units in the last place.
Approx exactly(double value) { return Approx(value).epsilon(1e-14); }

template <class Entries>
const auto& named(const Entries& entries, const std::string& name) {
  for (const auto& entry : entries)
    if (entry.name == name) return entry;
  throw std::runtime_error("no entry " + name);
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("the reference lift arrives in SI", "[case]") {
  const Case c = read_case(kBox);
  const Specification& s = c.specification;
  CHECK(s.name == "box_installation");
  CHECK(s.bodies.size() == 7);
  CHECK(s.joints.size() == 4);
  CHECK(s.wires.size() == 6);
  CHECK(s.moorings.size() == 8);
  REQUIRE(s.operation.phases.size() == 8);

  const BodySpec& crane = named(s.bodies, "crane");
  CHECK(crane.mass == exactly(19.146e6));
  CHECK(crane.inertia(1, 1) == exactly(19.146e6 * 31.83 * 31.83));
  CHECK(crane.hydrodynamics.kind == HydrodynamicsSpec::Kind::panels);
  CHECK(crane.hydrodynamics.radiation == HydrodynamicsSpec::RadiationModel::automatic);
  CHECK(s.panel_method.beyond == PanelMethodSpec::Beyond::cut);
  CHECK(crane.hydrodynamics.critical_fraction[3] == 0.04);
  CHECK(named(s.bodies, "boom_port").attitude.pitch == exactly(-75.099 * kPi / 180.0));
  CHECK(named(s.wires, "hoist_port").axial_stiffness == exactly(3.31e9));
  // The reference data set gives the gains as 1.2e6 N/rad and 6.0e6 N s/rad, here rounded to five digits per degree.
  CHECK(named(s.taglines, "tagline_port").kp == Approx(1.2e6).epsilon(3e-5));
  CHECK(named(s.taglines, "tagline_port").kd == Approx(6.0e6).epsilon(3e-5));
  CHECK(named(s.drives, "hoist").speed_max == exactly(2.6 / 60.0));

  const PhaseSpec& transfer = s.operation.phases[1];
  CHECK(transfer.stage == PhaseSpec::Stage::transfer);
  REQUIRE(transfer.moves[0].goal);
  CHECK(transfer.moves[0].goal->relative_to == "barge");
  CHECK(transfer.moves[0].goal->axis == 2);
  CHECK(transfer.moves[0].goal_value == exactly(3.88));
  CHECK(transfer.moves[1].travel == 0.0);
  CHECK(named(s.poses, "even_keel_unloaded_b_backstays").holds[0].coordinate == exactly(5.18 * kPi / 180.0));
  REQUIRE(c.plan.scenarios[1].heading);
  CHECK(*c.plan.scenarios[1].heading == exactly(0.75 * kPi));
  CHECK(c.plan.variables.size() == 11);
  CHECK(c.plan.variables[0].key == "operation.phases.load_transfer.moves.hoist.speed_m_per_min");  // order of the file
}

TEST_CASE("a double pendulum, a floating sphere and a three-point lift can be written", "[case]") {
  const Specification pendulum = read_case(kCases + "double_pendulum.toml").specification;
  CHECK(pendulum.joints[0].parent == "world");
  CHECK_FALSE(pendulum.solver.static_start);
  CHECK(pendulum.bodies[1].attitude.pitch == exactly(kPi / 3.0));

  const Specification sphere = read_case(kCases + "floating_sphere.toml").specification;
  CHECK(sphere.bodies[0].hull.mesh_file ==
        std::filesystem::absolute(kCases + "sphere.obj").lexically_normal().string());
  CHECK(sphere.bodies[0].hydrodynamics.added_mass(2, 2) == exactly(134e3));
  CHECK(sphere.bodies[0].hydrodynamics.linear_damping[4] == exactly(50e3));

  const Specification lift = read_case(kCases + "three_point_lift.toml").specification;
  CHECK(lift.wires[0].slack == exactly(-0.12));
  CHECK(lift.wires[2].unstretched_length == exactly(6.25));
  CHECK(lift.operation.phases[1].moves[0].profile.shape == ProfileSpec::Shape::knots);
  CHECK(lift.operation.phases[1].moves[0].profile.knots == std::vector<double>{0.6, 1.0, 1.0, 0.6});
  CHECK(lift.operation.phases[1].moves[0].speed == exactly(0.1));
}

TEST_CASE("a key from outside replaces, adds and reaches every entry", "[case]") {
  const Case c = read_case(kBox, {{"taglines.*.kp_kN_per_deg", "3"},
                                  {"sea.active", "paper_text"},
                                  {"bodies.load.position_m.2", "8.5"},
                                  {"operation.phases.hoist_up.moves.hoist.travel_m", "15"},
                                  {"limits.daf_total.max", "1.1"},
                                  {"wires.hoist_port.tension_max_kN", "9e3"}});
  for (const TaglineSpec& tagline : c.specification.taglines) CHECK(tagline.kp == exactly(3e3 * 180.0 / kPi));
  CHECK(c.specification.sea.active == "paper_text");
  CHECK(named(c.specification.bodies, "load").position.z() == 8.5);
  const MoveSpec& move = c.specification.operation.phases[2].moves[0];
  CHECK(move.travel == 15.0);
  CHECK_FALSE(move.goal);  // the travel takes the goal's place
  CHECK(named(c.specification.wires, "hoist_port").tension_max == exactly(9e6));
}

TEST_CASE("a wrong key from outside is told as such", "[case]") {
  const auto said = [](const std::string& key, const std::string& value) {
    try {
      read_case(kBox, {{key, value}});
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(said("sea.ramp_s", "-3") == "--set sea.ramp_s=-3: [sea] ramp_s: must be >= 0 s, got -3");
  CHECK(said("sea.active", "paper_txt") ==
        "--set sea.active=paper_txt: [sea] active: there is no sea state \"paper_txt\", did you mean \"paper_text\"?");
  CHECK(said("bodies.load.mass_kg", "3") ==
        "--set bodies.load.mass_kg=3: [bodies.load] mass_kg: wrong unit in the key: write \"mass_t\"");
  CHECK(said("wires.hoist_prt.slack_m", "1") ==
        "--set wires.hoist_prt.slack_m=1: [wires] hoist_prt: there is no entry of this name, did you mean "
        "\"hoist_port\"?");
  CHECK(said("sea.ramp_s.x", "1") == "--set sea.ramp_s.x=1: [sea] ramp_s: is a value, it has no \"x\"");
  CHECK(said("bodies.load.position_m.3", "1") ==
        "--set bodies.load.position_m.3=1: [bodies.load] position_m: has no item 3 in this case (the first is 0)");
  CHECK(said("sea.ramp_s", "3 4") ==
        "--set sea.ramp_s=3 4: the value is not TOML; write a number, true, false, \"text\" or [1, 2, 3]");
}

TEST_CASE("key values are in the key's unit, written or by default", "[case]") {
  const Case c = read_case(kBox);
  CHECK(key_value(c, "taglines.*.kp_kN_per_deg") == 20.944);
  CHECK(key_value(c, "operation.phases.hoist_up.moves.hoist.speed_m_per_min") == 2.0);
  CHECK(key_value(c, "solver.newton_tolerance") == SolverSpec{}.newton_tolerance);
  CHECK(key_value(c, "bodies.crane.cog_m.0") == -4.489);
  CHECK(key_value(c, "bodies.crane.hydrodynamics.linear_damping_kN_s_per_m.1") == 0.0);  // a list that is not written
  CHECK(key_unit(c, "bodies.crane.hydrodynamics.linear_damping_kN_s_per_m.1") == "kN s/m");
  CHECK(key_value(c, "moorings.crane_bow_port.azimuth_deg") == 45.0);
  CHECK_THROWS_AS(key_value(c, "moorings.*.azimuth_deg"), CaseError);  // they differ
  CHECK_THROWS_AS(key_value(c, "wires.hoist_port.role"), CaseError);   // no number
}

TEST_CASE("values in the keys' units change the lift and nothing else", "[case]") {
  const Case c = read_case(kBox, {{"sea.active", "paper_text"}});
  const double third = 1.0 / 3.0;
  const Case changed = with_values(c, {{"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 1.0 + third},
                                       {"taglines.*.kd_kN_s_per_deg", 50.0}});
  CHECK(changed.specification.operation.phases[2].moves[0].speed == exactly((1.0 + third) / 60.0));
  CHECK(changed.specification.sea.active == "paper_text");
  CHECK(key_value(changed, "taglines.*.kd_kN_s_per_deg") == 50.0);
  const Case back = with_values(changed, {{"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 2.0},
                                          {"taglines.*.kd_kN_s_per_deg", 104.72}});
  CHECK(resolved_text(back) == resolved_text(c));
  CHECK(back.overrides.size() == 3);  // a key is set once, however often it changes
  CHECK_THROWS_AS(with_values(c, {{"taglines.*.kd_kN_s_per_deg", std::nan("")}}), CaseError);
}

TEST_CASE("one item of a list that the case does not write", "[case]") {
  const Case c = with_values(read_case(kBox), {{"bodies.crane.hydrodynamics.quadratic_damping_kN_s2_per_m2.2", 7.0},
                                               {"bodies.crane.hydrodynamics.radiation_factor", 0.9}});
  const HydrodynamicsSpec& h = named(c.specification.bodies, "crane").hydrodynamics;
  CHECK(h.quadratic_damping == (Vector6() << 0.0, 0.0, 7e3, 0.0, 0.0, 0.0).finished());
  CHECK(h.radiation_factor == 0.9);
  CHECK(h.added_mass_factor == 1.0);
}

TEST_CASE("the parts of a fit", "[case][fit]") {
  const std::string base = text_of(kRoot + "/tests/bad_input/base.toml");
  const auto read = [&](const std::string& fit) { return read_case_text(base + fit, "base.toml", "/here"); };
  const auto said = [&](const std::string& fit) {
    try {
      read(fit);
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string record =
      "\n[[fit.records]]\nname = \"a\"\nkind = \"decay\"\nfile = \"a.csv\"\ntime_unit = \"min\"\n"
      "columns = [{ channel = \"ship.z\", unit = \"mm\", reversed = true }]\n";
  const Case c = read("\n[fit.parameters.\"bodies.ship.mass_t\"]\nmin = 1.0\nmax = 1e6\nprior_mean = 10.0\nprior_sd = 2.0\n" +
                      record);
  REQUIRE(c.fit.parameters.size() == 1);
  CHECK(c.fit.parameters[0].prior_sd == 2.0);
  REQUIRE(c.fit.records.size() == 1);
  CHECK(c.fit.records[0].file == "/here/a.csv");  // need not be there yet
  CHECK(c.fit.records[0].time_unit == 60.0);
  CHECK(c.fit.records[0].columns[0].reversed);
  CHECK(read_case_text(resolved_text(c), "case.toml", "/").fit.records[0].file == "/here/a.csv");
  CHECK_THAT(said("\n[fit.parameters.\"bodies.ship.mass_t\"]\nmin = 3.0\nmax = 2.0\n"),
             Catch::Contains("min: must be < max 2, got 3"));
  CHECK_THAT(said("\n[fit.parameters.\"bodies.ship.mass_t\"]\nmin = 1.0\nmax = 1e6\nprior_sd = 1.0\n"),
             Catch::Contains("needs prior_mean and prior_sd, or none of them"));
  CHECK_THAT(said("\n[fit.parameters.\"bodies.ship.mas_t\"]\nmin = 1.0\nmax = 2.0\n"), Catch::Contains("leads nowhere"));
  CHECK_THAT(said(record + "free = \"z\"\n"), Catch::Contains("free"));
  CHECK_THAT(said("\n[[fit.records]]\nname = \"a\"\nkind = \"decay\"\nfree = \"z\"\n"
                  "columns = [{ channel = \"ship.z\", unit = \"m\" }]\n"),
             Catch::Contains("[fit.records.a] free: needs free_body"));
}

TEST_CASE("the resolved case reads the same from another folder", "[case]") {
  const Case c = read_case(kBox, {{"taglines.*.kp_kN_per_deg", "3.1"}});
  const Case again = read_case_text(resolved_text(c), "case.toml", "/");
  CHECK(resolved_text(again) == resolved_text(c));
  CHECK(again.specification.taglines[0].kp == c.specification.taglines[0].kp);
  CHECK(again.specification.bodies[0].hydrodynamics.coefficient_file ==
        c.specification.bodies[0].hydrodynamics.coefficient_file);
  CHECK(again.plan.variables.front().key == c.plan.variables.front().key);
}

TEST_CASE("an error of the model is placed in the case", "[case]") {
  const Case c = read_case_text(text_of(kRoot + "/tests/bad_input/base.toml"), "base.toml", kRoot);
  const std::string text = text_of(kRoot + "/tests/bad_input/base.toml");
  const auto line_of = [&text](const std::string& what) {
    return std::to_string(1 +
                          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n'));
  };
  const std::string wire = line_of("[[wires]]\nname = \"luffing\""), hold = line_of("hold_joint");
  CHECK(std::string(located(c, SpecificationError("wires.luffing", "", "is slack")).what()) ==
        "base.toml:" + wire + ":1: [wires.luffing]: is slack");
  CHECK(std::string(located(c, SpecificationError("wires.luffing", "hold_joint", "cannot be held")).what()) ==
        "base.toml:" + hold + ":1: [wires.luffing] hold_joint: cannot be held");
  // A field by its name in the model, without the unit; nested; and an entry that the case does not have.
  CHECK(std::string(located(c, SpecificationError("wires.luffing", "axial_stiffness", "x")).what()) ==
        "base.toml:" + line_of("axial_stiffness_kN = 4.0e5") + ":1: [wires.luffing] axial_stiffness: x");
  CHECK(std::string(located(c, SpecificationError("bodies.ship", "hull.size", "x")).what()) ==
        "base.toml:" + line_of("size_m") + ":1: [bodies.ship] hull.size: x");
  CHECK(std::string(located(c, SpecificationError("nowhere", "", "x")).what()) == "base.toml:1:1: [nowhere]: x");
}

TEST_CASE("docs/case-format.md is what the tables say", "[case][docs]") {
  // Written by `stillhook schema --reference > docs/case-format.md`.
  CHECK(text_of(kRoot + "/docs/case-format.md") == key_reference_markdown());
}

TEST_CASE("every key of the format is documented, and the schema knows it", "[case][docs]") {
  const std::string schema = json_schema();
  int keys = 0;
  const std::function<void(const Table&)> visit = [&](const Table& table) {
    for (const Field& field : table.fields) {
      INFO(table.name << " " << field.key);
      ++keys;
      CHECK(field.doc.size() >= 3);
      CHECK(field.doc.back() == '.');
      CHECK(schema.find("\"" + field.key + "\": {") != std::string::npos);
      if (!field.unit.suffix.empty()) CHECK(field.key.size() > base_of(field).size());  // the unit stands in the key
      if (field.table) visit(field.table());
    }
  };
  visit(case_table());
  CHECK(keys > 200);
}

}  // namespace stillhook
