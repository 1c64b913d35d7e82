// What a metric is: one row that says its name, quantity, element, channels, value and smooth twin. The families of
// rows are the files of this folder; adding a metric is adding a row to one of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "results/metrics.h"
#include "results/metrics/metric_run.h"
#include "results/smooth_metrics.h"

namespace stillhook {

/// The channels that a row reads, collected by name.
class ChannelSet;

/// How a metric's value for the whole run comes from the phases.
enum class OverPhases {
  all_at_once,  // value() is asked with all of them
  largest,      // value() is asked phase by phase; the largest counts
  smallest      // the same with the smallest
};

struct MetricRow {
  std::string name = {};  // "%" stands for an element's name
  Quantity quantity = Quantity::ratio;
  MetricElement element = MetricElement::none;
  std::string kind = {};  // with MetricElement::entry
  std::string description = {};
  OverPhases over = OverPhases::all_at_once;
  bool by_phase = true;  // has a value in each phase; without effect for a metric of a phase
  bool better_when_larger = false;
  /// Adds what value() and smooth() read. Contacts, phases, static poses and the drives' positions belong to every run.
  std::function<void(ChannelSet& channels, const std::string& element)> channels = {};
  /// The value (SI and radians) over some phases, and when it was reached; without value where it does not apply.
  std::function<Peak(MetricRun& run, const std::string& element, const Phases& phases)> value = {};
  /// The smooth counterpart in the metric's unit; without one the metric is taken as it is.
  std::function<std::optional<double>(const RunView& view, const std::string& element, const SmoothOptions& options)>
      smooth = {};
};

/// Every family, in the order of the catalogue. Samples read for one are let go of before the next.
const std::vector<std::vector<MetricRow>>& metric_families();

/// The row of a catalogue name ("daf.%"); throws std::logic_error if there is none.
const MetricRow& metric_row(const std::string& name);

// The families.
std::vector<MetricRow> operation_metrics();
std::vector<MetricRow> load_metrics();
std::vector<MetricRow> sway_metrics();
std::vector<MetricRow> lead_metrics();
std::vector<MetricRow> wire_metrics();
std::vector<MetricRow> winch_metrics();
std::vector<MetricRow> tagline_metrics();
std::vector<MetricRow> mooring_metrics();
std::vector<MetricRow> contact_metrics();
std::vector<MetricRow> lift_off_metrics();
std::vector<MetricRow> set_down_metrics();
std::vector<MetricRow> vessel_metrics();
std::vector<MetricRow> crane_curve_metrics();
std::vector<MetricRow> clearance_metrics();

}  // namespace stillhook
