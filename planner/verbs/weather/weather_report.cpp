#include "planner/verbs/weather/weather_report.h"

#include <fmt/format.h>

#include <utility>

#include "planner/report_page.h"
#include "planner/verbs/weather/weather_tables.h"
#include "results/html.h"

namespace stillhook {
namespace {

std::string drawn(const std::string& svg) {
  return svg.empty() ? "" : "<figure><div class=\"scroll\" tabindex=\"0\">" + svg + "</div></figure>";
}

/// The section's heading says what the table's title would.
std::string untitled(ReportTable table) {
  table.title.clear();
  return table_html(table);
}

/// Words are flush left.
std::string settings_html(const WeatherTask& task) {
  ReportTable table = settings_table(task);
  table.title.clear();
  return table_html(table, -1);
}

/// A traffic light a phase, told apart by its word and its shape as well as by its colour.
std::string lights(const ForecastStudy& f) {
  std::string out = "<div class=\"lights\">";
  for (const PhaseDecision& d : f.decision.now) {
    const bool later = f.decision.first_start.has_value();
    const char* kind = d.go() ? "go" : later ? "wait" : "no";
    const char* word = d.go() ? "go" : later ? "wait" : "no-go";
    const char* shape = d.go()  ? "<circle cx=\"12\" cy=\"12\" r=\"9\"/>"
                        : later ? "<path d=\"M12 2l10 10-10 10-10-10z\"/>"
                                : "<rect x=\"3\" y=\"3\" width=\"18\" height=\"18\"/>";
    out += fmt::format(
        "<div class=\"light {}\"><svg viewBox=\"0 0 24 24\" aria-hidden=\"true\">{}</svg><b>{}</b> {}</div>", kind,
        shape, escape_html(phase_title(d.phase)), word);
  }
  return out + "</div>";
}

constexpr const char* kWeatherStyle =
    ".lights{display:flex;flex-wrap:wrap;gap:.6rem;margin:.8rem 0}"
    ".light{display:flex;align-items:center;gap:.45rem;border:1px solid var(--line);border-radius:4px;padding:.35rem "
    ".7rem}"
    ".light svg{width:1.3rem;height:1.3rem}"
    ".light.go svg{fill:#00805c}.light.wait svg{fill:#b07000}.light.no svg{fill:#a4001d}";

void add_hindcast_sections(ReportPage& page, const HindcastStudy& h, const OperationLimits& limits) {
  page.section("months", "Workable by month", drawn(months_drawing(h)) + untitled(months_table(h)));
  std::string waits = drawn(waiting_drawing(h)) + untitled(windows_table(h));
  for (const WindowStatistics& w : h.windows) waits += drawn(chances_drawing(h, w)) + table_html(waits_table(h, w));
  page.section("windows", "Weather windows and waits", waits);
  page.section("calms", "How long calms last", drawn(calms_drawing(h)));
  page.section("calendar", "A year by the hour", drawn(calendar_drawing(h)));
  page.section("scatter", "Heights and periods",
               drawn(scatter_drawing(counted(h.record), limits, "Samples in a thousand, by height and period")));
  page.section("samples", "Samples", untitled(states_table(h)));
}

std::string list_html(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += "<li>" + escape_html(item) + "</li>";
  return out.empty() ? "" : "<ul>" + out + "</ul>";
}

constexpr const char* kWeatherMethod =
    "<p>A sample of the record holds from its time to the next. It is workable when its significant wave height does "
    "not exceed "
    "the limit at its peak period and at its heading relative to the bow (bilinear between the given limits; outside "
    "their "
    "periods nothing is workable), and wind and daylight allow it. A window of T is ceil(T/step) workable samples in a "
    "row; a wait "
    "is the time from any sample to the start of the next window. For a forecast, T_R = T_POP + T_C with T_C at least "
    "6 h, and the "
    "height may not exceed OP_WF = alpha OP_LIM at any time at which a phase may happen.</p>";

}  // namespace

std::string weather_report(const WeatherStudy& study, const std::vector<std::string>& files,
                           const DocumentControl& control) {
  ReportPage page;
  const OperationLimits& limits = study.task.limits.limits;
  if (study.forecast) {
    std::string forecast = lights(*study.forecast) + table_html(decision_table(*study.forecast), 2);
    for (std::size_t p = 0; p < study.forecast->decision.phases.size(); ++p)
      forecast += drawn(forecast_drawing(*study.forecast, p));
    page.section("forecast", "Go or no-go", forecast);
  }
  if (study.hindcast) add_hindcast_sections(page, *study.hindcast, limits);
  if (study.scatter)
    page.section(
        "scatter-table", "From the scatter table",
        untitled(scatter_summary_table(*study.scatter)) + drawn(scatter_months_drawing(*study.scatter)) +
            drawn(scatter_drawing(study.scatter->table, limits, "Counts in a thousand, by height and period")));
  page.section("basis", "Basis", settings_html(study.task) + kWeatherMethod);
  page.section("notes", "What the files were taken for", list_html(study.remarks));
  std::string list;
  for (const std::string& file : files) list += fmt::format("<li><a href=\"{0}\">{0}</a></li>", escape_html(file));
  page.section("files", "Files", "<ul>" + list + "</ul>");
  const bool refused = study.forecast && !study.forecast->decision.first_start;
  const std::string head = fmt::format("<div class=\"verdict{}\" role=\"status\"><strong>{}</strong></div>",
                                       refused                  ? " fail"
                                       : study.warnings.empty() ? ""
                                                                : " warn",
                                       escape_html(verdict_of(study))) +
                           warnings_html(study.warnings);
  return page.html("Weather for " + study.task.title, kWeatherStyle, head, study.task.name, control);
}

}  // namespace stillhook
