// A case: everything one TOML document asks for. Lift, limits, the plan to search for and the fit to measured runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "problems/fit_spec.h"
#include "problems/weather_spec.h"
#include "results/limits.h"
#include "sim/error.h"
#include "sim/lifting/rigging.h"
#include "sim/operation.h"
#include "sim/specification.h"

namespace stillhook {

/// One term of the objective: weight * metric / scale.
struct ObjectiveTerm {
  std::string metric;
  double weight = 1.0;
  double scale = 1.0;  // in the metric's unit: the size of a unit step, makes terms comparable
};

/// A case key that the search may change. Bounds in the unit of the key.
struct VariableSpec {
  std::string key;  // e.g. "taglines.*.kp_kN_per_deg" or "operation.phases.hoist_up.moves.hoist.speed_m_per_min"
  double lower = 0.0, upper = 0.0;
  bool logarithmic = false;
  std::optional<double> start;  // of a second point that the search begins from; absent: the case's own value
};

/// One condition that a plan is evaluated in: a sea state with changes.
struct ScenarioSpec {
  std::string name;
  std::string sea;                // name of a sea state
  std::optional<double> heading;  // rad
  std::optional<double> phase;    // rad, regular waves
  std::optional<int> seed;        // irregular waves
  int seeds = 1;                  // irregular waves: that many, from `seed` on
  int phases = 1;                 // regular waves: that many, evenly spaced from `phase` on
  double weight = 1.0;
};

/// The front between two metrics, of which both are better when smaller.
struct ParetoSpec {
  std::string first, second;  // empty = no front
  int points = 5;             // its two ends included
  int evaluations = 12;       // for each point
};

struct PlanSpec {
  enum class Aggregate { mean, worst, tail };
  std::vector<ObjectiveTerm> objective;
  std::vector<VariableSpec> variables;
  std::vector<ScenarioSpec> scenarios;
  Aggregate aggregate = Aggregate::mean;   // of the objective over scenarios; limits hold in every scenario
  double tail_share = 0.2;                 // tail: mean of this worst share of the scenarios, in (0, 1]
  std::string global_algorithm = "isres";  // NLopt names, lower case, as in the docs
  std::string local_algorithm = "cobyla";
  double global_share = 0.5;                // of the evaluations
  int evaluations = 60;                     // budget
  std::string gradient_algorithm = "none";  // first stage, on the smooth problem with exact gradients
  int gradient_evaluations = 12;            // points with gradient
  bool random_search = true;                // beside the search, with as many evaluations
  int certify = 0;  // fresh seeds or phases for each scenario that the finished plan is tried in
  ParetoSpec pareto;
  double time_budget = 0.0;  // s of wall time, 0 = none (a time budget gives up reproducibility)
  int seed = 1;
  OperationPart part;  // of the operation that is simulated; not of the case file
};

/// Tuning of tagline gains: the plan's objective and limits over few variables.
struct TuneSpec {
  std::vector<VariableSpec> variables;  // empty = Kp and Kd of all taglines together
  std::string algorithm = "auto";       // with gradients where they are valid
  int evaluations = 20;                 // points
  std::string phase;                    // this phase alone; empty = the whole operation
  std::string pose;                     // instead: at rest at the end of this phase, for `hold`
  double hold = 300.0;                  // s
  bool schedule = false;                // factors on the gains over the fall length as well
  int map = 0;                          // points along each side of a map of the objective over the first two variables
};

/// --set KEY=VALUE: a dotted key, with the names of array entries as steps and "*" for all of them, and a TOML value.
struct Override {
  std::string key;
  std::string value;
};

struct Node;  // problems/case_document.h

struct Case {
  std::string name;
  std::string title;
  std::string project, revision, author, checked_by;  // head and foot of reports; empty = not given
  std::optional<double> north;  // rad, true north from +x, counter-clockwise; of reports and the replay
  std::string directory;        // of the case file; relative file names start here
  Specification specification;  // with the bodies and wires of the rigging
  std::vector<RiggingSpec> rigging;
  std::vector<LimitSpec> limits;
  PlanSpec plan;
  TuneSpec tune;
  FitSpec fit;
  WeatherSpec weather;
  std::shared_ptr<const Node> document;  // as used: the file plus every --set; names files by absolute paths
  std::string file;                      // what messages call the case file
  std::string text;                      // the file as it was read ...
  std::vector<Override> overrides;       // ... and what was set on top
};

/// Bad input: what, where, which rule, which value. what() is the whole sentence, e.g.
/// "calm.toml:2:1: [sea] tp_s: must be > 0 s, got -3".
class CaseError : public Error {
 public:
  using Error::Error;
};

/// Reads and checks a case file. Throws CaseError; collects every error it can (up to 20) before throwing, one per
/// line.
Case read_case(const std::string& path, const std::vector<Override>& overrides = {});

/// The same from text; `name` stands for the file in messages, `directory` for its folder.
Case read_case_text(const std::string& text, const std::string& name, const std::string& directory,
                    const std::vector<Override>& overrides = {});

/// Settings of `stillhook weather` without a case: defaults with `overrides` on top, all of them of the section
/// weather. File names start at `directory`. Throws CaseError.
WeatherSpec read_weather_settings(const std::string& directory, const std::vector<Override>& overrides);

/// The document as used, as TOML text that can be read from any folder.
std::string resolved_text(const Case& c);

/// Value of a numeric key in its own unit, as read or by default. With "*", all must be equal.
double key_value(const Case& c, const std::string& key);

/// Unit of a numeric key, as in messages: "kN/m"; empty for a pure number. Throws CaseError for a key that does not
/// exist.
std::string key_unit(const Case& c, const std::string& key);

/// The error that build_model() found, as a sentence about the case: with the place of the entry and field it names, as
/// far as the case has them.
CaseError located(const Case& c, const SpecificationError& error);

/// The case with numeric keys changed (values in the keys' units) and checked again. No text is read or written.
Case with_values(const Case& c, const std::vector<std::pair<std::string, double>>& values);

}  // namespace stillhook
