// `stillhook fit` as a user runs it.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/planner/program.h"
#include "tests/tuning/buoy.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

const std::string kDamping = "bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.2";

/// A folder with a case that has one record without a file, and a run for it.
struct FitFolder : Folder {
  FitFolder() {
    const std::string fit =
        "[fit]\n" + parameter(kDamping, 0.0, 500.0) +
        "[[fit.records]]\nname = \"still\"\nkind = \"decay\"\nfree_body = \"buoy\"\n" + column("buoy.z", "m");
    std::ofstream(*this / "buoy.toml") << "# What the damping is.\n" + buoy_text() + fit;
    std::ofstream(*this / "run.csv") << measured(case_of(buoy_text()), {{"buoy.z", 0.01}},
                                                 (Vector6() << 0, 0, 1.0, 0, 0, 0).finished(), 40.0, 4);
  }
};

TEST_CASE("fit leaves a case that other verbs take, a summary and a report", "[cli][fit]") {
  const FitFolder folder;
  const Result r = run(folder, {"fit", "buoy.toml", "--measured", "run.csv", "--json", "--quiet"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  const auto summary = nlohmann::json::parse(r.out);
  CHECK(summary["verb"] == "fit");
  CHECK(summary["trusted"] == true);
  REQUIRE(summary["estimates"].size() == 1);
  const auto& e = summary["estimates"][0];
  CHECK(e["name"] == kDamping);
  CHECK(e["unit"] == "kN s/m");
  CHECK(e["low"].get<double>() < e["value"].get<double>());
  CHECK(content(folder / "runs/buoy-fit/summary.json") == r.out);
  const std::string report = content(folder / "runs/buoy-fit/report.html");
  CHECK_THAT(report, Contains("95 % interval") && Contains("p-q plot") && Contains("spectrum of the residuals"));
  const std::string fitted = folder / "runs/buoy-fit/fitted.toml";
  CHECK_THAT(content(fitted), Contains("# What the damping is."));
  CHECK(key_value(read_case(fitted), kDamping) == e["value"].get<double>());
  CHECK(run(folder, {"simulate", fitted, "--quiet"}).code == 0);
  // Not over a run that is there.
  CHECK(run(folder, {"fit", "buoy.toml", "--measured", "run.csv"}).code == 2);
}

TEST_CASE("fit refuses to go where the plan of the same case may not", "[cli][fit]") {
  const FitFolder folder;
  const auto fit = [&](const std::string& lower, const std::string& upper) {
    std::ofstream(folder / "planned.toml") << content(folder / "buoy.toml")
                                           << "[plan.objective]\nduration = { weight = 1.0, scale = 100.0 }\n[plan.variables]\n\""
                                           << kDamping << "\" = { min = " << lower << ", max = " << upper << " }\n";
    return run(folder, {"fit", "planned.toml", "--measured", "run.csv", "--out", "planned", "--force", "--quiet"});
  };
  const Result narrow = fit("50.0", "70.0");
  CHECK(narrow.code == 2);
  CHECK_THAT(narrow.err, Contains("goes from 0 to 500") && Contains("from 50 to 70 only") && Contains("Widen"));
  const Result wide = fit("0.0", "500.0");
  INFO(wide.err);
  CHECK(wide.code == 0);
  CHECK_NOTHROW(read_case(folder / "planned/fitted.toml"));
}

TEST_CASE("fit says what it cannot do with exit code 2", "[cli][fit][bad_input]") {
  const FitFolder folder;
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"fit", "buoy.toml", "--out", "x", "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result r = run(folder, arguments);
    CHECK(r.code == 2);
    return r.err;
  };
  CHECK_THAT(told({}), Contains("[fit.records.still]: has no file; give one in the case or with --measured"));
  CHECK_THAT(told({"--measured", "nothing.csv"}), Contains("--measured nothing.csv: there is no such file"));
  std::ofstream(folder / "short.csv") << "t_s,buoy.z\n0,1\n1,2\n2,1\n";
  CHECK_THAT(told({"--measured", "still=short.csv"}), Contains("has 3 rows, a fit needs at least 20"));
  CHECK_THAT(told({"--measured", "run.csv", "--set", "fit.records.still.free_body=box"}), Contains("no body \"box\""));
}

TEST_CASE("a record is one file, and a file is no pipe", "[cli][fit][bad_input]") {
  const FitFolder folder;
  std::filesystem::copy_file(folder / "run.csv", folder / "other.csv");
  const auto told = [&](const std::vector<std::string>& files) {
    std::vector<std::string> arguments = {"fit", "buoy.toml", "--out", "x", "--force"};
    for (const std::string& file : files) arguments.insert(arguments.end(), {"--measured", file});
    const Result r = run(folder, arguments);
    CHECK(r.code == 2);
    return r.err;
  };
  for (const std::vector<std::string>& two : std::vector<std::vector<std::string>>{
           {"still=run.csv", "still=other.csv"}, {"still=run.csv", "other.csv"}, {"run.csv", "other.csv"}, {"run.csv", "still=other.csv"}})
    CHECK_THAT(told(two), Contains("record \"still\" has a file already") && Contains("run.csv"));
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THAT(told({"still=pipe"}), Contains("--measured pipe: is a pipe or a device") && Contains("write the run to a file"));
  CHECK_THAT(told({"still=/dev/null"}), Contains("is a pipe or a device"));
  CHECK_THAT(told({"."}), Contains("is a folder"));
}

TEST_CASE("the same decay in the dialects of several programs gives the same fit", "[cli][fit]") {
  const FitFolder folder;
  const std::string plain = content(folder / "run.csv");
  const auto estimate = [&](const std::string& text) {
    std::ofstream(folder / "dialect.csv", std::ios::binary) << text;
    const Result r = run(folder, {"fit", "buoy.toml", "--measured", "dialect.csv", "--out", "x", "--force", "--json", "--quiet"});
    INFO(r.err);
    REQUIRE(r.code == 0);
    return nlohmann::json::parse(r.out)["estimates"][0]["value"].get<double>();
  };
  const double right = estimate(plain);
  std::string german, quoted;
  for (const char c : plain) {
    german += c == ',' ? std::string(";") : c == '.' ? std::string(",") : c == '\n' ? "\r\n" : std::string(1, c);
    quoted += c == ',' ? std::string("\",\"") : c == '\n' ? std::string("\"\n\"") : std::string(1, c);
  }
  german.replace(german.find("buoy,z"), 6, "buoy.z");
  quoted = "\"" + quoted;
  quoted.pop_back();  // the quote after the last line
  CHECK(estimate("\xEF\xBB\xBF" + german) == right);
  CHECK(estimate(quoted) == right);
}

}  // namespace
}  // namespace stillhook
