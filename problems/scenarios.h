// The conditions that a plan is evaluated in.
#pragma once

#include <vector>

#include "problems/case.h"

namespace stillhook {

/// The scenarios of the case's plan; without any, the active sea alone, under its own name.
/// Seeds and phases asked for in number are written out. Throws CaseError where a number does not suit the sea.
std::vector<ScenarioSpec> scenarios_of(const Case& c);

/// Conditions that no search has seen: of each scenario `count` seeds far from its own, or `count` wave phases between
/// its own; calm water once.
std::vector<ScenarioSpec> fresh_scenarios(const Case& c, int count);

/// The specification with the scenario's sea active, and its heading, phase or seed where the scenario changes them.
/// Throws CaseError when there is no such sea state, or a change does not apply to its type.
Specification in_scenario(Specification specification, const ScenarioSpec& scenario);

}  // namespace stillhook
