// Limits, metrics and contacts as tables.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/html.h"
#include "results/report_parts.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr std::size_t kShortCell = 14;  // bytes: a number with its unit

std::string cell(const std::string& name, double value) {
  const Shown shown = show_metric(name, value);
  std::string text = shown.value + (shown.unit.empty() || shown.value == "–" ? "" : "\u00a0" + shown.unit);
  if (!shown.aside.empty()) text += " <small>(" + shown.aside + ")</small>";
  return text;
}

/// When, and in which scenario where there are several.
std::string when(const ReportData& data, const std::string& scenario, double time) {
  std::string text = std::isfinite(time) ? time_in(data, scenario, time) : "–";
  if (!scenario.empty()) text += " <small>(" + escape_html(scenario) + ")</small>";
  return text;
}

std::string phase_cell(const std::string& phase) { return phase.empty() ? "–" : escape_html(readable_name(phase)); }

/// Metrics of one kind of element: a row an element, a column a quantity.
std::string element_table(const ReportData& data, const char* title, const std::vector<MetricElement>& kinds,
                          const std::string& noun = {}) {
  std::vector<const MetricDefinition*> columns;
  std::vector<std::string> elements;
  for (const MetricDefinition& d : metric_catalogue()) {
    if (std::find(kinds.begin(), kinds.end(), d.element) == kinds.end() || d.kind != noun) continue;
    bool used = false;
    for (const Metric& m : data.metrics.items) {
      if (metric_definition(m.name) != &d) continue;
      used = true;
      const std::string element = m.name.substr(d.name.find('%'));
      if (std::find(elements.begin(), elements.end(), element) == elements.end()) elements.push_back(element);
    }
    if (used) columns.push_back(&d);
  }
  if (columns.empty()) return {};
  std::vector<std::string> header = {""};
  for (const MetricDefinition* d : columns)
    header.push_back(fmt::format("<span title=\"{}\">{}</span>{}", escape_html(d->description),
                                 escape_html(readable_name(d->name.substr(0, d->name.find('%') - 1))),
                                 d->unit == "1" ? "" : ",<br>" + d->unit));
  std::vector<std::vector<std::string>> rows;
  for (const std::string& element : elements) {
    rows.push_back({escape_html(readable_name(element))});
    for (const MetricDefinition* d : columns) {
      const std::string name = d->name.substr(0, d->name.find('%')) + element;
      const Shown shown = show_metric(name, data.metrics.value(name));
      rows.back().push_back(shown.value + (shown.aside.empty() ? "" : "<br><small>" + shown.aside + "</small>"));
    }
  }
  return fmt::format("<h3>{}</h3>{}", title, html_table(header, rows));
}

}  // namespace

std::string event_time(double time) {
  return fmt::format("<span data-time=\"{:.3f}\">{}</span>", time, clock_time(time));
}

std::string time_in(const ReportData& data, const std::string& scenario, double seconds) {
  const bool here = scenario.empty() || !data.search || data.search->shown == scenario;
  return here ? event_time(seconds) : clock_time(seconds);
}

std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                       int numeric_from) {
  const auto numeric = [&](std::size_t i) { return numeric_from >= 0 && static_cast<int>(i) >= numeric_from; };
  const auto cls = [&](std::size_t i) { return numeric(i) ? " class=\"n\"" : ""; };
  const auto cell_class = [&](std::size_t i, const std::string& cell) {
    return numeric(i) && cell.size() > kShortCell && cell.find(' ') != std::string::npos
               ? " class=\"n wide\""
               : cls(i);  // an interval, a sentence: it may wrap
  };
  std::string out = "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>";
  for (std::size_t i = 0; i < header.size(); ++i) out += fmt::format("<th scope=\"col\"{}>{}</th>", cls(i), header[i]);
  out += "</tr></thead><tbody>";
  for (const std::vector<std::string>& row : rows) {
    if (row.size() == 1 && header.size() > 1) {  // a heading within the table
      out += fmt::format("<tr class=\"group\"><th colspan=\"{}\">{}</th></tr>", header.size(), row[0]);
      continue;
    }
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      out += i == 0 ? "<th scope=\"row\">" + row[i] + "</th>"
                    : fmt::format("<td{}>{}</td>", cell_class(i, row[i]), row[i]);
    out += "</tr>";
  }
  return out + "</tbody></table></div>";
}

std::string html_section(const std::string& id, const std::string& title, const std::string& body) {
  if (body.empty()) return {};
  return fmt::format("<section id=\"{}\"><h2>{}</h2>{}</section>", id, title, body);
}

std::string limits_part(const ReportData& data) {
  if (data.limits.empty()) return "<p>The case sets no limits.</p>";
  std::vector<std::vector<std::string>> rows;
  for (const LimitCheck& c : data.limits) {
    const char* verdict = c.pass   ? "<span class=\"pass\">✓ kept</span>"
                          : c.hard ? "<span class=\"fail\">✗ broken</span>"
                                   : "<span class=\"warn\">! warning</span>";
    const std::string use = limit_use_text(c);
    rows.push_back(
        {escape_html(c.metric), cell(c.metric, c.value), (c.is_max ? "≤\u00a0" : "≥\u00a0") + cell(c.metric, c.limit),
         show_metric(c.metric, c.margin).value + (use.empty() ? "" : " <small>(" + use + ")</small>"), verdict,
         when(data, c.scenario, c.time), phase_cell(c.phase), c.source.empty() ? "case" : escape_html(c.source)});
  }
  return html_table({"criterion", "value", "limit", "margin", "verdict", "reached at", "phase", "source of the limit"},
                    rows, -1);
}

std::string metrics_part(const ReportData& data) {
  std::vector<std::vector<std::string>> rows;
  for (const Metric& m : data.metrics.items) {
    const MetricDefinition* d = metric_definition(m.name);
    if (!d || d->element != MetricElement::none) continue;
    rows.push_back({escape_html(m.name), cell(m.name, m.value), when(data, m.scenario, m.time), phase_cell(m.phase),
                    escape_html(d->description)});
  }
  std::string out =
      "<h3>Over the operation</h3>" + html_table({"metric", "value", "reached at", "phase", "meaning"}, rows, -1);
  out += element_table(data, "Motion of the load by phase", {MetricElement::phase});
  out += element_table(data, "Wires",
                       {MetricElement::wire, MetricElement::hoist_wire, MetricElement::hoist_wire_or_crane,
                        MetricElement::wire_or_crane});
  out += element_table(data, "Cranes", {MetricElement::crane, MetricElement::crane_vessel});
  out += element_table(data, "Winches", {MetricElement::winch});
  for_each_element_kind(
      [&](const auto& kind) { out += element_table(data, kind.title, {MetricElement::entry}, kind.noun); });
  out += element_table(data, "Clearances", {MetricElement::clearance});
  return out;
}

std::string contact_kind(const ReportData& data, const ContactEvent& contact) {
  const double run_start = data.trajectory.phases.empty() ? 0.0 : data.trajectory.phases.front().start;
  if (contact.start <= run_start) return "at rest at the start";
  if (contact.role == ContactSpec::Role::target) return "set-down";
  if (contact.role == ContactSpec::Role::other) return "contact";
  return contact.start > data.metrics.value("lift_off_time") ? "re-hit" : "before lift-off";
}

std::string contacts_part(const ReportData& data) {
  const std::vector<ContactEvent>& contacts = data.trajectory.contacts;
  if (contacts.empty()) return "<p>Nothing touched.</p>";
  std::vector<std::vector<std::string>> rows;
  for (const ContactEvent& c : contacts) {
    if (rows.size() == kShownContacts) break;
    const std::string kind = contact_kind(data, c);
    rows.push_back({escape_html(readable_name(c.contact)),
                    kind == "re-hit" ? "<span class=\"fail\">re-hit</span>" : kind, event_time(c.start),
                    fixed_number(c.end - c.start, 1), fixed_number(c.approach_speed, 3),
                    fixed_number(c.peak_force / 1000.0 / kStandardGravity, 1), fixed_number(c.impulse / 1000.0, 1),
                    fmt::format("{}, {}, {}", fixed_number(c.place.x(), 2), fixed_number(c.place.y(), 2),
                                fixed_number(c.place.z(), 2)),
                    phase_cell(c.phase)});
  }
  std::string out = html_table({"contact", "kind", "time", "length, s", "approach speed, m/s", "peak force, t",
                                "impulse, kN s", "place x, y, z, m", "phase"},
                               rows, -1);
  if (contacts.size() > kShownContacts)
    out += fmt::format("<p><small>The first {} of {} contacts; all are in history.nc.</small></p>", kShownContacts,
                       contacts.size());
  return out;
}

}  // namespace stillhook
