#include "planner/verbs/weather/study.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/run_folder.h"
#include "planner/weather/record_file.h"
#include "planner/weather/scatter_file.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// A record that lacks what the limits or the rules ask for would be judged without it.
void check_record(const WeatherRecord& record, const std::string& file, const WeatherTask& task) {
  const auto refuse = [&](const char* lacks, const char* why, const char* key) {
    throw UsageError(fmt::format("{}: has no column of {}, but {}; name it with weather.{}", file, lacks, why, key));
  };
  const OperationLimits& limits = task.limits.limits;
  if (record.period.empty() && limits.depends_on_period())
    refuse("wave periods", "the limits depend on the peak period", "period_column");
  if (record.from.empty() && limits.depends_on_heading() && task.spec.bow_towards)
    refuse("wave directions", "the limits depend on the heading and weather.bow_towards_deg is given",
           "direction_column");
  if (record.wind.empty() && task.spec.wind_max)
    refuse("wind speeds", "weather.wind_max_m_per_s is given", "wind_column");
}

void add_remarks(WeatherStudy& study, const std::string& file, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) study.remarks.push_back(file + ": " + remark);
}

/// What a record is too short, or too patchy, to say.
void warn_of_record(const HindcastStudy& h, const WeatherTask& task, WeatherStudy& study) {
  const auto percent = [&](SampleState state) {
    return 100.0 * static_cast<double>(h.workability.counts[static_cast<std::size_t>(state)]) /
           static_cast<double>(h.workability.size());
  };
  if (const double missing = percent(SampleState::missing); missing > 0.0)
    study.warnings.push_back(
        fmt::format("{}: {:.2f} % of the samples say nothing and count as not workable", h.file, missing));
  if (const double outside = percent(SampleState::outside); outside > 0.0)
    (outside > 1.0 ? study.warnings : study.remarks)
        .push_back(fmt::format("{}: {:.2f} % of the samples have periods that the limits do not cover and count as not "
                               "workable",
                               h.file, outside));
  std::string lacking;
  for (int month = 1; month <= 12; ++month)
    if (h.months.samples[static_cast<std::size_t>(month - 1)] == 0)
      lacking += std::string(lacking.empty() ? "" : ", ") + month_name(month);
  if (!lacking.empty())
    study.warnings.push_back(
        fmt::format("{}: has no sample in {}: the share of all samples is not that of a year", h.file, lacking));
  const double years = static_cast<double>(h.workability.size()) * h.record.step_h() / (365.25 * 24.0);
  if (lacking.empty() && h.months.whole_years.years.size() < 10)
    study.remarks.push_back(
        fmt::format("{}: {:.1f} years are few: shares of single months differ between years by more than "
                    "such a record shows",
                    h.file, years));
  if (task.spec.record_end == WeatherSpec::End::wrap && std::abs(years - std::round(years)) > 2.0 / 365.25)
    study.warnings.push_back(
        fmt::format("{}: {:.2f} years are no whole number, but the record is closed to a ring: its end "
                    "and its beginning are of different seasons",
                    h.file, years));
}

HindcastStudy study_hindcast(const WeatherTask& task, WeatherStudy& study) {
  HindcastStudy h;
  h.file = task.spec.hindcast;
  h.record = read_record_file(h.file, task.spec);
  check_record(h.record, h.file, task);
  add_remarks(study, h.file, h.record.remarks);
  const WeatherRules rules = rules_of(task.spec);
  h.workability = judge_weather(h.record, task.limits.limits, rules);
  h.months = monthly(h.workability);
  if (task.limits.low) h.share_low = judge_weather(h.record, *task.limits.low, rules).share();
  if (task.limits.high) h.share_high = judge_weather(h.record, *task.limits.high, rules).share();
  std::vector<double> days;
  for (const double s : task.spec.horizons) days.push_back(s / kDay);
  const RecordEnd end = task.spec.record_end == WeatherSpec::End::wrap ? RecordEnd::wrap : RecordEnd::censor;
  for (const double hours : windows_of(task)) h.windows.push_back(find_windows(h.workability, hours, end, days));
  warn_of_record(h, task, study);
  return h;
}

ScatterStudy study_scatter(const WeatherTask& task, WeatherStudy& study) {
  ScatterStudy s;
  s.file = task.spec.scatter;
  s.table = read_scatter_file(s.file);
  add_remarks(study, s.file, s.table.remarks);
  WeatherRules rules = rules_of(task.spec);
  if (rules.bow_towards && !s.table.has_directions() && task.limits.limits.depends_on_heading()) {
    rules.bow_towards.reset();
    study.warnings.push_back(s.file +
                             ": has no directions, so weather.bow_towards_deg cannot be used: the lowest limit over "
                             "all headings counts");
  }
  if (rules.wind_max || rules.daylight)
    study.warnings.push_back(s.file + ": a scatter table says nothing of wind and daylight: they are left out there");
  s.workability = judge_scatter(s.table, task.limits.limits, rules);
  s.heights = fit_heights(s.table);
  s.equivalent_height = s.mean_calm_h = kNaN;
  const double share = s.workability.share;
  if (!s.heights || !(share > 0.0 && share < 1.0)) return s;
  s.equivalent_height = s.heights->height_exceeded(1.0 - share);
  const CalmLaw law(*s.heights, s.equivalent_height);
  s.mean_calm_h = law.mean_h();
  for (const double hours : windows_of(task)) s.calms.push_back({hours, law.longer_than(hours)});
  study.remarks.push_back(s.file +
                          ": how long calms last is an estimate by an empirical law (Kuwashima & Hogben 1986) from "
                          "the distribution of heights; a record over time says it better");
  return s;
}

ForecastStudy study_forecast(const WeatherTask& task, WeatherStudy& study) {
  if (!(task.planned_h > 0.0))
    throw UsageError(
        "--forecast: a decision needs the planned duration of the operation: --set weather.operation_h=10, durations "
        "of the "
        "phases in [[weather.phases]], or --case CASE with the operation");
  ForecastStudy f;
  f.file = task.spec.forecast;
  f.record = read_record_file(f.file, task.spec);
  check_record(f.record, f.file, task);
  add_remarks(study, f.file, f.record.remarks);
  f.period = reference_period(task.planned_h, task.spec.contingency);
  f.built_in_alpha = task.spec.alpha.empty();
  GoNoGoRules rules;
  rules.weather = rules_of(task.spec);
  rules.period = f.period;
  rules.by_lead_time = task.spec.alpha_by == WeatherSpec::AlphaBy::lead_time;
  if (!f.built_in_alpha) rules.alpha = read_alpha_file(task.spec.alpha);
  if (f.built_in_alpha)
    study.warnings.push_back(
        "the alpha factors are a built-in table from general knowledge of DNV-OS-H101: replace it by that "
        "of your licensed copy, weather.alpha");
  const std::vector<PlannedPhase> whole = {{"", 0.0, task.planned_h}};
  try {
    f.decision = decide(f.record, task.limits.limits, task.phases.empty() ? whole : task.phases, rules);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--forecast: ") + error.what());
  }
  if (f.decision.starts_told == 0)
    study.warnings.push_back(
        fmt::format("{}: {:g} h of forecast are shorter than the {:g} h that the operation needs with its "
                    "contingency: no start can be allowed",
                    f.file, static_cast<double>(f.record.size()) * f.record.step_h(), f.period.total_h()));
  return f;
}

}  // namespace

std::vector<double> windows_of(const WeatherTask& task) {
  if (!task.spec.windows.empty()) {
    std::vector<double> hours;
    for (const double s : task.spec.windows) hours.push_back(s / kHour);
    return hours;
  }
  if (task.planned_h > 0.0) return {reference_period(task.planned_h, task.spec.contingency).total_h()};
  return {6.0, 12.0, 24.0, 48.0};
}

WeatherRules rules_of(const WeatherSpec& spec) {
  WeatherRules rules;
  rules.bow_towards = spec.bow_towards;
  rules.free_heading = spec.free_heading;
  rules.wind_max = spec.wind_max;
  if (spec.daylight.size() == 2) rules.daylight = {{spec.daylight[0] / kHour, spec.daylight[1] / kHour}};
  return rules;
}

WeatherStudy study_weather(const WeatherTask& task) {
  WeatherStudy study;
  study.task = task;
  study.warnings = task.warnings;
  study.remarks = task.remarks;
  add_remarks(study, task.limits_source, task.limits.remarks);
  const bool by_heading = task.limits.limits.depends_on_heading();
  if (by_heading && !task.spec.bow_towards && !task.spec.free_heading)
    study.warnings.push_back(
        "how the vessel lies is not said: the lowest limit over all headings counts; give "
        "weather.bow_towards_deg, or weather.free_heading if it can turn");
  if (!task.spec.hindcast.empty()) study.hindcast = study_hindcast(task, study);
  if (!task.spec.scatter.empty()) study.scatter = study_scatter(task, study);
  if (!task.spec.forecast.empty()) study.forecast = study_forecast(task, study);
  return study;
}

}  // namespace stillhook
