// Derivatives of a step of HydrodynamicsElement by its beginning.
#include <algorithm>
#include <optional>

#include "sim/hull/hydrodynamics.h"

namespace stillhook {

namespace {

/// A tangent of a radiation model's state, advanced by the model itself with the clock of the motion it belongs to.
class HistoryTangent {
 public:
  HistoryTangent(const Radiation& radiation, Memory of_motion)
      : clock_(radiation.clock_size()), motion_(of_motion), change_(radiation.state_size()) {}
  Memory at(const Eigen::Ref<const VectorX>& change) {
    change_ = change;
    std::copy_n(motion_.state.begin(), clock_, change_.begin());
    return {{change_.data(), static_cast<std::size_t>(change_.size())}, motion_.scratch};
  }
  /// What the model has made of it; the clock of a tangent is zero.
  const VectorX& advanced() {
    change_.head(clock_).setZero();
    return change_;
  }

 private:
  int clock_;
  Memory motion_;
  VectorX change_;
};

}  // namespace

bool HydrodynamicsElement::same_as(const ForceElement& other) const {
  const auto* o = dynamic_cast<const HydrodynamicsElement*>(&other);
  if (!o || o->hulls_ != hulls_ || o->A_inf_ != A_inf_) return false;
  if (!o->radiation_ != !radiation_ || !o->diffraction_ != !diffraction_) return false;
  return (!radiation_ || radiation_->same_as(*o->radiation_)) && (!diffraction_ || *diffraction_ == *o->diffraction_);
}

bool HydrodynamicsElement::add_history_tangent(const Instant& before, const Instant& now, double h, Memory m,
                                               const BodyChange& from, const Eigen::Ref<const MatrixX>& state,
                                               Eigen::Ref<MatrixX> dQ) const {
  if (radiation_ && !radiation_->linear_in_state()) return false;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6 * kMaxHulls, 6 * kMaxHulls>;
  Modes F(modes());
  Square D(modes(), modes());
  std::optional<HistoryTangent> change;
  if (radiation_) change.emplace(*radiation_, radiation_memory(m));
  for (Eigen::Index j = 0; radiation_ && j < dQ.cols(); ++j) {
    // The force is past - D V, and D does not depend on the history.
    radiation_->begin_step(h, change->at(state.col(j)), {F.data(), static_cast<std::size_t>(F.size())},
                           {D.data(), static_cast<std::size_t>(D.size())});
    for (std::size_t n = 0; n < hulls_.size(); ++n)
      dQ.col(j).segment<6>(6 * hulls_[n].frame.body) +=
          hulls_[n].frame.transform().transpose() * F.segment<6>(6 * static_cast<Eigen::Index>(n));
  }
  if (!diffraction_) return true;
  // F(o0) + F'(o0) (o1 - o0): by o0 it changes as F''(o0) (o1 - o0), the derivative of F' towards o1.
  for (int n = 0; n < static_cast<int>(hulls_.size()); ++n) {
    const HeadingFrame& frame = hulls_[n].frame;
    const Vector3 o0 = frame.origin(before);
    const Vector3 way = frame.origin(now) - o0;
    const double length = way.norm();
    if (length == 0.0) continue;
    constexpr double kAhead = 1e-2;  // m, against wave lengths of tens of metres
    const Vector3 ahead = (kAhead / length) * way;
    const Eigen::Matrix<double, 6, 2> by_o0 =
        (length / (2.0 * kAhead)) * (diffraction_at(n, now.t, o0 + ahead).dF - diffraction_at(n, now.t, o0 - ahead).dF);
    const int r = 6 * frame.body;
    const Matrix3 turning = before.body[frame.body].R_WB * cross_matrix(frame.cog);
    const MatrixX moved = from.xi.middleRows<3>(r) + turning * from.xi.middleRows<3>(r + 3);
    dQ.middleRows<6>(r) += frame.transform().transpose() * by_o0 * moved.topRows<2>();
  }
  return true;
}

bool HydrodynamicsElement::advance_state_tangent(const Instant&, const Instant&, double h, Memory m, const BodyChange&,
                                                 const BodyChange& to, Eigen::Ref<MatrixX> state) const {
  if (!radiation_) return true;
  if (!radiation_->linear_in_state()) return false;
  Modes V(modes());
  HistoryTangent change(*radiation_, radiation_memory(m));
  for (Eigen::Index j = 0; j < state.cols(); ++j) {
    for (std::size_t n = 0; n < hulls_.size(); ++n)
      V.segment<6>(6 * static_cast<Eigen::Index>(n)) =
          hulls_[n].frame.transform() * to.u.col(j).segment<6>(6 * hulls_[n].frame.body);
    radiation_->end_step({V.data(), static_cast<std::size_t>(V.size())}, h, change.at(state.col(j)));
    state.col(j) = change.advanced();
  }
  return true;
}

}  // namespace stillhook
