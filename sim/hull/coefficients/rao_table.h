// Displacement RAOs of one vessel, brought from the conventions of their file (sim/hull/rao_spec.h) to one:
//
//   q_i(t) = a Re(X_i exp(i th)),   th = k (x cos b + y sin b) - w t + e,  the wave a cos(th) at point Q
//
//   X_i  m/m for surge, sway, heave of the reference point, rad/m for roll, pitch, yaw; |X| exp(i lag)
//   b    direction towards which the wave travels, from the bow, counter-clockwise        w^2 = g k tanh kh
//   axes those of the heading frame at the mean pose: x forward, y port, z up; turns positive about them
//
// Q is the point of the plane y = 0 of the body at its centre of gravity, and the table has the translations of Q.
// There a ship's RAOs change least with frequency and heading, so that what lies between two rows of the file does not
// depend on the reference point and the phase origin that its owner chose.
#pragma once

#include <array>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "sim/body_spec.h"
#include "sim/error.h"

namespace stillhook {

using Raos = std::array<std::complex<double>, 6>;

struct RaoTable {
  std::vector<double> frequencies;  // rad/s, ascending
  std::vector<double> headings;     // rad, in [0, 2 pi), ascending
  std::vector<Raos> values;         // [frequency][heading], of Q
  std::string source;

  const Raos& at(std::size_t frequency, std::size_t heading) const {
    return values[frequency * headings.size() + heading];
  }
  /// Linear in frequency and heading, of the complex numbers. The frequency must lie within those of the table.
  Raos between(double frequency, double heading) const;
  /// The width of the gap between two headings of the table that this one lies in, rad; 0 on one of them.
  double gap_at(double heading) const;
};

/// Q and the reference point as seen from each other: what the mean pose leaves of the body's axes.
struct RaoFrame {
  double heading = 0.0;                // rad, of the mean pose
  Matrix3 R_HB = Matrix3::Identity();  // of the mean heel and trim
  Vector3 q = Vector3::Zero();         // m, Q in B
  Vector3 arm = Vector3::Zero();       // m, from Q to the reference point, in H
  Vector3 to_phase = Vector3::Zero();  // m, from Q to the phase origin, in H

  explicit RaoFrame(const BodySpec& body);
};

/// The RAOs of the reference point, from those of Q; small rotations.
Raos moved_by(const Raos& of_q, const Vector3& arm);

/// Reads the file of body.hydrodynamics.rao. Throws SpecificationError: of "<path>:<line>" for what the file lacks, has
/// twice or contradicts.
RaoTable read_rao_table(const BodySpec& body, double gravity,
                        double depth = std::numeric_limits<double>::infinity());

/// Whether the vessel follows the longest waves of the table, as everything that floats does in waves much longer than
/// itself: surge coth kh cos b and sway coth kh sin b at a quarter of a period, heave 1 in phase, roll and pitch with the slope of the
/// surface. A sentence for each motion that does not, empty when the table has no such waves.
std::vector<std::string> odd_in_long_waves(const RaoTable& table, double gravity,
                                           double depth = std::numeric_limits<double>::infinity());

}  // namespace stillhook
