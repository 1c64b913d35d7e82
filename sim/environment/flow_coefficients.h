// Coefficients of a hull in wind or current over the direction that the flow comes from.
//
//   F_x = q A_x C_x(a),   F_y = q A_y C_y(a),   M_z = q B C_n(a),   q = 1/2 rho |u_r|^2
//
// a  direction that the relative flow u_r comes from, off the bow, counter-clockwise: positive from port
// x forward, y to port, M_z bow to port positive, about amidships; so C_x(0) < 0 and C_y(90 deg) < 0 of any ship.
// Between the angles the coefficients are cubic, with the slopes of a parabola through three neighbours. Ships in the
// wind: Blendermann 1994; a hull in the current without a table of its own: each velocity drags by itself.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/environment/flow_spec.h"
#include "sim/spatial/pose.h"

namespace stillhook {

class FlowCoefficients {
 public:
  /// A row: the angle in rad, then C_x, C_y, C_n.
  using Row = std::array<double, 4>;
  /// Rows by rising angle from 0 to pi, which are mirrored for the other side (C_x even, C_y and C_n odd), or from 0 to
  /// 2 pi. Throws Error: what is wrong with them, as a sentence.
  explicit FlowCoefficients(std::vector<Row> rows);

  struct Values {
    Vector3 value, slope;  // C_x, C_y, C_n and their derivatives by the angle, 1/rad
  };
  Values at(double angle) const;
  /// Of the largest C_y in size.
  double broadside() const;

  bool operator==(const FlowCoefficients&) const = default;

 private:
  std::vector<double> angle_;  // rad, once round the circle: the last is the first plus a turn
  std::vector<std::array<double, 3>> value_, slope_;
};

/// Of a kind of ship in the wind (Blendermann 1994; parameters as in the MSS toolbox, blendermann94.m):
///   D = 1 - delta/2 (1 - CDl/CDt) sin^2 2a,  CDl = CDl_AF A_front/A_side with the bow's CDl_AF for |a| <= 90 deg, else
///   the stern's;  C_x = -CDl_AF cos(a)/D,  C_y = -CDt sin(a)/D,  C_n = C_y (s_L/L + 0.18 (pi/2 - |a|))
/// and the side force acts at kappa times the height of the side area's centroid.
FlowCoefficients blendermann(const WindHullSpec& hull);
/// kappa of a kind of ship, 1.
double blendermann_heeling(WindHullSpec::Ship ship);

/// Of a hull whose sides drag by themselves: C_x = -c_x cos a |cos a|, C_y = -c_y sin a |sin a|, C_n = 0.
FlowCoefficients cross_flow(double along, double across);

/// A table with the columns angle_deg, Cx, Cy, Cn. Throws FileError.
FlowCoefficients read_flow_coefficients(const std::string& path);

}  // namespace stillhook
