// Rigid body modes and incident waves on the panels of one symmetry class.
#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "sim/hull/rankine/layout.h"

namespace stillhook::rankine {

/// The modes of one parity, 0 .. 6 hulls - 1, about the middles of their hulls.
struct ClassModes {
  std::vector<int> modes;
  MatrixX normal;  // normal velocity for unit velocity of each, hull panels x modes
};
ClassModes modes_of(const HullPanels& panels, const Layout& layout, const Parity& parity);

/// rho times the area of each panel with all its images, kg/m.
VectorX panel_weights(const HullPanels& panels, double density);

/// -int psi_j n_i rho dS of a response of the hull panels to their own velocity (`local` or `hull_response` of
/// BoundaryClass).
MatrixX inertia_of(const MatrixX& response, const ClassModes& modes, const VectorX& weight);

/// d(phi_I)/dn on the panels of a wave of unit amplitude, the part of one parity: the mean over the images of sign
/// times value; the whole is the sum over the parities. heading: rad in the problem's frame, time factor exp(-i w t),
/// crest at the frame's origin at t = 0; depth: of the water, m. m/s per m.
///
///   phi_I = -(i g/w) exp(i k (x cos b + y sin b)) cosh k(z + h)/cosh kh,   w^2 = g k tanh kh,   in deep water exp(k z)
Eigen::VectorXcd incident_velocity(const HullPanels& panels, const Parity& parity, double frequency, double heading,
                                   double gravity, double depth = std::numeric_limits<double>::infinity());

/// Turns the phase of a force from the crest at the problem's origin to the crest at the hull's Bo.
std::complex<double> phase_at_origin(const Placement& hull, double frequency, double heading, double gravity,
                                     double depth = std::numeric_limits<double>::infinity());

}  // namespace stillhook::rankine
