// `stillhook operability` and its campaign as a user meets them: the same results for any number of workers, whichever
// of them is lost, and what is told when a folder is not what it should be.
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "planner/campaign/parts.h"
#include "tests/planner/documented_keys.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

/// The small lift, shortened: a run takes some tens of milliseconds. Half of eight seeds give a certified median.
std::string short_lift(const std::string& operability) {
  std::string text = content(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml");
  text = std::regex_replace(text, std::regex("duration_s = 20.0"), "duration_s = 6.0");
  text = std::regex_replace(text, std::regex("ramp_s = 10.0"), "ramp_s = 3.0");
  text = std::regex_replace(text, std::regex("time_step_s = 0.05"), "time_step_s = 0.1");
  text =
      std::regex_replace(text, std::regex("panel_length_m = 10.0"), "panel_length_m = 4.0");  // for every seed's waves
  text = std::regex_replace(text, std::regex("offlead_max = \\{ max = 15.0"), "offlead_max = { max = 4.0");
  return text + "\n" + operability;
}

constexpr const char* kTwoColumns = R"([operability]
sea = "wind_sea"
peak_periods_s = [6.0, 8.0]
headings_deg = [150.0]
level = 0.5
seeds = [8]
resolution = 0.1
)";

class Study {
 public:
  explicit Study(const std::string& operability = kTwoColumns) {
    std::ofstream(folder / "case.toml", std::ios::binary) << short_lift(operability);
  }
  std::vector<std::string> words(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"operability", "case.toml", "--out", "out", "--json", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Result go(std::vector<std::string> more = {}) const { return run(folder, words(std::move(more))); }
  std::string part(const std::string& name) const { return folder / ("out/parts/" + name); }
  Folder folder;
};

json operability_of(const Result& r) { return json::parse(r.out).at("operability"); }

bool wait_until(const std::function<bool()>& there) {
  for (int i = 0; i < 600; ++i) {
    if (there()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// Process of the attempt that a part is of.
pid_t pid_in(const std::string& part) {
  std::ifstream in(part);
  std::string line;
  std::getline(in, line);
  return line.empty() ? 0 : static_cast<pid_t>(json::parse(line).at("pid").get<long>());
}

/// Whether a process runs; one that has ended and waits to be asked for its code does not.
bool runs(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(in, line);
  const std::size_t name_end = line.rfind(')');
  return name_end != std::string::npos && line.size() > name_end + 2 && line[name_end + 2] != 'Z';
}

TEST_CASE("operability leaves limits that weather reads, with a documented summary", "[cli][operability][slow]") {
  const Study study;
  const Result r = study.go();
  INFO(r.err);
  REQUIRE(r.code == 0);
  CHECK(undocumented_keys(json::parse(r.out)) == std::set<std::string>{});
  const json o = operability_of(r);
  REQUIRE(o["columns"].size() == 2);
  for (const json& column : o["columns"]) {
    CHECK(column["hs_low_m"] <= column["hs_limit_m"]);
    CHECK(column["hs_limit_m"] <= column["hs_high_m"]);
    CHECK(column["by_phase"].size() == 3);
    // What is known of a phase is that it keeps its limits there, up to a bracket.
    for (const auto& [phase, limit] : column["by_phase"].items())
      CHECK(limit["hs_limit_m"].get<double>() >= column["hs_limit_m"].get<double>() / 1.1);
  }
  for (const char* file :
       {"case.toml", "manifest.json", "operability.csv", "operability.nc", "report.html", "summary.json"})
    CHECK(fs::exists(study.folder / (std::string("out/") + file)));
  const std::string page = content(study.folder / "out/report.html");
  for (const char* word : {"By period", "Seeds", "Method", "stillhook simulate case.toml"})
    CHECK_THAT(page, Contains(word));
  // The limits as they stand serve the next verb.
  std::ofstream(study.folder / "weather.csv")
      << "time,hs [m],tp [s]\n2026-01-01T00:00Z,0.01,7\n2026-01-01T03:00Z,20,7\n";
  const Result weather = run(study.folder, {"weather", "out", "--hindcast", "weather.csv", "--json", "--quiet"});
  INFO(weather.err);
  REQUIRE(weather.code == 0);
  CHECK(json::parse(weather.out)["weather"]["workability"] == 0.5);
  // The seed that breaks first breaks as a run of its own, too.
  std::smatch command;
  REQUIRE(std::regex_search(page, command, std::regex("stillhook (simulate case.toml[^<]*)")));
  std::istringstream in(command[1]);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  const Folder other;
  fs::copy_file(study.folder / "out/case.toml", other / "case.toml");
  CHECK(run(other, words).code == 3);
}

TEST_CASE("The results do not depend on the number of workers, on lost ones or on a coordinator that is killed",
          "[cli][operability][slow]") {
  const Study one, three, lost, resumed;
  const std::string hash = operability_of(one.go({"--jobs", "1"}))["results_sha256"];
  const std::string csv = content(one.folder / "out/operability.csv");
  CHECK(operability_of(three.go({"--jobs", "3"}))["results_sha256"] == hash);
  CHECK(content(three.folder / "out/operability.csv") == csv);

  // A worker that is killed, as by a cluster that takes its node away.
  const pid_t coordinator = start(lost.folder, lost.words({"--jobs", "3"}));
  REQUIRE(wait_until([&] { return fs::exists(lost.part("1.1.jsonl")) && count_results(lost.folder / "out", 1) >= 2; }));
  REQUIRE(kill(pid_in(lost.part("1.1.jsonl")), SIGKILL) == 0);
  const Result after = finish(lost.folder, coordinator);
  INFO(after.err);
  CHECK(after.code == 0);
  CHECK(fs::exists(lost.part("1.2.jsonl")));
  CHECK_FALSE(fs::exists(lost.part("1.1.crash")));  // it was not the program's fault
  CHECK(operability_of(after)["results_sha256"] == hash);
  CHECK(content(lost.folder / "out/operability.csv") == csv);

  const pid_t killed = start(resumed.folder, resumed.words({"--jobs", "2"}));
  REQUIRE(wait_until([&] { return count_results(resumed.folder / "out") >= 5; }));
  const pid_t orphan = pid_in(resumed.part("0.1.jsonl"));
  REQUIRE(kill(killed, SIGKILL) == 0);
  CHECK(finish(resumed.folder, killed).code == -SIGKILL);
  CHECK(wait_until([&] { return !runs(orphan); }));  // its workers end with it
  CHECK_FALSE(fs::exists(resumed.folder / "out/summary.json"));
  const std::size_t had = count_results(resumed.folder / "out");
  const Result went_on = resumed.go({"--resume"});
  INFO(went_on.err);
  CHECK(went_on.code == 0);
  CHECK(operability_of(went_on)["results_sha256"] == hash);
  CHECK(operability_of(went_on)["repeated"] == 0);
  CHECK(operability_of(went_on)["runs"].get<std::size_t>() > had);
}

TEST_CASE("Ctrl-C and cancel end a campaign that --resume goes on with", "[cli][operability][slow]") {
  const Study study;
  const pid_t coordinator = start(study.folder, study.words({"--jobs", "1"}));
  REQUIRE(wait_until([&] { return count_results(study.folder / "out") >= 3; }));
  CHECK(run(study.folder, {"operability", "case.toml", "--out", "out", "--resume", "--quiet"}).code ==
        2);  // one at a time
  CHECK(run(study.folder, {"campaign", "cancel", "out", "--quiet"}).code == 0);
  int status = 0;
  REQUIRE(waitpid(coordinator, &status, 0) == coordinator);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 130));
  const Result half = run(study.folder, {"campaign", "status", "out"});
  CHECK(half.code == 0);
  CHECK_THAT(half.out, Contains("of 2 columns are done") && Contains("It was told to end."));
  // What is there can be looked at: bounds, and no certificate.
  const Result collected = run(study.folder, {"campaign", "collect", "out", "--json", "--quiet"});
  CHECK(collected.code == 3);
  CHECK(json::parse(collected.out)["status"] == "interrupted");
  CHECK_THAT(content(study.folder / "out/operability.csv"), Contains("incomplete"));
  const Result rest = study.go({"--resume"});
  CHECK(rest.code == 0);
  const Result whole = run(study.folder, {"campaign", "collect", "out", "--json", "--quiet"});
  CHECK(whole.code == 0);
  CHECK(operability_of(whole)["results_sha256"] == operability_of(rest)["results_sha256"]);
}

/// The first lines of a part, up to the nth result, and the begin of the run after it.
void cut_after(const std::string& part, int results) {
  std::istringstream lines(content(part));
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("{\"begin\"") && results == 0) {
      kept += line + "\n";
      break;
    }
    if (line.starts_with("{\"result\"")) --results;
    kept += line + "\n";
  }
  std::ofstream(part, std::ios::binary) << kept;
}

TEST_CASE("Parts that are torn, repeated, damaged or of a crash", "[cli][operability][slow]") {
  const Study study(std::regex_replace(std::string(kTwoColumns), std::regex("6.0, 8.0"), "8.0"));
  const Result first = study.go({"--jobs", "1"});  // one run at a time, so that one is under way where a part is cut
  REQUIRE(first.code == 0);
  const std::string hash = operability_of(first)["results_sha256"], part = study.part("0.1.jsonl");
  const std::string whole = content(part);
  const auto worker = [&] { return run(study.folder, {"worker", "out", "--task", "0", "--quiet"}); };
  const auto collected = [&] { return run(study.folder, {"campaign", "collect", "out", "--json", "--quiet"}); };

  // A last line that is torn is not there; the run is made again.
  std::ofstream(part, std::ios::binary) << whole.substr(0, whole.size() - 20);
  CHECK(collected().code == 3);
  CHECK(worker().code == 0);
  CHECK(operability_of(collected())["results_sha256"] == hash);
  CHECK(operability_of(collected())["repeated"] == 0);

  // Two attempts at once: what both have made must be equal bit for bit.
  std::ofstream(study.part("0.2.jsonl"), std::ios::binary) << whole;
  CHECK(operability_of(collected())["results_sha256"] == hash);
  CHECK(operability_of(collected())["repeated"] > 0);
  const std::size_t at = whole.find("\"values\":[[") + 11;
  std::string other = whole;
  other[at + 3] = other[at + 3] == '1' ? '2' : '1';
  std::ofstream(study.part("0.2.jsonl"), std::ios::binary) << other;
  CHECK(collected().code == 2);
  CHECK_THAT(collected().err, Contains("gave other values than in attempt 1") && Contains("not deterministic"));
  fs::remove(study.part("0.2.jsonl"));

  // Damage in the middle is told with its line.
  std::ofstream(part, std::ios::binary) << whole.substr(0, 400) + "\n" + whole.substr(500);
  CHECK(collected().code == 2);
  CHECK_THAT(collected().err, Contains("0.1.jsonl:") && Contains("is damaged"));

  // Two attempts that ended in the same run by a signal of their own making: it is left out, and nothing is certified.
  for (const char* attempt : {"0.1", "0.2"}) {
    std::ofstream(study.part(std::string(attempt) + ".jsonl"), std::ios::binary) << whole;
    cut_after(study.part(std::string(attempt) + ".jsonl"), 4);
    std::ofstream(study.part(std::string(attempt) + ".crash")) << "11\n";
  }
  CHECK(worker().code == 0);
  const Result crashed = collected();
  CHECK(crashed.code == 3);
  CHECK(operability_of(crashed)["crashed"] == 1);
  CHECK(operability_of(crashed)["columns"][0]["state"][0] == "crashed");
  CHECK_THAT(content(study.folder / "out/operability.csv"), Contains("crashed"));
  // After one such attempt the run is simply made.
  fs::remove(study.part("0.1.crash"));
  fs::remove(study.part("0.3.jsonl"));
  CHECK(worker().code == 0);
  CHECK(operability_of(collected())["results_sha256"] == hash);
}

TEST_CASE("A campaign of another program, case or file is refused", "[cli][operability][slow]") {
  const Study study(std::regex_replace(std::string(kTwoColumns), std::regex("6.0, 8.0"), "8.0"));
  REQUIRE(study.go().code == 0);
  const auto told = [&](const std::vector<std::string>& words) {
    const Result r = run(study.folder, words);
    CHECK(r.code == 2);
    return r.err;
  };
  const std::vector<std::string> resume = {"operability", "case.toml", "--out", "out", "--resume"};
  CHECK_THAT(told({"operability", "case.toml", "--out", "out"}), Contains("exists already"));
  std::vector<std::string> changed = resume;
  changed.insert(changed.end(), {"--set", "operability.level=0.6"});
  CHECK_THAT(told(changed), Contains("was begun for another case"));
  CHECK_THAT(told({"worker", "out", "--task", "7"}), Contains("the campaign has tasks 0 to 0"));
  CHECK_THAT(told({"worker", "nowhere", "--task", "0"}), Contains("holds no campaign"));
  CHECK_THAT(told({"campaign", "status", "."}), Contains("there is no manifest.json"));
  CHECK_THAT(told({"operability", "case.toml", "--out", "new", "--resume"}), Contains("nothing to resume"));

  const std::string manifest = content(study.folder / "out/manifest.json");
  const auto with = [&](const std::string& pattern, const std::string& put) {
    std::ofstream(study.folder / "out/manifest.json") << std::regex_replace(manifest, std::regex(pattern), put);
  };
  with("\"program\": \"[^\"]*\"", "\"program\": \"0.1.0\"");
  CHECK_THAT(told({"worker", "out", "--task", "0"}), Contains("was begun by stillhook 0.1.0"));
  CHECK_THAT(told(resume), Contains("was begun by stillhook 0.1.0"));
  with("\"executable_sha256\": \"..", "\"executable_sha256\": \"zz");
  CHECK_THAT(told({"worker", "out", "--task", "0"}), Contains("another build"));
  with("\"case_sha256\": \"..", "\"case_sha256\": \"zz");
  CHECK_THAT(told({"campaign", "collect", "out"}), Contains("is not the case that the campaign was begun with"));
  with("\\{", "");
  CHECK_THAT(told({"campaign", "status", "out"}), Contains("is no manifest of a campaign"));
  // And a new one takes its place.
  CHECK(study.go({"--force"}).code == 0);
}

TEST_CASE("operability says what it will cost, and what a case lacks", "[cli][operability]") {
  const Study study;
  const Result dry = run(study.folder, {"operability", "case.toml", "--dry-run", "--jobs", "2"});
  INFO(dry.err);
  CHECK(dry.code == 0);
  CHECK_THAT(dry.out, Contains("2 tasks") && Contains("runs each") && Contains("core-hours") && Contains("disk:"));
  CHECK_FALSE(fs::exists(study.folder / "runs"));
  const auto told = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"operability", "case.toml", "--dry-run"});
    const Result r = run(study.folder, more);
    CHECK(r.code == 2);
    return r.err;
  };
  CHECK_THAT(told({"--set", "limits.setdown_speed.max=1", "--set", "limits.setdown_speed.source=x"}),
             Contains("has no value in a run of this lift"));
  CHECK_THAT(told({"--set", "operability.sea=swell"}), Contains("must name a sea state of type jonswap"));
  CHECK_THAT(told({"--jobs", "0"}), Contains("--jobs"));
  std::ofstream(study.folder / "case.toml") << short_lift("");
  CHECK_THAT(told({}), Contains("has no section [operability]") && Contains("--set operability.peak_periods_s"));
}

TEST_CASE("Phases are simulated alone, headings mirrored, every limit refined", "[cli][operability][slow]") {
  const Study study(R"([operability]
sea = "wind_sea"
peak_periods_s = [8.0]
headings_deg = [90.0, 180.0]
mirror = true
level = 0.5
seeds = [8]
resolution = 0.1
criteria = "all"
[[operability.phases]]
name = "hoist_up"
)");
  const Result r = study.go();
  INFO(r.err);
  REQUIRE(r.code == 0);
  const json o = operability_of(r);
  CHECK(o["columns"].size() == 2);  // 270 deg is 90 deg mirrored
  for (const json& column : o["columns"]) {
    CHECK(column["by_phase"].size() == 1);
    CHECK(column["by_phase"]["hoist_up"]["at_least"] == false);
    CHECK(column["by_phase"]["hoist_up"]["hs_limit_m"] == column["hs_limit_m"]);
  }
  const std::string csv = content(study.folder / "out/operability.csv");
  for (const char* row : {"\n8,90,all,", "\n8,180,all,", "\n8,270,all,"}) CHECK_THAT(csv, Contains(row));
  const auto limit_at = [&](const std::string& row) {
    const std::size_t at = csv.find(row) + row.size();
    return csv.substr(at, csv.find(',', at) - at);
  };
  CHECK(limit_at("\n8,90,all,") == limit_at("\n8,270,all,"));
}

}  // namespace
}  // namespace stillhook
