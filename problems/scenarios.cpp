#include "problems/scenarios.h"

#include <algorithm>

namespace stillhook {

std::vector<ScenarioSpec> scenarios_of(const Case& c) {
  if (!c.plan.scenarios.empty()) return c.plan.scenarios;
  ScenarioSpec only;
  only.name = only.sea = c.specification.sea.active;
  return {only};
}

Specification in_scenario(Specification specification, const ScenarioSpec& scenario) {
  using Type = SeaStateSpec::Type;
  std::vector<SeaStateSpec>& states = specification.sea.states;
  const auto state =
      std::find_if(states.begin(), states.end(), [&](const SeaStateSpec& s) { return s.name == scenario.sea; });
  const std::string where = "plan.scenarios." + scenario.name;
  if (state == states.end() && scenario.sea == "calm") {
    specification.sea.active = scenario.sea;
    return specification;
  }
  if (state == states.end()) throw CaseError(where + ".sea: there is no sea state \"" + scenario.sea + "\"");
  const bool irregular = state->type == Type::jonswap || state->type == Type::pierson_moskowitz;
  if (scenario.phase && state->type != Type::regular)
    throw CaseError(where + ".phase_deg: only a regular wave has a phase, " + scenario.sea + " is not one");
  if (scenario.seed && !irregular)
    throw CaseError(where + ".seed: only an irregular sea has a seed, " + scenario.sea + " is not one");
  if (scenario.heading) state->heading = *scenario.heading;
  if (scenario.phase) state->phase = *scenario.phase;
  if (scenario.seed) state->seed = *scenario.seed;
  specification.sea.active = scenario.sea;
  return specification;
}

}  // namespace stillhook
