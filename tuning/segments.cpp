#include "tuning/segments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace stillhook {
namespace {

constexpr std::size_t kFewestSamples = 10;  // of a segment

/// A measured channel about time t: level and slope of the samples near it; NaN without any.
std::pair<double, double> level_and_slope(const MeasuredRecord& data, const MeasuredChannel& channel, double t) {
  double n = 0.0, s = 0.0, ss = 0.0, x = 0.0, sx = 0.0;
  for (std::size_t i = 0; i < data.time.size(); ++i) {
    const double away = data.time[i] - t;
    if (std::abs(away) > 3.0 * data.interval || std::isnan(channel.value[i])) continue;
    n += 1.0, s += away, ss += away * away, x += channel.value[i], sx += away * channel.value[i];
  }
  const double det = n * ss - s * s;
  if (n < 3.0 || !(det > 0.0)) return {std::nan(""), std::nan("")};
  const double slope = (n * sx - s * x) / det;
  return {(x - slope * s) / n, slope};
}

/// The state with the positions, attitudes and rates that are measured at its time.
SystemState as_measured(const SystemState& state, const Specification& spec, const MeasuredRecord& data) {
  SystemState s = state;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    BodyKinematics& k = s.body[b];
    const Vector3& cog = spec.bodies[b].cog;
    Vector3 origin = k.p_WC - k.R_WB * cog, velocity = k.v_WC - k.R_WB * k.w_B.cross(cog);
    RollPitchYaw angles = roll_pitch_yaw(k.R_WB);
    double* const angle[3] = {&angles.roll, &angles.pitch, &angles.yaw};
    bool known_rate[6] = {};
    for (const bool rates : {true, false})  // measured rates go before slopes of positions
      for (const MeasuredChannel& channel : data.channels)
        for (int c = 0; c < kStartCoordinates; ++c) {
          if ((c >= 6) != rates ||
              channel.spec.channel != spec.bodies[b].name + "." + start_coordinate_names()[static_cast<std::size_t>(c)])
            continue;
          const auto [level, slope] = level_and_slope(data, channel, state.t);
          if (std::isnan(level)) continue;
          const int i = c % 3;
          (c < 3 ? origin[i] : c < 6 ? *angle[i] : c < 9 ? velocity[i] : k.w_B[i]) = level;
          known_rate[c % 6] = known_rate[c % 6] || rates;
          if (!rates && !known_rate[c]) (c < 3 ? velocity[i] : k.w_B[i]) = slope;
        }
    k.R_WB = rotation_from(angles);
    k.p_WC = origin + k.R_WB * cog;
    k.v_WC = velocity + k.R_WB * k.w_B.cross(cog);
  }
  return s;
}

/// d moved(state, delta) / d delta.
MatrixX moved_tangent(const SystemState& state, const VectorX& delta) {
  MatrixX D = MatrixX::Identity(delta.size(), delta.size());
  for (std::size_t i = 0; i < state.body.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i + 3);
    D.block<3, 3>(row, row) = right_jacobian(delta.segment<3>(row));
  }
  return D;
}

}  // namespace

SegmentedRecord::SegmentedRecord(const RecordModel& model, int segments) : record_(model) {
  const MeasuredRecord& data = model.data;
  const double step = model.base.specification.solver.time_step;
  if (data.kind == FitRecordSpec::Kind::constant) throw CaseError("a static pull has no segments");
  if (!model.base.specification.joints.empty())
    throw CaseError("[fit] shooting: \"multiple\" needs a lift without joints, whose bodies can begin a segment anywhere");
  for (int k = 0; k <= segments; ++k)
    times_.push_back(std::round(data.end() * k / segments / step) * step);
  times_.back() = data.end() + 4.0 * step;
  for (int k = 0; k < segments; ++k) {
    Part part{model, {}, {}};
    MeasuredRecord& own = part.model.data;
    own.time.clear();
    for (MeasuredChannel& channel : own.channels) channel.value.clear();
    for (std::size_t i = 0; i < data.time.size(); ++i) {
      if (data.time[i] < times_[static_cast<std::size_t>(k)] || data.time[i] >= times_[static_cast<std::size_t>(k) + 1])
        continue;
      part.sample.push_back(i);
      own.time.push_back(data.time[i]);
      for (std::size_t c = 0; c < own.channels.size(); ++c) own.channels[c].value.push_back(data.channels[c].value[i]);
    }
    if (own.time.size() < kFewestSamples)
      throw CaseError(fmt::format("[fit] segments: {} leave fewer than {} samples of {} in a segment", segments,
                                  kFewestSamples, data.name));
    part.index = valid_samples(own);
    parts_.push_back(std::move(part));
  }
}

void SegmentedRecord::lay_out(const VectorX& values, const VectorX& own, const RunOptions& options) {
  const Case c = case_at(record_, values);
  TangentRequest request;
  request.from = record_start(record_, c, own, false).from;
  begins_.assign(static_cast<std::size_t>(segments()), {});
  for (std::size_t k = 0; k + 1 < begins_.size(); ++k) {
    request.until = times_[k + 1];
    const TangentRun run = run_with_tangents(c, request, options);
    SystemState end = run.tangents.end;
    if (run.trajectory.status != RunStatus::completed) {
      if (!request.from) throw CaseError(record_.data.name + ": cannot be simulated: " + run.trajectory.message);
      end = *request.from;  // it was lost on the way: what is measured puts it right
      end.t = times_[k + 1];
    }
    begins_[k + 1] = as_measured(end, c.specification, record_.data);
    request.from = begins_[k + 1];
  }
  scale_beginnings();
}

void SegmentedRecord::scale_beginnings() {
  const SystemState& first = begins_[1];
  const int bodies = static_cast<int>(first.body.size());
  VectorX square = VectorX::Zero(change_size(first));
  for (std::size_t k = 2; k < begins_.size(); ++k) square += difference(first, begins_[k]).cwiseAbs2();
  spread_ = (square / std::max(1.0, static_cast<double>(begins_.size()) - 2.0)).cwiseSqrt();
  // What hardly moves is not held tighter than a share of what does.
  const auto floor_part = [this](Eigen::Index first_row, Eigen::Index rows, double least) {
    if (rows == 0) return;
    auto part = spread_.segment(first_row, rows);
    part = part.cwiseMax(std::max(least, 0.05 * part.maxCoeff()));
  };
  for (int i = 0; i < bodies; ++i)
    for (const int row : {6 * i, 6 * i + 3, 6 * bodies + 6 * i, 6 * bodies + 6 * i + 3}) floor_part(row, 3, 1e-6);
  floor_part(12 * bodies, spread_.size() - 12 * bodies, 1e-12);
}

void SegmentedRecord::take_from(const FitProblem& problem, int first_block) {
  for (std::size_t k = 1; k < begins_.size(); ++k)
    begins_[k] = moved(begins_[k], problem.blocks[static_cast<std::size_t>(first_block) + k - 1].value.cwiseProduct(spread_));
}

void SegmentedRecord::add_to(FitProblem& problem, const FitParameters& parameters, const std::vector<double>& sigma,
                             int own_block, double weight, const RunOptions& options) const {
  const int first_block = static_cast<int>(problem.blocks.size());
  const bool has_own = record_.own() > 0;
  for (std::size_t k = 1; k < begins_.size(); ++k) problem.blocks.push_back({VectorX::Zero(spread_.size()), {}, {}, false});
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    const bool last = k + 1 == parts_.size();
    FitUnit unit;
    unit.blocks = {0};
    if (has_own) unit.blocks.push_back(own_block);
    const int begin = k > 0 ? static_cast<int>(unit.blocks.size()) : -1;
    if (k > 0) unit.blocks.push_back(first_block + static_cast<int>(k) - 1);
    FitGroup data, ties;
    for (std::size_t i = 0; i < unit.blocks.size(); ++i) data.uses.push_back(static_cast<int>(i));
    const int next = last ? -1 : static_cast<int>(unit.blocks.size());
    if (!last) unit.blocks.push_back(first_block + static_cast<int>(k));
    for (std::size_t i = 0; i < unit.blocks.size(); ++i) ties.uses.push_back(static_cast<int>(i));
    data.count = static_cast<int>(part.index.size());
    ties.count = last ? 0 : static_cast<int>(spread_.size());
    ties.robust = false;
    unit.groups = {data, ties};
    const VectorX span = parameters.span();
    unit.evaluate = [this, k, &part, &parameters, sigma, weight, options, span, has_own, begin, next](
                        const std::vector<VectorX>& x, VectorX& r, std::vector<MatrixX>& J) {
      const VectorX own = has_own ? x[1] : VectorX();
      const Case c = case_at(record_, parameters.of(record_, parameters.values(x[0])));
      TangentRequest request;
      request.keys = record_.keys;
      for (const MeasuredChannel& channel : part.model.data.channels) request.channels.push_back(channel.spec.channel);
      request.until = times_[k + 1];
      const auto keys = static_cast<Eigen::Index>(record_.keys.size());
      // d(beginning)/d(keys, free coordinates) for the first segment, d/d(its block) for the others.
      MatrixX by;
      if (k == 0) {
        const RecordStart start = record_start(record_, c, own, true);
        request.from = start.from;
        by = start.by;
      } else {
        const VectorX delta = x[static_cast<std::size_t>(begin)].cwiseProduct(spread_);
        request.from = moved(begins_[k], delta);
        by = moved_tangent(begins_[k], delta) * spread_.asDiagonal();
      }
      request.by_initial_state = by.size() > 0;
      const TangentRun run = run_with_tangents(c, request, options);
      if (run.trajectory.status != RunStatus::completed || !run.tangents.valid) return false;
      const Interpolation at(run.trajectory.time, part.model.data.time);
      if (!at.complete()) return false;
      const auto samples = static_cast<Eigen::Index>(part.index.size());
      const Eigen::Index ties_count = next < 0 ? 0 : spread_.size();
      r = VectorX::Zero(samples + ties_count);
      J.assign(x.size(), MatrixX());
      for (std::size_t b = 0; b < x.size(); ++b) J[b] = MatrixX::Zero(r.size(), x[b].size());
      const auto spread_out = [&](Eigen::Index row, const Eigen::Ref<const Eigen::RowVectorXd>& d, double w) {
        for (Eigen::Index j = 0; j < keys; ++j) {
          const int parameter = record_.parameters[static_cast<std::size_t>(j)];
          J[0](row, parameter) += w * d[j] * span[parameter];
        }
        if (by.size() == 0) return;
        const Eigen::RowVectorXd through = d.tail(by.rows()) * by;
        if (k > 0) {
          J[static_cast<std::size_t>(begin)].row(row) += w * through;
          return;
        }
        for (Eigen::Index j = 0; j < keys; ++j) {
          const int parameter = record_.parameters[static_cast<std::size_t>(j)];
          J[0](row, parameter) += w * through[j] * span[parameter];
        }
        J[1].row(row).head(by.cols() - keys) += w * through.tail(by.cols() - keys);
      };
      std::vector<VectorX> value;
      std::vector<MatrixX> tangent;
      for (std::size_t channel = 0; channel < request.channels.size(); ++channel) {
        const auto& series = run.trajectory.values[static_cast<std::size_t>(run.trajectory.find(request.channels[channel]))];
        value.push_back(at(Eigen::Map<const VectorX>(series.data(), static_cast<Eigen::Index>(series.size()))));
        tangent.push_back(at(run.tangents.values[channel]));
      }
      for (Eigen::Index row = 0; row < samples; ++row) {
        const int channel = part.index.channel[static_cast<std::size_t>(row)];
        const auto which = static_cast<std::size_t>(channel);
        const Eigen::Index i = part.index.sample[static_cast<std::size_t>(row)];
        const double w = 1.0 / sigma[which];
        r[row] = w * (value[which][i] - part.model.data.channels[which].value[static_cast<std::size_t>(i)]);
        spread_out(row, tangent[which].row(i), w);
        const auto offset = std::find(record_.offsets.begin(), record_.offsets.end(), channel);
        if (offset == record_.offsets.end()) continue;
        const auto place = static_cast<Eigen::Index>(record_.free.size()) + (offset - record_.offsets.begin());
        r[row] += w * own[place];
        J[1](row, place) += w;
      }
      if (next < 0) return true;
      const SystemState beginning =
          moved(begins_[k + 1], x[static_cast<std::size_t>(next)].cwiseProduct(spread_));
      const VectorX gap = difference(beginning, run.tangents.end);
      for (Eigen::Index i = 0; i < ties_count; ++i) {
        const double w = weight / spread_[i];
        r[samples + i] = w * gap[i];
        spread_out(samples + i, run.tangents.end_state.row(i), w);
        J[static_cast<std::size_t>(next)](samples + i, i) = -weight;  // turns of a gap that closes are small
      }
      return true;
    };
    problem.units.push_back(std::move(unit));
  }
}

}  // namespace stillhook
