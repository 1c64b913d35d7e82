// The elastic catenary with seabed contact and friction: the load at the upper end for a given position of it.
//
// Suspended (V >= w L), with Va = V - w L, S = sqrt(H^2 + V^2), Sa = sqrt(H^2 + Va^2):
//   x = H/w (asinh V/H - asinh Va/H) + H L/EA
//   z = (S - Sa)/w + (V L - w L^2/2)/EA
// Partly on the bottom (V < w L), with LB = L - V/w and m = max(0, LB - H/(mu w)):
//   x = LB + H/w asinh V/H + H L/EA - mu w/(2 EA) (LB^2 - m^2)
//   z = (S - H)/w + V^2/(2 EA w)
// A buoyant line (w < 0) is the same picture upside down: x, H and the length as they are, z and V with the other sign,
// and nothing lies on the bottom.
// Slack (x so small that H = 0): the line hangs straight down with the length s, z = s + w s^2/(2 EA), V = w s.
//
//   x, z  horizontal and vertical distance of the upper end from the anchor, m      H, V  load there, N
//   L     unstretched length, m    w  weight in water, N/m    EA  axial stiffness, N    mu  seabed friction, 1
// Irvine (1981), Cable Structures, ch. 2; Jonkman (2007), NREL/TP-500-41958, section 2.5; Faltinsen (1990), ch. 8.
//
// The friction acts as if the line had last been pulled outwards. Without friction (H, V) is the gradient of the
// line's energy and its stiffness symmetric; friction disturbs both by terms of relative order H/EA.
#pragma once

#include <Eigen/Dense>

namespace stillhook {

struct CatenaryLine {
  double length = 0.0;           // m, unstretched, > 0
  double weight = 0.0;           // N/m, in water; < 0: buoyant
  double axial_stiffness = 0.0;  // N, > 0
  double seabed_friction = 0.0;  // 1, >= 0
  bool on_seabed = true;         // the anchor lies on a flat seabed; false: the line hangs free below it too. Of a
                                 // buoyant line without a meaning
  bool operator==(const CatenaryLine&) const = default;
};

struct CatenaryLoad {
  double H = 0.0, V = 0.0;       // N, horizontal and vertical (positive: the line pulls the upper end down)
  double grounded_length = 0.0;  // m, on the bottom
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  // d(H, V)/d(x, z), N/m, by the implicit function theorem
};

/// Load at the upper end for x > 0 and z. H_guess and V_guess (N) are the solution nearby; H_guess <= 0 means none.
/// The equations hold to 1e-12 of the length. With on_seabed, z below 1e-6 of the length counts as that.
CatenaryLoad solve_catenary(const CatenaryLine& line, double x, double z, double H_guess = 0.0, double V_guess = 0.0);

/// Horizontal distance at which the line, whose upper end is z (m) above the anchor, has the horizontal tension H > 0 (N).
double catenary_distance(const CatenaryLine& line, double H, double z);

/// How far a line that hangs free sags below its anchor under this load, or a buoyant one rises above its upper end, m.
double catenary_overhang(const CatenaryLine& line, const CatenaryLoad& load);

/// Elastic energy plus weight above the anchor, J, of the line without friction that carries this load.
double catenary_energy(const CatenaryLine& line, const CatenaryLoad& load, double x, double z);

}  // namespace stillhook
