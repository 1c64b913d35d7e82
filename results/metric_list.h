// How the metrics are collected: SI values in, catalogue units out, what is not finite left out. Used by metrics*.cpp.
#pragma once

#include <string>

#include "results/metrics.h"
#include "results/run_view.h"

namespace stillhook {

class MetricList {
 public:
  MetricList(const RunView& view, Metrics& metrics) : view_(view), metrics_(metrics) {}

  /// Adds a metric by its catalogue name and, for a name with "%", its element; `value` in SI (rad, N, N s, m, m/s).
  /// The phase is the one at `time` unless it is given. NaN and infinities are dropped: the metric does not apply.
  void add(const std::string& pattern, const std::string& element, double value, double time, std::string phase);
  void add(const std::string& pattern, const std::string& element, const Peak& peak) {
    add(pattern, element, peak.value, peak.time, view_.phase_at(peak.time));
  }
  void add(const std::string& name, const Peak& peak) { add(name, "", peak); }
  void add(const std::string& name, double value) {
    add(name, "", value, std::numeric_limits<double>::quiet_NaN(), "");
  }

 private:
  const RunView& view_;
  Metrics& metrics_;
};

void add_load_motion(const RunView& view, MetricList& list);  // metrics_motion.cpp
void add_sway(const RunView& view, MetricList& list);
void add_set_down_motion(const RunView& view, MetricList& list);
void add_crane_motion(const RunView& view, MetricList& list);
void add_wires(const RunView& view, MetricList& list);  // metrics_gear.cpp
void add_winches(const RunView& view, MetricList& list);
void add_taglines(const RunView& view, MetricList& list);
void add_moorings(const RunView& view, MetricList& list);
void add_contacts(const RunView& view, MetricList& list);  // metrics_contact.cpp
void add_lift_off(const RunView& view, MetricList& list);

}  // namespace stillhook
