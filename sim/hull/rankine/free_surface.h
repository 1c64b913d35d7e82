// The still water surface around hulls as flat panels, and the beach on it.
//
// Square cells in a tree: as small as the waves and the hull ask for near the hulls, doubling outwards. Cells that the
// hulls' waterlines cut are clipped to the water, and slivers join a neighbour. A cell need not share its edges with
// its neighbours: strengths are constant on each panel. The beach, a band in which waves are damped (Cha, Nam & Ha
// 2018, Eq. 9; "Newtonian cooling"), begins at the hull:
//
//   nu(s) = nu0 (s/L)^2       s: distance from the nearest hull, L: width
//
// A beach that begins farther away leaves short waves undamped on their way to coarse panels, which reflect them.
#pragma once

#include <array>
#include <vector>

#include "sim/hull/rankine/hull_panels.h"

namespace stillhook::rankine {

struct FreeSurfaceGrid {
  double near = 0.0;    // m, largest cell at a hull
  double far = 0.0;     // m, largest cell anywhere
  double growth = 0.2;  // 1, allowed growth of the cell size with the distance from a hull
  double width = 0.0;   // m, L: the surface ends this far from the hulls
  // m: cells are at most `middle` up to `reach` from the hulls, beyond it at most middle (s/reach)^6, as the shortest
  // wave that the beach has left there grows; 0 = no such bound.
  double middle = 0.0, reach = 0.0;
  double largest(double s) const;  // m, of a cell at distance s
};

/// A panel made of one or several flat pieces, with one strength and one collocation point.
struct SurfacePanels {
  std::vector<FlatPanel> pieces;
  std::vector<int> first;        // pieces of panel j: first[j] .. first[j+1]-1
  std::vector<Vector3> point;    // m, collocation point: the centroid
  std::vector<double> area;      // m2
  std::vector<double> distance;  // m, s of the collocation point
  std::vector<bool> in_gap;      // between two hulls (layout.h); empty = nowhere
  int size() const { return static_cast<int>(point.size()); }
};

/// The water around the waterlines of the panels' edges at z = 0, with the panels' symmetry. Throws MeshError when the
/// waterlines are not closed.
SurfacePanels free_surface(const HullPanels& hulls, const FreeSurfaceGrid& grid);

/// The waterplane as convex quadrilaterals between lines of constant x: corners (x, y) counter-clockwise. Only the part
/// that the symmetry keeps.
using Strip = std::array<Eigen::Vector2d, 4>;
std::vector<Strip> waterplane_strips(const HullPanels& hulls);

/// m, from a point of the water plane; 0 within a strip.
double distance_to(const std::vector<Strip>& strips, const Eigen::Vector2d& p);

/// m2, all images.
double waterplane_area(const HullPanels& hulls);

}  // namespace stillhook::rankine
