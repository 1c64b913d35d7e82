// What the gradient stage sees of a run: every metric of the catalogue from the channels that are kept for it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "results/smooth_metrics.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using truth::SyntheticLift;

namespace {

/// The run with some of its channels alone.
Trajectory with_channels(const Trajectory& run, const std::vector<std::string>& names) {
  Trajectory part = run;
  part.channels.clear();
  part.values.clear();
  for (auto& phase : part.extremes) phase.clear();
  for (const std::string& name : names) {
    const int c = run.find(name);
    if (c < 0) continue;
    const std::size_t k = static_cast<std::size_t>(c);
    part.channels.push_back(run.channels[k]);
    part.values.push_back(run.values[k]);
    for (std::size_t p = 0; p < run.extremes.size(); ++p) part.extremes[p].push_back(run.extremes[p][k]);
  }
  return part;
}

}  // namespace

TEST_CASE("every metric has its value on a run reduced to its channels", "[metrics][smooth]") {
  const SyntheticLift lift;
  const Metrics whole = compute_metrics(lift.specification, lift.trajectory);
  std::vector<std::string> without;
  for (const std::string& name : metric_names(lift.specification)) {
    CAPTURE(name);
    const Trajectory reduced = with_channels(lift.trajectory, channels_of_metric(lift.specification, name));
    const double there = compute_metrics(lift.specification, reduced).value(name);
    if (whole.find(name)) {
      CHECK(there == whole.value(name));  // from the same numbers in the same order
    } else {
      CHECK(std::isnan(there));
      without.push_back(name);
    }
    const auto smooth = smooth_metric(lift.specification, lift.trajectory, name, {}),
               smooth_there = smooth_metric(lift.specification, reduced, name, {});
    CHECK(smooth.has_value() == smooth_there.has_value());
    if (smooth) CHECK(std::isfinite(*smooth));
    if (smooth && name.starts_with("sway_")) CHECK(whole.find(name) != nullptr);  // none where nothing swings
    if (smooth && smooth_there) CHECK(*smooth == *smooth_there);
  }
  // Only swing where nothing hangs, the line that is not active and the crane's use have none in this lift: the crane has no
  // capacity curve (tests/problems/crane_curve_test.cpp has one).
  for (const std::string& name : without) {
    CAPTURE(name);
    CHECK((name.starts_with("sway_") || name.starts_with("crane_utilisation_max") ||
           name == "tagline_saturated.tag_starboard"));
  }
}

TEST_CASE("a smooth metric is near the one it stands for", "[metrics][smooth]") {
  const SyntheticLift lift;
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  SmoothOptions sharp;
  sharp.sharpness = 400.0;
  int compared = 0;
  for (const std::string& name : metric_names(lift.specification)) {
    if (name == "rehits" || name == "tagline_saturated") continue;  // an impulse and a logistic share stand for these
    const auto smooth = smooth_metric(lift.specification, lift.trajectory, name, sharp);
    if (!smooth || !metrics.find(name)) continue;
    CAPTURE(name, *smooth, metrics.value(name));
    // A log-sum-exp lies under the peak by ln(N)/s of the range, N the share of time near it: 6/400 of at most the
    // peak; windows that end between samples move an rms by one sample in a thousand.
    CHECK(*smooth == Approx(metrics.value(name)).epsilon(0.02));
    ++compared;
  }
  CHECK(compared >= 10);
}
