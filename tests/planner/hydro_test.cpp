// `stillhook hydro` as a user meets it: a small box, coarse panels, the files it leaves, the cache.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "planner/verbs/hydro/hydro_convergence.h"
#include "sim/hull/coefficients/database.h"
#include "tests/planner/documented_keys.h"
#include "tests/planner/program.h"

using namespace stillhook;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A box of 40 x 20 m afloat at 2 m, moored by its own stiffness alone, and a load on a wire.
std::string write_case(const Folder& folder, const std::string& hydrodynamics = "kind = \"panels\"",
                       const std::string& method = "refinement = 0.5") {
  std::ofstream(folder / "box.toml") << R"toml(# A box for tests.
name = "box"
title = "A box"

[sea]
active = "calm"

[[sea.states]]
name = "calm"
type = "calm"

[panel_method]
lowest_rad_per_s = 0.5
highest_rad_per_s = 2.4
accept_failed_checks = "kramers_kronig"  # panels coarser than refinement = 0.5 fail it
frequencies = 20
)toml" << method << R"toml(

[[bodies]]
name = "barge"
mass_t = 1640.0
cog_m = [0.0, 0.0, 1.0]
gyration_m = [6.5, 11.5, 12.5]
hull = { shape = "box", size_m = [40.0, 20.0, 4.0], centre_m = [0.0, 0.0, 0.0], panel_length_m = 10.0 }
hydrodynamics = { )toml" << hydrodynamics
                                     << R"toml( }

[operation]
load = "barge"
crane = "barge"

[[operation.phases]]
name = "waiting"
duration_s = 10.0
)toml";
  return folder / "box.toml";
}

/// With a cache of the test's own.
Result run_hydro(const Folder& folder, const std::vector<std::string>& arguments) {
  return run(folder, arguments, folder / "cache");
}

}  // namespace

TEST_CASE("hydro asks for no operation in the case", "[hydro]") {
  const Folder folder;
  const std::string text = content(write_case(folder));
  std::ofstream(folder / "box.toml") << text.substr(0, text.find("[operation]"));
  const Result check = run_hydro(folder, {"check", "box.toml"});
  CHECK(check.code == 2);
  CHECK_THAT(check.err, Catch::Contains("operation"));
  const Result hydro = run_hydro(folder, {"hydro", "box.toml", "--out", "out"});
  CHECK(hydro.code == 0);
  CHECK(fs::exists(folder / "out/summary.json"));
  CHECK_NOTHROW(read_case(folder / "out/case.toml"));
}

TEST_CASE("hydro computes over the bed of the case, and refuses a gap that panels cannot follow", "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder, "kind = \"panels\"", "refinement = 0.5\nfit_tolerance = 0.05");
  const Result shallow = run_hydro(folder, {"hydro", file, "--set", "sea.depth_m=8", "--out", "shallow", "--json"});
  INFO(shallow.err);
  REQUIRE(shallow.code == 0);
  const HydrodynamicCoefficients over = read_coefficient_file(folder / "shallow/coefficients-barge.csv");
  CHECK(over.depth == 8.0);
  CHECK_THAT(over.description, Catch::Contains("water 8 m deep"));
  CHECK(over.frequency.front().frequency == Approx(0.5));  // no A(0)
  // As deep as its own keys say, whatever the moorings' water.
  const Result deep =
      run_hydro(folder, {"hydro", file, "--set", "sea.depth_m=8", "--set", "sea.deep_waves=true", "--out", "deep"});
  REQUIRE(deep.code == 0);
  CHECK(std::isinf(read_coefficient_file(folder / "deep/coefficients-barge.csv").depth));
  // BEMIO's file says the depth; a case of another depth does not take it, one of the same does.
  const std::string database =
      "kind = \"database\", coefficient_file = \"shallow/coefficients-barge.h5\", "
      "database_origin_m = [0.0, 0.0, 0.0]";
  const std::string read = write_case(folder, database);
  // Panels as coarse as these leave 19 % between the table's frequencies, where the file has B of the retardation functions.
  const Result same = run_hydro(folder, {"hydro", read, "--set", "sea.depth_m=8.3", "--set",
                                         "panel_method.haskind_tolerance=0.25", "--out", "same"});
  INFO(same.err);
  CHECK(same.code == 0);
  const Result other = run_hydro(folder, {"hydro", read, "--set", "sea.depth_m=9", "--out", "other"});
  CHECK(other.code == 2);
  CHECK_THAT(other.err, Catch::Contains("depth of 8 m") && Catch::Contains("sea.depth_m = 9 m"));
  // 2 m of draft need 2.2 m of water.
  const Result stuck = run_hydro(folder, {"hydro", write_case(folder), "--set", "sea.depth_m=2.15", "--out", "stuck"});
  CHECK(stuck.code == 2);
  CHECK_THAT(stuck.err, Catch::Contains("sea.depth_m = 2.15 m") && Catch::Contains("150 mm above the bed") &&
                            Catch::Contains("a depth of 2.2 m") && Catch::Contains("sea.deep_waves"));
}

TEST_CASE("hydro computes, writes every file, and takes the second run from the cache", "[hydro]") {
  const Folder folder;
  // Panels as coarse as these leave ripples in K(1,1) that a state space meets to 3 %, not to the 2 % of the default.
  const std::string file = write_case(folder, "kind = \"panels\"", "refinement = 0.5\nfit_tolerance = 0.05");
  const Result first = run_hydro(folder, {"hydro", file, "--json", "--headings", "180,90"});
  INFO(first.err);
  REQUIRE(first.code == 0);
  CHECK(first.err.find("panels on the hull") != std::string::npos);  // stated before the computation
  const std::string run_folder = folder / "runs/box-hydro";
  const json summary = json::parse(first.out);
  CHECK(summary == json::parse(content(run_folder + "/summary.json")));
  CHECK(undocumented_keys(summary) == std::set<std::string>{});
  CHECK(summary["schema_version"] == 1);
  CHECK(summary["verb"] == "hydro");
  CHECK(summary["status"] == "completed");
  REQUIRE(summary["sets"].size() == 1);
  const json& set = summary["sets"][0];
  CHECK_FALSE(set["from_cache"].get<bool>());
  CHECK(set["seconds"].get<double>() > 0.0);
  CHECK(set["panels"].size() > 0);
  CHECK(set["checks"].size() > 5);
  for (const json& check : set["checks"]) {
    CAPTURE(check);
    CHECK(check["pass"].get<bool>());
  }
  CHECK(summary["warnings"].empty());
  // Head and beam seas: all six motions but yaw, which a box has in neither; each beside its lag, over periods as well.
  const std::string report = content(run_folder + "/report.html");
  for (const char* motion : {"Surge", "Sway", "Heave", "Roll", "Pitch"})
    CHECK_THAT(report, Catch::Contains(std::string(motion) + " of barge"));
  CHECK_THAT(report, !Catch::Contains("Yaw of barge") &&
                         Catch::Contains("Not drawn, because next to nothing moves: Yaw") &&
                         Catch::Contains("Its lag behind the crest") && Catch::Contains("ω, rad/s, with the period"));
  REQUIRE(set["fit"].contains("states"));
  CHECK(set["fit"]["states"].get<int>() > 0);
  CHECK(summary["rao"]["headings_deg"] == json({180.0, 90.0}));
  const json& heave = summary["rao"]["bodies"][0]["motions"][0]["heave"];
  CHECK(heave["amplitude"].size() == summary["rao"]["frequencies_rad_per_s"].size());

  // Every format holds the same set. Files have 9 digits; the frame of the databases is moved to Bo and back.
  const std::string base = run_folder + "/coefficients-barge";
  const HydrodynamicCoefficients own = read_coefficient_file(base + ".csv");
  DatabaseOptions options;
  options.frame.bodies = {{Vector3(0.0, 0.0, -own.waterline), own.volume[0]}};
  options.frame.length = own.length;
  options.wamit.density = own.density;
  options.wamit.gravity = own.gravity;
  options.wamit.reference = {Vector3::Zero()};  // XBODY of the files, in the water plane over Bo
  for (const char* ending : {".h5", ".1"}) {
    const HydrodynamicCoefficients other = read_database(base + ending, options);
    INFO(ending);
    CHECK((other.A_inf - own.A_inf).norm() < 1e-6 * own.A_inf.norm());
    REQUIRE(other.excitation.value.size() == own.excitation.value.size());
    double worst = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < own.excitation.value.size(); ++i) {
      worst = std::max(worst, std::abs(other.excitation.value[i] - own.excitation.value[i]));
      largest = std::max(largest, std::abs(own.excitation.value[i]));
    }
    CHECK(worst < 1e-5 * largest);
    // C_33 / rho g of 40 x 20 m
    CHECK(other.waterplane.at(0) == Approx(800.0).epsilon(1e-3));
  }
  const std::string page = content(run_folder + "/report.html");
  for (const char* part : {"Added mass in heave", "Retardation function in sway", "Heave of barge", "reduced model"})
    CHECK(page.find(part) != std::string::npos);

  CHECK(run_hydro(folder, {"hydro", file}).code == 2);  // the folder is taken
  const Result second = run_hydro(folder, {"hydro", file, "--force"});
  REQUIRE(second.code == 0);
  CHECK(second.err.find("computes") == std::string::npos);
  CHECK(second.out.find("taken from the cache") != std::string::npos);
  for (const char* part : {"Added mass of barge", "Radiation damping of barge", "Self-checks", "passivity margin"})
    CHECK(second.out.find(part) != std::string::npos);
  CHECK(json::parse(content(run_folder + "/summary.json"))["sets"][0]["from_cache"].get<bool>());
}

TEST_CASE("hydro refuses coefficients that fail a check, and says so when they are accepted", "[hydro]") {
  const Folder folder;
  // Retardation functions come from a state space that is asked for 2 %: no set has A and B to 0.1 %.
  const std::string file = write_case(
      folder, "kind = \"panels\"", "refinement = 0.4\nfit_tolerance = 0.05\nkramers_kronig_tolerance = 0.001");
  const Result accepted = run_hydro(folder, {"hydro", file, "--json"});
  INFO(accepted.err);
  REQUIRE(accepted.code == 0);
  const json summary = json::parse(accepted.out);
  std::vector<std::string> failed;
  for (const json& check : summary["sets"][0]["checks"])
    if (!check["pass"].get<bool>()) failed.push_back(check["key"]);
  CHECK(failed == std::vector<std::string>{"kramers_kronig"});
  CHECK_THAT(summary["warnings"].dump(), Catch::Contains("kramers_kronig") && Catch::Contains("is accepted by name"));

  // That they lie in the cache makes them no better.
  const Result refused =
      run_hydro(folder, {"hydro", file, "--out", "refused", "--set", "panel_method.accept_failed_checks=\"\""});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::Contains("the coefficients fail") && Catch::Contains("accept_failed_checks") &&
                              Catch::Contains("panel_method.kramers_kronig_tolerance") &&
                              Catch::Contains("panel_method.refinement = 0.56 takes"));
  CHECK_FALSE(fs::exists(folder / "refused/summary.json"));
}

TEST_CASE("without a static start, hydro and the run take the draft that the hull floats at, and the run begins where it is put",
          "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder);
  // 1,640 t float at 2 m, where the body's origin is in the water plane: held 0.25 m deeper, and let go.
  const std::vector<std::string> held = {"--set", "bodies.barge.position_m=[0.0, 0.0, -0.25]", "--set", "solver.static_start=false"};
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return run_hydro(folder, words);
  };
  const Result hydro = with({"hydro", file, "--out", "hydro"}, held);
  INFO(hydro.err);
  REQUIRE(hydro.code == 0);
  // That of its weight, to the centimetre: it swings about there.
  CHECK(read_coefficient_file(folder / "hydro/coefficients-barge.csv").waterline == Approx(0.0).margin(0.01));

  const Result simulate = with({"simulate", file, "--out", "run"}, held);
  INFO(simulate.err);
  REQUIRE((simulate.code == 0 || simulate.code == 3));
  // The set of that draft is kept, and the model asks for no other.
  CHECK(simulate.err.find("the panel method computes") == std::string::npos);
  const Result table = with({"export", "run", "--csv", "--out", "-", "--channels", "barge.z"}, {});
  INFO(table.err);
  std::istringstream rows(table.out);
  std::vector<double> t, z;
  for (std::string row; std::getline(rows, row);)
    if (const std::size_t comma = row.find(','); comma != std::string::npos && std::isdigit(static_cast<unsigned char>(row[0])))
      t.push_back(std::stod(row)), z.push_back(std::stod(row.substr(comma + 1)));
  REQUIRE(z.size() > 20);
  CHECK(t.front() == 0.0);
  CHECK(z.front() == -0.25);
  // Let go it comes up, through the draft that it floats at.
  CHECK(*std::max_element(z.begin(), z.end()) > 0.0);
}

TEST_CASE("simulate and check tell that the panel method runs", "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder);
  const Result check = run_hydro(folder, {"check", file});
  INFO(check.err);
  REQUIRE(check.code == 0);
  CHECK(check.err.find("the panel method computes") != std::string::npos);
  // The set is kept now.
  CHECK(run_hydro(folder, {"check", file}).err.find("the panel method computes") == std::string::npos);
}

TEST_CASE("warnings of the model reach the summary and the report", "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder, "kind = \"panels\"", "refinement = 0.5\nbeyond = \"cut\"");
  const Result result =
      run_hydro(folder, {"simulate", file, "--set", "sea.active=\"calm\"", "--set", "sea.states.calm.type=\"regular\"",
                         "--set", "sea.states.calm.amplitude_m=0.1", "--set",
                         "sea.states.calm.frequency_rad_per_s=2.45", "--set", "bodies.barge.hull.panel_length_m=2.0"});
  INFO(result.err);
  REQUIRE((result.code == 0 || result.code == 3));
  CHECK(result.err.find("beyond the hull's coefficients") != std::string::npos);
  const json summary = json::parse(content(folder / "runs/box-simulate/summary.json"));
  REQUIRE(summary["warnings"].size() >= 1);
  CHECK(summary["warnings"].dump().find("of the sea's energy lies beyond") != std::string::npos);
  CHECK(content(folder / "runs/box-simulate/report.html").find("<b>Warnings</b>") != std::string::npos);
}

TEST_CASE("hydro refuses what it cannot do", "[hydro]") {
  const Folder folder;
  SECTION("no coefficients") {
    const std::string file = write_case(folder, "kind = \"constant\", added_mass_t = [1.0, 1.0, 1.0]");
    const Result result = run_hydro(folder, {"hydro", file});
    CHECK(result.code == 2);
    CHECK(result.err.find("there is nothing to do") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "runs/box-hydro/summary.json"));
  }
  SECTION("no such file") { CHECK(run_hydro(folder, {"hydro", folder / "none.toml"}).code == 2); }
  SECTION("not afloat") {
    const std::string file = write_case(folder);
    CHECK(run_hydro(folder, {"hydro", file, "--set", "bodies.barge.mass_t=9000"}).code == 2);
  }
}

TEST_CASE("Ctrl-C ends a panel computation with 130", "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder, "kind = \"panels\"", "refinement = 1.0");
  const pid_t child = start(folder, {"hydro", file}, folder / "cache");
  // Not before it has begun: it says so first.
  for (int i = 0; i < 400 && content(folder / "stderr.txt").find("panels on the hull") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Result result = finish(folder, child);
  INFO(result.err);
  CHECK(result.code == 130);
  CHECK_FALSE(fs::exists(folder / "runs/box-hydro/summary.json"));
}

TEST_CASE("the estimated error of curves with a known one", "[hydro]") {
  // A(w) = 10 + cos w + c(w) h^p on panels of h = sqrt(2), 1, 1/sqrt(2): the error at h = 1 is max |c|.
  const auto row_of = [](double p, double noise) {
    std::array<HydrodynamicCoefficients, 3> sets;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 30; ++i) {
        const double w = 0.1 * i, h = std::pow(2.0, 0.5 - 0.5 * k);
        const double c = 0.2 * std::sin(3.0 * w) * std::pow(h, p) + noise * std::sin(40.0 * w * (k + 1));
        sets[k].frequency.push_back({w, MatrixX::Constant(1, 1, 10.0 + std::cos(w) + c), MatrixX::Zero(1, 1)});
      }
    return convergence_row({&sets[0], &sets[1], &sets[2]}, "A", 0);
  };
  // Relative to the largest of the finest curve, which itself is off by a tenth of that.
  for (const double p : {1.2, 2.0}) {
    const ConvergenceRow row = row_of(p, 0.0);
    CHECK(row.order == Approx(p).epsilon(1e-6));
    CHECK(row.error == Approx(0.2 / 11.0).epsilon(0.02));
  }
  // A third order that a coarse grid pretends is not believed: the error is over-, not underestimated.
  CHECK(row_of(4.0, 0.0).error > 0.2 / 11.0);
  // Changes that do not shrink show no order.
  const ConvergenceRow row = row_of(2.0, 1.0);
  CHECK(std::isnan(row.order));
  CHECK(row.error == Approx(std::max(row.first, row.second)));
}

TEST_CASE("the order of convergence is that of the changes", "[hydro]") {
  const Folder folder;
  const std::string file = write_case(folder, "kind = \"panels\"", "refinement = 0.5");
  const Result result = run_hydro(folder, {"hydro", file, "--converge", "--json"});
  INFO(result.err);
  REQUIRE(result.code == 0);
  const json convergence = json::parse(result.out)["sets"][0]["convergence"];
  CHECK(convergence["refinement"][2].get<double>() == Approx(0.5 * std::sqrt(2.0)));
  CHECK(convergence["surface_panels"][0].get<int>() < convergence["surface_panels"][2].get<int>());
  REQUIRE(convergence["rows"].size() == 18);
  for (const json& row : convergence["rows"]) {
    const double first = row["first_change"], second = row["second_change"];
    // r = sqrt(2): 1/(1 - r^-p) is 3.41 at first order and 2 at second, which is the highest that is believed.
    if (row["order"].is_null()) {
      CHECK(row["error"].get<double>() == Approx(std::max(first, second)));
    } else {
      CHECK(row["order"].get<double>() >= 1.0);
      CHECK(row["error"].get<double>() >= 2.0 * second * (1.0 - 1e-9));
      CHECK(row["error"].get<double>() <= 3.42 * second);
    }
  }
}
