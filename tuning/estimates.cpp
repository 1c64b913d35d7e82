#include "tuning/estimates.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tuning/size_check.h"
#include "tuning/uncertainty.h"

namespace stillhook {
namespace {

constexpr double kAtBound = 1e-4;      // of the range: nearer is at the bound
constexpr double kNormal95 = 1.959964;
constexpr double kCoupled = 0.3;       // share of a parameter in a direction that the data leave open
constexpr double kNoisy = 2.0;         // residuals up to this many times the sensor's noise are explained by it
constexpr double kPoorPrediction = 2.0;

/// Where each record's own unknowns stand among all.
std::vector<Eigen::Index> own_places(const EstimateInput& in, Eigen::Index& total) {
  std::vector<Eigen::Index> places;
  total = in.values.size();
  for (const VectorX& own : in.own) {
    places.push_back(total);
    total += own.size();
  }
  return places;
}

/// The residuals of every channel of every record, with derivatives by all unknowns.
std::vector<ResidualSeries> residual_series(const EstimateInput& in) {
  Eigen::Index total = 0;
  const std::vector<Eigen::Index> places = own_places(in, total);
  std::vector<ResidualSeries> all;
  for (std::size_t r = 0; r < in.models.size(); ++r) {
    const SampleIndex index = valid_samples(in.models[r].data);
    for (std::size_t k = 0; k < in.models[r].data.channels.size(); ++k) {
      std::vector<Eigen::Index> rows;
      ResidualSeries s;
      for (std::size_t i = 0; i < index.size(); ++i) {
        if (index.channel[i] != static_cast<int>(k)) continue;
        rows.push_back(static_cast<Eigen::Index>(i));
        s.sample.push_back(index.sample[i]);
      }
      s.r = in.units[r].r(rows);
      s.J = MatrixX::Zero(s.r.size(), total);
      s.J.leftCols(in.values.size()) = in.units[r].J[0](rows, Eigen::all);
      if (in.own[r].size() > 0) s.J.middleCols(places[r], in.own[r].size()) = in.units[r].J[1](rows, Eigen::all);
      all.push_back(std::move(s));
    }
  }
  return all;
}

ChannelFit channel_fit(const EstimateInput& in, std::size_t r, std::size_t k, const ResidualSeries& series) {
  const MeasuredChannel& m = in.models[r].data.channels[k];
  ChannelFit f;
  f.channel = m.spec.channel;
  f.unit = m.unit;
  f.measured = f.after = m.value;
  f.before.assign(m.value.size(), std::nan(""));
  f.sigma = in.sigma[r][k];
  f.samples = static_cast<int>(series.r.size());
  f.missing = m.missing;
  f.outliers = m.outliers;
  for (std::size_t i = 0; i < series.sample.size(); ++i)
    f.after[static_cast<std::size_t>(series.sample[i])] += f.sigma * series.r[static_cast<Eigen::Index>(i)];
  double square_before = 0.0;
  if (in.before[r].ok)
    for (std::size_t i = 0; i < f.before.size(); ++i) {
      f.before[i] = in.before[r].value[k][static_cast<Eigen::Index>(i)];
      if (!std::isnan(m.value[i])) square_before += std::pow(f.before[i] - m.value[i], 2);
    }
  f.rms_after = f.sigma * std::sqrt(series.r.squaredNorm() / static_cast<double>(f.samples));
  f.rms_before = in.before[r].ok ? std::sqrt(square_before / f.samples) : std::nan("");
  f.explained = 1.0 - std::pow(f.rms_after / spread_of(m.value), 2);
  f.correlation_time = autocorrelation(series.r, series.sample).time();
  return f;
}

RecordFit record_fit(const EstimateInput& in, std::size_t r) {
  const MeasuredRecord& data = in.models[r].data;
  RecordFit f;
  f.name = data.name;
  f.file = data.file;
  f.kind = data.kind;
  f.time = data.time;
  f.interval = data.interval;
  f.rows = data.rows;
  return f;
}

Prediction as_prediction(const RecordFit& record) {
  Prediction p;
  p.ok = true;
  for (const ChannelFit& channel : record.channels)
    p.value.push_back(Eigen::Map<const VectorX>(channel.after.data(), static_cast<Eigen::Index>(channel.after.size())));
  return p;
}

void warn_open_directions(const Uncertainty& u, Identification& result) {
  const auto n = static_cast<Eigen::Index>(result.estimates.size());
  for (const VectorX& direction : u.open) {
    std::vector<std::string> keys;
    for (Eigen::Index i = 0; i < n; ++i)
      if (std::abs(direction[i]) > kCoupled) keys.push_back(result.estimates[static_cast<std::size_t>(i)].spec.key);
    if (keys.size() < 2) continue;
    std::string names = keys[0];
    for (std::size_t i = 1; i < keys.size(); ++i) names += (i + 1 == keys.size() ? " and " : ", ") + keys[i];
    result.warnings.push_back(fmt::format("{} cannot be told apart at all by these records: {}.", names,
                                          separating_test(keys[0], keys[1])));
  }
}

void warn_estimates(Identification& result) {
  for (const FitEstimate& e : result.estimates) {
    if (e.no_influence)
      result.warnings.push_back(fmt::format("{} is not determined: no record shows it.", e.spec.key));
    else if (e.at_bound)
      result.warnings.push_back(fmt::format("{} is held at its bound {:.6g} and has no interval; the intervals of the "
                                            "others are for this value of it.",
                                            e.spec.key, e.value));
    else if (e.sd > kTooUncertain * std::abs(e.value))
      result.warnings.push_back(fmt::format("{} is poorly known: its standard deviation is {:.0f} % of the estimate.{}",
                                            e.spec.key, 100.0 * e.sd / std::abs(e.value),
                                            influence_of(e.spec.key) == Influence::quadratic_damping
                                                ? " Quadratic damping shows at large amplitudes only: add a decay from "
                                                  "a larger one."
                                                : ""));
  }
  for (const Inseparable& pair : result.inseparable)
    result.warnings.push_back(fmt::format("{} and {} are hardly told apart (correlation {:.3f}): {}.",
                                          result.estimates[static_cast<std::size_t>(pair.a)].spec.key,
                                          result.estimates[static_cast<std::size_t>(pair.b)].spec.key, pair.correlation,
                                          pair.test));
}

}  // namespace

void fill_estimates(const EstimateInput& in, Identification& result) {
  Eigen::Index total = 0;
  const std::vector<Eigen::Index> places = own_places(in, total);
  const std::vector<ResidualSeries> series = residual_series(in);
  const VectorX span = in.parameters.span();
  std::vector<bool> held(static_cast<std::size_t>(total), false);
  MatrixX prior = MatrixX::Zero(total, total);
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    FitEstimate& e = result.estimates[i];
    e.value = in.values[row];
    const double share = (e.value - e.spec.lower) / span[row];
    held[i] = e.at_bound = share < kAtBound || share > 1.0 - kAtBound;
    if (e.spec.prior_sd) prior(row, row) = std::pow(span[row] / *e.spec.prior_sd, 2);
  }
  // A parameter whose whole range moves all records together by less than one standard deviation is not in them.
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double influence = prior(row, row);
    for (const ResidualSeries& s : series) influence += s.J.col(row).squaredNorm();
    if (influence > 1.0) continue;
    FitEstimate& e = result.estimates[i];
    e.no_influence = held[i] = true;
    e.at_bound = false;
    e.value = e.start;  // rounding may have taken it anywhere
  }
  const Uncertainty u = uncertainty_of(series, prior, in.c.fit.robust, held);
  const VectorX sd = u.sd(), white = u.white.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    FitEstimate& e = result.estimates[i];
    e.no_influence = e.no_influence || (u.unknown[i] && !e.at_bound);
    if (e.at_bound || e.no_influence) continue;
    e.sd = sd[row] * span[row];
    e.white_sd = white[row] * span[row];
    e.low = e.value - kNormal95 * e.sd;
    e.high = e.value + kNormal95 * e.sd;
  }
  const auto n = static_cast<Eigen::Index>(result.estimates.size());
  result.correlation = u.correlation().topLeftCorner(n, n);
  std::vector<std::string> keys;
  for (const FitEstimate& e : result.estimates) keys.push_back(e.spec.key);
  result.inseparable = inseparable_pairs(keys, result.correlation);
  std::size_t at = 0;
  for (std::size_t r = 0; r < in.models.size(); ++r) {
    RecordFit fit = record_fit(in, r);
    for (std::size_t k = 0; k < in.models[r].data.channels.size(); ++k)
      fit.channels.push_back(channel_fit(in, r, k, series[at++]));
    for (int i = 0; i < in.models[r].own(); ++i)
      fit.own.push_back({in.models[r].own_name(i), in.models[r].own_unit(i), in.own[r][i], sd[places[r] + i]});
    fit.decays = compare_decays(in.models[r], as_prediction(fit));
    result.records.push_back(std::move(fit));
  }
  warn_open_directions(u, result);
  warn_estimates(result);
}

void judge(const Case& c, Identification& result) {
  result.trusted = true;
  for (const RecordFit& record : result.records) {
    if (record.kind == FitRecordSpec::Kind::constant) continue;
    for (const ChannelFit& channel : record.channels) {
      // Unless the sensor's own noise is what is left.
      const auto spec = std::find_if(c.fit.records.begin(), c.fit.records.end(),
                                     [&](const FitRecordSpec& s) { return s.name == record.name; });
      const bool noise_given = std::any_of(spec->columns.begin(), spec->columns.end(), [&](const FitColumnSpec& column) {
        return column.channel == channel.channel && column.noise;
      });
      if (channel.explained >= c.fit.explained || (noise_given && channel.rms_after < kNoisy * channel.sigma)) continue;
      result.trusted = false;
      result.warnings.push_back(
          fmt::format("The best fit explains {:.0f} % of {} in {}: it is no run of this case, or the clock, the sign or the "
                      "unknowns are others. The estimates mean nothing.",
                      100.0 * std::max(0.0, channel.explained), channel.channel, record.name));
    }
  }
  for (const LeftOut& left : result.cross)
    if (left.ratio > kPoorPrediction)
      result.warnings.push_back(fmt::format("The other records predict {} {:.1f} times worse than the fit to all: the "
                                            "records do not agree about the parameters.",
                                            left.record, left.ratio));
}

}  // namespace stillhook
