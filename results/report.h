// report.html: the document of a run or of a search. One file, no request to anything outside it; readable on a
// telephone, with or without its script, and printable on A4. Units are the operator's (tonnes, m/min, degrees):
// conversion from SI happens here.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "results/document_control.h"
#include "results/limits.h"
#include "results/metrics.h"

namespace stillhook {

/// A table made elsewhere (hydrostatics, natural periods, parameter estimates), shown as it is.
struct ReportTable {
  std::string title, note;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // the first cell names the row
};

/// A value of the case and where it comes from.
struct BasisEntry {
  std::string key;  // with its unit, "bodies.load.mass_t"
  std::string value, source;
};

/// How the metrics change with the design variables at the plan: derivatives in the metric's unit per unit of the
/// variable's key.
struct SensitivityTable {
  struct Column {
    std::string metric, unit;
  };
  struct Row {
    std::string key;
    double range = std::numeric_limits<double>::quiet_NaN();  // upper - lower bound, in the key's unit
    std::vector<double> derivative;                           // one a column; NaN: not known
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::string note;  // how they were found, one sentence
};

/// Two metrics that cannot both be had, and the plans between which there is only a choice.
struct ParetoFront {
  struct Point {
    double x = std::numeric_limits<double>::quiet_NaN(), y = std::numeric_limits<double>::quiet_NaN();
    bool on_front = false, feasible = true;
    std::string label;  // of a point to be named, may be empty
  };
  std::string metric_x, unit_x, metric_y, unit_y;
  std::vector<Point> points;
};

/// What a search found, in plain data.
struct SearchSection {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  /// One term of the objective: contribution = weight * value / scale.
  struct Term {
    std::string metric, unit;
    double weight = 1.0, scale = 1.0;
    double baseline_value = kNone, plan_value = kNone;
    double baseline_contribution = kNone, plan_contribution = kNone;
  };
  /// A design variable, in the unit of its case key.
  struct Variable {
    std::string key;
    double lower = kNone, upper = kNone, baseline = kNone, plan = kNone;
  };
  /// One evaluation, in the order they were made.
  struct Point {
    double objective = kNone;
    bool feasible = false;
  };

  std::string algorithm, status;  // status: how the search ended, as a sentence
  int evaluations = 0, seed = 0;
  double simulation_equivalents = 0.0;
  double wall = kNone;  // s
  double baseline_objective = kNone, plan_objective = kNone, random_objective = kNone;
  bool baseline_feasible = false, plan_feasible = false, random_feasible = false;
  std::vector<Term> terms;
  std::vector<Variable> variables;
  std::vector<LimitCheck> baseline_limits, plan_limits;  // same order, worst scenario of each
  std::vector<Point> history, random_history;
  std::vector<std::string> scenarios;  // one sentence each
  std::string shown;                   // of several: the name of the one that the histories are of
  std::optional<SensitivityTable> sensitivities = {};
  std::optional<ParetoFront> pareto = {};
  /// What fresh conditions say of the plan, for the first screen; empty = it was not tried in any.
  std::string certificate = {};
  bool certificate_kept = true;  // every hard limit, as far as its case allows
};

struct ReportData {
  std::string title;
  std::string statement;  // the problem in words
  std::string case_text;  // the case as resolved, TOML
  std::string program_version;
  const Specification& specification;
  const Trajectory& trajectory;  // of the plan, for a search
  const Metrics& metrics;
  const std::vector<LimitCheck>& limits;
  std::vector<std::string> notes;  // assumptions and deviations, one sentence each
  std::vector<StaticPose> poses;   // the poses the case asks to report
  std::vector<ReportTable> tables;
  const SearchSection* search = nullptr;
  std::vector<std::string> warnings = {};  // what must be known before the results are used, one sentence each
  std::vector<BasisEntry> basis = {};      // every value of the case, in its order
  DocumentControl control = {};
  std::optional<double> north = {};  // rad, true north from +x, counter-clockwise
};

/// The whole page.
std::string report_html(const ReportData& data);

/// Writes report_html() to a file, whole or not at all. Throws std::runtime_error.
void write_report(const ReportData& data, const std::string& path);

}  // namespace stillhook
