// Closed triangle meshes of hulls.
//
// Triangles are numbered counter-clockwise seen from outside, so that the normal (b - a) x (c - a) points into the
// water. A hull mesh is closed: it includes the deck, because the waterline moves. Coordinates are those of the body
// frame B, m.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/error.h"
#include "sim/spatial/pose.h"

namespace stillhook {

/// A mesh that cannot be used, or a file that holds none: one sentence that names the fault and how often it occurs.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// The largest mesh that is read or made by refinement.
inline constexpr std::size_t kMostTriangles = 1'000'000;

struct Mesh {
  std::vector<Vector3> vertices;              // m, in B
  std::vector<std::array<int, 3>> triangles;  // indices of vertices, counter-clockwise seen from outside
};

struct MeshProperties {
  double area = 0.0;                                      // m2
  double volume = 0.0;                                    // m3, negative when the normals point inwards
  Vector3 centroid = Vector3::Zero();                     // m, of the volume
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();  // m, bounding box
  double longest_edge = 0.0;                              // m
};

/// Area times outward normal of a triangle, m2.
Vector3 area_vector(const Mesh& mesh, const std::array<int, 3>& triangle);

/// Area, volume, centroid (divergence theorem) and bounding box. A mesh without vertices has all zeros.
MeshProperties properties_of(const Mesh& mesh);

/// A box with edges along B: size (length, breadth, depth; m) about its centre. Rows of vertices are evenly spaced, at
/// most panel_length (m) apart and even in number, with diagonals mirrored about the middle planes, so that a
/// symmetric load gives a symmetric force. No row needs to lie at the waterline. Throws MeshError for sizes or panel
/// lengths that are not positive and for more than a million triangles.
Mesh box_mesh(const Vector3& size, const Vector3& centre, double panel_length);

/// The panel length used when none is given, m: sqrt(area / 350), which gives the reference hull (110 x 46 x 7.5 m) 434
/// vertices, but not less than 2.5 m, so that a small body in the waves of a crane operation is not cut needlessly
/// fine.
double automatic_panel_length(double area);

/// The same surface with edges longer than longest_edge (m) halved until there are none. Both triangles at an edge are
/// divided together, so a closed mesh stays closed. Throws MeshError beyond a million triangles.
Mesh refined_mesh(const Mesh& mesh, double longest_edge);

/// Merges vertices closer than tolerance (m) and drops the triangles that collapse by it. Vertices keep the order and
/// coordinates of their first occurrence.
Mesh welded_mesh(const Mesh& mesh, double tolerance);

/// The mesh with holes closed whose rim is at most kSmallHole of the mesh's size around, without the connected parts
/// that lie inside others (their rooms would count as buoyancy twice), and with every other part turned outwards.
/// `done` tells what was changed, as a sentence; empty if nothing. What cannot be mended is
/// left for check_mesh to name.
inline constexpr double kSmallHole = 0.25;
Mesh mended_mesh(const Mesh& mesh, std::string& done);

/// Throws MeshError unless the mesh is a hull: finite, every triangle with an area, every edge shared by exactly two
/// triangles that run through it in opposite directions, no connected part inside another or overlapping one, and every
/// part facing outwards. `what` opens the
/// sentence ("hull.stl").
void check_mesh(const Mesh& mesh, const std::string& what);

}  // namespace stillhook
