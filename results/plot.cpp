#include "results/plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "results/html.h"

namespace stillhook {
namespace {

// Blue, vermilion, green, purple, brown, grey: told apart with any colour vision, 3:1 or better on white.
constexpr std::array<const char*, 6> kColours = {"#0072b2", "#d55e00", "#00805c", "#aa4499", "#806000", "#404040"};
constexpr double kFont = 12.0;
constexpr double kMarginLeft = 62.0, kMarginRight = 14.0, kMarginBottom = 40.0, kPhaseStrip = 17.0;
constexpr double kPeriodRow = 13.0, kAxisTitle = 28.0;
constexpr double kLegendRow = 18.0, kTitleRow = 24.0;
constexpr int kPointBudget = 4800;  // of all lines together: about 35 kB of path

/// Width of a text in DejaVu Sans or Helvetica, on the safe side; UTF-8 continuation bytes have none.
double text_width(const std::string& text, double size = kFont) {
  double width = 0.0;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) width += 0.62 * size;
  return width;
}

struct Scale {
  double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
  double operator()(double v) const { return from + (v - low) / (high - low) * (to - from); }
};

struct Axes {
  double left, right, top, bottom;
  Scale x, y;
};

struct LegendEntry {
  std::string label, colour;
  enum class Kind { line, limit, range, marker, note } kind;
};

double span_of(const std::vector<double>& ticks) { return ticks.back() - ticks.front(); }

std::string tick_label(double value, double step) {
  int decimals = 0;  // as many as the step itself needs: 0.25 two, 0.2 one
  for (double scaled = step; decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled; scaled *= 10.0)
    ++decimals;
  return fixed_number(value, decimals);
}

/// Values that would need many digits are shown in thousands of thousands, or parts of them: the factor, and how the
/// axis names it.
std::pair<double, std::string> power_of(const std::vector<double>& ticks) {
  static constexpr std::array<std::pair<double, const char*>, 8> kPowers = {{{1e-12, "10⁻¹²"},
                                                                             {1e-9, "10⁻⁹"},
                                                                             {1e-6, "10⁻⁶"},
                                                                             {1e-3, "10⁻³"},
                                                                             {1e3, "10³"},
                                                                             {1e6, "10⁶"},
                                                                             {1e9, "10⁹"},
                                                                             {1e12, "10¹²"}}};
  const double largest = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  if (largest == 0.0 || (largest > 5e-3 && largest < 1e6)) return {1.0, ""};
  std::size_t best = 0;
  for (std::size_t i = 0; i < kPowers.size(); ++i)
    if (kPowers[i].first <= largest) best = i;
  return {kPowers[best].first, std::string(" (in ") + kPowers[best].second + ")"};
}

std::pair<double, double> data_range(const Plot& plot) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotLine& line : plot.lines)
    for (double v : line.value)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  if (low > high) return {0.0, 1.0};
  return {low, high};
}

/// A limit or range is drawn when it does not squeeze the data into less than 40 % of the height.
bool fits(double value, double low, double high) {
  const double span = std::max(high - low, 1e-9 * std::max(std::abs(low), std::abs(high)));
  return value <= high + 1.5 * span && value >= low - 1.5 * span;
}

std::pair<double, double> time_range(const Plot& plot) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotPhase& p : plot.phases) {
    low = std::min(low, p.start);
    high = std::max(high, p.end);
  }
  if (plot.phases.empty())
    for (const PlotLine& line : plot.lines)
      if (!line.time.empty()) {
        low = std::min(low, line.time.front());
        high = std::max(high, line.time.back());
      }
  if (!(low < high)) return {0.0, 1.0};
  return {low, high};
}

std::string text(double x, double y, const char* anchor, const std::string& content, const char* extra = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, extra,
                     escape_html(content));
}

/// One line's path in tenths of a unit, whole numbers and relative moves: half the bytes of decimals.
std::string path_of(const PlotLine& line, const Axes& f, int columns) {
  std::string d;
  long x0 = 0, y0 = 0;
  bool pen_down = false;
  for (const auto& [t, v] : thin_out(line, f.x.low, f.x.high, columns)) {
    if (!std::isfinite(v)) {
      pen_down = false;
      continue;
    }
    const long x = std::lround(10.0 * f.x(t)), y = std::lround(10.0 * f.y(v));
    if (!pen_down)
      d += fmt::format("M{} {}", x, y);
    else if (x != x0 || y != y0)
      d += fmt::format("l{}{}{}", x - x0, y - y0 < 0 ? "" : " ", y - y0);
    x0 = x;
    y0 = y;
    pen_down = true;
  }
  return d;
}

std::string draw_phases(const Plot& plot, const Axes& f) {
  std::string out;
  for (std::size_t i = 0; i < plot.phases.size(); ++i) {
    const double x0 = std::clamp(f.x(plot.phases[i].start), f.left, f.right);
    const double x1 = std::clamp(f.x(plot.phases[i].end), f.left, f.right);
    if (x1 <= x0) continue;
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>"
        "<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#b8c0c8\" stroke-width=\".7\"/>",
        x0, f.top - kPhaseStrip, x1 - x0, f.bottom - f.top + kPhaseStrip, i % 2 ? "#eef1f4" : "#f8f9fa", x0,
        f.top - kPhaseStrip, f.bottom);
    const std::string number = std::to_string(i + 1), full = number + " " + plot.phases[i].label;
    const double room = x1 - x0 - 6.0;
    const std::string& label = text_width(full, 10.5) <= room ? full : number;
    if (text_width(label, 10.5) <= room + 4.0)
      out += text(0.5 * (x0 + x1), f.top - 5.0, "middle", label, " font-size=\"10.5\" fill=\"#3d4852\"");
  }
  return out;
}

std::string draw_axes(const Plot& plot, const Axes& f, const std::vector<double>& y_ticks,
                      const std::vector<double>& x_ticks) {
  std::string out;
  const auto [power, power_name] = power_of(y_ticks);
  const double y_step = (y_ticks[1] - y_ticks[0]) / power, x_step = x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1.0;
  for (double v : y_ticks) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#d4dae0\" stroke-width=\".7\"/>", f.left, f.y(v),
                       f.right);
    out += text(f.left - 7.0, f.y(v) + 4.0, "end", tick_label(v / power, y_step));
  }
  for (double v : x_ticks) {
    if (v < f.x.low - 1e-9 || v > f.x.high + 1e-9) continue;
    out += fmt::format("<path d=\"M{:.1f} {:.1f}v4\" stroke=\"#3d4852\"/>", f.x(v), f.bottom);
    out += text(f.x(v), f.bottom + 16.0, "middle", tick_label(v, x_step));
    if (plot.periods && v > 0.0)
      out += text(f.x(v), f.bottom + 16.0 + kPeriodRow, "middle", readable_number(2.0 * std::numbers::pi / v, 3) + " s",
                  " font-size=\"10.5\" fill=\"#4a5560\"");
  }
  out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" fill=\"none\" stroke=\"#3d4852\"/>", f.left, f.top,
                     f.bottom, f.right);
  out += text(0.5 * (f.left + f.right), f.bottom + 33.0 + (plot.periods ? kPeriodRow : 0.0), "middle",
              plot.periods ? plot.x_label + ", with the period" : plot.x_label);
  out += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                     0.5 * (f.top + f.bottom), escape_html(plot.y_label + power_name));
  return out;
}

std::string draw_limits(const Plot& plot, const Axes& f) {
  std::vector<const PlotLimit*> drawn;
  for (const PlotLimit& limit : plot.limits)
    if (limit.value >= f.y.low && limit.value <= f.y.high) drawn.push_back(&limit);
  std::sort(drawn.begin(), drawn.end(), [](auto* a, auto* b) { return a->value > b->value; });
  std::string out;
  double lowest_free = -1e9;  // labels go down the page; each keeps clear of the one above
  for (const PlotLimit* limit : drawn) {
    const double y = f.y(limit->value);
    out += fmt::format(
        "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#b00020\" stroke-width=\"1.3\" stroke-dasharray=\"7 4\"/>", f.left,
        y, f.right);
    if (limit->label.empty()) continue;
    double label_y = y - 4.0 < f.top + 10.0 ? y + 13.0 : y - 4.0;
    label_y = std::max(label_y, lowest_free + 13.0);
    lowest_free = label_y;
    out += text(f.right - 4.0, label_y, "end", limit->label,
                " font-size=\"11\" fill=\"#b00020\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"");
  }
  return out;
}

std::string draw_markers(const Plot& plot, const Axes& f) {
  std::string out;
  double free_from = -1e9;
  for (const PlotMarker& marker : plot.markers) {
    if (marker.time < f.x.low || marker.time > f.x.high) continue;
    const double x = f.x(marker.time);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" fill=\"#111\"/>", x, f.bottom - 9.0);
    const double width = text_width(marker.label, 10.5);
    const bool left_side = x + 7.0 + width > f.right;
    const double from = left_side ? x - 7.0 - width : x + 7.0;
    if (marker.label.empty() || from < free_from || from < f.left) continue;
    out += text(from, f.bottom - 3.0, "start", marker.label,
                " font-size=\"10.5\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"");
    free_from = from + width + 12.0;
  }
  return out;
}

std::vector<LegendEntry> legend_of(const Plot& plot, const Axes& f) {
  using Kind = LegendEntry::Kind;
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < plot.lines.size(); ++i)
    entries.push_back({plot.lines[i].label, kColours[i % kColours.size()], Kind::line});
  for (const PlotRange& range : plot.ranges)
    if (range.low < f.y.high && range.high > f.y.low) entries.push_back({range.label, "#009e73", Kind::range});
  for (const PlotLimit& limit : plot.limits)
    if (!limit.label.empty() && (limit.value < f.y.low || limit.value > f.y.high))
      entries.push_back({limit.label + " (off the scale)", "#b00020", Kind::note});
  if (!plot.markers.empty() && !plot.marker_label.empty()) entries.push_back({plot.marker_label, "#111", Kind::marker});
  return entries;
}

/// Lays the legend out in rows from (x, y) and tells how many rows it took.
std::pair<std::string, int> draw_legend(const std::vector<LegendEntry>& entries, double left, double right, double y) {
  using Kind = LegendEntry::Kind;
  std::string out;
  double x = left;
  int rows = entries.empty() ? 0 : 1;
  for (const LegendEntry& e : entries) {
    const double symbol = e.kind == Kind::note ? 0.0 : 26.0, width = symbol + text_width(e.label) + 16.0;
    if (x + width > right && x > left) {
      x = left;
      y += kLegendRow;
      ++rows;
    }
    if (e.kind == Kind::line)
      out += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" stroke=\"{}\" stroke-width=\"2.5\"/>", x, y - 4.0, e.colour);
    if (e.kind == Kind::range)
      out +=
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"20\" height=\"10\" fill=\"{}\" fill-opacity=\".18\"/>",
                      x, y - 9.0, e.colour);
    if (e.kind == Kind::marker)
      out += fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" fill=\"#111\"/>", x + 10.0, y - 8.0);
    out += text(x + symbol, y, "start", e.label, e.kind == Kind::note ? " fill=\"#b00020\"" : "");
    x += width;
  }
  return {out, rows};
}

std::vector<double> value_ticks(const Plot& plot) {
  auto [low, high] = data_range(plot);
  const double data_low = low, data_high = high;
  const auto include = [&](double v) {
    if (!fits(v, data_low, data_high)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  };
  for (const PlotLimit& limit : plot.limits) include(limit.value);
  for (const PlotRange& range : plot.ranges) {
    include(range.low);
    include(range.high);
  }
  if (high - low < 1e-9 * std::max({1.0, std::abs(low), std::abs(high)})) {
    const double room = std::max(1e-3, 0.05 * std::abs(high));  // a constant line: give it an axis to stand on
    low -= room;
    high += room;
  }
  return nice_ticks(low, high, 5);
}

}  // namespace

std::vector<double> nice_ticks(double low, double high, int wanted) {
  const double rough = (high - low) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= rough * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  const long first = static_cast<long>(std::floor(low / step + 1e-9));
  const long last = static_cast<long>(std::ceil(high / step - 1e-9));
  std::vector<double> ticks;
  for (long i = first; i <= std::max(last, first + 1); ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::vector<std::pair<double, double>> thin_out(const PlotLine& line, double low, double high, int columns) {
  std::vector<std::pair<double, double>> points;
  const std::size_t n = std::min(line.time.size(), line.value.size());
  const auto point = [&](std::size_t i) { points.emplace_back(line.time[i], line.value[i]); };
  if (n <= static_cast<std::size_t>(2 * columns)) {
    for (std::size_t i = 0; i < n; ++i)
      if (line.time[i] >= low && line.time[i] <= high) point(i);
    return points;
  }
  const auto column_of = [&](std::size_t i) {
    return static_cast<long>((line.time[i] - low) / (high - low) * columns);
  };
  for (std::size_t i = 0; i < n;) {
    if (line.time[i] < low || line.time[i] > high || !std::isfinite(line.value[i])) {
      if (line.time[i] >= low && line.time[i] <= high) points.emplace_back(line.time[i], std::nan(""));
      ++i;
      continue;
    }
    const std::size_t first = i;
    std::size_t lowest = i, highest = i, last = i;
    for (; i < n && line.time[i] <= high && column_of(i) == column_of(first) && std::isfinite(line.value[i]); ++i) {
      if (line.value[i] < line.value[lowest]) lowest = i;
      if (line.value[i] > line.value[highest]) highest = i;
      last = i;
    }
    std::array<std::size_t, 4> kept = {first, std::min(lowest, highest), std::max(lowest, highest), last};
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (k == 0 || kept[k] != kept[k - 1]) point(kept[k]);
  }
  return points;
}

std::string draw_plot(const Plot& plot) {
  const std::vector<double> y_ticks = value_ticks(plot);
  const auto [t0, t1] = time_range(plot);
  // The axis title stands clear of the tick labels, however long they are.
  const double power = power_of(y_ticks).first;
  double left = kMarginLeft;
  for (const double v : y_ticks)
    left = std::max(left, kAxisTitle + text_width(tick_label(v / power, (y_ticks[1] - y_ticks[0]) / power)));
  Axes f{left, plot.width - kMarginRight, 0.0, 0.0, {}, {}};
  f.y = {y_ticks.front(), y_ticks.front() + span_of(y_ticks), 1.0, 0.0};
  const auto [legend, rows] = draw_legend(legend_of(plot, f), f.left, f.right, kTitleRow + 13.0);
  f.top = kTitleRow + rows * kLegendRow + 4.0 + (plot.phases.empty() ? 0.0 : kPhaseStrip);
  const double height = plot.height + (rows > 1 ? (rows - 1) * kLegendRow : 0.0);
  f.bottom = height - kMarginBottom - (plot.periods ? kPeriodRow : 0.0);
  f.x = {t0, t1, f.left, f.right};
  f.y.from = f.bottom;
  f.y.to = f.top;

  std::string out = fmt::format(
      "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "font-family=\"system-ui,'Segoe UI',Helvetica,Arial,sans-serif\" font-size=\"{:.0f}\" fill=\"#1c2329\">"
      "<title>{}</title>",
      plot.width, height, kFont, escape_html(plot.title));
  out += draw_phases(plot, f);
  out += draw_axes(plot, f, y_ticks, nice_ticks(t0, t1, 8));
  for (const PlotRange& range : plot.ranges) {
    const double top = std::clamp(f.y(range.high), f.top, f.bottom),
                 bottom = std::clamp(f.y(range.low), f.top, f.bottom);
    if (bottom > top)
      out += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#009e73\" fill-opacity=\".18\"/>",
          f.left, top, f.right - f.left, bottom - top);
  }
  const int columns =
      std::clamp(kPointBudget / (3 * static_cast<int>(std::max<std::size_t>(1, plot.lines.size()))), 60, 680);
  out += "<g transform=\"scale(.1)\" fill=\"none\" stroke-width=\"13\" stroke-linejoin=\"round\">";
  for (std::size_t i = 0; i < plot.lines.size(); ++i)
    out += fmt::format("<path d=\"{}\" stroke=\"{}\"/>", path_of(plot.lines[i], f, columns),
                       kColours[i % kColours.size()]);
  out += "</g>";
  out += draw_limits(plot, f) + draw_markers(plot, f);
  out += text(f.left, 16.0, "start", plot.title, " font-size=\"13.5\" font-weight=\"600\"");
  return out + legend + "</svg>";
}

}  // namespace stillhook
