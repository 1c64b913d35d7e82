// The natural periods of a lift in its static poses.
#pragma once

#include <string>
#include <vector>

#include "results/report.h"
#include "sim/operation.h"

namespace stillhook {

/// A static equilibrium and what it is called.
struct NamedEquilibrium {
  std::string name;
  SystemState state;
};

/// The start, the end of each phase, and the poses that the case asks to report.
std::vector<NamedEquilibrium> all_equilibria(const Model& model, const Operation& operation);

/// One table for every body with a hull and one for the load, one row an equilibrium: the period of the mode in which
/// the coordinate takes the largest share. Contacts act as they do in the state's phase, with friction that holds where
/// the body stands; taglines are left out; added mass at each mode's own frequency, no damping.
std::vector<ReportTable> period_tables(const Model& model, const std::vector<NamedEquilibrium>& equilibria);

}  // namespace stillhook
