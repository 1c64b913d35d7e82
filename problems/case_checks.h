// Rules of a case that go beyond one key: names and what refers to them, and sense.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problems/case.h"
#include "problems/case_reader.h"

namespace stillhook {

/// Adds the bodies and wires of the rigging to the specification, and refuses slings that do not reach, hang slack or lie
/// too flat. The document keeps its entries.
void expand_rigging(Case& c, const Node& root, Findings& findings);

/// The entry of the document that an entry of the specification stands in: "rigging.hook.slings.port" for the wire that it
/// became, else the same.
std::string written_entry(const Case& c, const std::string& entry);

/// Duplicate names across kinds, unknown names.
void check_names(const Case& c, const Node& root, const std::vector<NamedThing>& references, Findings& findings);

/// Mass and inertia, self references, drives without anything to move, every entry of every kind of force element
/// (problems/format), phases, goals.
void check_lift(const Case& c, const Node& root, Findings& findings);

/// Vessels that move by displacement RAOs, and what cannot be with them.
void check_stations(const Case& c, const Node& root, Findings& findings);

/// Metrics that exist, variables that lead to a number between their bounds, scenarios.
void check_plan(const Case& c, const Node& root, Findings& findings);

/// Moves whose speed or ramp a search changes stay within the limits of their drives anywhere between its bounds.
void check_varied_moves(const Case& c, const Node& root, Findings& findings);

/// Parameters and records of the fit.
void check_fit(const Case& c, const Node& root, Findings& findings);

/// The sea state whose height and period are set, lists that ascend, a limit to be reached.
void check_operability(const Case& c, const Node& root, Findings& findings);

/// Hours of daylight, phases and what stands beside them.
void check_weather(const WeatherSpec& weather, const Node& root, Findings& findings);

/// Each crane with capacity curves has one for the active sea. The files of the seas must have been read.
void check_crane_seas(const Case& c, const Node& root, Findings& findings);

/// A key that a search or a fit changes, and the entry that asks for it.
struct VariedKey {
  std::string entry, key;
  double lower = 0.0, upper = 0.0;   // in the key's unit
  std::optional<double> start;       // absent: the case's own value
};

/// Bounds in order and allowed, a key that leads to numbers of the lift, one start value within the bounds.
void check_varied_key(const VariedKey& varied, const Node& root, Findings& findings);

}  // namespace stillhook
