#include "tests/planner/documented_keys.h"

#include <catch2/catch.hpp>

#include "planner/verbs/fit/fit_report.h"
#include "tests/planner/program.h"

using namespace stillhook;
using nlohmann::json;

namespace {

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";
const std::set<std::string> kNone;

/// One of everything that a fit can tell.
Identification full_identification() {
  Identification result;
  result.estimates.emplace_back();
  result.correlation = MatrixX::Identity(1, 1);
  result.inseparable.emplace_back();
  RecordFit& record = result.records.emplace_back();
  record.channels.emplace_back();
  record.own.emplace_back();
  record.decays.emplace_back();
  result.cross.emplace_back();
  return result;
}

}  // namespace

TEST_CASE("every key of a summary is in docs/summary.md", "[docs]") {
  const Folder folder;
  const json simulated = json::parse(run(folder, {"simulate", kCase, "--json", "--out", "s"}).out);
  CHECK(undocumented_keys(simulated) == kNone);
  const json planned = json::parse(run(folder, {"plan", kCase, "--json", "--out", "p", "--evaluations", "4"}).out);
  CHECK(planned.contains("objective"));
  CHECK(undocumented_keys(planned) == kNone);
  // hydro: in its own test, which has its summary at hand.
  CHECK(undocumented_keys(json::parse(fit_summary(Case{}, full_identification(), {"case.toml"}))) == kNone);
  // The check itself finds what is missing, however deep.
  CHECK(undocumented_keys({{"status", {{{"no_such_key", 1}}}}}) == std::set<std::string>{"no_such_key"});
}
