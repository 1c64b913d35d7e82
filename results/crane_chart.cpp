#include "results/crane_chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/crane_use.h"
#include "results/html.h"
#include "results/plot.h"
#include "results/svg.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kWidth = 760.0, kHeight = 380.0;
constexpr double kLeft = 66.0, kRight = kWidth - 16.0, kTop = 52.0, kBottom = kHeight - 44.0;
constexpr double kTonne = 1e3 * kStandardGravity;
constexpr std::size_t kSlices = 1500;  // of a path: more points than these are not seen

/// Radius, m, and load, t, to places on the drawing.
struct CraneAxes {
  double radius_low = 0.0, radius_high = 1.0, load_high = 1.0;
  double x(double radius) const {
    return kLeft + (kRight - kLeft) * (radius - radius_low) / (radius_high - radius_low);
  }
  double y(double load) const { return kBottom - (kBottom - kTop) * load / load_high; }
};

CraneAxes axes_of(const std::vector<const CraneCurveSpec*>& curves, const CraneUse& use) {
  double low = 1e9, high = 0.0, most = 0.0;
  for (const CraneCurveSpec* curve : curves) {
    low = std::min(low, curve->radius.front());
    high = std::max(high, curve->radius.back());
    for (const double c : curve->capacity) most = std::max(most, c / kTonne);
  }
  for (std::size_t i = 0; i < use.radius.size(); ++i) {
    low = std::min(low, use.radius[i]);
    high = std::max(high, use.radius[i]);
    most = std::max(most, use.load[i] / kTonne);
  }
  const double margin = 0.04 * (high - low);
  return {std::max(0.0, low - margin), high + margin, 1.08 * most};
}

std::string grid_of(const CraneAxes& a) {
  std::string out;
  for (const double load : nice_ticks(0.0, a.load_high, 6)) {
    if (load > a.load_high) continue;
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#d4dae0\" stroke-width=\".7\"/>", kLeft, a.y(load),
                       kRight) +
           svg_text(kLeft - 6.0, a.y(load) + 4.0, "end", fmt::format("{:g}", load));
  }
  for (const double radius : nice_ticks(a.radius_low, a.radius_high, 9)) {
    if (radius < a.radius_low || radius > a.radius_high) continue;
    out += fmt::format("<path d=\"M{:.1f} {:.1f}v4\" stroke=\"#3d4852\"/>", a.x(radius), kBottom) +
           svg_text(a.x(radius), kBottom + 17.0, "middle", fmt::format("{:g}", radius));
  }
  return out + svg_text(0.5 * (kLeft + kRight), kHeight - 8.0, "middle", "radius, m") +
         fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">hook load, t</text>",
                     0.5 * (kTop + kBottom)) +
         fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" fill=\"none\" stroke=\"#3d4852\"/>", kLeft, kTop, kBottom,
                     kRight);
}

std::string curve_path(const CraneCurveSpec& curve, const CraneAxes& a) {
  std::string path;
  for (std::size_t i = 0; i < curve.radius.size(); ++i)
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", a.x(curve.radius[i]), a.y(curve.capacity[i] / kTonne));
  return path;
}

/// First, last and the samples of extreme radius and load of each slice, in order of time.
std::string load_path(const CraneUse& use, const CraneAxes& a) {
  const std::size_t n = use.radius.size(), slice = std::max<std::size_t>(1, n / kSlices);
  std::string path;
  for (std::size_t first = 0; first < n; first += slice) {
    const std::size_t last = std::min(n, first + slice);
    std::vector<std::size_t> kept = {first, last - 1};
    for (const std::vector<double>* values : {&use.radius, &use.load}) {
      const auto from = values->begin() + static_cast<std::ptrdiff_t>(first),
                 to = values->begin() + static_cast<std::ptrdiff_t>(last);
      const auto [least, most] = std::minmax_element(from, to);
      kept.push_back(static_cast<std::size_t>(least - values->begin()));
      kept.push_back(static_cast<std::size_t>(most - values->begin()));
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t i : kept)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", a.x(use.radius[i]), a.y(use.load[i] / kTonne));
  }
  return path;
}

std::string mark_largest(const CraneUse& use, const CraneAxes& a) {
  const auto at = std::max_element(use.use.begin(), use.use.end()) - use.use.begin();
  const double x = a.x(use.radius[static_cast<std::size_t>(at)]), y = a.y(use.load[static_cast<std::size_t>(at)] / kTonne);
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"none\" stroke=\"#111\" stroke-width=\"2\"/>", x, y);
}

}  // namespace

std::string draw_crane_curve(const RunView& view, const std::string& crane) {
  const CraneUse use = crane_use(view, crane);
  if (!use.curve || use.radius.empty()) return {};
  std::vector<const CraneCurveSpec*> curves;
  for (const CraneCurveSpec& curve : view.specification().crane_curves)
    if (curve.crane == crane) curves.push_back(&curve);
  const CraneAxes axes = axes_of(curves, use);
  std::string out = svg_begin(kWidth, kHeight, "Hook load of " + readable_name(crane) + " over its radius") + grid_of(axes);
  double x = kLeft;
  const auto legend = [&](const std::string& label, const std::string& look) {
    out += fmt::format("<path d=\"M{:.1f} 36h20\" fill=\"none\" {}/>", x, look) + svg_text(x + 26.0, 40.0, "start", label);
    x += 44.0 + svg_text_width(label);
  };
  out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"1.2\"/>", load_path(use, axes));
  for (const CraneCurveSpec* curve : curves) {
    const std::string look = curve == use.curve ? "stroke=\"#b00020\" stroke-width=\"2.4\""
                                                : "stroke=\"#8b97a3\" stroke-width=\"1.2\" stroke-dasharray=\"6 4\"";
    out += fmt::format("<path d=\"{}\" fill=\"none\" {}/>", curve_path(*curve, axes), look);
    std::string label = readable_name(curve->name);
    if (std::isfinite(curve->significant_height)) label += fmt::format(", up to {:g} m", curve->significant_height);
    legend(label, look);
  }
  const bool dynamic = use.curve->basis == CraneCurveSpec::Basis::dynamic;
  legend(dynamic ? "the lift, dynamic" : "the lift, at rest", "stroke=\"#1f5fa8\" stroke-width=\"1.2\"");
  return out + mark_largest(use, axes) + "</svg>";
}

}  // namespace stillhook
