// Which changes of a case make the evaluations of its search worthless, and which do not.
#include <catch2/catch.hpp>

#include "planner/verbs/plan/plan.h"

using namespace stillhook;

TEST_CASE("a search goes on after changes of what it does not depend on, and of nothing else") {
  const std::string lift = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";
  const auto problem = [&](const std::vector<Override>& overrides) {
    return store_identity(read_case(lift, overrides)).problem;
  };
  const std::string as_it_is = problem({});
  // Evaluations keep metrics by place: a program that knows others must not read them.
  CHECK(as_it_is.find(" sway_rms ") != std::string::npos);
  for (const Override& same : std::vector<Override>{{"title", "\"Another title\""},
                                                    {"fit.iterations", "7"},
                                                    {"fit.cross_validate", "false"},
                                                    {"tune.evaluations", "9"},
                                                    {"plan.evaluations", "11"},
                                                    {"plan.certify", "3"}}) {
    CAPTURE(same.key);
    CHECK(problem({same}) == as_it_is);
  }
  for (const Override& other :
       std::vector<Override>{{"sea.ramp_s", "9"}, {"limits.offlead_max.max", "4.9"}, {"solver.time_step_s", "0.011"}}) {
    CAPTURE(other.key);
    CHECK(problem({other}) != as_it_is);
  }
}
