// summary.json: the result of a verb for programs to read. Its keys are documented in docs/summary.md.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "results/limits.h"
#include "results/metrics.h"

namespace stillhook {

/// The objective of a search at the case as given, at the plan found and at the best of a random search with the same
/// number of evaluations. NaN = not there.
struct ObjectiveSummary {
  double baseline = std::numeric_limits<double>::quiet_NaN();
  double plan = std::numeric_limits<double>::quiet_NaN();
  double random_search = std::numeric_limits<double>::quiet_NaN();
};

/// What a search did.
struct SearchSummary {
  std::string algorithm;
  int evaluations = 0;
  double simulation_equivalents = 0.0;  // simulations of whole operations, scenarios and gradients counted
  int seed = 0;
};

/// A design variable of a search, in the unit of its case key.
struct VariableSummary {
  std::string name;
  double lower = std::numeric_limits<double>::quiet_NaN(), upper = std::numeric_limits<double>::quiet_NaN();
  double baseline = std::numeric_limits<double>::quiet_NaN(), plan = std::numeric_limits<double>::quiet_NaN();
};

/// A mean over fresh conditions with its 90 % interval.
struct MeanSummary {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

/// What a plan promises in conditions that its search has not seen.
struct CertificateSummary {
  struct Limit {
    std::string name;
    int broken = 0, baseline_broken = 0;
    double share_at_most = 1.0, allowed = 0.0;  // 95 % bound of the share that breaks it; share allowed
  };
  struct Term {
    std::string name, unit;
    MeanSummary plan, baseline;
  };
  int conditions = 0, completed = 0, baseline_completed = 0;
  MeanSummary plan, baseline, improvement;  // of the objective; improvement: paired
  std::vector<Term> terms;
  std::vector<Limit> limits;
};

/// A front between two metrics; values in the metrics' units.
struct ParetoSummary {
  struct Point {
    double first = std::numeric_limits<double>::quiet_NaN(), second = std::numeric_limits<double>::quiet_NaN();
    bool on_front = false, within_limits = false;
    std::vector<double> variables;  // as in Summary::variables
  };
  std::string first, second;
  std::vector<Point> points;
};

struct Summary {
  static constexpr int kSchemaVersion = 1;
  std::string case_name, verb, sea;  // sea: name of the sea state
  std::string program_version;
  std::string date;  // when the run was made, "2026-03-01 14:05 UTC"; given by the program that runs it, never reckoned
  RunStatus status = RunStatus::not_run;
  std::string message;
  double simulated = std::numeric_limits<double>::quiet_NaN();  // s
  double wall = std::numeric_limits<double>::quiet_NaN();       // s
  Metrics metrics;
  std::vector<LimitCheck> limits;
  std::optional<ObjectiveSummary> objective;  // searches
  std::optional<SearchSummary> search;
  std::vector<VariableSummary> variables;
  std::optional<CertificateSummary> certificate;
  std::optional<ParetoSummary> pareto;
  std::vector<std::string> warnings;  // what must be known before the numbers are used, one sentence each
};

/// "completed", "interrupted", "diverged", "failed", "not_run".
std::string status_name(RunStatus status);

/// Status, times, metrics and limits of one run.
Summary summarise(const Specification& specification, const Trajectory& trajectory, const Metrics& metrics,
                  const std::vector<LimitCheck>& limits);

/// The document as text, keys in a fixed order, numbers in the shortest form that reads back to the same double; NaN
/// and infinities become null.
std::string summary_json(const Summary& summary);

/// Reads a file that write_summary() has written: what concerns the run, that is everything but what a search
/// adds. null becomes NaN. Throws FileError that names the file and what is missing or wrong in it.
Summary read_summary(const std::string& path);

/// Writes summary_json() to a file, whole or not at all. Throws FileError.
void write_summary(const Summary& summary, const std::string& path);

}  // namespace stillhook
