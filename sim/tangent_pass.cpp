#include "sim/tangent_pass.h"

#include <algorithm>
#include <cmath>

#include "sim/lifting/contact.h"

namespace stillhook {

namespace {
constexpr double kNudge = 2e-6;  // m, rad, m/s: width of the differences that start the directions of the initial state
}

int state_directions(const MultibodySystem& system) { return 2 * system.coordinates() + system.element_state_size(); }

TangentPass::TangentPass(const Model& model, HhtStepper& stepper, const std::vector<LiftTwin>& twins,
                         const TangentOptions& wanted, const Trajectory& run, Tangents& out, bool started_elsewhere)
    : model_(model),
      stepper_(stepper),
      twins_(twins),
      wanted_(wanted),
      run_(run),
      started_elsewhere_(started_elsewhere),
      out_(out),
      board_(model),
      work_(model.system().make_workspace()) {
  out_ = {};
  for (const LiftTwin& twin : twins_) {
    lifts_.emplace_back();
    for (int side = 0; side < 2; ++side)
      lifts_.back()[side] = {std::make_unique<ChannelBoard>(*twin.model[side]),
                             std::make_unique<SystemWorkspace>(twin.model[side]->system().make_workspace()),
                             std::make_unique<OperationClock>(*twin.operation[side])};
  }
  choose_parts(wanted.channels);
}

void TangentPass::choose_parts(const std::vector<std::string>& channels) {
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const int channel = board_.find(channels[k]);
    if (channel < 0) throw SpecificationError("channels", "", "there is no channel '" + channels[k] + "'");
    out_.channels.push_back(channel);
    const auto [source, index] = board_.source_of(channel);
    auto part = std::find_if(parts_.begin(), parts_.end(),
                             [&](const Part& p) { return p.source == source && p.index == index; });
    if (part == parts_.end()) part = parts_.insert(parts_.end(), {source, index, {}, {}, true, {}});
    part->wanted.push_back(static_cast<int>(k));
    part->channels.push_back(channel);
  }
  samples_.resize(channels.size());
}

// The given state moved by +- width/2 along `change`.
std::array<SystemState, 2> TangentPass::moved_both_ways(const SystemState& base, const VectorX& change,
                                                        double width) const {
  const int n = model_.system().coordinates();
  const BodyChange bodies{change.head(n), change.segment(n, n)};
  std::array<SystemState, 2> sides = {base, base};
  for (int side = 0; side < 2; ++side) {
    const double by = (side == 0 ? -0.5 : 0.5) * width;
    displace_bodies(bodies, 0, by, sides[side].body);
    for (std::size_t k = 0; k < base.element_state.size(); ++k)
      sides[side].element_state[k] += by * change[2 * n + static_cast<Eigen::Index>(k)];
  }
  return sides;
}

std::vector<std::array<SystemState, 2>> TangentPass::starts(const SystemState& base, std::vector<SystemTwin>& systems) {
  std::vector<std::array<SystemState, 2>> all;
  const MatrixX& change = wanted_.start_change;
  for (std::size_t j = 0; j < twins_.size(); ++j) {
    const LiftTwin& twin = twins_[j];
    systems.push_back({{&twin.model[0]->system(), &twin.model[1]->system()}, twin.width});
    if (twin.from[0])
      all.push_back({*twin.from[0], *twin.from[1]});
    else if (!started_elsewhere_)
      all.push_back({twin.model[0]->initial_state(), twin.model[1]->initial_state()});
    else if (change.size() > 0)
      all.push_back(moved_both_ways(base, change.col(static_cast<Eigen::Index>(j)), twin.width));
    else
      all.push_back({base, base});
  }
  const auto add = [&](const VectorX& direction, double width) {
    systems.push_back({{nullptr, nullptr}, width});
    all.push_back(moved_both_ways(base, direction, width));
  };
  for (auto j = static_cast<Eigen::Index>(twins_.size()); j < change.cols(); ++j)
    add(change.col(j), kNudge / std::max(1e-12, change.col(j).cwiseAbs().maxCoeff()));
  if (!wanted_.by_initial_state) return all;
  const int n = model_.system().coordinates(), all_directions = state_directions(model_.system());
  for (int i = 0; i < all_directions; ++i) {
    const bool of_element = i >= 2 * n;
    const double size =
        of_element ? std::max(1.0, std::abs(base.element_state[static_cast<std::size_t>(i - 2 * n)])) : 1.0;
    add(VectorX::Unit(all_directions, i), kNudge * size);
  }
  return all;
}

void TangentPass::start(const SystemState& state) {
  std::vector<SystemTwin> systems;
  auto sides = starts(state, systems);
  hht_ = std::make_unique<HhtTangent>(stepper_, systems);
  hht_->start(state, std::move(sides));
  const int p = directions();
  range_ = VectorX::Ones(p);
  for (std::size_t j = 0; j < twins_.size(); ++j) range_[static_cast<Eigen::Index>(j)] = twins_[j].range;
  drives_.assign(static_cast<std::size_t>(p), {state.drive, state.drive});
  for (std::size_t j = 0; j < twins_.size(); ++j)
    for (std::size_t side = 0; side < 2; ++side)
      if (twins_[j].from[side]) drives_[j][side] = twins_[j].from[side]->drive;
  slope_ = MatrixX::Zero(static_cast<Eigen::Index>(out_.channels.size()), p);
  gap_slope_ = MatrixX::Zero(1, p);
  last_gap_slope_ = parted_slope_ = end_slope_ = VectorX::Zero(p);
  out_.valid = true;
}

void TangentPass::drives_at(double t) {
  for (std::size_t j = 0; j < drives_.size(); ++j)
    for (int side = 0; side < 2; ++side) {
      if (j < lifts_.size())
        lifts_[j][side].clock->drives_at(t, drives_[j][side]);
      else
        drives_[j][side] = moved_.drive;
    }
}

void TangentPass::follow(const OperationClock& clock) {
  const auto& openings = clock.openings();
  for (; phases_open_ < static_cast<int>(openings.size()); ++phases_open_) {
    const OperationClock::Opening& opening = openings[static_cast<std::size_t>(phases_open_)];
    VectorX start = opening.cause == OperationClock::Cause::event ? parted_slope_ : end_slope_;
    for (std::size_t j = 0; j < lifts_.size(); ++j) {
      const EventSpec* wait[2];
      for (int side = 0; side < 2; ++side)
        wait[side] = &twins_[j].operation[side]->phases[static_cast<std::size_t>(phases_open_)].wait_for;
      const double w = twins_[j].width;
      double& slope = start[static_cast<Eigen::Index>(j)];
      if (opening.cause == OperationClock::Cause::event) slope += (wait[1]->hold - wait[0]->hold) / w;
      if (opening.cause == OperationClock::Cause::timeout) slope += (wait[1]->timeout - wait[0]->timeout) / w;
      for (int side = 0; side < 2; ++side)
        lifts_[j][side].clock->open_next(opening.start + (side == 0 ? -0.5 : 0.5) * w * slope);
      end_slope_[static_cast<Eigen::Index>(j)] =
          (lifts_[j][1].clock->phase_end() - lifts_[j][0].clock->phase_end()) / w;
    }
    for (Eigen::Index j = static_cast<Eigen::Index>(lifts_.size()); j < start.size(); ++j) end_slope_[j] = start[j];
    if (!out_.phase_start.empty()) out_.phase_end.push_back(start);
    out_.phase_start.push_back(start);
  }
}

void TangentPass::end_step(SystemState& state, double h) {
  drives_before_ = drives_;
  moved_.drive = state.drive;
  drives_at(state.t);
  hht_->end(state, h, drives_before_, drives_);
}

bool TangentPass::depends_directly(int j, const Part& part) const {
  const auto& sides = drives_[static_cast<std::size_t>(j)];
  const auto moves = [&](int d) {
    return sides[0][d].position != sides[1][d].position || sides[0][d].rate != sides[1][d].rate;
  };
  switch (part.source) {
    case Source::body: {
      const auto cog = [&](int side) {
        return twins_[static_cast<std::size_t>(j)].model[side]->system().bodies[part.index].cog;
      };
      return cog(0) != cog(1);
    }
    case Source::element:
      return hht_->differs(j, part.index) ||
             std::ranges::any_of(model_.system().elements[part.index]->drives(), moves);
    case Source::drive:
      return moves(part.index);
    case Source::joint:
    case Source::rest:
      break;
  }
  return true;
}

void TangentPass::differentiate(std::span<Part> parts, SystemState& state, MatrixX& out) {
  out.setZero();
  for (Part& part : parts) {
    part.branches.record();
    if (part.due) board_.measure(part.source, part.index, state, work_, &part.branches);
  }
  for (int j = 0; j < directions(); ++j) {
    const auto add = [&](const Part& part, const ChannelBoard& board, double factor) {
      for (std::size_t k = 0; k < part.wanted.size(); ++k)
        out(part.wanted[k], j) += factor * board.values()[static_cast<std::size_t>(part.channels[k])];
    };
    const double by = hht_->small_step(j);
    for (const double sign : {-1.0, 1.0}) {
      if (by == 0.0) break;
      hht_->displaced(state, j, sign * by, moved_);
      for (Part& part : parts) {
        if (!part.due) continue;
        part.branches.replay();
        board_.measure(part.source, part.index, moved_, work_, &part.branches);
        add(part, board_, sign / (2.0 * by));
      }
    }
    if (!has_twin(j)) continue;
    for (Part& part : parts) {
      if (!part.due || !depends_directly(j, part)) continue;
      for (int side = 0; side < 2; ++side) {
        Lift& lift = lifts_[static_cast<std::size_t>(j)][side];
        moved_ = state;
        moved_.drive = drives_[static_cast<std::size_t>(j)][side];
        part.branches.replay();
        lift.board->measure(part.source, part.index, moved_, *lift.work, &part.branches);
        add(part, *lift.board, (side == 0 ? -1.0 : 1.0) / twins_[static_cast<std::size_t>(j)].width);
      }
    }
  }
}

// t* = t0 + h g0/(g0 - g1) between the steps with the gaps g0 < 0 and g1 > 0.
void TangentPass::watch_gap(SystemState& state, double h, const Recorder& recorder, const OperationClock& clock) {
  const int contact = clock.awaited_contact();
  if (contact < 0) {
    gap_.reset();
    return;
  }
  const bool fresh = !gap_ || gap_->index != contact;
  if (fresh) {
    const int channel = board_.find(contact_channels::gap.of(model_.system().elements[contact]->name()));
    gap_ = Part{Source::element, contact, {0}, {channel}, true, {}};
  }
  differentiate({&*gap_, 1}, state, gap_slope_);
  board_.measure(Source::element, contact, state, work_);
  const double gap = board_.values()[static_cast<std::size_t>(gap_->channels.front())];
  const VectorX slope = gap_slope_.row(0).transpose();
  if (recorder.just_parted(contact)) {
    parted_slope_.setZero();
    if (!fresh && last_gap_ < 0.0)
      parted_slope_ = h * (last_gap_ * slope - gap * last_gap_slope_) / std::pow(gap - last_gap_, 2);
  }
  last_gap_ = gap;
  last_gap_slope_ = slope;
}

bool TangentPass::note(SystemState& state, double h, const Recorder& recorder, const OperationClock& clock,
                       bool sample) {
  const double growth = hht_->growth(range_);
  out_.growth = std::max(out_.growth, growth);
  if (!(growth <= wanted_.growth_limit)) {
    out_.valid = false;
    return false;
  }
  watch_gap(state, h, recorder, clock);
  while (out_.extremes.size() < run_.extremes.size()) {
    const VectorX none = VectorX::Zero(directions());
    out_.extremes.emplace_back(out_.channels.size(), Tangents::OfExtreme{none, none});
  }
  const std::size_t phase = static_cast<std::size_t>(std::max(0, clock.phase()));
  bool any = false;
  for (Part& part : parts_) {
    part.due = sample || std::ranges::any_of(part.channels, [&](int channel) {
                 const Extreme& e = run_.extremes[phase][static_cast<std::size_t>(channel)];
                 return e.t_min == state.t || e.t_max == state.t;
               });
    any = any || part.due;
  }
  if (!any) return true;
  differentiate(parts_, state, slope_);
  for (std::size_t k = 0; k < out_.channels.size(); ++k) {
    const auto row = slope_.row(static_cast<Eigen::Index>(k));
    const Extreme& e = run_.extremes[phase][static_cast<std::size_t>(out_.channels[k])];
    if (e.t_min == state.t) out_.extremes[phase][k].min = row.transpose();
    if (e.t_max == state.t) out_.extremes[phase][k].max = row.transpose();
    if (sample) samples_[k].insert(samples_[k].end(), row.begin(), row.end());
  }
  return true;
}

void TangentPass::close(const SystemState& state, bool completed) {
  out_.valid = out_.valid && completed;
  if (!out_.phase_start.empty()) out_.phase_end.push_back(end_slope_);
  const int p = directions();
  for (const std::vector<double>& values : samples_) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Index rows = p > 0 ? static_cast<Eigen::Index>(values.size()) / p : 0;
    out_.values.push_back(Eigen::Map<const RowMajor>(values.data(), rows, p));
  }
  out_.end = state;
  out_.end_state = hht_->state_change();
}

}  // namespace stillhook
