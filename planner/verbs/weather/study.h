// What `stillhook weather` works out: in which weather an operation may be done, how often that comes, and whether it
// may start now.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/weather/limit_file.h"
#include "problems/weather_spec.h"
#include "results/weather/go_no_go.h"
#include "results/weather/scatter.h"
#include "results/weather/windows.h"

namespace stillhook {

/// What is known before any weather is read.
struct WeatherTask {
  std::string name, title;
  std::string limits_source;  // file, or the height that was given
  LimitFile limits;
  WeatherSpec spec;
  std::vector<PlannedPhase> phases;  // empty: not known
  double planned_h = 0.0;            // T_POP; 0: not known
  std::vector<std::string> warnings, remarks;
};

struct HindcastStudy {
  std::string file;
  WeatherRecord record;
  Workability workability;
  MonthlyWorkability months;
  std::vector<WindowStatistics> windows;
  std::optional<double> share_low, share_high;  // with every limit at its lower, its upper bound
};

struct ScatterStudy {
  std::string file;
  ScatterTable table;
  ScatterWorkability workability;
  std::optional<WeibullHeights> heights;
  double equivalent_height = 0.0;  // m; not exceeded as often as the operation is workable. NaN: unknown
  double mean_calm_h = 0.0;        // NaN: unknown
  struct Calm {
    double hours = 0.0, longer = 0.0;  // share of calms that last longer
  };
  std::vector<Calm> calms;
};

struct ForecastStudy {
  std::string file;
  WeatherRecord record;
  ReferencePeriod period;
  GoNoGo decision;
  bool built_in_alpha = true;
};

struct WeatherStudy {
  WeatherTask task;
  std::optional<HindcastStudy> hindcast;
  std::optional<ScatterStudy> scatter;
  std::optional<ForecastStudy> forecast;
  std::vector<std::string> warnings, remarks;  // those of the task included
};

/// Reads the weather that the task names and works everything out. Throws CaseError and UsageError.
WeatherStudy study_weather(const WeatherTask& task);

/// Durations of the windows that are looked for, h.
std::vector<double> windows_of(const WeatherTask& task);

WeatherRules rules_of(const WeatherSpec& spec);

}  // namespace stillhook
