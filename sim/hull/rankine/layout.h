// Where the hulls of a panel problem are, and what symmetry they have together.
//
// The problem's frame has its origin in the still water plane at the middle of the first hull, P_0, and the first hull's
// heading as x axis. Modes are taken about each hull's own middle P_k, where symmetry makes most of them uncouple, and
// carried over to Bo afterwards.
#pragma once

#include <vector>

#include "sim/hull/rankine/boundary_problem.h"
#include "sim/hull/rankine/panel_method.h"

namespace stillhook::rankine {

struct Placement {
  Mesh mesh;                         // about the middle: x, y from P, z from Bo
  Symmetry own;                      // of the hull alone
  ReferencePoint reference;          // P and the heading in the problem's frame
  Vector3 from_Bo = Vector3::Zero(); // m, p_BP, in B = the hull's heading frame
  double Bo_x = 0.0, Bo_y = 0.0;     // m, Bo in the problem's frame
  double length = 0.0, breadth = 0.0, draft = 0.0;  // m
};

struct Layout {
  std::vector<Placement> hulls;
  Symmetry symmetry;
  double gap = 0.0;  // m, least distance between waterlines of different hulls; 0 for one hull
};

/// Share of its draft that a hull must have below its keel: in a narrower gap the pressure is not that of linear
/// theory, and panels of one strength do not follow it.
inline constexpr double kLeastClearance = 0.1;

/// Throws SpecificationError("bodies.<name>") for a hull with less than that under its keel in water of `depth` m.
void require_clearance(const std::vector<PanelHull>& hulls, const Layout& layout, double depth);

/// Throws SpecificationError("bodies.<name>") for a hull that cannot be used and for hulls that overlap.
Layout place(const std::vector<PanelHull>& hulls);

/// Panels of all hulls at most panel_length (m) long.
HullPanels panels_of(const std::vector<PanelHull>& hulls, const Layout& layout, double panel_length);

/// Marks the cells between two hulls: as near to both as the gap is wide, with half of it to spare.
void mark_gap(const Layout& layout, const HullPanels& panels, SurfacePanels& surface);

/// From motion of Bo to motion of P, all hulls: V_P = T V_Bo; F_Bo = T^T F_P.
MatrixX to_middle(const Layout& layout);

}  // namespace stillhook::rankine
