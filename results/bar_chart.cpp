#include "results/bar_chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/html.h"
#include "results/plot.h"
#include "results/svg.h"

namespace stillhook {
namespace {

constexpr double kChartLeft = 56.0, kChartRight = 14.0, kChartTop = 48.0, kChartBottom = 26.0;
constexpr const char* kBarColour = "#7fb2d9";

double tallest(const BarChart& chart) {
  double most = 0.0;
  for (const BarChart::Bar& bar : chart.bars)
    for (const double v : {bar.value, bar.high, bar.mark})
      if (std::isfinite(v)) most = std::max(most, v);
  return most > 0.0 ? most : 1.0;
}

std::string chart_legend(const BarChart& chart) {
  std::string out;
  double x = kChartLeft;
  const double y = 34.0;
  const auto entry = [&](const std::string& label, const std::string& symbol) {
    if (label.empty()) return;
    out += symbol + svg_text(x + 24.0, y, "start", label);
    x += 40.0 + svg_text_width(label);
  };
  entry(chart.bar_label, fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"16\" height=\"10\" fill=\"{}\" "
                                     "stroke=\"#2f5f85\"/>",
                                     x, y - 9.0, kBarColour));
  entry(
      chart.whisker_label,
      fmt::format("<path d=\"M{:.1f} {:.1f}v12m-4 0h8m-8 -12h8\" stroke=\"#111\" fill=\"none\"/>", x + 8.0, y - 10.0));
  entry(chart.mark_label,
        fmt::format("<path d=\"M{:.1f} {:.1f}h16\" stroke=\"#a4001d\" stroke-width=\"2.5\"/>", x, y - 4.0));
  return out;
}

}  // namespace

std::string draw_bar_chart(const BarChart& chart) {
  const std::vector<double> ticks = nice_ticks(0.0, tallest(chart), 5);
  const double bottom = chart.height - kChartBottom, right = chart.width - kChartRight;
  const auto place = [&](double v) { return bottom - v / ticks.back() * (bottom - kChartTop); };
  std::string out = svg_begin(chart.width, chart.height, chart.title) + chart_legend(chart);
  for (const double tick : ticks) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#d4dae0\" stroke-width=\".7\"/>", kChartLeft,
                       place(tick), right);
    out += svg_text(kChartLeft - 6.0, place(tick) + 4.0, "end", readable_number(tick));
  }
  out += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                     0.5 * (kChartTop + bottom), escape_html(chart.y_label));
  const double slot = (right - kChartLeft) / static_cast<double>(std::max<std::size_t>(1, chart.bars.size()));
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const BarChart::Bar& bar = chart.bars[i];
    const double middle = kChartLeft + (static_cast<double>(i) + 0.5) * slot, half = 0.32 * slot;
    out += svg_text(middle, bottom + 17.0, "middle", bar.category);
    if (!std::isfinite(bar.value)) continue;
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" stroke=\"#2f5f85\"/>",
        middle - half, place(bar.value), 2.0 * half, bottom - place(bar.value), kBarColour);
    double top = place(bar.value);
    if (std::isfinite(bar.low) && std::isfinite(bar.high)) {
      top = std::min(top, place(bar.high));
      out += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}h8M{3:.1f} {2:.1f}h8\" stroke=\"#111\" "
          "fill=\"none\"/>",
          middle, place(bar.low), place(bar.high), middle - 4.0);
    }
    if (std::isfinite(bar.mark))
      out += fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#a4001d\" stroke-width=\"2.5\"/>",
                         middle - 0.5 * half, place(bar.mark), half);
    out += svg_text(middle, top - 4.0, "middle", fixed_number(bar.value, chart.decimals), " font-size=\"10.5\"");
  }
  out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#3d4852\"/>", kChartLeft, bottom, right);
  return out + "</svg>";
}

}  // namespace stillhook
