#include "planner/cli/colour.h"

#include <catch2/catch.hpp>

#include "planner/cli/tables.h"
#include "planner/cli/text_table.h"
#include "tests/planner/program.h"

using namespace stillhook;

namespace {

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

std::string without_colours(std::string text) {
  for (std::size_t at; (at = text.find('\x1b')) != std::string::npos;) text.erase(at, text.find('m', at) - at + 1);
  return text;
}

}  // namespace

TEST_CASE("colours do not move columns", "[colour]") {
  set_stdout_colour(true);
  TextTable table({"limit", "verdict"});
  table.add({"heel", coloured(Colour::good, "ok")});
  table.add({"trim", coloured(Colour::caution, "warning")});
  const std::string text = table.text();
  set_stdout_colour(false);
  CHECK(text.find('\x1b') != std::string::npos);
  CHECK(without_colours(text) == std::string("  limit  verdict\n  --------------\n  heel        ok\n  trim   warning\n"));
  CHECK(coloured(Colour::bad, "FAIL") == "FAIL");
}

TEST_CASE("the verdict names the criterion that governs", "[colour]") {
  Metrics metrics;
  metrics.status = RunStatus::completed;
  LimitCheck heel;
  heel.metric = "heel_max";
  heel.unit = "deg";
  heel.value = 4.5;
  heel.limit = 5.0;
  heel.margin = 0.5;
  heel.pass = true;
  const std::string governed = ", governed by heel_max (largest heel of any crane vessel, waves included): ";
  CHECK(verdict_text(metrics, {heel}) == "WITHIN LIMITS" + governed + "4.5 deg, limit 5 deg (90 % of what it allows)");
  heel.value = 6.0;
  heel.margin = -1.0;
  heel.pass = false;
  CHECK(verdict_text(metrics, {heel}) == "NOT WITHIN LIMITS" + governed + "6 deg, limit 5 deg (120 % of what it allows)");
  metrics.status = RunStatus::interrupted;
  CHECK_THAT(verdict_text(metrics, {heel}), Catch::StartsWith("NOT COMPLETED"));
  CHECK(verdict_text(metrics, {}) == "No limits to keep.");
}

TEST_CASE("colours as asked for: never into files, always when told, NO_COLOR heard", "[colour]") {
  const Folder folder;
  const auto simulate = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"simulate", kCase, "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder, arguments).out;
  };
  const std::string plain = simulate({});
  CHECK(plain.find('\x1b') == std::string::npos);
  CHECK_THAT(plain, Catch::Contains("WITHIN LIMITS") && Catch::Contains("Report: "));
  CHECK_THAT(simulate({"--color", "always"}), Catch::Contains("\x1b[32mok\x1b[0m"));
  CHECK_THAT(simulate({"--color", "always", "--set", "limits.offlead_max.max=0.5"}),
             Catch::Contains("\x1b[1;31mFAIL\x1b[0m"));
  CHECK(simulate({"--color", "always", "--json"}).find('\x1b') == std::string::npos);
  CHECK(run(folder, {"simulate", kCase, "--color", "sometimes"}).code == 2);
  setenv("NO_COLOR", "1", 1);
  CHECK_FALSE(wants_colour(ColourWish::automatic, STDOUT_FILENO));
  CHECK(wants_colour(ColourWish::always, STDOUT_FILENO));
  unsetenv("NO_COLOR");
  CHECK_FALSE(wants_colour(ColourWish::never, STDOUT_FILENO));
}
