#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/verbs/operability/operability_report.h"
#include "results/plot.h"
#include "results/svg.h"

namespace stillhook {
namespace {

// Those of plots over time: told apart with any colour vision; the dashes tell them apart in grey.
constexpr std::array<const char*, 6> kPolarColours = {"#0072b2", "#d55e00", "#00805c", "#aa4499", "#806000", "#404040"};
constexpr std::array<const char*, 4> kPolarDashes = {"", "7 4", "2 3", "9 3 2 3"};

struct PolarFrame {
  double x = 230.0, y = 235.0, radius = 175.0, most = 1.0;
  /// Bow to the right. A wave's place is where it comes from: opposite to its heading; +y is to port, upwards.
  std::pair<double, double> at(double heading, double height) const {
    const double r = radius * std::min(1.0, height / most), from = heading + std::numbers::pi;
    return {x + r * std::cos(from), y - r * std::sin(from)};
  }
};

std::string rings(const PolarFrame& f, const std::vector<double>& ticks) {
  std::string out;
  for (const double tick : ticks) {
    if (tick <= 0.0 || tick > f.most * 1.0001) continue;
    const double r = f.radius * tick / f.most;
    out +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" stroke=\"#ccd2d8\"/>", f.x, f.y, r);
    out +=
        svg_text(f.x + 3.0, f.y - r - 2.0, "start", fmt::format("{:g} m", tick), " font-size=\"10\" fill=\"#56616b\"");
  }
  return out;
}

std::string spokes(const PolarFrame& f, const std::vector<double>& headings) {
  std::string out;
  for (const double heading : headings) {
    const auto [x, y] = f.at(heading, f.most);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#e4e8ec\"/>", f.x, f.y, x, y);
    const double from = heading + std::numbers::pi;
    out += svg_text(f.x + (f.radius + 16.0) * std::cos(from), f.y - (f.radius + 16.0) * std::sin(from) + 4.0, "middle",
                    fmt::format("{:g}", degrees_of(heading)), " font-size=\"11\"");
  }
  return out;
}

/// A ship's outline, bow to the right.
std::string hull_outline(const PolarFrame& f) {
  return fmt::format("<path d=\"M{0:.1f} {1:.1f}h44q14 2 20 9q-6 7 -20 9h-44z\" fill=\"#dfe5ea\" stroke=\"#56616b\"/>",
                     f.x - 32.0, f.y - 9.0);
}

std::string period_outline(const OperabilityStudy& study, const PolarFrame& f, std::size_t period) {
  const std::vector<double>& headings = study.plan().headings;
  std::string path, points;
  bool down = false, whole = true;
  const char* colour = kPolarColours[period % kPolarColours.size()];
  for (std::size_t h = 0; h < headings.size(); ++h) {
    const double limit = study.limit(period, h).limit.height;
    whole = whole && !std::isnan(limit);
    if (!std::isnan(limit)) {
      const auto [x, y] = f.at(headings[h], limit);
      path += fmt::format("{}{:.1f} {:.1f}", down ? "L" : "M", x, y);
      points += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>", x, y, colour);
    }
    down = !std::isnan(limit);
  }
  if (whole) path += "Z";
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"/>", path,
                     colour, kPolarDashes[period % kPolarDashes.size()]) +
         points;
}

/// From the lower to the upper bound of the limit, of each heading at the period with the lowest limit.
std::string interval_bars(const OperabilityStudy& study, const PolarFrame& f, std::size_t period) {
  std::string out;
  for (std::size_t h = 0; h < study.plan().headings.size(); ++h) {
    const LimitingHeight& l = study.limit(period, h).limit;
    if (std::isnan(l.low) || std::isnan(l.high)) continue;
    const auto [x0, y0] = f.at(study.plan().headings[h], l.low);
    const auto [x1, y1] = f.at(study.plan().headings[h], l.high);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"5\" opacity=\"0.35\"/>",
                       x0, y0, x1, y1, kPolarColours[period % kPolarColours.size()]);
  }
  return out;
}

std::string period_legend(const OperabilityStudy& study, std::size_t shown) {
  std::string out;
  double y = 60.0;
  for (std::size_t p = 0; p < study.plan().peak_periods.size(); ++p, y += 20.0) {
    out += fmt::format("<path d=\"M480 {0:.1f}h30\" stroke=\"{1}\" stroke-width=\"2\" stroke-dasharray=\"{2}\"/>", y,
                       kPolarColours[p % kPolarColours.size()], kPolarDashes[p % kPolarDashes.size()]);
    out +=
        svg_text(518.0, y + 4.0, "start",
                 fmt::format("Tp {:g} s{}", study.plan().peak_periods[p], p == shown ? ", bars: 95 % interval" : ""));
  }
  out += svg_text(480.0, y + 14.0, "start", "A point lies where its waves come from;");
  return out + svg_text(480.0, y + 32.0, "start", "the numbers are headings, deg. Bow right.");
}

}  // namespace

std::string polar_drawing(const OperabilityStudy& study) {
  const OperabilityPlan& plan = study.plan();
  if (plan.headings.size() < 3) return {};
  PolarFrame f;
  f.most = 0.0;
  double least = 1e300;
  std::size_t lowest = 0;
  for (std::size_t p = 0; p < plan.peak_periods.size(); ++p)
    for (std::size_t h = 0; h < plan.headings.size(); ++h) {
      const double limit = study.limit(p, h).limit.height;
      if (std::isnan(limit)) continue;
      f.most = std::max(f.most, limit);
      if (limit < least) {
        least = limit;
        lowest = p;
      }
    }
  if (!(f.most > 0.0)) return {};
  const std::vector<double> ticks = nice_ticks(0.0, f.most, 5);
  f.most = ticks.back();
  const double height = std::max(465.0, 120.0 + 20.0 * static_cast<double>(plan.peak_periods.size()));
  std::string out = svg_begin(760.0, height, "Limiting significant wave height around the hull, m") + rings(f, ticks) +
                    spokes(f, plan.headings) + hull_outline(f) + interval_bars(study, f, lowest);
  for (std::size_t p = 0; p < plan.peak_periods.size(); ++p) out += period_outline(study, f, p);
  return out + period_legend(study, lowest) + "</svg>";
}

}  // namespace stillhook
