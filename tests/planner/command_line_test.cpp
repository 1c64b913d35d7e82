// The program as a user meets it: exit codes, streams, folders, Ctrl-C, kill -9 and resume.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "planner/verbs/plan/plan.h"
#include "results/sha256.h"
#include "tests/planner/program.h"

using namespace stillhook;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

/// Evaluations in the store of a run folder, 0 as long as there is none.
int stored(const std::string& folder) {
  if (!fs::exists(folder + "/evaluations.sqlite")) return 0;
  try {
    const Case c = read_case(folder + "/case.toml");
    const Evaluator evaluator(c);
    EvaluationStore store(folder + "/evaluations.sqlite", store_identity(c), evaluator.problem());
    return store.size();
  } catch (const std::exception&) {
    return 0;  // not written yet
  }
}

void wait_for_evaluations(const std::string& folder, int count) {
  // Generous: the machine may be busy. What is waited for takes a fraction of a second on an idle one.
  for (int i = 0; i < 6000 && stored(folder) < count; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(stored(folder) >= count);
}

}  // namespace

TEST_CASE("help, version and usage") {
  const Folder folder;
  CHECK(run(folder, {"--help"}).code == 0);
  const Result version = run(folder, {"--version"});
  CHECK(version.code == 0);
  CHECK_THAT(version.out, Catch::StartsWith("stillhook "));
  for (const char* verb : {"check", "simulate", "plan", "report", "schema"}) {
    CHECK_THAT(run(folder, {"--help"}).out, Catch::Contains(verb));
    CHECK(run(folder, {verb, "--help"}).code == 0);
  }
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{},
                                             {"dance"},
                                             {"simulate"},
                                             {"simulate", kCase, "--wrong"},
                                             {"simulate", kCase, "--threads", "0"},
                                             {"simulate", kCase, "--seed", "3"},  // the active sea is regular
                                             {"simulate", "missing.toml"},
                                             {"plan", kCase, "--evaluations", "none"},
                                             {"plan", kCase, "--resume"},
                                             {"plan", kCase, "--resume", "--force"},
                                             {"plan", kCase, "--set", "plan.local_algorithm=bobyqa"},
                                             {"report", "nowhere"},
                                             {"check", kCase, "--set", "sea.ramp_s"},
                                             {"check", kCase, "--set", "sea.ramp_s=-3"},
                                             {"check", kCase, "--set", "wires.fall.axial_stiffness_kN=-1"}}) {
    CAPTURE(wrong);
    const Result result = run(folder, wrong);
    CHECK(result.code == 2);
    CHECK(result.out.empty());
    CHECK_FALSE(result.err.empty());
  }
  CHECK_FALSE(fs::exists(folder / "runs"));  // nothing of this leaves a trace
}

TEST_CASE("check prints the poses and phases, as text and as JSON") {
  const Folder folder;
  const Result text = run(folder, {"check", kCase});
  CHECK(text.code == 0);
  CHECK_THAT(text.out, Catch::Contains("Hull of barge") && Catch::Contains("hoist_up") && Catch::Contains("valid"));
  // Across, the two linear moorings hold the barge by their pretension alone: 2 * 50 kN / 200 m on 1640 + 400 t of barge
  // and water and the load's 20 t, a period of 403 s that the program warns of, in one line.
  CHECK_THAT(text.err, Catch::StartsWith("warning: barge is not held in y: its period there is 403 s"));
  CHECK(std::count(text.err.begin(), text.err.end(), '\n') == 1);
  const json document = json::parse(run(folder, {"check", kCase, "--json"}).out);
  CHECK(document["case"] == "small_lift");
  CHECK(document["duration_s"] == Approx(20 + 20 + 3 + 20));  // 4 m at 12 m/min is 20 s, plus one ramp of 3 s
  bool found = false;
  for (const json& table : document["tables"]) {
    if (table["title"] != "Hull of barge") continue;
    found = true;
    // Archimedes: (1640 + 20 t) / (1.025 * 40 * 20), the tagline's and moorings' vertical pull aside.
    CHECK(table["rows"][0][1].get<double>() == Approx(1660.0 / 820.0).margin(2e-3));
  }
  CHECK(found);
  CHECK(json::parse(run(folder, {"schema"}).out).contains("properties"));
}

TEST_CASE("check draws the start pose into a file and every pose into a folder") {
  const Folder folder;
  const Result one = run(folder, {"check", kCase, "--draw", "start.svg"});
  CHECK(one.code == 0);
  CHECK_THAT(one.out, Catch::Contains("Drawn: start.svg"));
  const std::string svg = content(folder / "start.svg");
  CHECK_THAT(svg, Catch::StartsWith("<svg") && Catch::Contains("xmlns") && Catch::Contains("elevation and plan"));
  // Never over a file that is there, unless told.
  const Result again = run(folder, {"check", kCase, "--draw", "start.svg"});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Catch::Contains("start.svg") && Catch::Contains("--force"));
  CHECK(run(folder, {"check", kCase, "--draw", "start.svg", "--force"}).code == 0);
  // The load goes up 4 m in `hoist_up`; `settle` and `hold` look like what is before them.
  const json all = json::parse(run(folder, {"check", kCase, "--draw", "poses", "--json"}).out);
  CHECK(all["drawings"] == json({"poses/1_start.svg", "poses/2_hoist_up.svg"}));
  for (const std::string name : {"1_start", "2_hoist_up"}) CHECK(fs::exists(folder / ("poses/" + name + ".svg")));
  CHECK(run(folder, {"check", kCase, "--draw", "start.svg/poses"}).code == 2);  // a file is no folder
}

TEST_CASE("quiet: nothing is printed but errors, and JSON where it is asked for") {
  const Folder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"check", kCase},
                                             {"simulate", kCase, "--out", "s"},
                                             {"plan", kCase, "--out", "p", "--evaluations", "4"},
                                             {"tune", kCase, "--out", "t", "--evaluations", "4"}}) {
    CAPTURE(arguments);
    std::vector<std::string> quiet = arguments;
    quiet.push_back("--quiet");
    const Result result = run(folder, quiet);
    CHECK(result.code == 0);
    CHECK(result.out.empty());
    CHECK(result.err.empty());
  }
  CHECK(json::parse(run(folder, {"check", kCase, "--quiet", "--json"}).out)["case"] == "small_lift");
}

TEST_CASE("simulate leaves a complete folder, and refuses to overwrite it") {
  const Folder folder;
  const Result first = run(folder, {"simulate", kCase, "--json"});
  CHECK(first.code == 0);
  const json summary = json::parse(first.out);
  CHECK(summary == json::parse(content(folder / "runs/small_lift-simulate/summary.json")));
  CHECK(summary["status"] == "completed");
  CHECK(summary["simulated_s"] == Approx(63.0).margin(0.1));
  for (const char* file : {"case.toml", "history.nc", "report.html"})
    CHECK(fs::exists(folder / ("runs/small_lift-simulate/" + std::string(file))));
  CHECK(run(folder, {"simulate", kCase}).code == 2);
  CHECK(run(folder, {"simulate", kCase, "--force"}).code == 0);
  // The resolved case is a case that gives the same run; the statement is kept.
  const std::string resolved = folder / "runs/small_lift-simulate/case.toml";
  CHECK_THAT(content(resolved), Catch::StartsWith("# A 20 t load on one fall"));
  const json again = json::parse(run(folder, {"simulate", resolved, "--json", "--out", "again"}).out);
  CHECK(again["metrics"] == summary["metrics"]);
  CHECK(again["limits"] == summary["limits"]);
}

TEST_CASE("a violated limit is 3, a soft one is not") {
  const Folder folder;
  const Result hard = run(folder, {"simulate", kCase, "--out", "a", "--set", "limits.offlead_max.max=0.5"});
  CHECK(hard.code == 3);
  CHECK_THAT(hard.out, Catch::Contains("FAIL"));
  const Result soft = run(folder, {"simulate", kCase, "--out", "b", "--set", "limits.offlead_max.max=0.5", "--set",
                                   "limits.offlead_max.hard=false"});
  CHECK(soft.code == 0);
  CHECK_THAT(soft.out, Catch::Contains("warning"));
}

TEST_CASE("the report of a run folder can be rebuilt, for a run and for a plan") {
  const Folder folder;
  REQUIRE(run(folder, {"simulate", kCase, "--out", "s"}).code == 0);
  REQUIRE(run(folder, {"plan", kCase, "--out", "p", "--evaluations", "6"}).code == 0);
  REQUIRE(run(folder, {"plan", kCase, "--out", "g", "--evaluations", "4", "--set", "plan.gradient_algorithm=slsqp",
                       "--set", "plan.gradient_evaluations=3", "--set", "plan.certify=3"})
              .code == 0);
  const std::string judged = content(folder / "g/report.html");
  CHECK(judged.find("What moves what at the plan") != std::string::npos);
  CHECK(judged.find("In conditions the search has not seen") != std::string::npos);
  for (const char* name : {"s", "p", "g"}) {
    CAPTURE(name);
    const std::string report = folder / (std::string(name) + "/report.html");
    const std::string before = content(report);
    fs::remove(report);
    CHECK(run(folder, {"report", name}).code == 0);
    CHECK(fs::exists(report));
    // Byte for byte; only how long the search took is not known any more.
    const std::regex time_taken(", ([0-9]+:)?[0-9]+:[0-9]{2} of computing \\(h:min:s\\)");
    const bool same = content(report) == std::regex_replace(before, time_taken, "");
    CHECK(same);
  }
}

TEST_CASE("a report says when its run was made, of which case, and who stands for it, also when it is made again") {
  const Folder folder;
  REQUIRE(run(folder, {"simulate", kCase, "--out", "s", "--set", "revision=B", "--set", "author='A. Naval'", "--set",
                       "north_deg=90"})
              .code == 0);
  const json summary = json::parse(content(folder / "s/summary.json"));
  const std::string date = summary["date"];
  CHECK(std::regex_match(date, std::regex("20[0-9]{2}-[01][0-9]-[0-3][0-9] [0-2][0-9]:[0-5][0-9] UTC")));
  // Another day: a rebuilt report keeps the date of the run, which stands in summary.json alone.
  std::string older = content(folder / "s/summary.json");
  older.replace(older.find(date), date.size(), "2001-02-03 04:05 UTC");
  std::ofstream(folder / "s/summary.json") << older;
  REQUIRE(run(folder, {"report", "s"}).code == 0);
  const std::string report = content(folder / "s/report.html");
  const std::string hash = sha256(content(folder / "s/case.toml"));
  for (const std::string& part :
       {std::string("<dt>Run</dt><dd>2001-02-03 04:05 UTC</dd>"), std::string("<dt>Revision</dt><dd>B</dd>"),
        std::string("<dt>Author</dt><dd>A. Naval</dd>"), std::string("<dt>Checked by</dt><dd>–</dd>"),
        "SHA-256 of case.toml: " + hash, std::string("revision B · 2001-02-03 04:05 UTC"), std::string("° true")})
    CHECK_THAT(report, Catch::Contains(part));
  for (const char* file : {"s/history.nc", "s/case.toml"})
    CHECK(content(folder / file).find(date.substr(0, 10)) == std::string::npos);  // same run, same bytes
}

TEST_CASE("plan: better than the baseline, the same with one thread and two, and the plan simulates") {
  const Folder folder;
  const Result two = run(folder, {"plan", kCase, "--out", "two", "--threads", "2", "--evaluations", "25", "--json"});
  CHECK(two.code == 0);
  const Result one = run(folder, {"plan", kCase, "--out", "one", "--threads", "1", "--evaluations", "25", "--json"});
  const json a = json::parse(two.out), b = json::parse(one.out);
  for (const char* key : {"metrics", "limits", "objective", "search", "variables", "status"}) CHECK(a[key] == b[key]);
  CHECK(content(folder / "one/plan.toml") == content(folder / "two/plan.toml"));
  CHECK(a["objective"]["plan"].get<double>() < a["objective"]["baseline"].get<double>());
  CHECK(a["search"]["evaluations"] == 25);

  // The plan, simulated in each scenario, gives the summary's numbers: every metric in the scenario that it is shown of.
  std::map<std::string, json> simulated;
  for (const auto& [scenario, heading] : {std::pair{"from_aft", "30.0"}, std::pair{"from_ahead", "150.0"}})
    simulated[scenario] = json::parse(run(folder, {"simulate", folder / "two/plan.toml", "--json", "--out", scenario,
                                                   "--set", std::string("sea.states.swell.heading_deg=") + heading})
                                          .out)["metrics"];
  CHECK(a["metrics"].size() == simulated["from_aft"].size());
  for (const auto& [name, shown] : a["metrics"].items()) {
    CAPTURE(name);
    json metric = shown;
    metric.erase("scenario");
    CHECK(metric == simulated.at(shown.at("scenario").get<std::string>()).at(name));
  }
}

TEST_CASE("plan leaves the random search out where it is not wanted, and --resume adds it") {
  const Folder folder;
  const Result alone =
      run(folder, {"plan", kCase, "--out", "p", "--evaluations", "6", "--set", "plan.random_search=false"});
  REQUIRE(alone.code == 0);
  CHECK_THAT(alone.out, !Catch::Contains("random search"));
  CHECK_THAT(content(folder / "p/report.html"), !Catch::Contains("random search"));
  CHECK(json::parse(content(folder / "p/summary.json"))["objective"]["random_search"].is_null());
  const Result both = run(folder, {"plan", kCase, "--out", "p", "--evaluations", "6", "--resume"});
  CHECK_THAT(both.out, Catch::Contains("random search"));
  CHECK(json::parse(content(folder / "p/summary.json"))["objective"]["random_search"].is_number());
}

TEST_CASE("plan begins from the guesses as well, with the case as its baseline") {
  const Folder folder;
  const Result r = run(folder, {"plan", kCase, "--out", "p", "--evaluations", "2", "--json", "--set",
                                "plan.variables.operation.phases.hoist_up.moves.hoist.speed_m_per_min.start=24"});
  REQUIRE(r.code == 0);
  const json s = json::parse(r.out);
  CHECK(s["objective"]["plan"].get<double>() < s["objective"]["baseline"].get<double>());  // a faster hoist sways less
  bool seen = false;
  for (const json& v : s["variables"]) {
    const bool hoist = v["name"] == "operation.phases.hoist_up.moves.hoist.speed_m_per_min";
    seen = seen || hoist;
    CHECK(v["plan"].get<double>() == (hoist ? 24.0 : v["baseline"].get<double>()));
  }
  CHECK(seen);
}

TEST_CASE("plan without a feasible point is 3, with the least violation in its folder") {
  const Folder folder;
  const Result result =
      run(folder, {"plan", kCase, "--out", "p", "--evaluations", "5", "--set", "limits.offlead_max.max=0.01"});
  CHECK(result.code == 3);
  CHECK_THAT(result.err, Catch::Contains("no plan within the limits"));
  CHECK(fs::exists(folder / "p/plan.toml"));
}

TEST_CASE("plan: kill -9, resume, same plan, nothing lost and nothing repeated") {
  const Folder folder;
  std::vector<std::string> options = {"--evaluations", "24", "--seed", "3", "--json", "--quiet"};
  const bool with_gradients = GENERATE(false, true);
  if (with_gradients)
    for (const char* key : {"plan.gradient_algorithm=slsqp", "plan.gradient_evaluations=6",
                            "plan.pareto.first=duration", "plan.pareto.second=sway_peak", "plan.pareto.evaluations=4"})
      options.insert(options.end(), {"--set", key});
  const auto plan = [&](const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"plan", kCase, "--out", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const json undisturbed = json::parse(run(folder, plan("whole")).out);
  const int evaluations = stored(folder / "whole");

  for (const int wanted : {4, 15}) {
    const pid_t child =
        start(folder, plan("killed", wanted == 4 ? std::vector<std::string>{} : std::vector<std::string>{"--resume"}));
    wait_for_evaluations(folder / "killed", wanted);
    kill(child, SIGKILL);
    finish(folder, child);
  }
  const int kept = stored(folder / "killed");
  CHECK(kept >= 15);
  const Result resumed = run(folder, plan("killed", {"--resume"}));
  CHECK(resumed.code == 0);
  const json b = json::parse(resumed.out);
  for (const char* key : {"metrics", "limits", "objective", "search", "variables", "status"})
    CHECK(undisturbed[key] == b[key]);
  if (with_gradients) CHECK(undisturbed["pareto"] == b["pareto"]);
  CHECK(content(folder / "whole/plan.toml") == content(folder / "killed/plan.toml"));
  CHECK(stored(folder / "killed") == evaluations);

  // Another case is not gone on with.
  const Result other = run(folder, plan("killed", {"--resume", "--set", "sea.ramp_s=9"}));
  CHECK(other.code == 2);
  CHECK_THAT(other.err, Catch::Contains("another case"));
  // A larger budget is: the first evaluations are all there.
  CHECK(run(folder, {"plan", kCase, "--out", "killed", "--seed", "3", "--evaluations", "27", "--resume"}).code == 0);
}

TEST_CASE("plan: Ctrl-C leaves the best plan so far, exit code 130, and the search goes on with --resume") {
  const Folder folder;
  const pid_t child = start(folder, {"plan", kCase, "--out", "p", "--evaluations", "3000", "--json"});
  wait_for_evaluations(folder / "p", 5);
  kill(child, SIGINT);
  const Result interrupted = finish(folder, child);
  CHECK(interrupted.code == 130);
  const json summary = json::parse(interrupted.out);
  CHECK(summary["status"] == "interrupted");
  CHECK(summary["search"]["evaluations"].get<int>() >= 5);
  CHECK(fs::exists(folder / "p/plan.toml"));
  CHECK_NOTHROW(read_case(folder / "p/plan.toml"));
  const int kept = stored(folder / "p");
  CHECK(run(folder, {"plan", kCase, "--out", "p", "--evaluations", "8", "--resume"}).code == 0);
  CHECK(stored(folder / "p") >= kept);
}

TEST_CASE("simulate: Ctrl-C stops at the next call, with the part that ran in its folder") {
  const Folder folder;
  const pid_t child =
      start(folder, {"simulate", kCase, "--out", "s", "--json", "--set", "operation.phases.settle.duration_s=200000",
                     "--set", "solver.output_interval_s=50"});
  for (int i = 0; i < 6000 && !fs::exists(folder / "s/case.toml"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Result result = finish(folder, child);
  CHECK(result.code == 130);
  CHECK(json::parse(result.out)["status"] == "interrupted");
  CHECK(fs::exists(folder / "s/history.nc"));
}

TEST_CASE("NO_COLOR and files get no escape sequences") {
  const Folder folder;
  setenv("NO_COLOR", "1", 1);
  const Result result = run(folder, {"check", "missing.toml"});
  unsetenv("NO_COLOR");
  CHECK(result.err.find('\x1b') == std::string::npos);
  CHECK(run(folder, {"simulate", kCase}).err.find('\x1b') == std::string::npos);
}
