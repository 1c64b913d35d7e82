// The metrics of one run while they are computed: values of rows, and what several rows share, each worked out once.
#pragma once

#include <any>
#include <map>
#include <string>
#include <vector>

#include "results/run_view.h"

namespace stillhook {

struct MetricRow;

using Phases = std::vector<std::size_t>;  // indices of phases, ascending

class MetricRun {
 public:
  /// Keeps a reference: the view must outlive it.
  explicit MetricRun(const RunView& view) : view_(view) {}

  const RunView& view() const { return view_; }
  const Specification& specification() const { return view_.specification(); }

  /// A row's value (SI) in one phase, over some phases as the row combines them, or over the whole run.
  Peak in(const MetricRow& row, const std::string& element, std::size_t phase);
  Peak over(const MetricRow& row, const std::string& element, const Phases& phases);
  Peak whole(const MetricRow& row, const std::string& element) { return over(row, element, view_.all_phases()); }

  /// The largest, or smallest, of another row among elements.
  Peak largest_of(const std::string& row, const std::vector<std::string>& elements, const Phases& phases);
  Peak smallest_of(const std::string& row, const std::vector<std::string>& elements, const Phases& phases);

  /// Makes a value the first time that it is asked for. One key belongs to one type.
  template <class Make>
  const auto& once(const std::string& key, Make make) {
    using T = decltype(make());
    std::any& place = made_[key];
    if (!place.has_value()) place = make();
    return *std::any_cast<T>(&place);
  }

  /// True if these are all phases of the run.
  bool all(const Phases& phases) const { return phases.size() == view_.all_phases().size(); }

  /// Lets go of samples and of what was made of them; values stay.
  void forget();

 private:
  const RunView& view_;
  std::map<std::string, std::any> made_;
  std::map<std::string, Peak> values_;  // by row, element and phase
};

/// The phases that have one of these stages.
Phases with_stage(const RunView& view, const Phases& phases, std::initializer_list<PhaseSpec::Stage> stages);

}  // namespace stillhook
