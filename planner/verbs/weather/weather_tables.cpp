#include "planner/verbs/weather/weather_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "planner/text_number.h"

namespace stillhook {
namespace {

std::string percent(double share, int decimals = 1) { return cell(100.0 * share, decimals); }

/// "within 3 days, %"
std::string horizon_title(const ChanceWithin& chance) {
  return fmt::format("within {:g} {}, %", chance.days, chance.days == 1.0 ? "day" : "days");
}

/// Why a phase may not happen, or how near it comes to its limit.
std::string reason_of(const ForecastStudy& f, std::size_t p, const PhaseDecision& d) {
  const std::vector<ForecastSample>& samples = f.decision.samples[p];
  const auto said = [&](std::size_t i) {
    const ForecastSample& s = samples[i];
    if (s.state == SampleState::too_high || s.state == SampleState::workable)
      return fmt::format("Hs {:.2f} m against {:.2f} m at {}", f.record.height[i], s.allowed,
                         instant_text(f.record.time(i)));
    return fmt::format("{} at {}", state_text(s.state), instant_text(f.record.time(i)));
  };
  if (d.first_broken) return said(*d.first_broken);
  if (!d.within_forecast) return "the forecast ends before";
  return "tightest: " + said(d.tightest);
}

std::string forecast_verdict(const ForecastStudy& f) {
  if (f.decision.go_now()) return fmt::format("GO: a start at {} is allowed.", instant_text(f.record.time(0)));
  std::string why;
  for (std::size_t p = 0; p < f.decision.now.size() && why.empty(); ++p)
    if (!f.decision.now[p].go())
      why = fmt::format(" ({}: {})", phase_title(f.decision.now[p].phase), reason_of(f, p, f.decision.now[p]));
  if (f.decision.first_start)
    return fmt::format("WAIT: no start at {}{}; the first that is allowed is at {}.", instant_text(f.record.time(0)),
                       why, instant_text(f.record.time(*f.decision.first_start)));
  return fmt::format("NO-GO: no start is allowed within the forecast{}.", why);
}

std::string hindcast_verdict(const HindcastStudy& h) {
  std::string text = fmt::format("{} % of the time is workable", percent(h.workability.share()));
  if (h.share_low || h.share_high)
    text += fmt::format(" ({} to {} % with the limits at their bounds)", h.share_low ? percent(*h.share_low) : "?",
                        h.share_high ? percent(*h.share_high) : "?");
  int best = -1, worst = -1;
  for (int m = 0; m < 12; ++m) {
    const double share = h.months.share[static_cast<std::size_t>(m)];
    if (std::isnan(share)) continue;
    if (best < 0 || share > h.months.share[static_cast<std::size_t>(best)]) best = m;
    if (worst < 0 || share < h.months.share[static_cast<std::size_t>(worst)]) worst = m;
  }
  if (best >= 0 && best != worst)
    text += fmt::format(": {} % in {}, {} % in {}", percent(h.months.share[static_cast<std::size_t>(best)]),
                        month_name(best + 1), percent(h.months.share[static_cast<std::size_t>(worst)]),
                        month_name(worst + 1));
  const WindowStatistics& w = h.windows.front();
  return text + fmt::format(". A window of {:g} h is {} h away on average, {} h in four cases of five.", w.duration_h,
                            cell(w.all.mean_h, 1), cell(w.all.p80_h, 1));
}

}  // namespace

std::string phase_title(const std::string& phase) { return phase.empty() ? "operation" : phase; }

std::string verdict_of(const WeatherStudy& study) {
  std::string text;
  const auto add = [&](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (study.forecast) add(forecast_verdict(*study.forecast));
  if (study.hindcast) add(hindcast_verdict(*study.hindcast));
  if (study.scatter)
    add(fmt::format("By the scatter table {} % of the time is workable.", percent(study.scatter->workability.share)));
  return text;
}

ReportTable states_table(const HindcastStudy& h) {
  ReportTable table{"What the samples are", "", {"", "samples", "share, %"}, {}};
  for (std::size_t s = 0; s < kSampleStates; ++s)
    if (h.workability.counts[s] > 0)
      table.rows.push_back(
          {state_text(static_cast<SampleState>(s)), std::to_string(h.workability.counts[s]),
           percent(static_cast<double>(h.workability.counts[s]) / static_cast<double>(h.workability.size()), 2)});
  table.note = fmt::format("{} samples of {:g} h from {} on; {} of them are missing in the file.", h.record.size(),
                           h.record.step_h(), instant_text(h.record.start), h.record.gaps);
  return table;
}

ReportTable months_table(const HindcastStudy& h) {
  ReportTable table{"Workable by month", "", {"month", "workable, %", "P10", "P50", "P90", "years"}, {}};
  for (const WindowStatistics& w : h.windows) table.header.push_back(fmt::format("wait for {:g} h, h", w.duration_h));
  for (int m = 1; m <= 12; ++m) {
    const std::size_t i = static_cast<std::size_t>(m - 1);
    if (h.months.samples[i] == 0) continue;
    const YearSpread& years = h.months.by_year[i];
    table.rows.push_back({month_name(m), percent(h.months.share[i]), percent(years.p10()), percent(years.p50()),
                          percent(years.p90()), std::to_string(years.years.size())});
    for (const WindowStatistics& w : h.windows) table.rows.back().push_back(cell(w.by_month[i].mean_h, 1));
  }
  table.note =
      "P10, P50 and P90 of the shares of whole months in single years, from three years on. Waits are means over "
      "all samples of the month.";
  return table;
}

ReportTable windows_table(const HindcastStudy& h) {
  ReportTable table{
      "Weather windows",
      "Waits are from any sample to the start of the next window. Chances are of starts whose horizon lies "
      "within the record.",
      {"window, h", "samples", "starts, %", "mean wait, h", "P50", "P80", "P90"},
      {}};
  for (const ChanceWithin& chance : h.windows.front().all.within) table.header.push_back(horizon_title(chance));
  table.header.push_back("cut off");
  for (const WindowStatistics& w : h.windows) {
    table.rows.push_back({fmt::format("{:g}", w.duration_h), std::to_string(w.samples), percent(w.all.start_share),
                          cell(w.all.mean_h, 1), cell(w.all.p50_h, 1), cell(w.all.p80_h, 1), cell(w.all.p90_h, 1)});
    for (const ChanceWithin& chance : w.all.within) table.rows.back().push_back(percent(chance.share));
    table.rows.back().push_back(std::to_string(w.censored));
  }
  return table;
}

ReportTable waits_table(const HindcastStudy& h, const WindowStatistics& w) {
  ReportTable table{fmt::format("Waiting for {:g} h, by month", w.duration_h),
                    "P10 to P90 of the mean wait are over the years, from three on.",
                    {"month", "starts, %", "mean wait, h", "P50", "P80", "P90", "mean in years, P10", "P50", "P90"},
                    {}};
  for (int m = 1; m <= 12; ++m) {
    const std::size_t i = static_cast<std::size_t>(m - 1);
    if (h.months.samples[i] == 0) continue;
    const WaitSummary& s = w.by_month[i];
    const YearSpread& years = w.mean_by_year[i];
    table.rows.push_back({month_name(m), percent(s.start_share), cell(s.mean_h, 1), cell(s.p50_h, 1), cell(s.p80_h, 1),
                          cell(s.p90_h, 1), cell(years.p10(), 1), cell(years.p50(), 1), cell(years.p90(), 1)});
  }
  return table;
}

ReportTable scatter_summary_table(const ScatterStudy& s) {
  ReportTable table{"From the scatter table", "", {"", "value"}, {}};
  const double total = s.workability.total;
  table.rows = {{"counts", fmt::format("{:g}", total)},
                {"workable, bins shared linearly, %", percent(s.workability.share, 2)},
                {"workable, bins by their middle, %", percent(s.workability.share_centre, 2)},
                {"periods that the limits do not cover, %", percent(s.workability.outside / total, 3)}};
  if (std::isnan(s.mean_calm_h)) return table;
  table.rows.push_back({"a single limit that is kept as often, m", cell(s.equivalent_height, 2)});
  table.rows.push_back({"mean length of a calm, estimated, h", cell(s.mean_calm_h, 1)});
  for (const ScatterStudy::Calm& calm : s.calms)
    table.rows.push_back({fmt::format("calms longer than {:g} h, estimated, %", calm.hours), percent(calm.longer)});
  table.note = "Lengths of calms are an estimate from the distribution of heights (Kuwashima & Hogben 1986).";
  return table;
}

ReportTable decision_table(const ForecastStudy& f) {
  const GoNoGo& d = f.decision;
  ReportTable table{
      fmt::format("Start at {}", instant_text(f.record.time(0))),
      fmt::format("T_POP {:g} h, T_C {:g} h, T_R {:g} h. A phase may be delayed by T_C. OP_WF = alpha OP_LIM, "
                  "at the phase's tightest time.",
                  f.period.planned_h, f.period.contingency_h, f.period.total_h()),
      {"phase", "decision", "from, h", "to, h", "OP_LIM, m", "alpha", "OP_WF, m", "why"},
      {}};
  for (std::size_t p = 0; p < d.now.size(); ++p) {
    const PhaseDecision& now = d.now[p];
    const ForecastSample& s = d.samples[p][now.first_broken.value_or(now.tightest)];
    table.rows.push_back({phase_title(now.phase),
                          now.go()        ? "go"
                          : d.first_start ? "wait"
                                          : "no-go",
                          cell(d.phases[p].start_h, 2), cell(d.phases[p].end_h + f.period.contingency_h, 2),
                          cell(s.limit, 2), cell(s.alpha, 3), cell(s.allowed, 2), reason_of(f, p, now)});
  }
  return table;
}

ReportTable settings_table(const WeatherTask& task) {
  const WeatherSpec& s = task.spec;
  ReportTable table{"Settings", "", {"setting", "value"}, {}};
  const auto add = [&](const std::string& name, const std::string& value) { table.rows.push_back({name, value}); };
  add("limits", task.limits_source);
  for (const auto& [name, file] :
       {std::pair("hindcast", s.hindcast), std::pair("scatter table", s.scatter), std::pair("forecast", s.forecast)})
    if (!file.empty()) add(name, file);
  add("heading", s.bow_towards
                     ? fmt::format("bow towards {:g} deg (compass)", *s.bow_towards * 180.0 / std::numbers::pi)
                 : s.free_heading ? "the best one in every sample"
                                  : "the lowest limit over all headings counts");
  if (s.wind_max) add("largest wind speed, m/s", short_number(*s.wind_max));
  if (s.daylight.size() == 2)
    add("work between, h UTC", fmt::format("{:g} and {:g}", s.daylight[0] / kHour, s.daylight[1] / kHour));
  add("planned duration T_POP, h", task.planned_h > 0.0 ? short_number(task.planned_h) : "not given");
  add("contingency", fmt::format("{:g} of T_POP, at least 6 h", s.contingency));
  add("end of the record",
      s.record_end == WeatherSpec::End::wrap ? "closed to a ring" : "waits that it cuts off are left out");
  return table;
}

}  // namespace stillhook
