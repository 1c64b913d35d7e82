// The conditions that a plan is evaluated in.
#pragma once

#include <vector>

#include "problems/case.h"

namespace stillhook {

/// The scenarios of the case's plan; without any, the active sea alone, under its own name.
std::vector<ScenarioSpec> scenarios_of(const Case& c);

/// The specification with the scenario's sea active, and its heading, phase or seed where the scenario changes them.
/// Throws CaseError when there is no such sea state, or a change does not apply to its type.
Specification in_scenario(Specification specification, const ScenarioSpec& scenario);

}  // namespace stillhook
