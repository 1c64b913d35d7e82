// Numbers that judge a lift, computed from a trajectory. Every metric has a fixed name, unit and sense, and knows
// when and in which phase it was reached; limits, objectives and reports refer to it by name.
//
// Definitions that several metrics share:
//   extremes   come from Trajectory::extremes, which see every step, wherever the metric is an extreme of one channel;
//              extremes of a combination (total hook load, sway, tilt, set-down movement), all means, and leads and
//              slack during load transfer and set-down come from the recorded samples.
//   static     "static" values are interpolated between the static poses at the two ends of a phase, by the progress of
//              the drives that move in it (by time if none does). A pose in which the load still rests on a pickup
//              or target contact is not one of a hanging load: the pose at the phase's other end is then used alone.
//   static load  what a wire (or several together) holds without dynamics, the divisor of the amplification: while the
//              load hangs at both ends of a phase its static tension of the moment; in a phase at whose start or end
//              the load rests (lift-off, set-down) the larger of its static tensions at the two ends; in one at whose
//              both ends it rests the larger of these and of the static tension in the nearest pose in which it hangs.
//   hangs free from lift-off until the first contact with a target, and in every hanging phase.
//   leads      off-lead in, side-lead out of the plane of the boom that holds the wire's upper end (sim/crane_parts.h);
//              heel and trim are those of the vessel under it.
//   sway       mean over the hoist wires of (offset_x, offset_y) minus its static value; horizontal, relative to the
//              boom tips, in the crane vessel's heading.
//   lift-off   the first instant at or after the start of the first `transfer` phase (without one: of the first
//              `hanging` phase) at which no pickup contact has a force; a re-hit is a pickup contact that starts later.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "results/quantity.h"
#include "sim/trajectory.h"

namespace stillhook {

/// What "%" in the name of a metric stands for.
enum class MetricElement {
  none,
  phase,
  wire,
  hoist_wire,
  wire_or_crane,
  hoist_wire_or_crane,
  crane,
  crane_vessel,
  winch,
  clearance,
  entry  // of one kind of force element (specification.h), named by the metric's `kind`
};

/// One entry of the catalogue: what exists, in which unit, and what it means.
struct MetricDefinition {
  std::string name;  // e.g. "daf_total"; "%" stands for an element's name, e.g. "daf.%"
  Quantity quantity = Quantity::ratio;
  std::string unit;  // as reported: "m", "deg", "kN", "kN s", "m/s", "s", "1"
  std::string description;
  MetricElement element = MetricElement::none;
  std::string kind;                 // with MetricElement::entry: the noun of its kind, "mooring"
  bool better_when_larger = false;  // least clearances and slack ratios
};

/// "hoist wire or crane"; empty for a metric that is not of an element.
std::string word_of(const MetricDefinition& definition);

/// The value of a metric in one phase.
struct PhaseValue {
  std::string phase;
  double value = std::numeric_limits<double>::quiet_NaN();  // in the metric's unit
};

struct Metric {
  std::string name;
  std::string unit;
  double value = std::numeric_limits<double>::quiet_NaN();
  double time = std::numeric_limits<double>::quiet_NaN();  // s, when it was reached; NaN if it is not of one instant
  std::string phase;                                       // where it was reached; empty if over all
  std::string scenario;                                    // of a plan in several: the one it is of
  std::vector<PhaseValue> by_phase;                        // in the phases in which it has a value; empty for some
};

class Metrics {
 public:
  RunStatus status = RunStatus::not_run;
  std::string message;  // why, if the run did not complete or no lift would have
  double failed_at = std::numeric_limits<double>::quiet_NaN();  // s, with RunStatus::failed: from then on it is no lift
  std::vector<Metric> items;

  const Metric* find(const std::string& name) const;
  /// Value by name, NaN if absent.
  double value(const std::string& name) const;
};

/// All metrics a report or case may name, with "%" for element names.
const std::vector<MetricDefinition>& metric_catalogue();

/// The definition that `name` (with an element's name in place of "%") belongs to; nullptr if there is none. Looks at
/// the pattern alone, not at which elements exist.
const MetricDefinition* metric_definition(const std::string& name);

/// Every metric name that the elements of this specification allow.
std::vector<std::string> metric_names(const Specification& specification);

/// True if `name` is in the catalogue for the elements of this specification.
bool metric_exists(const std::string& name, const Specification& specification);

/// The element in a metric's name; empty for a metric that is not of one.
std::string element_of(const MetricDefinition& definition, const std::string& name);

/// True for the metrics that want to be large: least clearances and slack ratios.
bool better_when_larger(const std::string& name);

/// How reports write the value of a metric, by its name.
Shown show_metric(const std::string& name, double value);

/// Computes every metric that applies. A run that diverged yields the metrics of the part that ran, with its status.
Metrics compute_metrics(const Specification& specification, const Trajectory& trajectory);

}  // namespace stillhook
