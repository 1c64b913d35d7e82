// Every metric knows its value in each phase; and the rows that metrics are made of are whole.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include "results/metrics/metric_row.h"
#include "results/summary.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using truth::SyntheticLift;

namespace {

double in_phase(const Metrics& metrics, const std::string& name, const std::string& phase) {
  const Metric* metric = metrics.find(name);
  if (metric)
    for (const PhaseValue& here : metric->by_phase)
      if (here.phase == phase) return here.value;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST_CASE("a metric's value in a phase is that of the phase alone", "[metrics]") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const double rms = std::sqrt(0.5 * (std::pow(SyntheticLift::kSwayX, 2) + std::pow(SyntheticLift::kSwayY, 2)));
  for (const char* phase : {"hoist_up", "turn"}) {
    CAPTURE(phase);
    // The trapezoidal rule over whole periods of a square: exact but for rounding; the drift of the static path adds
    // what its interpolation misses.
    CHECK(in_phase(m, "sway_rms", phase) == Approx(rms).epsilon(1e-3));
    CHECK(in_phase(m, "sway_rms", phase) == m.value(std::string("sway_rms.") + phase));
    CHECK(in_phase(m, "daf.hoist_port", phase) == Approx(1.0 + SyntheticLift::kDynamicPort).epsilon(1e-3));
    CHECK(in_phase(m, "heel_max", phase) == Approx(SyntheticLift::kRoll * 180.0 / std::numbers::pi).epsilon(1e-3));
  }
  CHECK(std::isnan(in_phase(m, "sway_rms", "settle")));          // the load does not hang
  CHECK(std::isnan(in_phase(m, "setdown_movement_x", "turn")));  // nor is it set down
  CHECK(in_phase(m, "duration", "hoist_up") == Approx(300.0));
}

TEST_CASE("the whole run's value is that of its phases together", "[metrics]") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  int extremes = 0;
  for (const Metric& metric : m.items) {
    CAPTURE(metric.name);
    const MetricDefinition* definition = metric_definition(metric.name);
    REQUIRE(definition != nullptr);
    const MetricRow& row = metric_row(definition->name);
    if (row.element == MetricElement::phase || !row.by_phase) {
      CHECK(metric.by_phase.empty());
      continue;
    }
    REQUIRE_FALSE(metric.by_phase.empty());
    std::vector<double> values;
    for (const PhaseValue& here : metric.by_phase) values.push_back(here.value);
    if (row.over == OverPhases::largest) CHECK(metric.value == *std::max_element(values.begin(), values.end()));
    if (row.over == OverPhases::smallest) CHECK(metric.value == *std::min_element(values.begin(), values.end()));
    extremes += row.over != OverPhases::all_at_once ? 1 : 0;
    if (metric.name == "duration" || metric.name == "rehits" || metric.name == "event_timeouts")
      CHECK(metric.value == Approx(std::accumulate(values.begin(), values.end(), 0.0)));
  }
  CHECK(extremes > 20);
}

TEST_CASE("every row of the catalogue is whole", "[metrics]") {
  std::set<std::string> names;
  for (const auto& family : metric_families())
    for (const MetricRow& row : family) {
      CAPTURE(row.name);
      CHECK(names.insert(row.name).second);
      CHECK_FALSE(row.description.empty());
      CHECK(row.channels != nullptr);
      CHECK(row.value != nullptr);
      CHECK((row.name.find('%') != std::string::npos) == (row.element != MetricElement::none));
      CHECK(row.kind.empty() == (row.element != MetricElement::entry));
    }
}

TEST_CASE("summary.json carries the values by phase and gives them back", "[metrics][summary]") {
  const SyntheticLift lift;
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  const std::string path = (std::filesystem::temp_directory_path() / "stillhook_by_phase_summary.json").string();
  write_summary(summarise(lift.specification, lift.trajectory, metrics, {}), path);
  const Summary read = read_summary(path);
  std::filesystem::remove(path);
  REQUIRE(read.metrics.items.size() == metrics.items.size());
  for (std::size_t i = 0; i < metrics.items.size(); ++i) {
    CAPTURE(metrics.items[i].name);
    const Metric* back = read.metrics.find(metrics.items[i].name);
    REQUIRE(back != nullptr);
    REQUIRE(back->by_phase.size() == metrics.items[i].by_phase.size());
    for (std::size_t k = 0; k < back->by_phase.size(); ++k) {
      CHECK(back->by_phase[k].phase == metrics.items[i].by_phase[k].phase);
      CHECK(back->by_phase[k].value == metrics.items[i].by_phase[k].value);
    }
  }
}
