#include "tuning/segments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

/// Which of a unit's blocks are what; -1 none.
struct SegmentPlace {
  int own = -1, begin = -1, next = -1;
};

struct SegmentSettings {
  const FitParameters* parameters;
  std::vector<double> sigma;
  double weight;
  RunOptions options;
  SegmentPlace place;
};

SegmentedRecord::SegmentedRecord(const RecordModel& model, int segments) : record_(model) {
  const MeasuredRecord& data = model.data;
  const double step = model.base.specification.solver.time_step;
  if (data.kind == FitRecordSpec::Kind::constant) throw CaseError("a static pull has no segments");
  const std::vector<BodySpec>& bodies = model.base.specification.bodies;
  if (std::any_of(bodies.begin(), bodies.end(), [](const BodySpec& b) { return b.moved_by_sea(); }))
    throw CaseError("[fit] shooting: \"multiple\" needs bodies that can begin a segment anywhere, none that moves by RAOs");
  if (!model.base.specification.joints.empty())
    throw CaseError("[fit] shooting: \"multiple\" needs a lift without joints, whose bodies can begin a segment anywhere");
  for (int k = 0; k <= segments; ++k)
    times_.push_back(std::round(data.end() * k / segments / step) * step);
  times_.back() = data.end() + 4.0 * step;
  for (int k = 0; k < segments; ++k) {
    Part part{model, {}};
    MeasuredRecord& own = part.model.data;
    own.time.clear();
    for (MeasuredChannel& channel : own.channels) channel.value.clear();
    for (std::size_t i = 0; i < data.time.size(); ++i) {
      if (data.time[i] < times_[static_cast<std::size_t>(k)] || data.time[i] >= times_[static_cast<std::size_t>(k) + 1])
        continue;
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
  request.from = record_start(record_, c, own).from;
  begins_.assign(static_cast<std::size_t>(segments()), {});
  for (std::size_t k = 0; k + 1 < begins_.size(); ++k) {
    request.until = times_[k + 1];
    const TangentRun run = tangent_run(c, request, options);
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

/// One segment at given blocks: its simulation, and where its residuals and derivatives go.
class SegmentEvaluation {
 public:
  SegmentEvaluation(const SegmentedRecord& record, std::size_t k, const SegmentSettings& settings,
                    const std::vector<VectorX>& x)
      : record_(record.record_), segment_(record), k_(k), settings_(settings), x_(x), keys_(record_.keys.size()) {}

  std::string run(VectorX& r, std::vector<MatrixX>& J) {
    simulate();
    const MeasuredRecord& data = part().model.data;
    const std::string segment = fmt::format("{}, segment {}: ", record_.data.name, k_ + 1);
    if (run_.trajectory.status != RunStatus::completed) return segment + run_.trajectory.message;
    if (!run_.tangents.valid) return segment + "the derivatives grew beyond use";
    const Interpolation at(run_.trajectory.time, data.time);
    if (!at.complete()) return segment + "the case ends before it";
    const auto samples = static_cast<Eigen::Index>(part().index.size());
    r = VectorX::Zero(samples + (place().next < 0 ? 0 : segment_.spread_.size()));
    J.assign(x_.size(), MatrixX());
    for (std::size_t b = 0; b < x_.size(); ++b) J[b] = MatrixX::Zero(r.size(), x_[b].size());
    add_samples(at, r, J);
    if (place().next >= 0) add_ties(samples, r, J);
    return {};
  }

 private:
  const SegmentedRecord::Part& part() const { return segment_.parts_[k_]; }
  const SegmentPlace& place() const { return settings_.place; }
  VectorX own() const { return place().own < 0 ? VectorX() : x_[static_cast<std::size_t>(place().own)]; }

  void simulate() {
    const Case c = case_at(record_, settings_.parameters->of(record_, settings_.parameters->values(x_[0])));
    TangentRequest request;
    request.keys = record_.keys;
    request.ranges = record_.ranges;
    for (const MeasuredChannel& channel : record_.data.channels) request.channels.push_back(channel.spec.channel);
    request.until = segment_.times_[k_ + 1];
    RecordStart start;
    VectorX delta;
    if (k_ == 0) {
      start = record_start(record_, c, own());
      request.from = start.from;
    } else {
      delta = x_[static_cast<std::size_t>(place().begin)].cwiseProduct(segment_.spread_);
      request.from = moved(segment_.begins_[k_], delta);
    }
    request.by_initial_state = request.from.has_value();
    run_ = tangent_run(c, request, settings_.options);
    if (k_ > 0)
      by_ = moved_tangent(segment_.begins_[k_], delta) * segment_.spread_.asDiagonal();
    else if (start.from)
      by_ = start_tangent(record_, c, start, run_);
  }

  /// A row of derivatives by (keys, beginning) into the blocks, through what the beginning depends on.
  void add_row(Eigen::Index row, const Eigen::Ref<const Eigen::RowVectorXd>& d, double weight,
               std::vector<MatrixX>& J) const {
    add_keys(row, d.head(static_cast<Eigen::Index>(keys_)), weight, J);
    if (by_.size() == 0) return;
    const Eigen::RowVectorXd through = d.tail(by_.rows()) * by_;
    if (k_ > 0) {
      J[static_cast<std::size_t>(place().begin)].row(row) += weight * through;
      return;
    }
    const auto free = by_.cols() - static_cast<Eigen::Index>(keys_);
    add_keys(row, through.head(static_cast<Eigen::Index>(keys_)), weight, J);
    J[static_cast<std::size_t>(place().own)].row(row).head(free) += weight * through.tail(free);
  }

  void add_keys(Eigen::Index row, const Eigen::RowVectorXd& d, double weight, std::vector<MatrixX>& J) const {
    for (std::size_t j = 0; j < keys_; ++j)
      J[0](row, record_.parameters[j]) += weight * d[static_cast<Eigen::Index>(j)] * record_.ranges[j];
  }

  void add_samples(const Interpolation& at, VectorX& r, std::vector<MatrixX>& J) const {
    std::vector<VectorX> value;
    std::vector<MatrixX> tangent;
    for (std::size_t k = 0; k < record_.data.channels.size(); ++k) {
      const int channel = run_.trajectory.find(record_.data.channels[k].spec.channel);
      const std::vector<double>& series = run_.trajectory.values[static_cast<std::size_t>(channel)];
      value.push_back(at(Eigen::Map<const VectorX>(series.data(), static_cast<Eigen::Index>(series.size()))));
      tangent.push_back(at(run_.tangents.values[k]));
    }
    for (std::size_t n = 0; n < part().index.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      const int channel = part().index.channel[n];
      const auto k = static_cast<std::size_t>(channel);
      const Eigen::Index i = part().index.sample[n];
      const double weight = 1.0 / settings_.sigma[k];
      r[row] = weight * (value[k][i] - part().model.data.channels[k].value[static_cast<std::size_t>(i)]);
      add_row(row, tangent[k].row(i), weight, J);
      const auto offset = std::find(record_.offsets.begin(), record_.offsets.end(), channel);
      if (offset == record_.offsets.end()) continue;
      const auto at_own = static_cast<Eigen::Index>(record_.free.size()) + (offset - record_.offsets.begin());
      r[row] += weight * own()[at_own];
      J[static_cast<std::size_t>(place().own)](row, at_own) += weight;
    }
  }

  void add_ties(Eigen::Index first, VectorX& r, std::vector<MatrixX>& J) const {
    const auto next = static_cast<std::size_t>(place().next);
    const SystemState beginning = moved(segment_.begins_[k_ + 1], x_[next].cwiseProduct(segment_.spread_));
    const VectorX gap = difference(beginning, run_.tangents.end);
    for (Eigen::Index i = 0; i < gap.size(); ++i) {
      const double weight = settings_.weight / segment_.spread_[i];
      r[first + i] = weight * gap[i];
      add_row(first + i, run_.tangents.end_state.row(i), weight, J);
      J[next](first + i, i) = -settings_.weight;  // turns of a gap that closes are small
    }
  }

  const RecordModel& record_;
  const SegmentedRecord& segment_;
  std::size_t k_;
  const SegmentSettings& settings_;
  const std::vector<VectorX>& x_;
  std::size_t keys_;
  TangentRun run_;
  MatrixX by_;  // d(beginning)/d(keys, free coordinates) for the first segment, d/d(its block) for the others
};

void SegmentedRecord::add_to(FitProblem& problem, const FitParameters& parameters, const std::vector<double>& sigma,
                             int own_block, double weight, const RunOptions& options) const {
  const int first_block = static_cast<int>(problem.blocks.size());
  for (std::size_t k = 1; k < begins_.size(); ++k) problem.blocks.push_back({VectorX::Zero(spread_.size()), {}, {}, false});
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const bool last = k + 1 == parts_.size();
    FitUnit unit;
    SegmentSettings settings{&parameters, sigma, weight, options, {}};
    FitGroup data, ties;
    const auto add = [&unit, &data, &ties](int block) {
      unit.blocks.push_back(block);
      const int at = static_cast<int>(unit.blocks.size()) - 1;
      data.uses.push_back(at);
      ties.uses.push_back(at);
      return at;
    };
    add(0);
    if (record_.own() > 0) settings.place.own = add(own_block);
    if (k > 0) settings.place.begin = add(first_block + static_cast<int>(k) - 1);
    data.count = static_cast<int>(parts_[k].index.size());
    if (!last) {
      unit.blocks.push_back(first_block + static_cast<int>(k));
      settings.place.next = static_cast<int>(unit.blocks.size()) - 1;
      ties.uses.push_back(settings.place.next);
      ties.count = static_cast<int>(spread_.size());
    }
    ties.robust = false;
    unit.groups = {data, ties};
    unit.evaluate = [this, k, settings](const std::vector<VectorX>& x, VectorX& r, std::vector<MatrixX>& J) {
      return SegmentEvaluation(*this, k, settings, x).run(r, J);
    };
    problem.units.push_back(std::move(unit));
  }
}

}  // namespace stillhook
