#include "sim/multibody/drive_path.h"

#include <algorithm>
#include <cmath>

#include "sim/multibody/stability.h"

namespace stillhook {
namespace {

constexpr double kProbe = 1e-5;         // m, rad or share: of the drive that moves most, for dQ/ds
constexpr double kFreeMotion = 1e-6;    // 1/s2: what nothing holds is left where it is
constexpr int kCorrections = 60;        // Newton's iterations of one stretch
constexpr double kLongestMove = 100.0;  // m predicted at once
constexpr double kLongestTurn = 0.15;   // rad predicted at once
constexpr double kMissedMove = 0.3;     // m off the prediction that is always accepted,
constexpr double kMissedTurn = 0.03;    // rad the same,
constexpr double kMissedShare = 0.15;   // and in addition this share of what was predicted
constexpr double kShortest = 1e-3;      // m, rad or share of a stretch: below it the lift lets go
constexpr double kFall = 0.02;          // m, rad or share: stretch over which a lift that lets go is moved on
constexpr int kFalls = 200;             // that a way may have

struct Size {
  double move = 0.0, turn = 0.0;  // m, rad
};

Size largest_of(const VectorX& xi) {
  Size s;
  for (int i = 0; i < xi.size(); i += 6) {
    s.move = std::max(s.move, xi.segment<3>(i).norm());
    s.turn = std::max(s.turn, xi.segment<3>(i + 3).norm());
  }
  return s;
}

Size distance_of(const SystemState& a, const SystemState& b) {
  Size s;
  for (std::size_t i = 0; i < a.body.size(); ++i) {
    s.move = std::max(s.move, (a.body[i].p_WC - b.body[i].p_WC).norm());
    s.turn = std::max(s.turn, log_rotation(a.body[i].R_WB.transpose() * b.body[i].R_WB).norm());
  }
  return s;
}

class DrivePath {
 public:
  DrivePath(const MultibodySystem& system, SystemState& state, const std::vector<DriveState>& to)
      : system_(system), state_(state), work_(system.make_workspace()), begin_(state.drive), to_(to) {
    for (std::size_t d = 0; d < to.size(); ++d)
      length_ = std::max(length_, std::abs(to[d].position - begin_[d].position));
  }

  EquilibriumReport run() {
    EquilibriumReport report = settle_stably(system_, state_);
    if (length_ == 0.0) return report;
    if (!report.converged) return settle_at_the_end();
    double stretch = 1.0;
    int falls = 0;
    while (done_ < 1.0) {
      stretch = std::min(stretch, 1.0 - done_);
      SystemState next = state_;
      stretch = predict(next, stretch);
      const SystemState predicted = next;
      report = solve_equilibrium(system_, next, true, kCorrections);
      if (report.converged && near(predicted, next) && weakest_motion(system_, next).stable()) {
        accept(next, stretch);
        stretch *= 3.0;
        continue;
      }
      if (stretch * length_ > kShortest) {
        stretch *= 0.25;
        continue;
      }
      if (++falls > kFalls) break;
      stretch = std::min(1.0 - done_, std::max(stretch, kFall / length_));
      report = let_go(stretch);
      if (!report.converged) break;
    }
    report.converged = done_ >= 1.0;
    return report;
  }

 private:
  double position(std::size_t drive, double done) const {
    // The end to the last bit: equal cases have equal drives.
    if (done >= 1.0) return to_[drive].position;
    return begin_[drive].position + done * (to_[drive].position - begin_[drive].position);
  }

  void set_drives(SystemState& state, double done) const {
    for (std::size_t d = 0; d < to_.size(); ++d) state.drive[d].position = position(d, done);
  }

  double past(double stretch) const { return done_ + stretch > 1.0 - 1e-12 ? 1.0 : done_ + stretch; }

  void accept(const SystemState& next, double stretch) {
    state_ = next;
    done_ = past(stretch);
  }

  EquilibriumReport settle_at_the_end() {
    SystemState next = state_;
    set_drives(next, 1.0);
    const EquilibriumReport report = settle_stably(system_, next);
    if (report.converged) state_ = next;
    return report;
  }

  EquilibriumReport let_go(double stretch) {
    SystemState next = state_;
    set_drives(next, past(stretch));
    const EquilibriumReport report = settle_stably(system_, next);
    if (report.converged) accept(next, stretch);
    return report;
  }

  // Moves `next` along the tangent by at most `stretch` of the way; returns how far.
  double predict(SystemState& next, double stretch) {
    const int n = system_.coordinates(), m = system_.constraints();
    VectorX Q, Q_on;
    system_.forces(next, 0.0, work_, Q);
    SystemState probe = next;
    const double by = kProbe / length_;
    for (std::size_t d = 0; d < to_.size(); ++d) probe.drive[d].position += by * (to_[d].position - begin_[d].position);
    system_.forces(probe, 0.0, work_, Q_on);
    MatrixX C_q;
    system_.constraint_jacobian(next, C_q);
    system_.jacobian(next, 0.0, work_);
    const double scale = system_.mass().trace() / std::max(1, n);
    MatrixX A(n + m, n + m);
    A.topLeftCorner(n, n) = kFreeMotion * system_.mass() - work_.jacobian.stiffness();
    A.topRightCorner(n, m) = scale * C_q.transpose();
    A.bottomLeftCorner(m, n) = scale * C_q;
    A.bottomRightCorner(m, m).setZero();
    VectorX b = VectorX::Zero(n + m);
    b.head(n) = (Q_on - Q) / by;
    const VectorX x = A.partialPivLu().solve(b);
    predicted_ = {};
    if (x.allFinite()) {
      const VectorX along = x.head(n);
      const Size rate = largest_of(along);
      stretch = std::min({stretch, kLongestMove / std::max(1e-9, rate.move), kLongestTurn / std::max(1e-9, rate.turn)});
      predicted_ = {stretch * rate.move, stretch * rate.turn};
      move_bodies(next, stretch * along);
      next.lambda += stretch * scale * x.tail(m);
    }
    set_drives(next, past(stretch));
    return stretch;
  }

  bool near(const SystemState& predicted, const SystemState& next) const {
    const Size off = distance_of(predicted, next);
    return off.move < kMissedMove + kMissedShare * predicted_.move &&
           off.turn < kMissedTurn + kMissedShare * predicted_.turn;
  }

  const MultibodySystem& system_;
  SystemState& state_;
  SystemWorkspace work_;
  std::vector<DriveState> begin_, to_;
  double length_ = 0.0;  // m, rad or share, of the drive that moves most
  double done_ = 0.0;    // share of the way
  Size predicted_;
};

}  // namespace

EquilibriumReport follow_drives(const MultibodySystem& system, SystemState& state, const std::vector<DriveState>& to) {
  return DrivePath(system, state, to).run();
}

}  // namespace stillhook
