#include "sim/samples.h"

#include <limits>

namespace stillhook {

std::vector<double> samples_of(const Trajectory& run, std::size_t channel) {
  if (channel < run.values.size() && run.values[channel].size() == run.time.size()) return run.values[channel];
  if (run.source) return run.source->series(channel);
  return std::vector<double>(run.time.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace stillhook
