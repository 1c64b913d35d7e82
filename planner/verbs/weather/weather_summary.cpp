#include <algorithm>

#include "planner/verbs/weather/weather_files.h"
#include "planner/verbs/weather/weather_tables.h"
#include "planner/version.h"
#include "results/json_number.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

/// "waves_too_high"
std::string state_key(SampleState state) {
  std::string key = state_text(state);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

Json spread_json(const YearSpread& spread) {
  return {{"years", spread.years},
          {"p10", json_number(spread.p10())},
          {"p50", json_number(spread.p50())},
          {"p80", json_number(spread.p80())},
          {"p90", json_number(spread.p90())}};
}

Json wait_json(const WaitSummary& s) {
  Json within = Json::array();
  for (const ChanceWithin& chance : s.within)
    within.push_back({{"days", chance.days}, {"share", json_number(chance.share)}});
  return {{"start_share", json_number(s.start_share)}, {"mean_wait_h", json_number(s.mean_h)},
          {"p50_wait_h", json_number(s.p50_h)},        {"p80_wait_h", json_number(s.p80_h)},
          {"p90_wait_h", json_number(s.p90_h)},        {"within", within}};
}

void add_hindcast(Json& weather, const HindcastStudy& h) {
  weather["hindcast"] = h.file;
  weather["samples"] = h.record.size();
  weather["step_h"] = h.record.step_h();
  weather["gaps"] = h.record.gaps;
  weather["workability"] = json_number(h.workability.share());
  if (h.share_low) weather["workability_low"] = json_number(*h.share_low);
  if (h.share_high) weather["workability_high"] = json_number(*h.share_high);
  for (std::size_t s = 0; s < kSampleStates; ++s)
    weather["states"][state_key(static_cast<SampleState>(s))] = h.workability.counts[s];
  Json& months = weather["by_month"] = Json::array();
  for (std::size_t m = 0; m < 12; ++m)
    months.push_back({{"month", m + 1},
                      {"samples", h.months.samples[m]},
                      {"workable", json_number(h.months.share[m])},
                      {"by_year", spread_json(h.months.by_year[m])}});
  weather["whole_years"] = spread_json(h.months.whole_years);
  Json& windows = weather["windows"] = Json::array();
  for (const WindowStatistics& w : h.windows) {
    Json by_month = Json::array();
    for (std::size_t m = 0; m < 12; ++m) {
      by_month.push_back(wait_json(w.by_month[m]));
      by_month.back()["month"] = m + 1;
      by_month.back()["mean_by_year"] = spread_json(w.mean_by_year[m]);
    }
    windows.push_back(
        {{"duration_h", w.duration_h}, {"samples", w.samples}, {"starts", w.starts}, {"cut_off", w.censored}});
    windows.back().update(wait_json(w.all));
    windows.back()["by_month"] = by_month;
  }
}

Json scatter_json(const ScatterStudy& s) {
  Json calms = Json::array(), months = Json::array();
  for (const ScatterStudy::Calm& calm : s.calms)
    calms.push_back({{"hours", calm.hours}, {"longer", json_number(calm.longer)}});
  for (const double share : s.workability.by_month) months.push_back(json_number(share));
  return {{"file", s.file},
          {"total", s.workability.total},
          {"outside", s.workability.outside},
          {"workable", json_number(s.workability.share)},
          {"workable_bin_middle", json_number(s.workability.share_centre)},
          {"workable_by_month", months},
          {"equivalent_height_m", json_number(s.equivalent_height)},
          {"mean_calm_h", json_number(s.mean_calm_h)},
          {"calms_longer", calms}};
}

Json decisions_json(const ForecastStudy& f, const std::vector<PhaseDecision>& decisions) {
  Json list = Json::array();
  for (std::size_t p = 0; p < decisions.size(); ++p) {
    const PhaseDecision& d = decisions[p];
    const std::size_t at = d.first_broken.value_or(d.tightest);
    const ForecastSample& s = f.decision.samples[p][at];
    list.push_back({{"phase", phase_title(d.phase)},
                    {"go", d.go()},
                    {"within_forecast", d.within_forecast},
                    {"time", instant_text(f.record.time(at))},
                    {"hs_m", json_number(f.record.height[at])},
                    {"op_lim_m", json_number(s.limit)},
                    {"alpha", json_number(s.alpha)},
                    {"op_wf_m", json_number(s.allowed)},
                    {"state", state_text(s.state)}});
  }
  return list;
}

Json forecast_json(const ForecastStudy& f) {
  const GoNoGo& d = f.decision;
  Json first = nullptr;
  if (d.first_start) first = instant_text(f.record.time(*d.first_start));
  return {{"file", f.file},
          {"t_pop_h", f.period.planned_h},
          {"t_c_h", f.period.contingency_h},
          {"t_r_h", f.period.total_h()},
          {"decision", d.go_now()      ? "go"
                       : d.first_start ? "wait"
                                       : "no-go"},
          {"first_start", first},
          {"starts_told", d.starts_told},
          {"now", decisions_json(f, d.now)},
          {"then", decisions_json(f, d.then)}};
}

}  // namespace

std::string weather_summary(const WeatherStudy& study, const std::vector<std::string>& files, const std::string& date) {
  Json document = summary_envelope(kVersion, date, study.task.name, "weather");
  document["status"] = "completed";
  document["message"] = verdict_of(study);
  document["warnings"] = study.warnings;
  document["notes"] = study.remarks;
  document["files"] = files;
  Json& weather = document["weather"] = Json::object();
  weather["limits"] = study.task.limits_source;
  if (study.hindcast) add_hindcast(weather, *study.hindcast);
  if (study.scatter) weather["scatter"] = scatter_json(*study.scatter);
  if (study.forecast) weather["forecast"] = forecast_json(*study.forecast);
  return summary_text(document);
}

}  // namespace stillhook
