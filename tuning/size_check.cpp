#include "tuning/size_check.h"

#include <fmt/core.h>

#include <cmath>

#include "tuning/measured_unit.h"

namespace stillhook {
namespace {

constexpr double kFar = 20.0;

void refuse_ratio(const MeasuredRecord& data, const MeasuredChannel& channel, double measured, double expected,
                  const std::string& than) {
  if (channel.spec.trust_unit || !(expected > 0.0) || !(measured > 0.0)) return;
  const double ratio = measured / expected;
  if (ratio < kFar && ratio > 1.0 / kFar) return;
  const std::string mistake = mistaken_unit(ratio, channel.unit);
  if (mistake.empty()) return;
  throw CaseError(fmt::format("{}: column \"{}\" in {} is {:.3g} times {}: {}; if it is right, set trust_unit = true",
                              data.file, channel.spec.column, channel.spec.unit, ratio, than, mistake));
}

/// Root mean square of the slope of a channel's samples.
double slope_spread(const MeasuredRecord& data, const MeasuredChannel& channel) {
  std::vector<double> slopes;
  for (std::size_t i = 1; i + 1 < channel.value.size(); ++i)
    slopes.push_back((channel.value[i + 1] - channel.value[i - 1]) / (data.time[i + 1] - data.time[i - 1]));
  return spread_of(slopes);
}

void compare_rates(const MeasuredRecord& data) {
  const auto& names = start_coordinate_names();
  for (const MeasuredChannel& rate : data.channels)
    for (const MeasuredChannel& angle : data.channels)
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t dot = angle.spec.channel.find_last_of('.');
        const std::string body = angle.spec.channel.substr(0, dot + 1);
        if (angle.spec.channel != body + names[k] || rate.spec.channel != body + names[k + 6]) continue;
        refuse_ratio(data, rate, spread_of(rate.value), slope_spread(data, angle),
                     "the rate at which \"" + angle.spec.column + "\" changes");
      }
}

}  // namespace

double spread_of(const std::vector<double>& values) {
  double n = 0.0, sum = 0.0, square = 0.0;
  for (const double v : values)
    if (!std::isnan(v)) n += 1.0, sum += v;
  const double mean = n > 1.0 ? sum / n : 0.0;
  for (const double v : values)
    if (!std::isnan(v)) square += (v - mean) * (v - mean);
  return n > 0.0 ? std::sqrt(square / n) : 0.0;
}

void refuse_other_units(const RecordModel& model, const Prediction& simulated) {
  const MeasuredRecord& data = model.data;
  if (data.kind != FitRecordSpec::Kind::constant) compare_rates(data);
  if (!simulated.ok) return;
  for (std::size_t k = 0; k < data.channels.size(); ++k) {
    const MeasuredChannel& channel = data.channels[k];
    std::vector<double> z;
    for (std::size_t i = 0; i < channel.value.size(); ++i)
      z.push_back(std::isnan(channel.value[i]) ? channel.value[i] : simulated.value[k][static_cast<Eigen::Index>(i)]);
    refuse_ratio(data, channel, spread_of(channel.value), spread_of(z), "what the model shows");
  }
}

}  // namespace stillhook
