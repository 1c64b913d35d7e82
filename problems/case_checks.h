// Rules of a case that go beyond one key: names and what refers to them, and sense.
#pragma once

#include <vector>

#include "problems/case.h"
#include "problems/case_reader.h"

namespace stillhook {

/// Duplicate names across kinds, unknown names.
void check_names(const Case& c, const Node& root, const std::vector<NamedThing>& references, Findings& findings);

/// Mass and inertia, self references, drives of the wrong kind or without anything to move, gear, phases, goals.
void check_lift(const Case& c, const Node& root, Findings& findings);

/// Metrics that exist, variables that lead to a number between their bounds, scenarios.
void check_plan(const Case& c, const Node& root, Findings& findings);

}  // namespace stillhook
