#include "results/grid_chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "results/html.h"
#include "results/svg.h"

namespace stillhook {
namespace {

constexpr std::array<const char*, 4> kGridLines = {"#a4001d", "#111111", "#806000", "#aa4499"};

/// White to dark blue; text on it is dark or white.
struct Shade {
  std::string fill;
  const char* ink;
};
Shade shade_of(double part) {
  const double p = std::clamp(part, 0.0, 1.0);
  const auto mix = [&](int light, int dark) { return static_cast<int>(std::lround(light + p * (dark - light))); };
  return {fmt::format("#{:02x}{:02x}{:02x}", mix(255, 8), mix(255, 64), mix(255, 129)),
          p > 0.55 ? "#ffffff" : "#1c2329"};
}

struct GridFrame {
  double left, top, right, bottom, column, row;
};

std::string grid_cells(const GridChart& chart, const GridFrame& f) {
  double most = chart.darkest;
  for (const auto& row : chart.values)
    for (const double v : row)
      if (chart.darkest == 0.0 && std::isfinite(v)) most = std::max(most, v);
  std::string out;
  for (std::size_t r = 0; r < chart.values.size(); ++r)
    for (std::size_t c = 0; c < chart.values[r].size(); ++c) {
      const double value = chart.values[r][c];
      if (!std::isfinite(value)) continue;
      const double x = f.left + static_cast<double>(c) * f.column, y = f.bottom - static_cast<double>(r + 1) * f.row;
      const Shade shade = shade_of(most > 0.0 ? value / most : 0.0);
      out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>", x, y,
                         f.column, f.row, shade.fill);
      if (r < chart.texts.size() && c < chart.texts[r].size())
        out += svg_text(x + 0.5 * f.column, y + 0.5 * f.row + 4.0, "middle", chart.texts[r][c],
                        fmt::format(" font-size=\"10.5\" fill=\"{}\"", shade.ink));
    }
  return out;
}

std::string grid_labels(const GridChart& chart, const GridFrame& f) {
  std::string out;
  const double shift = chart.labels_at_edges ? 0.0 : 0.5;
  for (std::size_t c = 0; c < chart.columns.size(); ++c)
    out += svg_text(f.left + (static_cast<double>(c) + shift) * f.column, f.bottom + 15.0, "middle", chart.columns[c]);
  for (std::size_t r = 0; r < chart.rows.size(); ++r)
    out += svg_text(f.left - 6.0, f.bottom - (static_cast<double>(r) + shift) * f.row + 4.0, "end", chart.rows[r]);
  out += svg_text(0.5 * (f.left + f.right), f.bottom + 31.0, "middle", chart.x_label);
  out += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                     0.5 * (f.top + f.bottom), escape_html(chart.y_label));
  return out + fmt::format(
                   "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
                   "stroke=\"#3d4852\"/>",
                   f.left, f.top, f.right - f.left, f.bottom - f.top);
}

std::string grid_lines(const GridChart& chart, const GridFrame& f) {
  std::string out;
  double x = f.left;
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const GridChart::Line& line = chart.lines[i];
    const std::string look =
        fmt::format(" fill=\"none\" stroke=\"{}\" stroke-width=\"2.2\"{}", kGridLines[i % kGridLines.size()],
                    line.dashed ? " stroke-dasharray=\"7 4\"" : "");
    std::string path;
    bool down = false;
    for (const auto& [c, r] : line.points) {
      const bool inside = std::isfinite(c) && std::isfinite(r);
      if (inside)
        path += fmt::format("{}{:.1f} {:.1f}", down ? "L" : "M", f.left + c * f.column,
                            std::clamp(f.bottom - r * f.row, f.top, f.bottom));
      down = inside;
    }
    out += fmt::format("<path d=\"{}\"{}/>", path, look);
    out += fmt::format("<path d=\"M{:.1f} 32h20\"{}/>", x, look) + svg_text(x + 26.0, 36.0, "start", line.label);
    x += 44.0 + svg_text_width(line.label);
  }
  return out;
}

}  // namespace

std::string draw_grid_chart(const GridChart& chart) {
  double widest = 0.0;
  for (const std::string& label : chart.rows) widest = std::max(widest, svg_text_width(label));
  GridFrame f{};
  f.left = 30.0 + widest;
  f.right = chart.width - 14.0;
  f.top = chart.lines.empty() ? 26.0 : 46.0;
  f.row = chart.cell_height;
  f.bottom = f.top + f.row * static_cast<double>(chart.rows.size());
  f.column = (f.right - f.left) / static_cast<double>(std::max<std::size_t>(1, chart.columns.size()));
  return svg_begin(chart.width, f.bottom + 38.0, chart.title) + grid_cells(chart, f) + grid_labels(chart, f) +
         grid_lines(chart, f) + "</svg>";
}

}  // namespace stillhook
