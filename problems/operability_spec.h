// What `stillhook operability` is asked: for which seas limiting heights are wanted, and how surely.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stillhook {

/// A phase that is simulated alone, begun at rest.
struct OperabilityPhaseSpec {
  std::string name;
};

struct OperabilitySpec {
  enum class Criteria { governing, all };

  std::string sea;                   // irregular state that gives the spectrum's shape; empty = the active one
  std::vector<double> peak_periods;  // s, ascending; empty = the case has no such section
  std::vector<double> headings;      // rad; empty = by the step
  double heading_step = 0.0;         // rad, around the circle from 0 on; 0 = by the list
  bool mirror = false;               // port and starboard are alike: half the headings are simulated
  double level = 0.90;               // share of the seeds that shall keep the limits
  std::vector<double> seeds = {30.0, 60.0, 90.0};  // looks, whole numbers
  double tolerance = 0.08;                         // of the limit: half-width of its interval at which the search ends
  double resolution = 0.02;                        // of a seed's height
  double guess = 1.0;                              // m, where the search begins
  std::optional<double> height_max;                // m; absent: by the steepness of the sea alone
  std::vector<OperabilityPhaseSpec> phases;        // empty = the whole operation
  Criteria criteria = Criteria::governing;
};

}  // namespace stillhook
