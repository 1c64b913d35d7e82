#include "sim/hull/rankine/panel_march.h"

#include <cmath>
#include <sstream>

#include "sim/hull/rankine/bands.h"
#include "sim/hull/rankine/frequencies.h"
#include "sim/sea/dispersion.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook::rankine {
namespace {

// Cells in the shortest wave: at the hull, and as far as that wave reaches; in the longest wave, beyond.
constexpr double kCellsPerWave = 16.0, kCellsPerShortestWave = 8.0, kCellsPerLongestWave = 20.0, kGrowth = 0.12;
// The beach: width in longest waves, and its strength over the geometric mean of the band's ends.
constexpr double kBeachWidth = 1.0, kBeachStrength = 1.5;
// The shortest wave reaches to where the beach has left exp(-kFaded) of its amplitude.
constexpr double kFaded = 2.0;
// Panels across a hull, which cost nothing in the march, and cells at its waterline in its breadth.
constexpr double kPanelsAcross = 16.0, kCellsAcross = 14.0;
// Panels of the hull in one of the length that the case asks for: as those of A_inf and A(0) in panel_method.cpp.
constexpr double kPanelsInLength = 2.0;
// Share of the stability limit that is used.
constexpr double kStable = 0.9;

/// Largest eigenvalue of g P + nu^2 by power iteration: the square of the highest frequency on the surface.
double highest_square(const MatrixX& P, const VectorX& damping, double gravity) {
  VectorX x = VectorX::Ones(P.rows());
  // A rough vector: neighbours alternate in the fastest mode.
  for (int i = 0; i < x.size(); ++i) x[i] = i % 2 ? 1.0 : -0.9;
  double value = 0.0;
  for (int k = 0; k < 60; ++k) {
    x.normalize();
    const VectorX y = gravity * (P * x) + damping.cwiseAbs2().cwiseProduct(x);
    value = y.norm();
    x = y;
  }
  return value;
}

}  // namespace

PanelMarch::PanelMarch(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options, double dt)
    : dt_(dt), gravity_(options.gravity), modes_(6 * static_cast<int>(hulls.size())) {
  const Layout layout = place(hulls);
  require_clearance(hulls, layout, options.depth);
  const auto wave = [&](double w) {
    const double deep = deep_frequency(w, gravity_, options.depth);
    return kTwoPi * gravity_ / (deep * deep);
  };
  double breadth = layout.hulls[0].breadth;
  for (const Placement& p : layout.hulls) breadth = std::min({breadth, p.breadth, p.length});
  const double panel = (options.panel_length > 0.0 ? options.panel_length / kPanelsInLength : breadth / kPanelsAcross) /
                       options.refinement;
  const double middle = std::sqrt(options.lowest * options.highest);
  const double strength = kBeachStrength * middle * energy_speed(middle, gravity_, options.depth);
  FreeSurfaceGrid grid;
  grid.near =
      std::min(panel * kPanelsAcross / kCellsAcross, wave(options.highest) / kCellsPerWave / options.refinement);
  if (layout.gap > 0.0) grid.near = std::min(grid.near, layout.gap / 4.0 / options.refinement);
  grid.far = wave(options.lowest) / kCellsPerLongestWave / options.refinement;
  grid.growth = kGrowth;
  grid.width = kBeachWidth * wave(options.lowest) * wider_beach(options.lowest, gravity_, options.depth);
  // Amplitude exp(-int nu/c ds), nu = strength (s/L)^2, group velocity c, in deep water g/2w.
  grid.middle = wave(options.highest) / kCellsPerShortestWave / options.refinement;
  const double slowness =  // g/2c
      std::isinf(options.depth) ? options.highest
                                : 0.5 * gravity_ / group_velocity(options.highest, gravity_, options.depth);
  grid.reach = std::cbrt(1.5 * kFaded * gravity_ * grid.width * grid.width / (strength * slowness));
  const HullPanels panels = panels_of(hulls, layout, panel);
  const SurfacePanels surface = free_surface(panels, grid);
  damping_.resize(surface.size());
  for (int i = 0; i < surface.size(); ++i) {
    const double s = surface.distance[i] / grid.width;
    damping_[i] = strength * s * s;
  }

  const VectorX weight = panel_weights(panels, options.density);
  const MatrixX T = to_middle(layout);
  A_inf_ = MatrixX::Zero(modes_, modes_);
  double fastest = 0.0;
  for (BoundaryClass& c : boundary_problem(panels, surface, bed_within(grid.width, layout, options))) {
    const ClassModes modes = modes_of(panels, layout, c.parity);
    if (modes.modes.empty()) continue;
    const MatrixX P = c.N.partialPivLu().inverse();
    fastest = std::max(fastest, highest_square(P, damping_, gravity_));
    const MatrixX weighted = modes.normal.transpose() * weight.asDiagonal();
    const MatrixX Q = -P * (c.R * modes.normal);
    const MatrixX W = -gravity_ * (weighted * c.C) * P;
    // psi by the same panels: phi_F = 0.
    const MatrixX A = -weighted * (c.hull_response * modes.normal + c.C * Q);
    MatrixX select = MatrixX::Zero(modes.modes.size(), modes_);  // motion of Bo to these modes of the middle
    for (std::size_t k = 0; k < modes.modes.size(); ++k) select.row(k) = T.row(modes.modes[k]);
    A_inf_ += select.transpose() * A * select;
    classes_.push_back({CompactMatrix(P), Q * select, select.transpose() * W});
  }
  A_inf_ = (0.5 * (A_inf_ + A_inf_.transpose())).eval();
  stable_ = kStable * 2.0 / std::sqrt(fastest);
  if (!(dt_ > 0.0 && dt_ <= stable_)) {
    std::ostringstream sentence;
    sentence << "a step of " << dt_ << " s is not stable on these panels; at most " << stable_ << " s is";
    throw SpecificationError("panel method", "direct", sentence.str());
  }
}

double PanelMarch::bytes() const {
  double sum = 0.0;
  for (const MarchClass& c : classes_)
    sum += 4.0 * static_cast<double>(c.P.size()) + 8.0 * static_cast<double>(c.Q.size() + c.W.size());
  return sum;
}

void PanelMarch::step(std::span<const double> V, std::span<double> state, std::span<double> F) const {
  const int n = surface_panels();
  const Eigen::Map<const VectorX> velocity(V.data(), modes_);
  Eigen::Map<VectorX> force(F.data(), modes_);
  force.setZero();
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const MarchClass& m = classes_[c];
    Eigen::Map<VectorX> eta(state.data() + 2 * c * n, n), phi(state.data() + (2 * c + 1) * n, n);
    const Eigen::VectorXf phi_f = phi.cast<float>();
    const Eigen::VectorXf P_phi = m.P * phi_f;
    const VectorX rate = P_phi.cast<double>() + m.Q * velocity;
    for (int i = 0; i < n; ++i) {
      const double nu = damping_[i];
      eta[i] = ((1.0 - nu * dt_) * eta[i] + dt_ * (rate[i] + nu * nu / gravity_ * phi[i])) / (1.0 + nu * dt_);
      phi[i] -= gravity_ * dt_ * eta[i];
    }
    force.noalias() += m.W * eta;
  }
}

}  // namespace stillhook::rankine
