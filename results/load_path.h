// Where the load is on its way from support to target, and what its wires hold against what they would hold at rest
// (definitions in metrics.h).
#pragma once

#include <string>
#include <vector>

#include "results/run_view.h"

namespace stillhook {

/// When the load first left its support, s; NaN if it never did or has none.
double lift_off_time(const RunView& view);

/// When the load first touched a target, s; infinity if it never did.
double landing_time(const RunView& view);

/// The static load of a phase for the sum of some tension channels.
class StaticLoad {
 public:
  StaticLoad(const RunView& view, std::size_t phase, const std::vector<std::string>& channels);
  /// At time t (s), N; NaN if there is none.
  double at(double t) const;

 private:
  const RunView& view_;
  std::size_t phase_;
  std::vector<StaticPath> paths_;  // by channel, while the load hangs at both ends of the phase
  double constant_ = 0.0;          // N, otherwise
};

/// Largest (sum of tensions) / (static load) over phases. For one wire the extremes of every step enter too; of a sum
/// only the samples are known.
Peak largest_amplification(const RunView& view, const std::vector<std::string>& channels,
                           const std::vector<std::size_t>& phases);

/// Smallest tension / static load of a wire in a phase, while the load hangs free. A wire that is to hold the load in part after
/// it has landed counts against the smaller of its static tensions at the ends of the phase.
Peak smallest_share(const RunView& view, const std::string& channel, std::size_t phase);

}  // namespace stillhook
