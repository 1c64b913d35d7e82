// From the conventions of frequency-domain databases (WAMIT, BEMIO) to those of coefficients.h, and back.
//
//   There: time factor exp(+i w t); phases relative to a wave whose crest passes the origin O of the database's frame
//   at
//          t = 0; forces and moments of each hull about a reference point of its own (WAMIT: the body's origin; BEMIO:
//          its centre of gravity); axes of the hulls parallel to those of the frame; z = 0 is the calm water plane.
//   Here:  phase at, and moments about, the hull's body origin Bo; F = Re[X a exp(i th)], th = k.x - w t.
//
//   X_here = T^T conj(X_there) exp(-i k.p),   A_here = T^T A_there T  (B, K alike),   V_reference = T V_Bo,
//   p: horizontal position of Bo from O;  k of the depth:  w^2 = g k tanh(k h).
//
// Both name the heading by the direction towards which the waves travel, counter-clockwise from +x.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/radiation/damping_transform.h"

namespace stillhook {

/// What a database does not say about a hull.
struct DatabaseBody {
  Vector3 origin = Vector3::Zero();  // m, Bo in the frame of the database, whose z = 0 is the calm water plane
  double volume = 0.0;               // m3, displaced; 0: what the database says
};

/// Share by which the depth of a set may differ from that of the case: in shallow water of half the length of its
/// waves.
inline constexpr double kSameDepth = 0.05;

struct DatabaseFrame {
  std::vector<DatabaseBody> bodies = {{}};  // in the order of the database
  int chosen = 0;                           // from 1: that body alone of all in the database; 0: all of them
  double length = 0.0;                      // m, > 0: length scale of the hull, as in HydrodynamicCoefficients
  bool port_starboard = false;              // headings 0..180 deg are mirrored; one hull only
  bool axisymmetric = false;                // one heading stands for all, see turn_heading; one hull only
  double lowest = 0.0;                      // rad/s, lower frequencies are left out
  double highest = std::numeric_limits<double>::infinity();  // rad/s, higher frequencies are left out
  double depth = std::numeric_limits<double>::infinity();    // m, of the water that the set is for, see water_of
  bool accept_finite_depth = false;                          // take a set computed in any depth
  RetardationOptions retardation;           // where the database has no retardation functions
  bool without_retardation = false;         // none are made of B where the database has none
};

/// Throws SpecificationError(source) unless there are hulls, all their origins at one height, and a length.
void require_frame(const DatabaseFrame& frame, const std::string& source);

/// m, the depth that a set computed in water of `depth` m holds for: infinite when the lowest frequency of X is in deep
/// water (k h >= pi), else the depth itself. Throws SpecificationError(source) when that is not frame.depth within 5 %,
/// unless accepted: with the frequency from which on the depth does not matter.
double water_of(const ExcitationTable& X, double gravity, double depth, const DatabaseFrame& frame,
                const std::string& source);

/// The same set about and at the hulls' origins; `reference` are the points of the database, one a hull. Waterline too.
void to_body_origins(HydrodynamicCoefficients& coefficients, const std::vector<Vector3>& reference,
                     const DatabaseFrame& frame, double depth = std::numeric_limits<double>::infinity());

/// The inverse of to_body_origins.
HydrodynamicCoefficients from_body_origins(const HydrodynamicCoefficients& coefficients,
                                           const std::vector<Vector3>& reference, const DatabaseFrame& frame);

/// The bodies to read of `held` in the database, from 0: all, or frame.chosen. Throws SpecificationError(source) when they
/// are not as many as frame.bodies; `remarks` hears of bodies that are left out.
std::vector<int> chosen_bodies(int held, const DatabaseFrame& frame, const std::string& source,
                               std::vector<std::string>& remarks);

/// Leaves out A, B and X outside frame.lowest..highest, and retardation functions, which hold all of B. Throws
/// SpecificationError(source) when fewer than three frequencies are left.
void cut_frequencies(HydrodynamicCoefficients& coefficients, const DatabaseFrame& frame, const std::string& source);

/// With frame.axisymmetric: the excitation of a body of revolution about the vertical through `reference`, from its one
/// heading turned to as many, evenly around the circle, as the highest frequency needs: with the phase of the wave at
/// `reference`, the force turns with the wave. In the frame of the database, before to_body_origins. Throws
/// SpecificationError(source) when A, B or X are not those of such a body (3 % of the largest of the kind).
void turn_heading(HydrodynamicCoefficients& coefficients, const Vector3& reference, const DatabaseFrame& frame,
                  double depth, const std::string& source);

/// Headings (rad, any, in any order) brought into [0, 2 pi), ascending, a heading that is given twice (0 and 360 deg)
/// taken once; with frame.port_starboard those between 0 and 180 deg mirrored. Evenly spaced ones (90 deg or less) get
/// their exactly even values. Others stay as they are and serve waves from these directions alone (diffraction.h).
/// Throws SpecificationError(source) when the same heading comes with different forces, or the symmetry does not hold.
void complete_headings(ExcitationTable& X, const DatabaseFrame& frame, const std::string& source);

/// K from the table of B, for databases that have none. Throws SpecificationError(source).
void complete_retardation(HydrodynamicCoefficients& coefficients, const DatabaseFrame& frame);

}  // namespace stillhook
