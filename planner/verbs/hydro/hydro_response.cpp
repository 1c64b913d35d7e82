#include "planner/verbs/hydro/hydro_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/modes.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr int kSamples = 120;
constexpr double kLowest = 0.2, kHighest = 2.0;  // rad/s, where no set gives a band

std::vector<double> frequencies_of(const Model& model, double lowest, double highest) {
  std::vector<double> frequencies;
  for (int i = 0; i < kSamples; ++i) frequencies.push_back(lowest + i * (highest - lowest) / (kSamples - 1));
  // Lightly damped peaks are narrower than the step.
  for (const Mode& mode : natural_modes(model, model.initial_state()))
    for (const double off : {0.97, 0.985, 0.995, 1.0, 1.005, 1.015, 1.03})
      if (const double w = off * mode.frequency; w > lowest && w < highest) frequencies.push_back(w);
  std::sort(frequencies.begin(), frequencies.end());
  frequencies.erase(
      std::unique(frequencies.begin(), frequencies.end(), [](double a, double b) { return b - a < 1e-6; }),
      frequencies.end());
  return frequencies;
}

}  // namespace

ResponseCurves response_curves(const Model& model, const std::vector<double>& headings) {
  const Specification& spec = model.specification();
  const LinearResponse linear(model);
  ResponseCurves curves;
  curves.headings = headings;
  const double lowest = linear.lowest_frequency() > 0.0 ? linear.lowest_frequency() : kLowest;
  const double highest = std::isfinite(linear.highest_frequency()) ? linear.highest_frequency() : kHighest;
  if (!(lowest < highest)) return curves;
  curves.frequencies = frequencies_of(model, lowest, highest);
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    if (spec.bodies[i].hull.shape != HullSpec::Shape::none || spec.bodies[i].name == spec.operation.load)
      curves.bodies.push_back({static_cast<int>(i), spec.bodies[i].name, spec.bodies[i].cog, {}});
  const ResponseAmplitude::Vector6c unknown =
      ResponseAmplitude::Vector6c::Constant(std::numeric_limits<double>::quiet_NaN());
  for (BodyResponse& body : curves.bodies)
    body.value.assign(headings.size(), std::vector<ResponseAmplitude::Vector6c>(curves.frequencies.size(), unknown));
  for (std::size_t h = 0; h < headings.size(); ++h)
    for (std::size_t f = 0; f < curves.frequencies.size(); ++f) {
      if (!linear.resolves(curves.frequencies[f], headings[h])) continue;
      const ResponseAmplitude response = linear.at(curves.frequencies[f], headings[h]);
      for (BodyResponse& body : curves.bodies) body.value[h][f] = linear.motion(response, body.body, body.point);
    }
  return curves;
}

std::vector<double> usual_headings(const Model& model) {
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  double yaw = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].hull.shape != HullSpec::Shape::none) {
      yaw = roll_pitch_yaw(model.initial_state().body[i].R_WB).yaw;
      break;
    }
  std::vector<double> headings;
  for (const double relative : {180.0, 135.0, 90.0}) headings.push_back(yaw + relative * kDegree);
  return headings;
}

}  // namespace stillhook
