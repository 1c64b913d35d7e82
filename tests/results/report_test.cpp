#include "results/report.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/files.h"
#include "results/html.h"
#include "results/plot.h"
#include "results/report_parts.h"
#include "results/summary.h"
#include "results/viewer_bundle.h"
#include "tests/results/markup.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;

namespace {

/// The page without what its script elements hold: only the tags stay.
std::string without_scripts(std::string html) {
  for (std::size_t at = html.find("<script"); at != std::string::npos; at = html.find("<script", at + 1)) {
    const std::size_t from = html.find('>', at) + 1;
    html.erase(from, html.find("</script>", from) - from);
  }
  return html;
}

SearchSection a_search(const std::vector<LimitCheck>& checks) {
  SearchSection search;
  search.algorithm = "ISRES, then COBYLA";
  search.status = "The budget is used up.";
  search.evaluations = 60;
  search.seed = 1;
  search.simulation_equivalents = 240;
  search.wall = 512;
  search.baseline_objective = 3.21;
  search.plan_objective = 2.11;
  search.random_objective = 2.76;
  search.plan_feasible = search.random_feasible = true;
  search.terms = {{"sway_rms", "m", 1.0, 0.5, 0.99, 0.61, 1.98, 1.22},
                  {"duration", "s", 0.2, 1800, 1886, 1700, 0.21, 0.19}};
  search.variables = {{"taglines.*.kp_kN_per_deg", 0, 100, 20.9, 63.2}};
  search.baseline_limits = search.plan_limits = checks;
  search.plan_limits[0].value = 1.02;
  for (int i = 0; i < 60; ++i) {
    search.history.push_back({3.3 - 1.2 * (1 - std::exp(-i / 15.0)) + 0.04 * ((i * 7919) % 13), i % 3 != 0});
    search.random_history.push_back({2.7 + 0.06 * ((i * 104729) % 17), i % 4 == 0});
  }
  search.sensitivities = SensitivityTable{
      {{"daf_total", "1"}, {"sway_rms", "m"}},
      {{"taglines.*.kp_kN_per_deg", 100, {-0.0002, 0.0011}}, {"operation.ramp_s", 52, {0.0001, std::nan("")}}},
      "By the tangent of the run."};
  search.pareto = ParetoFront{"daf_max", "1", "duration", "s", {}};
  for (int i = 0; i < 9; ++i)
    search.pareto->points.push_back({1.0 + 0.02 * i, 2400.0 - 60.0 * i, true, true, i == 4 ? "plan" : ""});
  search.pareto->points.push_back({1.15, 2300.0, false, false, ""});
  search.scenarios = {"paper_text, towards 45°", "paper_table1, towards 135°"};
  return search;
}

}  // namespace

TEST_CASE("the report is one well-formed file that asks for nothing outside itself") {
  truth::SyntheticLift lift;
  lift.trajectory.contacts[0].contact = "deck\"><script>alert(1)</script>";
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  const std::vector<LimitCheck> checks = check_limits(lift.limits, metrics);
  const SearchSection search = a_search(checks);
  const ReportData data{"Box & barge",
                        "Minimise the swing.\n\nSecond paragraph.",
                        "[sea]\nactive = \"<x>\"\n",
                        "0.1.0",
                        lift.specification,
                        lift.trajectory,
                        metrics,
                        checks,
                        {"Radiation is constant."},
                        {},
                        {{"Natural periods", "Calculated.", {"mode", "T, s"}, {{"roll", "8.8"}}}},
                        &search};
  const std::string page = report_html(data), html = without_scripts(page);
  if (const char* path = std::getenv("STILLHOOK_REPORT_LOOK")) write_file(path, page);  // to be looked at

  CHECK(unbalanced(html) == "");
  CHECK(html.find("Content-Security-Policy") != std::string::npos);
  // One script, which the policy names by its hash, and its data; or none and the reason.
  if (viewer_script().empty()) {
    CHECK(count(html, "<script") == 0);
    CHECK(html.find("There is no 3-D replay in this report: " + std::string(viewer_missing())) != std::string::npos);
  } else {
    CHECK(count(html, "<script>") == 1);
    CHECK(count(html, "<script type=\"text/plain\"") == 1);
    CHECK(count(html, "script-src '" + std::string(viewer_hash()) + "'") == 1);
    CHECK(html.find("The above copyright notice and this permission notice shall be included") != std::string::npos);
  }
  CHECK(count(html, "http") - count(html, "http-equiv") == count(html, "xmlns=\"http://www.w3.org/2000/svg\""));
  CHECK(count(html, " src=") == 0);
  CHECK(count(html, "@import") + count(html, "url(") == 0);
  CHECK(html.find("swell &lt;1 m&gt;") != std::string::npos);  // the sea state's name
  CHECK(html.size() < 700000);

  // Verdict first, and every part that was asked for.
  CHECK(html.find("Outside limits: 1 of 8") < html.find("Phases of the operation"));
  for (const char* part :
       {"id=\"overview\"", "id=\"replay\"", "id=\"search\"", "id=\"limits\"", "id=\"procedure\"", "id=\"plots\"",
        "id=\"metrics\"", "id=\"contacts\"", "id=\"poses\"", "id=\"tables\"", "id=\"assumptions\"", "id=\"case\""})
    CHECK(count(html, part) == 1);
  CHECK(html.find("0027/ND Table 5-1, inshore") != std::string::npos);
  CHECK(html.find("extra roll damping 4.0 % of critical") != std::string::npos);
  CHECK(html.find("haul in 14.00 m at 5.60 m/min") != std::string::npos);  // 2 * 14 m / 300 s
  CHECK(html.find("Radiation is constant.") != std::string::npos);
  CHECK(html.find("<td class=\"n\"><b>0.0011</b></td>") != std::string::npos);  // the only one known of its column
  CHECK(html.find("<td class=\"n\"><b>\u22120.0002</b></td>") != std::string::npos);  // 0.02 over its range, not 0.005
  CHECK(count(html, "<circle cx=") >= 10);
  CHECK(count(html, "class=\"plot\"") >= 16);
}

TEST_CASE("the tabulated amplification factor at the rows of 0027/ND Table 5-1") {
  // Read off the printed table; between 3 t and 100 t the formulae at SHL 25 t, where the root is 2.
  CHECK(tabulated_daf(LiftPlace::offshore, 50.0, 25.0) == Approx(1.5));
  CHECK(tabulated_daf(LiftPlace::inshore, 50.0, 25.0) == Approx(1.17));
  CHECK(tabulated_daf(LiftPlace::onshore, 50.0, 25.0) == Approx(1.10));
  CHECK(tabulated_daf(LiftPlace::offshore, 300.0, 310.0) == Approx(1.25));
  CHECK(tabulated_daf(LiftPlace::offshore, 1000.0, 1003.0) == Approx(1.20));
  CHECK(tabulated_daf(LiftPlace::inshore, 1001.0, 1003.0) == Approx(1.08));
  CHECK(tabulated_daf(LiftPlace::onshore, 5000.0, 5100.0) == Approx(1.03));
  CHECK(tabulated_daf(LiftPlace::offshore, 5000.0, 5100.0) == Approx(1.10));
  CHECK(std::isnan(tabulated_daf(LiftPlace::offshore, 2.0, 2.0)));
}

TEST_CASE("a run that failed at once still has a report that says so") {
  const truth::SyntheticLift lift;
  Trajectory run;
  run.status = RunStatus::diverged;
  run.message = "diverged at t = 0.05 s: body 'load'";
  const Metrics metrics = compute_metrics(lift.specification, run);
  const std::vector<LimitCheck> checks = check_limits(lift.limits, metrics);
  const std::string html = report_html({"", "", "", "0.1.0", lift.specification, run, metrics, checks, {}, {}, {}});
  CHECK(unbalanced(html) == "");
  CHECK(html.find("Not completed: diverged") != std::string::npos);
  CHECK(html.find("body &#39;load&#39;") != std::string::npos);
}

TEST_CASE("numbers for people") {
  CHECK(readable_number(-0.0) == "0");
  CHECK(readable_number(1234.5678) == "1235");
  CHECK(readable_number(-0.012345) == "\u22120.01235");
  CHECK(readable_number(std::nan("")) == "\u2013");
  CHECK(fixed_number(-0.001, 2) == "0.00");
  CHECK(fixed_number(-1.005, 1) == "\u22121.0");
  CHECK(escape_html("a<b&\"c'\x01") == "a&lt;b&amp;&quot;c&#39;\uFFFD");
}

TEST_CASE("summary.json holds metrics, limits and search, with null for what is not there") {
  const truth::SyntheticLift lift;
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  std::vector<LimitSpec> limits = lift.limits;
  limits.push_back({"clearance_min.none", {}, 3.0, ""});
  Summary summary = summarise(lift.specification, lift.trajectory, metrics, check_limits(limits, metrics));
  summary.objective = ObjectiveSummary{3.2, 2.1, SearchSection::kNone};
  summary.search = SearchSummary{"isres", 60, 240.0, 1};
  const auto json = nlohmann::json::parse(summary_json(summary));
  CHECK(json["schema_version"] == 1);
  CHECK(json["status"] == "completed");
  CHECK(json["simulated_s"] == 960.0);
  CHECK(json["real_time_factor"] == 640.0);
  CHECK(json["within_limits"] == false);
  CHECK(json["metrics"]["rehits"]["value"] == 3.0);
  CHECK(json["metrics"]["daf_max"]["phase"] == "load_transfer");  // its first crest
  CHECK(json["metrics"]["daf_max"]["value"].get<double>() == metrics.value("daf_max"));  // the same double
  CHECK(json["metrics"]["sway_rms"]["time"].is_null());
  CHECK(json["limits"].size() == limits.size());
  CHECK(json["limits"].back()["value"].is_null());
  CHECK(json["limits"].back()["pass"] == false);
  CHECK(json["objective"]["random_search"].is_null());
  CHECK(json["search"]["evaluations"] == 60);
  CHECK_FALSE(json.contains("estimates"));
}

namespace {

/// A page and what it is made of.
struct Page {
  truth::SyntheticLift lift;
  Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  std::vector<LimitCheck> checks = check_limits(lift.limits, metrics);

  std::string html(const SearchSection* search = nullptr, std::vector<BasisEntry> basis = {},
                   std::optional<double> north = {}) const {
    return without_scripts(report_html({"Lift",
                                        "",
                                        "",
                                        "0.1.0",
                                        lift.specification,
                                        lift.trajectory,
                                        metrics,
                                        checks,
                                        {},
                                        {},
                                        {},
                                        search,
                                        {},
                                        std::move(basis),
                                        {},
                                        north}));
  }
};

std::string part_of(const std::string& html, const std::string& from, const std::string& to) {
  const std::size_t at = html.find(from);
  return at == std::string::npos ? "" : html.substr(at, html.find(to, at) - at);
}

}  // namespace

TEST_CASE("loads and procedure come before the design basis, which has no column without a source in it") {
  const Page page;
  const std::vector<BasisEntry> bare = {{"bodies.load.mass_t", "1000", ""}, {"solver.time_step_s", "0.05", ""}};
  const std::string html = page.html(nullptr, bare);
  const std::size_t loads = html.find("<section id=\"loads\""), procedure = html.find("<section id=\"procedure\""),
                    basis = html.find("<section id=\"basis\"");
  CHECK(loads < procedure);
  CHECK(procedure < basis);
  REQUIRE(basis != std::string::npos);
  const std::string table = part_of(html, "<section id=\"basis\"", "</section>");
  CHECK(table.find("<td>–</td>") == std::string::npos);
  CHECK(table.find("source, as the case file gives it") == std::string::npos);
  std::vector<BasisEntry> sourced = bare;
  sourced[0].source = "weighed";
  const std::string with = part_of(page.html(nullptr, sourced), "<section id=\"basis\"", "</section>");
  CHECK_THAT(with, Catch::Contains("source, as the case file gives it") && Catch::Contains("<td>weighed</td>"));
}

TEST_CASE("the first screen says how much the verdict rests on") {
  Page page;
  SeaStateSpec& sea = page.lift.specification.sea.states[0];
  sea.type = SeaStateSpec::Type::jonswap;
  sea.significant_height = 1.5;
  sea.peak_period = 8.0;
  sea.seed = 7;
  CHECK_THAT(part_of(page.html(), "id=\"overview\"", "class=\"tiles\""),
             Catch::Contains("This is one run in one seed of the sea (7)"));
  SearchSection search = a_search(page.checks);
  search.shown = "paper_text";
  std::string first = part_of(page.html(&search), "id=\"overview\"", "class=\"tiles\"");
  CHECK_THAT(first, Catch::Contains("in all 2 scenarios of the search") &&
                        Catch::Contains("of one of them, paper text") &&
                        Catch::Contains("has not been tried in conditions"));
  CHECK_THAT(first, !Catch::Contains("one seed"));
  search.certificate = "In 20 fresh conditions the plan breaks offlead_max in 2.";
  search.certificate_kept = false;
  first = part_of(page.html(&search), "id=\"overview\"", "class=\"tiles\"");
  CHECK_THAT(first, Catch::Contains("<b class=\"fail\">Certificate:</b> In 20 fresh conditions the plan breaks"));
  CHECK_THAT(first, !Catch::Contains("has not been tried"));
}

TEST_CASE("a plan that its certificate does not bear out is no green verdict") {
  Page page;
  SearchSection search = a_search(page.checks);
  page.checks.clear();  // without limits every run is within them
  CHECK_THAT(page.html(&search), Catch::Contains("<div class=\"verdict\" role=\"status\">"));
  search.certificate = "It breaks one.";
  search.certificate_kept = false;
  CHECK_THAT(page.html(&search),
             Catch::Contains("<div class=\"verdict warn\" role=\"status\"><strong>Within limits in the search&#39;s "
                             "conditions, not in fresh ones</strong>"));
}

TEST_CASE("a search without a point within the limits says so instead of an empty frame") {
  const Page page;
  SearchSection search = a_search(page.checks);
  CHECK_THAT(page.html(&search), Catch::Contains("Convergence: best objective"));
  for (auto* history : {&search.history, &search.random_history})
    for (SearchSection::Point& point : *history) point.feasible = false;
  const std::string html = page.html(&search);
  CHECK_THAT(html, !Catch::Contains("Convergence: best objective"));
  CHECK_THAT(html, Catch::Contains("No evaluation was within the limits"));
}

TEST_CASE("worse but within its limit is not shown in red") {
  const Page page;
  SearchSection search = a_search(page.checks);
  LimitCheck daf;
  daf.metric = "daf_total";
  daf.unit = "1";
  daf.value = 1.02;
  daf.limit = 1.3;
  daf.pass = true;
  search.baseline_limits = search.plan_limits = {daf};
  search.plan_limits[0].value = 1.03;
  CHECK_THAT(page.html(&search), Catch::Contains("<span>+0.01 (+1.0 %) worse</span>"));
  search.plan_limits[0].value = 1.4;
  search.plan_limits[0].pass = false;
  CHECK_THAT(page.html(&search), Catch::Contains("<span class=\"fail\">+0.38 (+37.3 %) worse</span>"));
}

TEST_CASE("waves come from a compass direction where true north is known") {
  Page page;
  page.lift.specification.sea.states[0].heading = 0.0;  // towards +x
  // North along +x: waves towards north come from the south. North along +y (90 deg): +x is east, they come from the
  // west.
  CHECK_THAT(page.html(nullptr, {}, 0.0), Catch::Contains("that is from 180° true"));
  CHECK_THAT(page.html(nullptr, {}, 1.5707963267948966), Catch::Contains("that is from 270° true"));
  CHECK_THAT(page.html(nullptr, {}, -3.1415926), Catch::Contains("that is from 0° true"));
  CHECK_THAT(page.html(), !Catch::Contains("° true"));
}

TEST_CASE("long keys and intervals in tables may be broken, short numbers may not") {
  const std::string html = table_html({"Estimates",
                                       "",
                                       {"parameter", "bounds"},
                                       {{"bodies.ship.added_mass_t.2, t", "1 000 to 20 000"}, {"x", "4.25"}}});
  CHECK_THAT(html, Catch::Contains("bodies.<wbr>ship.<wbr>added_<wbr>mass_<wbr>t.<wbr>2, t"));
  CHECK_THAT(html, Catch::Contains("<td class=\"n wide\">1 000 to 20 000</td>") &&
                       Catch::Contains("<td class=\"n\">4.25</td>"));
}
