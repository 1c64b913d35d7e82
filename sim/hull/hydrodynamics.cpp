#include "sim/hull/hydrodynamics.h"

#include <algorithm>
#include <stdexcept>

namespace stillhook {
namespace {

constexpr const char* kModeNames[6] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr int kDiffractionScratch = 2 + 6 + 12;  // x, y, F, dF of one hull

// Scratch: past (modes), D (modes x modes), diffraction of each hull, then the radiation model's own.
std::span<double> past_of(Memory m, int modes) { return m.scratch.subspan(0, modes); }
std::span<double> damping_of(Memory m, int modes) { return m.scratch.subspan(modes, modes * modes); }
double* diffraction_of(Memory m, int modes, int hull) {
  return m.scratch.data() + modes + modes * modes + kDiffractionScratch * hull;
}

}  // namespace

HydrodynamicsElement::HydrodynamicsElement(std::string element_name, std::vector<HydrodynamicsHull> hulls,
                                           MatrixX A_inf, std::unique_ptr<const Radiation> radiation,
                                           std::unique_ptr<const Diffraction> diffraction)
    : ForceElement(std::move(element_name)),
      hulls_(std::move(hulls)),
      A_inf_(std::move(A_inf)),
      radiation_(std::move(radiation)),
      diffraction_(std::move(diffraction)) {
  if (hulls_.empty() || hulls_.size() > kMaxHulls || A_inf_.rows() != modes() || A_inf_.cols() != modes() ||
      (radiation_ && radiation_->modes() != modes()))
    throw std::invalid_argument("hydrodynamics: hulls, added mass and radiation do not match");
  if (diffraction_ && diffraction_->calm()) diffraction_.reset();
}

int HydrodynamicsElement::scratch_size() const {
  return modes() + modes() * modes() + kDiffractionScratch * static_cast<int>(hulls_.size()) +
         (radiation_ ? radiation_->scratch_size() : 0);
}

Memory HydrodynamicsElement::radiation_memory(Memory m) const {
  const int own = modes() + modes() * modes() + kDiffractionScratch * static_cast<int>(hulls_.size());
  return {m.state, m.scratch.subspan(own)};
}

HydrodynamicsElement::Modes HydrodynamicsElement::velocities(const Instant& now) const {
  Modes V(modes());
  for (std::size_t n = 0; n < hulls_.size(); ++n) V.segment<6>(6 * n) = hulls_[n].frame.velocity(now);
  return V;
}

HydrodynamicsElement::Linearised HydrodynamicsElement::diffraction_at(int hull, double t, const Vector3& origin) const {
  Linearised d{origin.x(), origin.y(), Vector6::Zero(), Eigen::Matrix<double, 6, 2>::Zero()};
  diffraction_->evaluate(hull, t, d.x, d.y, d.F, d.dF);
  return d;
}

HydrodynamicsElement::Linearised HydrodynamicsElement::diffraction_in_step(int hull, const Instant& now, double h,
                                                                           Memory m) const {
  const Vector3 origin = hulls_[hull].frame.origin(now);
  if (h <= 0.0) return diffraction_at(hull, now.t, origin);
  // A hull moves some centimetres in a step and the force changes over a wave length, so the second order left out is
  // (k dx)^2 / 2 < 1e-4 of the force for the shortest waves; a sum over all components is saved in each iteration.
  const double* stored = diffraction_of(m, modes(), hull);
  Linearised d{origin.x(), origin.y(), Eigen::Map<const Vector6>(stored + 2),
               Eigen::Map<const Eigen::Matrix<double, 6, 2>>(stored + 8)};
  d.F += d.dF * Eigen::Vector2d(d.x - stored[0], d.y - stored[1]);
  return d;
}

void HydrodynamicsElement::start(const Instant& now, Memory m) const {
  std::fill(m.scratch.begin(), m.scratch.end(), 0.0);
  if (!radiation_) return;
  const Modes V = velocities(now);
  radiation_->start({V.data(), static_cast<std::size_t>(V.size())}, radiation_memory(m));
}

void HydrodynamicsElement::begin_step(const Instant& before, double h, Memory m) const {
  if (radiation_) radiation_->begin_step(h, radiation_memory(m), past_of(m, modes()), damping_of(m, modes()));
  if (!diffraction_) return;
  for (int n = 0; n < static_cast<int>(hulls_.size()); ++n) {
    const Linearised d = diffraction_at(n, before.t + h, hulls_[n].frame.origin(before));
    double* stored = diffraction_of(m, modes(), n);
    stored[0] = d.x;
    stored[1] = d.y;
    std::copy_n(d.F.data(), 6, stored + 2);
    std::copy_n(d.dF.data(), 12, stored + 8);
  }
}

void HydrodynamicsElement::add_forces(const Instant& now, double h, Memory m, ForceSum& out) const {
  const Modes V = velocities(now);
  Modes F = Modes::Zero(modes());
  if (radiation_ && h > 0.0) {
    F = Eigen::Map<const Modes>(past_of(m, modes()).data(), modes());
    F.noalias() -= Eigen::Map<const MatrixX>(damping_of(m, modes()).data(), modes(), modes()).lazyProduct(V);
  } else if (radiation_) {
    radiation_->force({V.data(), static_cast<std::size_t>(V.size())}, radiation_memory(m),
                      {F.data(), static_cast<std::size_t>(F.size())});
  }
  for (int n = 0; n < static_cast<int>(hulls_.size()); ++n) {
    const HydrodynamicsHull& hull = hulls_[n];
    if (diffraction_) F.segment<6>(6 * n) += diffraction_in_step(n, now, h, m).F;
    hull.frame.add_force(F.segment<6>(6 * n), out);
    if (!hull.viscous.none()) hull.frame.add_force_at_cog(hull.viscous.force(hull.frame.velocity_of_cog(now)), out);
  }
}

void HydrodynamicsElement::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  const int hulls = static_cast<int>(hulls_.size());
  if (radiation_) {
    const std::span<double> D = damping_of(m, modes());
    if (h <= 0.0) radiation_->instantaneous_damping(D);
    const Eigen::Map<const MatrixX> damping(D.data(), modes(), modes());
    for (int i = 0; i < hulls; ++i)
      for (int j = 0; j < hulls; ++j) {
        const Matrix6 block = damping.block<6, 6>(6 * i, 6 * j);
        if (block.isZero(0.0)) continue;
        out.add_damping(hulls_[i].frame.body, hulls_[j].frame.body,
                        -hulls_[i].frame.transform().transpose() * block * hulls_[j].frame.transform());
      }
  }
  for (int n = 0; n < hulls; ++n) {
    const HydrodynamicsHull& hull = hulls_[n];
    const int body = hull.frame.body;
    if (diffraction_) {
      // dp_Bo = dp + R [c]x dtheta
      Eigen::Matrix<double, 3, 6> dorigin;
      dorigin << Matrix3::Identity(), now.body[body].R_WB * cross_matrix(hull.frame.cog);
      const Linearised d = diffraction_in_step(n, now, h, m);
      out.add_stiffness(body, body, hull.frame.transform().transpose() * d.dF * dorigin.topRows<2>());
    }
    if (!hull.viscous.none()) {
      const Vector6 slope = hull.viscous.derivative(hull.frame.velocity_of_cog(now));
      Matrix6 C = Matrix6::Zero();
      C.topLeftCorner<3, 3>() = hull.frame.R_WH * slope.head<3>().asDiagonal() * hull.frame.R_WH.transpose();
      C.bottomRightCorner<3, 3>() = slope.tail<3>().asDiagonal();
      out.add_damping(body, body, C);
    }
  }
}

void HydrodynamicsElement::end_step(const Instant& now, double h, Memory m) const {
  if (!radiation_) return;
  const Modes V = velocities(now);
  radiation_->end_step({V.data(), static_cast<std::size_t>(V.size())}, h, radiation_memory(m));
}

void HydrodynamicsElement::add_mass(MatrixX& M, int /*phase*/) const {
  for (std::size_t i = 0; i < hulls_.size(); ++i)
    for (std::size_t j = 0; j < hulls_.size(); ++j)
      M.block<6, 6>(6 * hulls_[i].frame.body, 6 * hulls_[j].frame.body) +=
          hulls_[i].frame.transform().transpose() * A_inf_.block<6, 6>(6 * i, 6 * j) * hulls_[j].frame.transform();
}

double HydrodynamicsElement::dissipated_power(const Instant& now, Memory) const {
  double power = 0.0;
  for (const HydrodynamicsHull& hull : hulls_) power += hull.viscous.power(hull.frame.velocity_of_cog(now));
  if (radiation_) {
    const Modes V = velocities(now);
    power += radiation_->radiated_power({V.data(), static_cast<std::size_t>(V.size())});
  }
  return power;
}

std::vector<Channel> HydrodynamicsElement::channels() const {
  std::vector<Channel> result;
  for (const HydrodynamicsHull& hull : hulls_)
    for (const char* kind : {"radiation", "diffraction"})
      for (int i = 0; i < 6; ++i)
        result.push_back({hull.name + "." + kind + "_" + kModeNames[i], i < 3 ? "N" : "N m",
                          std::string(kind) + (i < 3 ? " force in " : " moment in ") + kModeNames[i] +
                              ", heading frame, about the body's origin"});
  return result;
}

void HydrodynamicsElement::measure(const Instant& now, Memory m, std::span<double> out) const {
  Modes F = Modes::Zero(modes());
  if (radiation_) {
    const Modes V = velocities(now);
    radiation_->force({V.data(), static_cast<std::size_t>(V.size())}, radiation_memory(m),
                      {F.data(), static_cast<std::size_t>(F.size())});
  }
  for (int n = 0; n < static_cast<int>(hulls_.size()); ++n) {
    Vector6 D = Vector6::Zero();
    if (diffraction_) D = diffraction_at(n, now.t, hulls_[n].frame.origin(now)).F;
    std::copy_n(F.data() + 6 * n, 6, out.begin() + 12 * n);
    std::copy_n(D.data(), 6, out.begin() + 12 * n + 6);
  }
}

}  // namespace stillhook
