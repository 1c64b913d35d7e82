#include "planner/verbs/fit/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "planner/report_page.h"
#include "planner/text_number.h"
#include "results/html.h"
#include "results/plot.h"
#include "results/quantity.h"

namespace stillhook {
namespace {

std::string figure(const Plot& plot) {
  return "<figure><div class=\"scroll\" tabindex=\"0\">" + draw_plot(plot) + "</div></figure>";
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v /= factor;
  return values;
}

std::string history_plot(const RecordFit& record, const ChannelFit& c) {
  const ShownUnit unit = shown_unit(c.unit);
  Plot plot;
  plot.title = record.name + ": " + c.channel;
  plot.y_label = c.channel + ", " + unit.name;
  plot.lines = {{"measured", record.time, scaled(c.measured, unit.factor)},
                {"with the fit", record.time, scaled(c.after, unit.factor)},
                {"at the start values", record.time, scaled(c.before, unit.factor)}};
  return figure(plot);
}

std::vector<double> residual(const ChannelFit& c) {
  std::vector<double> r(c.measured.size());
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = c.measured[i] - c.after[i];
  return r;
}

std::string residual_plot(const RecordFit& record, const ChannelFit& c) {
  const ShownUnit unit = shown_unit(c.unit);
  Plot plot;
  plot.title = record.name + ": residuals of " + c.channel;
  plot.y_label = "residual, " + unit.name;
  plot.lines = {{"residual", record.time, scaled(residual(c), unit.factor)}};
  plot.height = 170.0;
  return figure(plot);
}

/// One-sided power spectrum of the residuals by Welch's method: Hann windows half over one another, gaps as zeros.
PlotLine spectrum(const RecordFit& record, const ChannelFit& c) {
  std::vector<double> r = scaled(residual(c), shown_unit(c.unit).factor);
  for (double& v : r)
    if (std::isnan(v)) v = 0.0;
  std::size_t length = 32;
  while (length * 8 < r.size()) length *= 2;
  PlotLine line{"residual", {}, {}};
  if (r.size() < length) return line;
  std::vector<double> power(length / 2 + 1, 0.0), piece(length);
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  int pieces = 0;
  for (std::size_t first = 0; first + length <= r.size(); first += length / 2, ++pieces) {
    for (std::size_t i = 0; i < length; ++i)
      piece[i] = r[first + i] *
                 (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length)));
    fft.fwd(transform, piece);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(transform[k]);
  }
  const double step = 2.0 * std::numbers::pi / (record.interval * static_cast<double>(length));  // rad/s
  // The window's power is 3/8; the sum of S step over all lines is the variance.
  const double scale = 2.0 / (0.375 * std::pow(static_cast<double>(length), 2) * pieces * step);
  for (std::size_t k = 1; k < power.size(); ++k) {
    line.time.push_back(step * static_cast<double>(k));
    line.value.push_back(scale * power[k]);
  }
  return line;
}

std::string spectrum_plot(const RecordFit& record, const ChannelFit& c) {
  Plot plot;
  plot.lines = {spectrum(record, c)};
  if (plot.lines[0].time.size() < 4) return {};
  const std::string unit = shown_unit(c.unit).name;
  plot.title = record.name + ": spectrum of the residuals of " + c.channel;
  plot.x_label = "frequency, rad/s";
  plot.periods = true;
  plot.y_label = "(" + unit + ")² s/rad";
  plot.height = 190.0;
  return figure(plot);
}

PlotLine pq_points(const std::string& label, const DecayLine& line, double factor) {
  std::vector<DecayCycle> cycles = line.cycles;
  std::sort(cycles.begin(), cycles.end(), [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  PlotLine points{label, {}, {}};
  for (const DecayCycle& cycle : cycles) {
    points.time.push_back(cycle.amplitude / factor);
    points.value.push_back(cycle.decrement);
  }
  return points;
}

std::string pq_plot(const RecordFit& record, const DecayComparison& d) {
  if (!d.measured.usable()) return {};
  std::string si;
  for (const ChannelFit& c : record.channels)
    if (c.channel == d.channel) si = c.unit;
  const ShownUnit unit = shown_unit(si);
  Plot plot;
  plot.title = record.name + ": p-q plot of " + d.channel;
  plot.x_label = "mean amplitude, " + unit.name;
  plot.y_label = "decrement of a cycle";
  plot.lines = {pq_points("measured", d.measured, unit.factor)};
  PlotLine straight{"p + q A", {0.0, plot.lines[0].time.back()}, {}};
  for (const double A : straight.time) straight.value.push_back(d.measured.p + d.measured.q * A * unit.factor);
  plot.lines.push_back(straight);
  if (d.simulated.usable()) plot.lines.push_back(pq_points("with the fit", d.simulated, unit.factor));
  plot.height = 200.0;
  return figure(plot);
}

std::string record_html(const RecordFit& record) {
  std::string out = fmt::format("<p>{}: {} rows, samples every {} s.</p>", escape_html(record.file), record.rows,
                                short_number(record.interval));
  if (!record.own.empty()) {
    ReportTable own;
    own.title = "Its own unknowns";
    own.header = {"what", "unit", "estimate", "sd"};
    for (const OwnEstimate& o : record.own) {
      const ShownUnit unit = shown_unit(o.unit);
      own.rows.push_back({o.name, unit.name, short_number(o.value / unit.factor), short_number(o.sd / unit.factor)});
    }
    out += table_html(own);
  }
  if (record.kind == FitRecordSpec::Kind::constant) {
    ReportTable values;
    values.title = "At rest";
    values.header = {"channel", "unit", "measured", "with the fit", "at the start values"};
    for (const ChannelFit& c : record.channels) {
      const ShownUnit unit = shown_unit(c.unit);
      values.rows.push_back({c.channel, unit.name, short_number(c.measured[0] / unit.factor),
                             short_number(c.after[0] / unit.factor), short_number(c.before[0] / unit.factor)});
    }
    return out + table_html(values);
  }
  for (const ChannelFit& c : record.channels)
    out += history_plot(record, c) + residual_plot(record, c) + spectrum_plot(record, c);
  for (const DecayComparison& d : record.decays) out += pq_plot(record, d);
  return out;
}

std::string correlation_html(const Identification& result) {
  ReportTable t;
  t.title = "Correlation of the estimates";
  t.note = fmt::format("Above {} in size two parameters are hardly told apart.", kTooAlike);
  t.header = {""};
  for (std::size_t i = 0; i < result.estimates.size(); ++i) t.header.push_back(std::to_string(i + 1));
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    t.rows.push_back({fmt::format("{} {}", i + 1, result.estimates[i].spec.key)});
    for (std::size_t j = 0; j < result.estimates.size(); ++j)
      t.rows.back().push_back(cell(result.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), 3));
  }
  return table_html(t);
}

std::string head(const Identification& result) {
  return fmt::format("<div class=\"verdict{}\" role=\"status\"><strong>{}</strong><p>{} iterations, {} simulations with "
                     "derivatives, {}.</p></div>",
                     !result.trusted ? " fail" : result.warnings.empty() ? "" : " warn", escape_html(verdict_of(result)),
                     result.iterations, result.simulations, duration_text(result.wall)) +
         warnings_html(result.warnings);
}

}  // namespace

std::string fit_report(const Case& c, const Identification& result, const std::vector<std::string>& files,
                       const DocumentControl& control) {
  ReportPage page;
  const auto table_section = [&page](const std::string& id, ReportTable table, int numeric_from, const std::string& more) {
    if (table.rows.empty()) return;
    const std::string title = std::exchange(table.title, "");  // the section's own heading says it
    page.section(id, title, table_html(table, numeric_from) + more);
  };
  table_section("estimates", estimate_table(result), 1, correlation_html(result));
  table_section("residuals", residual_table(result), 1, "");
  table_section("decays", decay_table(result), 2, "");
  table_section("cross", cross_table(result), 1, "");
  for (const RecordFit& record : result.records)
    page.section("record-" + record.name, "Record " + readable_name(record.name), record_html(record));
  std::string notes;
  for (const std::string& note : result.notes) notes += "<li>" + escape_html(note) + "</li>";
  if (!notes.empty()) page.section("data", "What was left out of the data", "<ul>" + notes + "</ul>");
  std::string list;
  for (const std::string& file : files) list += fmt::format("<li><a href=\"{0}\">{0}</a></li>", escape_html(file));
  page.section("files", "Files", "<ul>" + list + "</ul>");
  page.section("case", "Case as resolved",
               "<details><summary>Show the case file</summary><pre tabindex=\"0\">" + escape_html(resolved_text(c)) +
                   "</pre></details>");
  return page.html("Fit of " + (c.title.empty() ? c.name : c.title), "", head(result), c.name, control);
}

}  // namespace stillhook
