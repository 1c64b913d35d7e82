#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/verbs/operability/operability_report.h"
#include "planner/verbs/operability/operability_tables.h"
#include "results/grid_chart.h"
#include "results/html.h"
#include "results/plot.h"
#include "results/statistics/binomial.h"

namespace stillhook {

std::string limits_drawing(const OperabilityStudy& study, std::size_t place) {
  const OperabilityPlan& plan = study.plan();
  GridChart chart;
  chart.title = place == 0 ? "Limiting significant wave height, m, and what governs"
                           : "Phase " + readable_name(place_name(plan, place)) + ": limiting height, m";
  chart.x_label = "peak period, s";
  chart.y_label = "heading, deg";
  chart.cell_height = 22.0;
  for (const double tp : plan.peak_periods) chart.columns.push_back(fmt::format("{:g}", tp));
  for (std::size_t h = 0; h < plan.headings.size(); ++h) {
    chart.rows.push_back(fmt::format("{:g}", degrees_of(plan.headings[h])));
    chart.values.emplace_back();
    chart.texts.emplace_back();
    for (std::size_t p = 0; p < plan.peak_periods.size(); ++p) {
      const LimitingHeight& l = study.limit(p, h, place).limit;
      chart.values.back().push_back(l.height);
      chart.texts.back().push_back(limit_text(study, study.task_at(p, h), place) + " " +
                                   criterion_letter(study, l.governing));
    }
  }
  return draw_grid_chart(chart);
}

std::string limit_curves(const OperabilityStudy& study) {
  const OperabilityPlan& plan = study.plan();
  if (plan.peak_periods.size() < 2) return {};
  Plot plot;
  plot.title = "Limiting significant wave height";
  plot.x_label = "peak period, s";
  plot.y_label = "Hs, m";
  for (std::size_t h = 0; h < plan.headings.size(); ++h) {
    PlotLine line{fmt::format("{:g} deg", degrees_of(plan.headings[h])), plan.peak_periods, {}};
    for (std::size_t p = 0; p < plan.peak_periods.size(); ++p) line.value.push_back(study.limit(p, h).limit.height);
    plot.lines.push_back(line);
  }
  return draw_plot(plot);
}

std::string broken_share_drawing(const OperabilityStudy& study, std::size_t task) {
  const TargetLimit& whole = study.collected.columns[task].result.targets[0];
  std::vector<double> heights;
  double last = 0.0;
  for (const SeedBracket& b : whole.seeds) {
    if (b.found()) heights.push_back(b.high);
    last = std::max(last, b.found() ? b.high : b.low);
  }
  if (heights.empty()) return {};
  std::sort(heights.begin(), heights.end());
  // Seeds that were not refined are only known to break somewhere above the heights that decide the limit.
  double end = last;
  for (const SeedBracket& b : whole.seeds)
    if (b.runs > 0 && !(b.found() && b.high <= 1.2 * b.low)) end = std::min(end, b.low);
  Plot plot;
  plot.title = "Share of the seeds that break: " + column_text(study.plan().columns[task]);
  plot.x_label = "significant wave height, m";
  plot.y_label = "share, %";
  const int seeds = static_cast<int>(whole.seeds.size());
  PlotLine share{"seeds that break", {}, {}}, low{"90 % interval", {}, {}}, high{"its other end", {}, {}};
  const double begin = 0.8 * heights.front();
  constexpr int kPoints = 160;
  for (int i = 0; i <= kPoints && end > begin; ++i) {
    const double h = begin + (end - begin) * i / kPoints;
    const int broken = static_cast<int>(std::upper_bound(heights.begin(), heights.end(), h) - heights.begin());
    const Interval interval = share_interval(broken, seeds);
    for (PlotLine* line : {&share, &low, &high}) line->time.push_back(h);
    share.value.push_back(100.0 * broken / seeds);
    low.value.push_back(100.0 * interval.low);
    high.value.push_back(100.0 * interval.high);
  }
  if (share.time.empty()) return {};
  plot.lines = {share, low, high};
  plot.limits = {{"allowed", 100.0 * (1.0 - study.plan().rules.level)}};
  return draw_plot(plot);
}

}  // namespace stillhook
