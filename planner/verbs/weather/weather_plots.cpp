#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/verbs/weather/weather_report.h"
#include "planner/verbs/weather/weather_tables.h"
#include "results/bar_chart.h"
#include "results/grid_chart.h"
#include "results/html.h"
#include "results/plot.h"
#include "results/svg.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// A limit over the periods of a table, in its cells.
GridChart::Line limit_line(const std::string& label, bool dashed, double first_period, double height_step,
                           std::size_t periods, const std::function<double(double)>& limit) {
  GridChart::Line line{label, {}, dashed};
  constexpr int kPerCell = 8;
  for (std::size_t i = 0; i <= periods * kPerCell; ++i) {
    const double cells = static_cast<double>(i) / kPerCell;
    line.points.emplace_back(cells, limit(first_period + cells) / height_step);
  }
  return line;
}

/// Colours that differ in lightness, so that they read in grey.
constexpr std::array<const char*, kSampleStates> kStateColours = {"#bfe3d0", "#0b3d6b", "#7a4fa3",
                                                                  "#9aa3ab", "#d9a441", "#ffffff"};

int year_of_calendar(const HindcastStudy& h) {
  if (!h.months.whole_years.years.empty()) return h.months.whole_years.years.back();
  return date_of(h.record.time(h.record.size() - 1)).year;
}

/// Rectangles of one state, as one path.
struct CalendarPaths {
  std::array<std::string, kSampleStates> of;
};

}  // namespace

std::string months_drawing(const HindcastStudy& h) {
  BarChart chart;
  chart.title = "Workable by month";
  chart.y_label = "workable, %";
  chart.bar_label = "share of all samples";
  bool spread = false;
  for (std::size_t m = 0; m < 12; ++m) {
    const YearSpread& years = h.months.by_year[m];
    chart.bars.push_back({month_name(static_cast<int>(m) + 1), 100.0 * h.months.share[m], 100.0 * years.p10(),
                          100.0 * years.p90(), 100.0 * years.p50()});
    spread = spread || !std::isnan(years.p10());
  }
  if (spread) {
    chart.whisker_label = "P10 to P90 over the years";
    chart.mark_label = "P50";
  }
  return draw_bar_chart(chart);
}

std::string waiting_drawing(const HindcastStudy& h) {
  Plot plot;
  plot.title = "Chance that a window starts within a time";
  plot.x_label = "days";
  plot.y_label = "chance, %";
  constexpr double kLongest = 21.0;  // days
  for (const WindowStatistics& w : h.windows) {
    std::vector<double> waits;
    for (const double wait : w.wait_h)
      if (!std::isnan(wait)) waits.push_back(wait);
    std::sort(waits.begin(), waits.end());
    if (waits.empty()) continue;
    PlotLine line{fmt::format("{:g} h", w.duration_h), {}, {}};
    for (int i = 0; i <= 168; ++i) {
      const double days = kLongest * i / 168.0;
      const auto within = std::upper_bound(waits.begin(), waits.end(), 24.0 * days) - waits.begin();
      line.time.push_back(days);
      line.value.push_back(100.0 * static_cast<double>(within) / static_cast<double>(waits.size()));
    }
    plot.lines.push_back(line);
  }
  return plot.lines.empty() ? "" : draw_plot(plot);
}

std::string chances_drawing(const HindcastStudy& h, const WindowStatistics& w) {
  GridChart chart;
  chart.title = fmt::format("Chance of a window of {:g} h, by the month in which the wait begins, %", w.duration_h);
  chart.x_label = "month";
  chart.y_label = "within";
  chart.darkest = 1.0;
  for (int m = 1; m <= 12; ++m) chart.columns.emplace_back(month_name(m));
  const auto add_row = [&](const std::string& label, auto share_of) {
    chart.rows.push_back(label);
    chart.values.emplace_back();
    chart.texts.emplace_back();
    for (std::size_t m = 0; m < 12; ++m) {
      const double share = h.months.samples[m] == 0 ? kNaN : share_of(w.by_month[m]);
      chart.values.back().push_back(share);
      chart.texts.back().push_back(fixed_number(100.0 * share, 0));
    }
  };
  add_row("at once", [](const WaitSummary& s) { return s.start_share; });
  for (std::size_t d = 0; d < w.all.within.size(); ++d)
    add_row(fmt::format("{:g} {}", w.all.within[d].days, w.all.within[d].days == 1.0 ? "day" : "days"),
            [d](const WaitSummary& s) { return s.within[d].share; });
  return draw_grid_chart(chart);
}

std::string calms_drawing(const HindcastStudy& h) {
  std::vector<double> lengths = calms(h.workability);
  if (lengths.empty()) return {};
  std::sort(lengths.begin(), lengths.end());
  double total = 0.0;
  for (const double length : lengths) total += length;
  Plot plot;
  plot.title = "Persistence of calms";
  plot.x_label = "length, h";
  plot.y_label = "%";
  PlotLine number{"of the calms last at least so long", {}, {}},
      time{"of the workable time lies in such calms", {}, {}};
  const double longest = lengths.back();
  for (int i = 0; i <= 240; ++i) {
    const double length = longest * i / 240.0;
    double count = 0.0, hours = 0.0;
    for (const double l : lengths)
      if (l >= length) {
        count += 1.0;
        hours += l;
      }
    number.time.push_back(length);
    time.time.push_back(length);
    number.value.push_back(100.0 * count / static_cast<double>(lengths.size()));
    time.value.push_back(100.0 * hours / total);
  }
  plot.lines = {number, time};
  return draw_plot(plot);
}

std::string calendar_drawing(const HindcastStudy& h) {
  const int year = year_of_calendar(h);
  const double left = 40.0, top = 46.0, day_width = 714.0 / 366.0, hour_height = 4.0, bottom = top + 24.0 * hour_height;
  CalendarPaths paths;
  std::array<bool, kSampleStates> seen{};
  const UnixTime first = *instant_of_date(year, 1, 1);
  for (std::size_t i = 0; i < h.record.size(); ++i) {
    const UnixTime begin = h.record.time(i);
    if (date_of(begin).year != year) continue;
    const std::size_t state = static_cast<std::size_t>(h.workability.state[i]);
    seen[state] = true;
    // A sample of more than a day, or across midnight, is drawn in the day that it begins in.
    const double day = std::floor(static_cast<double>(begin - first) / kDay), hour = date_of(begin).hour;
    paths.of[state] +=
        fmt::format("M{:.1f} {:.1f}h{:.2f}v{:.1f}h-{:.2f}z", left + day * day_width, top + hour * hour_height,
                    day_width + 0.15, hour_height * std::min(h.record.step_h(), 24.0 - hour), day_width + 0.15);
  }
  std::string out = svg_begin(760.0, bottom + 28.0, fmt::format("Every sample of {}", year));
  double x = left;
  for (std::size_t s = 0; s < kSampleStates; ++s) {
    if (!seen[s]) continue;
    out += fmt::format("<path d=\"{}\" fill=\"{}\"/>", paths.of[s], kStateColours[s]);
    const std::string label = state_text(static_cast<SampleState>(s));
    out += fmt::format("<rect x=\"{:.1f}\" y=\"26\" width=\"14\" height=\"10\" fill=\"{}\" stroke=\"#7c8894\"/>", x,
                       kStateColours[s]) +
           svg_text(x + 20.0, 35.0, "start", label);
    x += 38.0 + svg_text_width(label);
  }
  for (int m = 1; m <= 12; ++m) {
    const double day = static_cast<double>(*instant_of_date(year, m, 1) - first) / kDay;
    out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#3d4852\" stroke-width=\".8\"/>",
                       left + day * day_width, top, bottom + 4.0) +
           svg_text(left + (day + 15.0) * day_width, bottom + 17.0, "middle", month_name(m));
  }
  for (const int hour : {0, 12, 24})
    out += svg_text(left - 6.0, top + hour * hour_height + 4.0, "end", fmt::format("{} h", hour));
  return out +
         fmt::format(
             "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#3d4852\"/>",
             left, top, 366.0 * day_width, bottom - top) +
         "</svg>";
}

ScatterTable counted(const WeatherRecord& record) {
  std::map<std::pair<int, int>, double> counts;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const double height = record.height[i], period = WeatherRecord::value(record.period, i);
    if (std::isnan(height) || std::isnan(period)) continue;
    counts[{static_cast<int>(std::floor(height / 0.5)), static_cast<int>(std::floor(period))}] += 1.0;
  }
  ScatterTable table;
  for (const auto& [bin, count] : counts)
    table.bins.push_back({0, kNaN, 0.5 * bin.first, 0.5 * (bin.first + 1), static_cast<double>(bin.second),
                          static_cast<double>(bin.second + 1), count});
  return table;
}

std::string scatter_drawing(const ScatterTable& table, const OperationLimits& limits, const std::string& title) {
  if (table.bins.empty()) return {};
  constexpr double kHeightStep = 0.5,
                   kPeriodStep = 1.0;  // drawn bins; those of the table are shared among them by middle
  double first = 1e9, last = 0.0, highest = 0.0;
  for (const ScatterBin& bin : table.bins) {
    first = std::min(first, std::floor(bin.period_low));
    last = std::max(last, std::ceil(bin.period_high));
    highest = std::max(highest, bin.height_high);
  }
  const std::size_t columns = static_cast<std::size_t>(last - first),
                    rows = static_cast<std::size_t>(std::ceil(highest / kHeightStep));
  GridChart chart;
  chart.title = title;
  chart.x_label = "peak period, s";
  chart.y_label = "Hs, m";
  chart.labels_at_edges = true;
  chart.values.assign(rows, std::vector<double>(columns, kNaN));
  chart.texts.assign(rows, std::vector<std::string>(columns));
  const double total = table.total();
  for (const ScatterBin& bin : table.bins) {
    const std::size_t r = static_cast<std::size_t>(0.5 * (bin.height_low + bin.height_high) / kHeightStep);
    const std::size_t c = static_cast<std::size_t>((0.5 * (bin.period_low + bin.period_high) - first) / kPeriodStep);
    double& value = chart.values[std::min(r, rows - 1)][std::min(c, columns - 1)];
    value = (std::isnan(value) ? 0.0 : value) + 1000.0 * bin.count / total;
  }
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      if (!std::isnan(chart.values[r][c]))
        chart.texts[r][c] = chart.values[r][c] < 0.5 ? "<1" : fixed_number(chart.values[r][c], 0);
  for (std::size_t c = 0; c < columns; ++c) chart.columns.push_back(fixed_number(first + static_cast<double>(c), 0));
  for (std::size_t r = 0; r < rows; ++r) chart.rows.push_back(fixed_number(kHeightStep * static_cast<double>(r), 1));
  const bool by_heading = limits.depends_on_heading();
  chart.lines.push_back(limit_line(by_heading ? "limit at the worst heading" : "limit", false, first, kHeightStep,
                                   columns, [&](double period) { return limits.lowest(period); }));
  if (by_heading)
    chart.lines.push_back(limit_line("limit at the best heading", true, first, kHeightStep, columns,
                                     [&](double period) { return limits.highest(period); }));
  return draw_grid_chart(chart);
}

std::string scatter_months_drawing(const ScatterStudy& s) {
  if (!s.table.has_months()) return {};
  BarChart chart;
  chart.title = "Workable by month, from the scatter table";
  chart.y_label = "workable, %";
  for (std::size_t m = 0; m < 12; ++m)
    chart.bars.push_back({month_name(static_cast<int>(m) + 1), 100.0 * s.workability.by_month[m], kNaN, kNaN, kNaN});
  return draw_bar_chart(chart);
}

std::string forecast_drawing(const ForecastStudy& f, std::size_t p) {
  const GoNoGo& d = f.decision;
  Plot plot;
  plot.title = "Forecast: " + phase_title(d.phases[p].name);
  plot.x_label = "hours after " + instant_text(f.record.time(0));
  plot.y_label = "m";
  PlotLine height{"Hs", {}, {}}, limit{"OP_LIM", {}, {}}, allowed{"OP_WF", {}, {}};
  for (std::size_t i = 0; i < f.record.size(); ++i)
    for (const double end : {0.0, 1.0}) {  // a sample holds until the next
      const double hours = (static_cast<double>(i) + end) * f.record.step_h();
      for (PlotLine* line : {&height, &limit, &allowed}) line->time.push_back(hours);
      height.value.push_back(f.record.height[i]);
      limit.value.push_back(d.samples[p][i].limit);
      allowed.value.push_back(d.samples[p][i].allowed);
    }
  plot.lines = {height, allowed, limit};
  if (d.first_start) {
    const PhaseDecision& then = d.then[p];
    plot.phases = {{"wait", 0.0, static_cast<double>(then.first) * f.record.step_h()},
                   {"operation", static_cast<double>(then.first) * f.record.step_h(),
                    static_cast<double>(then.last) * f.record.step_h()},
                   {"after it", static_cast<double>(then.last) * f.record.step_h(),
                    static_cast<double>(f.record.size()) * f.record.step_h()}};
    std::erase_if(plot.phases, [](const PlotPhase& phase) { return phase.end <= phase.start; });
  }
  return draw_plot(plot);
}

}  // namespace stillhook
