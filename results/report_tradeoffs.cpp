// What moves what: derivatives of the metrics to the design variables, and the front between two of them.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/html.h"
#include "results/report_parts.h"

namespace stillhook {
namespace {

/// Change of a metric over the whole range of a variable.
double effect(const SensitivityTable::Row& row, std::size_t column) {
  return column < row.derivative.size() ? row.derivative[column] * row.range : std::numeric_limits<double>::quiet_NaN();
}

struct Axis {
  std::vector<double> ticks;
  double from, to;  // user units
  double operator()(double v) const {
    return from + (v - ticks.front()) / (ticks.back() - ticks.front()) * (to - from);
  }
};

Axis axis_of(const std::vector<ParetoFront::Point>& points, double ParetoFront::Point::*value, double from, double to) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ParetoFront::Point& p : points)
    if (std::isfinite(p.x) && std::isfinite(p.y)) {
      low = std::min(low, p.*value);
      high = std::max(high, p.*value);
    }
  if (high - low < 1e-9 * std::max(1.0, std::abs(high))) {
    const double room = std::max(1e-3, 0.05 * std::abs(high));
    low -= room;
    high += room;
  }
  return {nice_ticks(low, high, 5), from, to};
}

std::string axis_name(const std::string& metric, const std::string& unit) {
  return escape_html(readable_name(metric) + (unit.empty() || unit == "1" ? "" : ", " + unit));
}

std::string grid(const Axis& x, const Axis& y, const ParetoFront& front) {
  std::string out;
  for (const double v : y.ticks)
    out += fmt::format(
        "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#d4dae0\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{}</text>",
        x.from, y(v), x.to, x.from - 7.0, y(v) + 4.0, readable_number(v));
  for (const double v : x.ticks)
    out += fmt::format(
        "<path d=\"M{:.1f} {:.1f}v5\" stroke=\"#3d4852\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"middle\">{}</text>",
        x(v), y.from, x(v), y.from + 18.0, readable_number(v));
  out += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" fill=\"none\" stroke=\"#3d4852\"/>", x.from, y.to,
                     y.from, x.to);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", 0.5 * (x.from + x.to),
                     y.from + 36.0, axis_name(front.metric_x, front.unit_x));
  return out + fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                           0.5 * (y.from + y.to), axis_name(front.metric_y, front.unit_y));
}

}  // namespace

std::string sensitivity_part(const SensitivityTable& table) {
  if (table.rows.empty() || table.columns.empty()) return {};
  std::vector<std::string> header = {"case key"};
  std::vector<double> largest(table.columns.size(), 0.0);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const SensitivityTable::Column& column = table.columns[c];
    header.push_back(escape_html(column.metric) +
                     (column.unit.empty() || column.unit == "1" ? "" : ", " + escape_html(column.unit)));
    for (const SensitivityTable::Row& row : table.rows)
      if (const double e = std::abs(effect(row, c)); std::isfinite(e)) largest[c] = std::max(largest[c], e);
  }
  std::vector<std::vector<std::string>> rows;
  for (const SensitivityTable::Row& row : table.rows) {
    rows.push_back({"<code>" + escape_html(row.key) + "</code>"});
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const double value = c < row.derivative.size() ? row.derivative[c] : std::numeric_limits<double>::quiet_NaN();
      const double e = std::abs(effect(row, c));
      const bool strongest = std::isfinite(e) && e > 0.0 && e >= 0.999 * largest[c];
      rows.back().push_back(strongest ? "<b>" + readable_number(value, 3) + "</b>" : readable_number(value, 3));
    }
  }
  std::string out = "<h3>What moves what at the plan</h3>" + html_table(header, rows);
  out +=
      "<p><small>Change of the metric, in its unit, per unit of the key. Bold: the variable that moves the metric most "
      "over its whole range.";
  if (!table.note.empty()) out += " " + escape_html(table.note);
  return out + "</small></p>";
}

std::string pareto_part(const ParetoFront& front) {
  std::vector<ParetoFront::Point> points;
  for (const ParetoFront::Point& p : front.points)
    if (std::isfinite(p.x) && std::isfinite(p.y)) points.push_back(p);
  if (points.empty()) return {};
  const Axis x = axis_of(points, &ParetoFront::Point::x, 66.0, 740.0);
  const Axis y = axis_of(points, &ParetoFront::Point::y, 300.0, 34.0);
  std::string dots, labels;
  std::vector<const ParetoFront::Point*> on_front;
  for (const ParetoFront::Point& p : points) {
    const char* fill = p.on_front ? "#0072b2" : "#fff";
    const char* stroke = p.on_front ? "#0072b2" : p.feasible ? "#5b6672" : "#b00020";
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>",
                        x(p.x), y(p.y), p.on_front ? 5 : 3.5, fill, stroke);
    if (!p.label.empty()) {
      const bool left = x(p.x) > 560.0;
      labels += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" stroke=\"#fff\" stroke-width=\"3\" "
          "paint-order=\"stroke\">{}</text>",
          x(p.x) + (left ? -9.0 : 9.0), y(p.y) - 6.0, left ? "end" : "start", escape_html(p.label));
    }
    if (p.on_front) on_front.push_back(&p);
  }
  std::sort(on_front.begin(), on_front.end(), [](auto* a, auto* b) { return a->x < b->x; });
  std::string path;
  for (const ParetoFront::Point* p : on_front)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(p->x), y(p->y));
  return fmt::format(
      "<h3>Choice between {} and {}</h3><figure><div class=\"scroll\" tabindex=\"0\"><svg class=\"plot\" "
      "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 345\" role=\"img\" "
      "font-family=\"system-ui,'Segoe UI',Helvetica,Arial,sans-serif\" font-size=\"12\" fill=\"#1c2329\"><title>Pareto "
      "front</title>{}<path d=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>{}{}</svg></div>"
      "<figcaption>Filled: plans that no other beats in both. Hollow: plans that are beaten; red ones break a "
      "limit.</figcaption></figure>",
      escape_html(readable_name(front.metric_x)), escape_html(readable_name(front.metric_y)), grid(x, y, front), path,
      dots, labels);
}

}  // namespace stillhook
