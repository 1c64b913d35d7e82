#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {

void check_weather(const WeatherSpec& weather, const Node& root, Findings& findings) {
  const auto report = [&](const std::string& key, const std::string& sentence) {
    findings.add(position_of_key(root, "weather", key), "weather", key, sentence);
  };
  if (weather.daylight.size() == 2 && !(weather.daylight[0] < weather.daylight[1]))
    report("daylight_h",
           fmt::format("must go from an earlier to a later hour, got {:g} to {:g}; across midnight UTC there "
                       "is none",
                       weather.daylight[0] / 3600.0, weather.daylight[1] / 3600.0));
  if (weather.operation && !weather.phases.empty()) {
    double sum = 0.0;
    for (const WeatherPhaseSpec& phase : weather.phases) sum += phase.duration;
    if (*weather.operation < sum * (1.0 - 1e-9))
      report("operation_h", fmt::format("must be at least the sum of the phases, {:g} h, got {:g}", sum / 3600.0,
                                        *weather.operation / 3600.0));
  }
}

}  // namespace stillhook
