// Diffraction by a fixed hull in a regular wave, marched in time, against the frequency domain.
//
// The march of rankine/panel_march.h driven by the normal velocity of the incident wave on every panel, v =
// -d(phi_I)/dn, in place of six modes; the local part by its own rate of change:
//
//   eta_t = P (phi - R v) - 2 nu eta + (nu^2/g) phi,   phi_t = -g eta,
//   F = rho int n (C q + hull_response v)_t dS,         q = P (phi - R v)
//
// The frequency domain's excitation comes by Haskind's relation from the radiation potentials: other right-hand sides,
// another solver, no time.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/hull/linear_froude_krylov.h"
#include "sim/hull/rankine/bands.h"
#include "sim/hull/rankine/hull_modes.h"
#include "sim/hull/rankine/panel_method.h"

namespace stillhook {
namespace {

using namespace rankine;
using Vector6c = Eigen::Matrix<Complex, 6, 1>;

/// X_D as the march settles to it, about the middle of the hull.
Vector6c marched(const PanelHull& hull, const PanelMethodOptions& options, double w, double heading) {
  const Layout layout = place({hull});
  const PanelBand band = bands_of(layout, options).front();
  const HullPanels panels = panels_of({hull}, layout, band.panel_length);
  const SurfacePanels surface = free_surface(panels, grid_of(band));
  const Beach beach = beach_of(band, options);
  VectorX nu(surface.size());
  for (int i = 0; i < surface.size(); ++i) nu[i] = beach.strength * w * std::pow(surface.distance[i] / beach.width, 2);
  const VectorX weight = panel_weights(panels, options.density);
  const double g = options.gravity, period = 2.0 * std::numbers::pi / w;
  constexpr int kSteps = 80, kPeriods = 12;  // steps of a period; the transient has left by the last one
  const double dt = period / kSteps;
  Vector6c X = Vector6c::Zero();
  for (const BoundaryClass& c : boundary_problem(panels, surface)) {
    const ClassModes modes = modes_of(panels, layout, c.parity);
    if (modes.modes.empty()) continue;
    const Eigen::VectorXcd v = -incident_velocity(panels, c.parity, w, heading, g);
    const MatrixX P = c.N.partialPivLu().inverse();
    const MatrixX weighted = modes.normal.transpose() * weight.asDiagonal(), W = -g * (weighted * c.C) * P;
    const Eigen::VectorXcd drive = -P.cast<Complex>() * (c.R.cast<Complex>() * v);
    const Eigen::VectorXcd local =
        weighted.cast<Complex>() * (c.hull_response.cast<Complex>() * v + c.C.cast<Complex>() * drive);
    VectorX eta = VectorX::Zero(surface.size()), phi = eta;
    Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(modes.modes.size());
    for (int n = 0; n < kPeriods * kSteps; ++n) {
      const double t = n * dt, ramp = std::min(1.0, t / (2.0 * period));
      // The drive at the step's beginning takes eta to its middle, where the force is; exp(-i w t).
      const VectorX rate = P * phi + ramp * (drive * std::polar(1.0, -w * t)).real();
      for (int i = 0; i < surface.size(); ++i)
        eta[i] = ((1.0 - nu[i] * dt) * eta[i] + dt * (rate[i] + nu[i] * nu[i] / g * phi[i])) / (1.0 + nu[i] * dt);
      phi -= g * dt * eta;
      if (n < (kPeriods - 1) * kSteps) continue;
      const double middle = t + 0.5 * dt;
      const VectorX F = W * eta + (Complex(0.0, -w) * local * std::polar(1.0, -w * middle)).real();
      sum += 2.0 / kSteps * F.cast<Complex>() * std::polar(1.0, w * middle);
    }
    for (std::size_t k = 0; k < modes.modes.size(); ++k) X(modes.modes[k]) = sum(k);
  }
  return X;
}

}  // namespace

TEST_CASE("diffraction marched in time has the force of the frequency domain", "[rankine]") {
  PanelHull hull;
  hull.name = "crane";
  hull.box_size = Vector3(110.0, 46.0, 7.5);
  hull.box_centre = Vector3(0.0, 0.0, -0.25);  // draft 4 m
  hull.mesh = box_mesh(hull.box_size, hull.box_centre, 4.0);
  constexpr double kFrequency = 0.628;
  PanelMethodOptions options;
  options.headings = 8;
  options.chosen = {kFrequency};
  options.refinement = 0.7;  // both on the same panels
  const HydrodynamicCoefficients c = panel_method({hull}, options);
  const LinearFroudeKrylov incident(hull.mesh, 0.0, options.density, options.gravity);
  constexpr double kHeading = std::numbers::pi / 4.0;
  const auto FK = incident.excitation(kFrequency, kHeading);
  const Vector6c X = marched(hull, options, kFrequency, kHeading);
  double force = 0.0, moment = 0.0;
  for (int i = 0; i < 3; ++i) {
    force = std::max(force, std::abs(X(i)));
    moment = std::max(moment, std::abs(X(3 + i)));
  }
  for (int i = 0; i < 6; ++i) {
    // Both are about midship in the water plane.
    const Complex table = c.excitation.at(0, 1, i) - FK(i);
    INFO("mode " << i + 1 << ": marched " << X(i) << ", table " << table);
    // One system, two ways: 0.2 % was found, of which the step in time has (w dt)^2/24 = 0.03 %.
    CHECK(std::abs(X(i) - table) < 0.005 * (i < 3 ? force : moment));
  }
}

}  // namespace stillhook
