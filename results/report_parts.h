// The parts of the report, each a piece of HTML. Used by report*.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/plot.h"
#include "results/report.h"
#include "results/run_view.h"
#include "results/scene.h"

namespace stillhook {

/// A plot over time of the report.
struct ReportFigure {
  std::string group;  // the heading it stands under
  Plot plot;
  std::string caption;
};

/// The plots of a run, every one with the phases shaded and the limits that apply drawn in; empty without samples.
std::vector<ReportFigure> report_figures(const ReportData& data, const RunView& view);  // report_plots.cpp

/// The contacts that a report lists; the rest is in history.nc.
inline constexpr std::size_t kShownContacts = 400;

/// "re-hit", "set-down", ...
std::string contact_kind(const ReportData& data, const ContactEvent& contact);  // report_tables.cpp

/// The same as an element that the viewer turns into a way to jump there.
std::string event_time(double seconds);

/// A time of one scenario of a plan: a way to jump there if it is the one that the replay shows. report_tables.cpp
std::string time_in(const ReportData& data, const std::string& scenario, double seconds);

/// A table in a box that scrolls sideways when the page is narrow. Cells are HTML already; the first of a row is its
/// heading. `numeric_from`: first column set flush right; -1 for none.
std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                       int numeric_from = 1);
/// A table with its title above and its note below; cells are escaped. report.cpp
std::string table_html(const ReportTable& table, int numeric_from = 1);
std::string html_section(const std::string& id, const std::string& title, const std::string& body);

enum class LiftPlace { onshore, inshore, offshore };

/// Dynamic amplification factor by 0027/ND rev 11.2, Table 5-1, for a gross weight and a static hook load in t; NaN
/// below 3 t.
double tabulated_daf(LiftPlace place, double weight, double static_hook_load);

std::string report_style();  // report_style.cpp
/// Everything before <body>. `title` is HTML already. report.cpp
std::string page_head(const std::string& title, const std::string& program_version, bool with_viewer,
                      const std::string& more_style = "");
/// The place of the 3-D replay, or why there is none, and the timeline. report_verdict.cpp
std::string replay_part(const ReportData& data, bool with_viewer);
std::string verdict_part(const ReportData& data);                     // report_verdict.cpp
std::string basis_part(const ReportData& data);                       // report_basis.cpp
std::string loads_part(const ReportData& data, const RunView& view);  // report_loads.cpp
std::string sensitivity_part(const SensitivityTable& table);          // report_tradeoffs.cpp
std::string pareto_part(const ParetoFront& front);
std::string limits_part(const ReportData& data);  // report_tables.cpp
std::string metrics_part(const ReportData& data);
std::string contacts_part(const ReportData& data);
std::string procedure_part(const ReportData& data, const RunView& view);  // report_procedure.cpp
std::string poses_part(const ReportData& data, const Scene& scene);
std::string assumptions_part(const ReportData& data);
std::string plots_part(const std::vector<ReportFigure>& figures);  // report_plots.cpp
std::string search_part(const SearchSection& search);              // report_search.cpp
}  // namespace stillhook
