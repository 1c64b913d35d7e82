#include "problems/case_sources.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "problems/case.h"

using namespace stillhook;

namespace {

std::string remark_of(const std::vector<CaseSource>& sources, const std::string& key) {
  for (const CaseSource& s : sources)
    if (s.key == key) return s.remark;
  FAIL("no " << key);
  return {};
}

}  // namespace

TEST_CASE("remarks behind the values of a case are kept with them, also through the resolved file") {
  const std::string file = std::string(STILLHOOK_SOURCE_DIR) + "/problems/box_installation.toml";
  const Case c = read_case(file, {{"bodies.load.mass_t", "990.0"}, {"taglines.*.kp_kN_per_deg", "30.0"}});
  const std::vector<CaseSource> sources = case_sources(c);
  // As the file has them today.
  CHECK(remark_of(sources, "bodies.crane.hull.centre_m") == "P: draft 4.0 m of a depth of 7.5 m");
  CHECK(remark_of(sources, "operation.phases.hoist_up.moves.hoist.speed_m_per_min") == "V");
  CHECK(remark_of(sources, "bodies.load.mass_t") == "set on top of the case file");
  CHECK(remark_of(sources, "taglines.tagline_starboard.kp_kN_per_deg") == "set on top of the case file");
  CHECK(remark_of(sources, "sea.active").find("set on top") == std::string::npos);

  const Case again = read_case_text(text_with_remarks(c), "case.toml", c.directory);
  CHECK(resolved_text(again) == resolved_text(c));
  const std::vector<CaseSource> kept = case_sources(again);
  REQUIRE(kept.size() == sources.size());
  for (const char* key : {"bodies.crane.hull.centre_m", "operation.phases.hoist_up.moves.hoist.speed_m_per_min",
                          "bodies.load.mass_t", "taglines.tagline_starboard.kp_kN_per_deg"})
    CHECK(remark_of(kept, key) == remark_of(sources, key));
}

TEST_CASE("a # inside a string is no remark") {
  const Case c =
      read_case(std::string(STILLHOOK_SOURCE_DIR) + "/problems/manifold_installation.toml", {{"title", "\"Lift #3\""}});
  const Case again = read_case_text(text_with_remarks(c), "case.toml", c.directory);
  CHECK(again.title == "Lift #3");
  CHECK(remark_of(case_sources(again), "title") == "set on top of the case file");
}
