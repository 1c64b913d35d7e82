// The wetted surface of hulls in still water as flat panels, and the planes of symmetry that save most of the work.
//
// Coordinates are those of the panel problem: z up from the still water plane, x and y those of the world or of a lone
// hull's heading frame. With a plane of symmetry only the half with positive coordinate is panelled, with two only a
// quarter; the rest follows by mirroring.
#pragma once

#include <span>
#include <vector>

#include "sim/hull/mesh/mesh.h"
#include "sim/hull/rankine/flat_panel.h"

namespace stillhook::rankine {

/// Planes x = 0 and y = 0 about which everything in the water is symmetric.
struct Symmetry {
  bool x = false, y = false;
  int images() const { return (x ? 2 : 1) * (y ? 2 : 1); }
};

struct HullPanels {
  std::vector<FlatPanel> panels;  // normals into the water
  std::vector<int> hull;          // which hull each belongs to
  Symmetry symmetry;

  /// Displaced volume of one hull, all images, m3, by the divergence theorem.
  double volume(int which) const;
};

/// Spacing of panels on a box: short at its edges, where the velocity of the water is singular, and at the waterline.
struct BoxGrading {
  double edge = 0.12;   // first panel at an edge, share of the panel length
  double growth = 1.6;  // from each panel to the next, at most
};

/// A box of length x breadth about (0, 0), from z = -draft to 0; panels at most panel_length (m) long. Symmetric about
/// both planes: a quarter of it. Throws MeshError for numbers that are not positive.
HullPanels box_panels(double length, double breadth, double draft, double panel_length, const BoxGrading& grading = {});

/// The part of a closed mesh below z = waterline (m), with z from there on; edges longer than panel_length (m) are
/// divided first. Only the half or quarter that `symmetry` asks for. Throws MeshError when nothing is below the water,
/// when all of it is, or for a lid: panels that lie in the water plane.
HullPanels mesh_panels(const Mesh& hull, double waterline, double panel_length, const Symmetry& symmetry);

/// The planes about which the mesh's vertices are symmetric within tolerance (m).
Symmetry symmetry_of(const Mesh& hull, double tolerance);

/// The panels of one hull.
HullPanels only(const HullPanels& panels, int hull);

/// All of it without the planes of symmetry that `keep` does not have.
HullPanels unfolded(const HullPanels& panels, const Symmetry& keep);

/// Nodes from a to b, first spacings `at_a` and `at_b` (0 = no grading at that end), growing inwards by `growth` up to
/// `most`. Shared with the free surface's grid.
std::vector<double> graded_nodes(double a, double b, double at_a, double at_b, double most, double growth);

/// What a convex polygon leaves on the positive side of normal.x = offset; fewer than 3 corners when nothing.
std::vector<Vector3> clipped_polygon(const std::vector<Vector3>& polygon, const Vector3& normal, double offset);

/// Appends a convex polygon as one panel, or several if it has more corners than a panel holds; none if its area is
/// below least_area.
void append_polygon(const std::vector<Vector3>& polygon, double least_area, std::vector<FlatPanel>& panels);

}  // namespace stillhook::rankine
