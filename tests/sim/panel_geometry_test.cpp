#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/hull/rankine/free_surface.h"
#include "sim/hull/rankine/layout.h"
#include "sim/specification.h"
#include "tests/truth/sphere_mesh.h"

namespace stillhook::rankine {
namespace {

PanelHull box(const std::string& name, const Vector3& size, const Vector3& centre, double x, double y, double yaw) {
  PanelHull hull;
  hull.name = name;
  hull.box_size = size;
  hull.box_centre = centre;
  hull.mesh = box_mesh(size, centre, 4.0);
  hull.x = x;
  hull.y = y;
  hull.yaw = yaw;
  return hull;
}

std::string refusal(const std::vector<PanelHull>& hulls) {
  try {
    const Layout layout = place(hulls);
    panels_of(hulls, layout, 3.0);
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("panels of a box cover a quarter of it, graded to its edges", "[rankine]") {
  const HullPanels panels = box_panels(110.0, 46.0, 4.0, 6.0);
  CHECK(panels.volume(0) == Approx(110.0 * 46.0 * 4.0).epsilon(1e-12));
  double area = 0.0, smallest = 1e9, largest = 0.0;
  Vector3 sum = Vector3::Zero();
  for (const FlatPanel& panel : panels.panels) {
    area += panel.area;
    sum += panel.area * panel.normal;
    for (int i = 0; i < panel.corners; ++i) {
      const double edge = (panel.v[(i + 1) % panel.corners] - panel.v[i]).norm();
      smallest = std::min(smallest, edge);
      largest = std::max(largest, edge);
    }
    CHECK(panel.centroid.x() > 0.0);
    CHECK(panel.centroid.y() > 0.0);
  }
  CHECK(4.0 * area == Approx(110.0 * 46.0 + 2.0 * 4.0 * (110.0 + 46.0)));
  CHECK(sum.isApprox(Vector3(23.0 * 4.0, 55.0 * 4.0, -55.0 * 23.0), 1e-12));  // outwards on each side
  CHECK(largest <= 6.0 + 1e-9);
  CHECK(smallest < 1.0);
  CHECK(waterplane_area(panels) == Approx(110.0 * 46.0));
  CHECK_THROWS_AS(box_panels(110.0, 46.0, 0.0, 6.0), MeshError);
}

TEST_CASE("graded nodes fill the length", "[rankine]") {
  const std::vector<double> nodes = graded_nodes(2.0, 10.0, 0.1, 0.2, 1.5, 1.5);
  CHECK(nodes.front() == 2.0);
  CHECK(nodes.back() == 10.0);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    CHECK(nodes[i] > nodes[i - 1]);
    CHECK(nodes[i] - nodes[i - 1] <= 1.5 + 1e-12);
    if (i > 1 && i + 1 < nodes.size()) {
      const double ratio = (nodes[i] - nodes[i - 1]) / (nodes[i - 1] - nodes[i - 2]);
      CHECK(std::max(ratio, 1.0 / ratio) < 1.5 * 1.5 + 1e-9);  // the two ends meet within one growth of each other
    }
  }
  CHECK(nodes[1] - nodes[0] <= 0.1 + 1e-12);
}

TEST_CASE("the wetted part of a mesh, with and without symmetry", "[rankine]") {
  const Mesh sphere = truth::sphere_mesh(5.0, 24);
  const MeshProperties whole = properties_of(sphere);
  CHECK(symmetry_of(sphere, 1e-9).x);
  CHECK(symmetry_of(sphere, 1e-9).y);
  const HullPanels full = mesh_panels(sphere, 0.0, 1.0, {});
  const HullPanels quarter = mesh_panels(sphere, 0.0, 1.0, {true, true});
  CHECK(full.volume(0) == Approx(0.5 * whole.volume).epsilon(1e-9));
  CHECK(quarter.volume(0) == Approx(0.5 * whole.volume).epsilon(1e-9));
  CHECK(waterplane_area(full) == Approx(waterplane_area(quarter)).epsilon(1e-9));
  // A 96-gon's area is below the circle's by (pi/48)^2/1.5.
  CHECK(waterplane_area(full) == Approx(std::numbers::pi * 25.0).epsilon(0.003));
  CHECK(unfolded(quarter, {}).volume(0) == Approx(full.volume(0)).epsilon(1e-9));
  CHECK(unfolded(quarter, {false, true}).volume(0) == Approx(full.volume(0)).epsilon(1e-9));
  // Cut above the middle: the spherical segment pi h^2 (3 r - h)/3.
  CHECK(mesh_panels(sphere, 2.0, 1.0, {}).volume(0) ==
        Approx(std::numbers::pi * 49.0 * (15.0 - 7.0) / 3.0).epsilon(0.01));  // a polyhedron, as above
  Mesh moved = sphere;
  for (Vector3& vertex : moved.vertices) vertex.x() += 0.4;
  CHECK_FALSE(symmetry_of(moved, 1e-3).x);
  CHECK(symmetry_of(moved, 1e-3).y);
}

TEST_CASE("the water surface leaves out the hulls and nothing else", "[rankine]") {
  const HullPanels panels = box_panels(110.0, 46.0, 4.0, 6.0);
  const SurfacePanels surface = free_surface(panels, {4.0, 16.0, 0.2, 100.0});
  double near = 0.0, smallest = 1e9, largest = 0.0;
  for (int j = 0; j < surface.size(); ++j) {
    const Vector3& p = surface.point[j];
    CHECK((p.x() > 55.0 || p.y() > 23.0));
    if (p.x() < 60.0 && p.y() < 28.0) near += surface.area[j];
    smallest = std::min(smallest, surface.area[j]);
    largest = std::max(largest, surface.area[j]);
    CHECK(surface.distance[j] <= 101.0);
  }
  CHECK(smallest > 0.3 * 16.0);   // slivers have joined a neighbour
  CHECK(largest <= 1.5 * 256.0);  // a whole cell and a sliver
  CHECK(largest > 200.0);
  // All pieces together: the rounded rectangle 100 m around the quarter, less what its rim's cells miss.
  double area = 0.0;
  for (const FlatPanel& piece : surface.pieces) area += piece.area;
  const double exact = 100.0 * (55.0 + 23.0) + 0.25 * std::numbers::pi * 1e4;
  CHECK(area == Approx(exact).epsilon(0.05));
  for (const FlatPanel& piece : surface.pieces) {
    CHECK(piece.normal.z() > 0.999);
    for (int i = 0; i < piece.corners; ++i) CHECK((piece.v[i].x() >= 55.0 - 1e-9 || piece.v[i].y() >= 23.0 - 1e-9));
  }
}

TEST_CASE("where hulls lie, and what symmetry they have together", "[rankine]") {
  const PanelHull crane = box("crane", {110, 46, 7.5}, {0, 0, -0.25}, 10.0, 5.0, 0.3);
  CHECK(place({crane}).symmetry.x);
  const Layout one = place({crane});
  CHECK(std::abs(one.hulls[0].reference.x) < 1e-12);  // the frame is the hull's own
  // A barge ahead of the bow on the centre line: port and starboard stay symmetric, fore and aft do not.
  const double c = std::cos(0.3), s = std::sin(0.3);
  PanelHull barge = box("barge", {24.4, 82.3, 4.88}, {0, 0, -0.06}, 10.0 + 74.0 * c, 5.0 + 74.0 * s, 0.3);
  const Layout two = place({crane, barge});
  CHECK_FALSE(two.symmetry.x);
  CHECK(two.symmetry.y);
  CHECK(two.hulls[1].reference.x == Approx(74.0));
  CHECK(two.gap == Approx(74.0 - 55.0 - 12.2));
  CHECK(panels_of({crane, barge}, two, 5.0).volume(1) == Approx(24.4 * 82.3 * 2.5));
  barge.y += 3.0;
  CHECK_FALSE(place({crane, barge}).symmetry.y);
  barge.x -= 15.0 * c;
  barge.y -= 15.0 * s;
  CHECK_THAT(refusal({crane, barge}), Catch::Contains("bodies.barge.hull") && Catch::Contains("overlaps"));
}

TEST_CASE("hulls that the panel method cannot use are refused by name", "[rankine]") {
  PanelHull hull = box("tank", {20, 10, 4}, {0, 0, 2.5}, 0, 0, 0);
  CHECK_THAT(refusal({hull}), Catch::Contains("bodies.tank.hull") && Catch::Contains("has no draft"));
  hull = box("tank", {20, 10, 4}, {0, 0, -3.0}, 0, 0, 0);
  hull.box_size.setZero();
  CHECK_THAT(refusal({hull}), Catch::Contains("wholly below the water"));
  // A hull closed by panels in the still water plane.
  hull = box("tank", {20, 10, 4}, {0, 0, -2.0}, 0, 0, 0);
  hull.box_size.setZero();
  for (Vector3& vertex : hull.mesh.vertices)
    if (vertex.z() > -1e-9) vertex.z() = 0.0;
  const Mesh bridge = box_mesh({2, 2, 3}, {0, 0, 1.5}, 4.0);
  const int first = static_cast<int>(hull.mesh.vertices.size());
  hull.mesh.vertices.insert(hull.mesh.vertices.end(), bridge.vertices.begin(), bridge.vertices.end());
  for (auto t : bridge.triangles) hull.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  CHECK_THAT(refusal({hull}), Catch::Contains("lid"));
}

}  // namespace stillhook::rankine
