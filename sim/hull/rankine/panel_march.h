// The panel method marched in time: what is left of the radiation force once A_inf is split off.
//
// With N, R and C of boundary_problem.h, P = N^-1 and phi split into the local part psi V (zero on z = 0) and the
// waves,
//
//   eta_t = P phi + Q V - 2 nu eta + (nu^2/g) phi       phi_t = -g eta        F = -A_inf a + W eta
//   Q = -P R n,     W_k = -rho g int_H n_k (C P) dS
//
// (Cha, Nam & Ha 2018, Eq. 6-9, with the beach nu; Kring 1994). W is exact: the potential's rate of change on the water
// surface is -g eta, so no potential is differenced in time. P, Q, W are constant: one matrix-vector product a step.
//
// Leapfrog: eta at the middles of the steps, phi and V at their ends; second order, stable for dt sqrt(g |P|) < 2. The
// march reads all of P in every step and memory is what limits its speed: it is kept in half the bytes
// (compact_matrix.h).
//
// One surface serves the whole band: cells are a share of the shortest wave as far as the beach lets it get, and a
// share of the longest one beyond.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/hull/rankine/compact_matrix.h"
#include "sim/hull/rankine/hull_modes.h"
#include "sim/hull/rankine/panel_method.h"

namespace stillhook::rankine {

/// The system of one symmetry class.
struct MarchClass {
  CompactMatrix P;  // F x F, 1/m
  MatrixX Q;        // F x modes
  MatrixX W;        // modes x F, N/m
};

/// Constant matrices of the march; modes about Bo.
class PanelMarch {
 public:
  /// Cells of `surface_panel` (m) near the hulls and, growing, up to what the longest wave wants. `dt`: wanted step, s.
  /// Throws SpecificationError as panel_method(), and when dt is too long for the panels to be stable.
  PanelMarch(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options, double dt);

  int modes() const { return modes_; }
  double dt() const { return dt_; }                     // s
  double longest_stable_dt() const { return stable_; }  // s
  int surface_panels() const { return static_cast<int>(damping_.size()); }
  double bytes() const;
  const MatrixX& A_inf() const { return A_inf_; }  // modes x modes, of these panels

  /// Doubles of eta and phi of all classes, in this order for each class.
  int state_size() const { return 2 * static_cast<int>(classes_.size()) * surface_panels(); }
  /// Advances eta from the middle of the last step to that of the next one, phi to its end, with the velocities V at
  /// the instant between; F: force at the new middle.
  void step(std::span<const double> V, std::span<double> state, std::span<double> F) const;

 private:
  std::vector<MarchClass> classes_;
  VectorX damping_;  // nu, 1/s
  MatrixX A_inf_;
  double dt_, gravity_, stable_ = 0.0;
  int modes_;
};

}  // namespace stillhook::rankine
