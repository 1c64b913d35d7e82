// The plots of the report, every one with the phases shaded and the limits that apply drawn in.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/channel_plot.h"
#include "results/clearance.h"
#include "results/html.h"
#include "results/report_parts.h"
#include "sim/crane_parts.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"

namespace stillhook {
namespace {

constexpr double kDegrees = 1.0 / kDegree, kTonnes = 1.0 / kTonneForce, kMinutes = 1.0 / kPerMinute;

class Plots {
 public:
  Plots(const ReportData& data, const RunView& view) : data_(data), view_(view) {
    for (const PhaseRecord& p : data.trajectory.phases) phases_.push_back({readable_name(p.name), p.start, p.end});
  }

  Plot make(const std::string& title, const std::string& y_label) const {
    Plot plot;
    plot.title = title;
    plot.y_label = y_label;
    plot.phases = phases_;
    return plot;
  }

  /// Adds a channel if it was recorded.
  void line(Plot& plot, const std::string& channel, const std::string& label, double factor) const {
    const auto values = view_.series(channel);
    if (values.empty()) return;
    PlotLine l{label, data_.trajectory.time, {values.begin(), values.end()}};
    for (double& v : l.value) v *= factor;
    plot.lines.push_back(std::move(l));
  }

  /// The static value of a channel along the run, one point every few seconds.
  void static_line(Plot& plot, const std::string& channel, const std::string& label, double factor) const {
    PlotLine l{label, {}, {}};
    for (std::size_t p = 0; p < data_.trajectory.phases.size(); ++p) {
      const PhaseRecord& phase = data_.trajectory.phases[p];
      const int steps = std::max(2, static_cast<int>((phase.end - phase.start) / 5.0));
      for (int i = 0; i <= steps; ++i) {
        const double t = phase.start + (phase.end - phase.start) * i / steps;
        l.time.push_back(t);
        l.value.push_back(factor * view_.planned_at(p, t, channel));
      }
    }
    if (std::any_of(l.value.begin(), l.value.end(), [](double v) { return std::isfinite(v); }))
      plot.lines.push_back(std::move(l));
  }

  /// Draws the limits on `metric`, on both sides of zero if the metric is a magnitude.
  void limit(Plot& plot, const std::string& metric, double factor, const std::string& unit, bool both_sides) const {
    for (const LimitCheck& c : data_.limits) {
      if (c.metric != metric) continue;
      const double value = factor * c.limit;
      plot.limits.push_back({fmt::format("limit {}{} {}", both_sides ? "±" : "", readable_number(value), unit), value});
      if (both_sides) plot.limits.push_back({"", -value});
    }
  }

  void contacts(Plot& plot) const {
    const double start = data_.trajectory.phases.empty() ? 0.0 : data_.trajectory.phases.front().start;
    for (const ContactEvent& c : data_.trajectory.contacts)
      if (c.start > start && plot.markers.size() < 200) plot.markers.push_back({c.start, ""});
    plot.marker_label = "contact";
  }

  /// Starts a new heading.
  void group(const std::string& title) { group_ = title; }
  const std::string& group() const { return group_; }
  /// Keeps a plot that shows something.
  void add(Plot plot, const std::string& caption = "") {
    const auto shows = [](const PlotLine& line) {
      return std::any_of(line.value.begin(), line.value.end(), [](double v) { return std::isfinite(v); });
    };
    std::erase_if(plot.lines, [&](const PlotLine& line) { return !shows(line); });
    if (!plot.lines.empty()) figures_.push_back({group_, std::move(plot), caption});
  }
  std::vector<ReportFigure> take() { return std::move(figures_); }

 private:
  const ReportData& data_;
  const RunView& view_;
  std::vector<PlotPhase> phases_;
  std::string group_;
  std::vector<ReportFigure> figures_;
};

void load_plots(const ReportData& data, Plots& plots) {
  const std::string& load = data.specification.operation.load;
  for (const auto& [axis, title] : {std::pair{body_channels::x, "Load, fore and aft (x)"},
                                    {body_channels::y, "Load, athwart (y)"},
                                    {body_channels::z, "Load, height (z)"}}) {
    Plot plot = plots.make(title, "position, m");
    plots.line(plot, axis.of(load), "load", 1.0);
    plots.static_line(plot, axis.of(load), "calm water", 1.0);
    plots.contacts(plot);
    plots.add(std::move(plot));
  }
  for (const auto& [axis, title] : {std::pair{body_channels::roll, "Load, roll"},
                                    {body_channels::pitch, "Load, pitch"},
                                    {body_channels::yaw, "Load, yaw"}}) {
    Plot plot = plots.make(title, "angle, °");
    plot.height = 210.0;
    plots.line(plot, axis.of(load), "load", kDegrees);
    plots.add(std::move(plot));
  }
}

/// Hoist wire tensions with the band from static tension to the DAF limit.
void hoist_plot(const ReportData& data, const RunView& view, Plots& plots) {
  Plot plot = plots.make("Hoist wire tensions", "tension, t");
  double static_sum = 0.0, limit = std::numeric_limits<double>::quiet_NaN();
  int count = 0;
  for (const WireSpec& wire : data.specification.wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    plots.line(plot, wire_channels::tension.of(wire), readable_name(wire.name), kTonnes);
    for (std::size_t p : view.phases_of({PhaseSpec::Stage::hanging})) {
      const double at_rest = view.static_at(p, data.trajectory.phases[p].end, wire_channels::tension.of(wire));
      if (!std::isfinite(at_rest)) continue;
      static_sum += at_rest;
      ++count;
    }
  }
  for (const LimitCheck& c : data.limits)
    if (c.metric.starts_with("daf") && c.is_max && !(limit <= c.limit)) limit = c.limit;
  if (count > 0 && std::isfinite(limit)) {
    const double at_rest = kTonnes * static_sum / count;
    plot.ranges.push_back({fmt::format("static to DAF {}", readable_number(limit)), at_rest, at_rest * limit});
  }
  plots.contacts(plot);
  plots.add(std::move(plot),
            "The band reaches from the mean static tension of a fall while hanging to that tension times the "
            "smallest DAF limit.");
}

/// Breaks the lines of hoist wire angles where the wire is slack: its direction means nothing there.
void blank_slack(const ReportData& data, const RunView& view, Plot& plot) {
  for (const WireSpec& wire : data.specification.wires) {
    const auto tension = view.series(wire_channels::tension.of(wire));
    for (PlotLine& line : plot.lines) {
      if (line.label != readable_name(wire.name) || tension.size() != line.value.size()) continue;
      for (std::size_t i = 0; i < tension.size(); ++i)
        if (tension[i] <= 0.0) line.value[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void wire_plots(const ReportData& data, const RunView& view, Plots& plots) {
  hoist_plot(data, view, plots);
  Plot other = plots.make("Luffing, stay and other wires", "tension, t");
  for (const WireSpec& wire : data.specification.wires)
    if (wire.role != WireSpec::Role::hoist)
      plots.line(other, wire_channels::tension.of(wire), readable_name(wire.name), kTonnes);
  plots.add(std::move(other));
  Plot rates = plots.make("Winch rates (hauling in positive)", "rate, m/min");
  for (const DriveSpec& drive : data.specification.drives)
    if (drive.kind == DriveSpec::Kind::winch)
      plots.line(rates, drive_channels::rate.of(drive), readable_name(drive.name), kMinutes);
  plots.add(std::move(rates));
  for (const auto& [quantity, title, metric] :
       {std::tuple{wire_channels::off_lead, "Off-lead of the hoist wires", "offlead_max"},
        {wire_channels::side_lead, "Side-lead of the hoist wires", "sidelead_max"}}) {
    Plot lead = plots.make(title, "angle, °");
    for (const WireSpec& wire : data.specification.wires)
      if (wire.role == WireSpec::Role::hoist) plots.line(lead, quantity.of(wire), readable_name(wire.name), kDegrees);
    blank_slack(data, view, lead);
    plots.limit(lead, metric, 1.0, "°", true);
    plots.add(std::move(lead));
  }
}

void line_plots(const ReportData& data, Plots& plots) {
  Plot tension = plots.make("Tagline tensions", "tension, t"),
       speed = plots.make("Tagline line speeds (paying out positive)", "speed, m/min");
  bool speed_limited = false;
  for (const TaglineSpec& line : data.specification.taglines) {
    plots.line(tension, tagline_channels::tension.of(line), readable_name(line.name), kTonnes);
    plots.line(speed, tagline_channels::line_speed.of(line), readable_name(line.name), kMinutes);
    if (line.speed_max > 0.0 && !speed_limited) {
      speed.limits.push_back({fmt::format("winch limit ±{} m/min", readable_number(kMinutes * line.speed_max)),
                              kMinutes * line.speed_max});
      speed.limits.push_back({"", -kMinutes * line.speed_max});
      speed_limited = true;
    }
  }
  plots.limit(tension, "tagline_tension_max", 1000.0 * kTonnes, "t", false);
  plots.add(std::move(tension));
  plots.add(std::move(speed));
}

/// What the kinds of force elements have to show under a heading.
void element_plots(const ReportData& data, Plots& plots) {
  for_each_element_kind([&](const auto& kind) {
    for (const ChannelPlot& channel : channel_plots(kind.tag())) {
      if (channel.group != plots.group()) continue;
      Plot plot = plots.make(channel.title, channel.axis);
      for (const auto& entry : data.specification.*kind.entries)
        plots.line(plot, channel.channel(entry.name), readable_name(entry.name), channel.per_si);
      plots.add(std::move(plot));
    }
  });
}

void geometry_plots(const ReportData& data, Plots& plots) {
  Plot clearance = plots.make("Clearances", "distance, m");
  double shown_limit = std::numeric_limits<double>::quiet_NaN();
  for (ClearanceSeries& series : compute_clearances(data.specification, data.trajectory)) {
    if (series.time.empty()) continue;
    for (const LimitCheck& c : data.limits)
      if (c.metric == "clearance_min." + series.name && c.limit != shown_limit) {
        clearance.limits.push_back(
            {fmt::format("{} at least {} m", readable_name(series.name), readable_number(c.limit)), c.limit});
        shown_limit = c.limit;
      }
    clearance.lines.push_back({readable_name(series.name), std::move(series.time), std::move(series.distance)});
  }
  plots.add(std::move(clearance));
  const std::vector<std::string> vessels = crane_vessels(data.specification);
  for (const auto& [quantity, title, metric] :
       {std::tuple{body_channels::roll, "Heel of the crane", "heel_max"},
        {body_channels::pitch, "Trim of the crane (bow down positive)", "trim_max"}}) {
    Plot plot = plots.make(title, "angle, °");
    plot.height = 210.0;
    for (const std::string& vessel : vessels) {
      const std::string of = vessels.size() > 1 ? readable_name(vessel) + " " : "";
      plots.line(plot, quantity.of(vessel), of + "in waves", kDegrees);
      plots.static_line(plot, quantity.of(vessel), of + "calm water", kDegrees);
    }
    plots.limit(plot, metric, 1.0, "°", true);
    plots.add(std::move(plot));
  }
  Plot contact = plots.make("Contact forces", "normal force, t");
  for (const ContactSpec& spec : data.specification.contacts)
    plots.line(contact, contact_channels::force.of(spec), readable_name(spec.name), kTonnes);
  plots.contacts(contact);
  plots.add(std::move(contact));
}

}  // namespace

std::vector<ReportFigure> report_figures(const ReportData& data, const RunView& view) {
  if (data.trajectory.time.size() < 2) return {};
  Plots plots(data, view);
  plots.group("Load");
  load_plots(data, plots);
  element_plots(data, plots);
  plots.group("Wires and winches");
  wire_plots(data, view, plots);
  element_plots(data, plots);
  plots.group("Taglines and moorings");
  line_plots(data, plots);
  element_plots(data, plots);
  plots.group("Geometry, vessel and contact");
  geometry_plots(data, plots);
  element_plots(data, plots);
  plots.group("Wind and water");
  element_plots(data, plots);
  return plots.take();
}

std::string plots_part(const std::vector<ReportFigure>& figures) {
  if (figures.empty()) return "<p>No samples were recorded.</p>";
  std::string out, group;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const ReportFigure& figure = figures[i];
    if (figure.group != group) out += "<h3>" + figure.group + "</h3>";
    group = figure.group;
    out += fmt::format("<figure data-plot=\"{}\"><div class=\"scroll\" tabindex=\"0\">{}</div>{}</figure>", i,
                       draw_plot(figure.plot),
                       figure.caption.empty() ? "" : "<figcaption>" + figure.caption + "</figcaption>");
  }
  return out;
}

}  // namespace stillhook
