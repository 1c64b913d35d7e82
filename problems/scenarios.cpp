#include "problems/scenarios.h"

#include <algorithm>
#include <numbers>

namespace stillhook {

namespace {

// Seeds of certification lie far from those of a search.
constexpr int kFreshSeeds = 1'000'003;

const SeaStateSpec* sea_of(const Case& c, const ScenarioSpec& scenario) {
  for (const SeaStateSpec& s : c.specification.sea.states)
    if (s.name == scenario.sea) return &s;
  return nullptr;
}

// Something in it is drawn from the seed that a scenario gives: waves, or gusts that follow them.
bool has_seed(const Case& c, const SeaStateSpec* sea) {
  return (sea && sea->seeded()) || c.specification.wind.follows_seed();
}

// `count` seeds or phases in place of one; an offset of the seed, a shift of the phases in steps between them.
void expand(const Case& c, const ScenarioSpec& scenario, int count, int seed_offset, double phase_shift,
            std::vector<ScenarioSpec>& all) {
  const SeaStateSpec* sea = sea_of(c, scenario);
  const bool regular = sea && sea->type == SeaStateSpec::Type::regular;
  for (int k = 0; k < count; ++k) {
    ScenarioSpec one = scenario;
    one.seeds = one.phases = 1;
    one.weight = scenario.weight / count;
    if (count > 1) one.name += "#" + std::to_string(k + 1);
    if (regular && (count > 1 || phase_shift != 0.0))
      one.phase = scenario.phase.value_or(sea->phase) + 2.0 * std::numbers::pi * (k + phase_shift) / count;
    if (has_seed(c, sea) && (count > 1 || seed_offset != 0))
      one.seed = scenario.seed.value_or(sea && sea->seeded() ? sea->seed : 1) + seed_offset + k;
    all.push_back(one);
  }
}

std::vector<ScenarioSpec> given(const Case& c) {
  if (!c.plan.scenarios.empty()) return c.plan.scenarios;
  ScenarioSpec only;
  const std::string& active = c.specification.sea.active;
  only.name = only.sea = active.empty() ? "calm" : active;  // a case without a sea is one in calm water
  return {only};
}

}  // namespace

std::vector<ScenarioSpec> scenarios_of(const Case& c) {
  std::vector<ScenarioSpec> all;
  for (const ScenarioSpec& s : given(c)) {
    const SeaStateSpec* sea = sea_of(c, s);
    const bool regular = sea && sea->type == SeaStateSpec::Type::regular;
    if (s.seeds > 1 && s.phases > 1)
      throw CaseError("plan.scenarios." + s.name + ": a sea has either seeds or phases, not both");
    const bool too_many_seeds = s.seeds > 1 && sea && !has_seed(c, sea);
    if (too_many_seeds || (s.phases > 1 && !regular))
      throw CaseError("plan.scenarios." + s.name +
                      (too_many_seeds ? ".seeds: only an irregular sea and gusts have seeds, "
                                      : ".phases: only a regular wave has phases, ") +
                      s.sea + " is not one");
    expand(c, s, std::max(s.seeds, s.phases), 0, 0.0, all);
  }
  return all;
}

std::vector<ScenarioSpec> fresh_scenarios(const Case& c, int count) {
  std::vector<ScenarioSpec> all;
  // A shift that no even division of the search's own phases hits.
  constexpr double kShift = 0.381966;
  for (const ScenarioSpec& s : given(c)) {
    const SeaStateSpec* sea = sea_of(c, s);
    const bool one_of_its_kind = !has_seed(c, sea) && !(sea && sea->type == SeaStateSpec::Type::regular);
    expand(c, s, one_of_its_kind ? 1 : count, kFreshSeeds, one_of_its_kind ? 0.0 : kShift, all);
  }
  return all;
}

Specification in_scenario(Specification specification, const ScenarioSpec& scenario) {
  std::vector<SeaStateSpec>& states = specification.sea.states;
  const auto state =
      std::find_if(states.begin(), states.end(), [&](const SeaStateSpec& s) { return s.name == scenario.sea; });
  const std::string where = "plan.scenarios." + scenario.name;
  const bool gusts = specification.wind.follows_seed();
  if (scenario.seed && gusts && !(state != states.end() && state->seeded())) specification.wind.seed = *scenario.seed;
  if (state == states.end() && scenario.sea == "calm") {
    specification.sea.active = scenario.sea;
    return specification;
  }
  if (state == states.end()) throw CaseError(where + ".sea: there is no sea state \"" + scenario.sea + "\"");
  if (scenario.phase && state->type != SeaStateSpec::Type::regular)
    throw CaseError(where + ".phase_deg: only a regular wave has a phase, " + scenario.sea + " is not one");
  if (scenario.seed && !state->seeded() && !gusts)
    throw CaseError(where + ".seed: only an irregular sea and gusts have a seed, " + scenario.sea + " is not one");
  if (scenario.heading && !state->has_heading() && state->type != SeaStateSpec::Type::calm)
    throw CaseError(where + ".heading_deg: only a sea of one direction has a heading, " + scenario.sea +
                    " has several");
  if (scenario.heading) state->heading = *scenario.heading;
  if (scenario.phase) state->phase = *scenario.phase;
  if (scenario.seed && state->seeded()) state->seed = *scenario.seed;
  specification.sea.active = scenario.sea;
  return specification;
}

}  // namespace stillhook
