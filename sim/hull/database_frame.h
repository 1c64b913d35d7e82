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

#include "sim/hull/coefficients.h"
#include "sim/hull/damping_transform.h"

namespace stillhook {

/// What a database does not say about a hull.
struct DatabaseBody {
  Vector3 origin = Vector3::Zero();  // m, Bo in the frame of the database, whose z = 0 is the calm water plane
  double volume = 0.0;               // m3, displaced; 0: what the database says
};

struct DatabaseFrame {
  std::vector<DatabaseBody> bodies = {{}};  // in the order of the database
  double length = 0.0;                      // m, > 0: length scale of the hull, as in HydrodynamicCoefficients
  bool port_starboard = false;              // headings 0..180 deg are mirrored; one hull only
  bool accept_finite_depth = false;         // take a set computed where the longest wave feels the bottom
  RetardationOptions retardation;           // where the database has no retardation functions
};

/// Throws SpecificationError(source) unless there are hulls, all their origins at one height, and a length.
void require_frame(const DatabaseFrame& frame, const std::string& source);

/// Throws SpecificationError(source) when the lowest frequency of X is not in deep water (k h < pi), unless accepted.
void require_deep_water(const ExcitationTable& X, double gravity, double depth, const DatabaseFrame& frame,
                        const std::string& source);

/// Wave number k > 0 of w^2 = g k tanh(k depth); depth may be infinite. rad/m
double wave_number(double frequency, double gravity, double depth);

/// The same set about and at the hulls' origins; `reference` are the points of the database, one a hull. Waterline too.
void to_body_origins(HydrodynamicCoefficients& coefficients, const std::vector<Vector3>& reference,
                     const DatabaseFrame& frame, double depth = std::numeric_limits<double>::infinity());

/// The inverse of to_body_origins.
HydrodynamicCoefficients from_body_origins(const HydrodynamicCoefficients& coefficients,
                                           const std::vector<Vector3>& reference, const DatabaseFrame& frame);

/// Headings (rad, any, in any order) brought into [0, 2 pi), ascending, a heading that is given twice (0 and 360 deg)
/// taken once; with frame.port_starboard those of 0..180 deg mirrored. Throws SpecificationError(source) unless they
/// are evenly spaced around the circle then, by 90 deg or less; the exactly even values are put in their place.
void complete_headings(ExcitationTable& X, const DatabaseFrame& frame, const std::string& source);

/// K from the table of B, for databases that have none. Throws SpecificationError(source).
void complete_retardation(HydrodynamicCoefficients& coefficients, const DatabaseFrame& frame);

}  // namespace stillhook
