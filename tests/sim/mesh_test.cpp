#include "sim/hull/mesh/mesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

std::string complaint(const Mesh& mesh) {
  try {
    check_mesh(mesh, "hull");
  } catch (const MeshError& e) {
    return e.what();
  }
  return "";
}

void turn(Mesh& mesh, std::size_t triangle) { std::swap(mesh.triangles[triangle][0], mesh.triangles[triangle][1]); }

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh m = a;
  const int n = static_cast<int>(a.vertices.size());
  m.vertices.insert(m.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) m.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return m;
}

// A tetrahedron with corners at the origin and at 2, 3 and 5 m along the axes.
Mesh tetrahedron() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST_CASE("a box mesh has the volume, area, centroid and outward normals of the box") {
  const Vector3 size(110.0, 46.0, 7.5), centre(3.0, -2.0, 0.4);
  const Mesh mesh = box_mesh(size, centre, 9.0);
  CHECK(complaint(mesh) == "");
  const MeshProperties p = properties_of(mesh);
  // Sums of a few hundred terms in double.
  CHECK(p.volume == Approx(110.0 * 46.0 * 7.5).epsilon(1e-13));
  CHECK(p.area == Approx(2.0 * (110.0 * 46.0 + 46.0 * 7.5 + 7.5 * 110.0)).epsilon(1e-13));
  CHECK((p.centroid - centre).norm() < 1e-11);
  CHECK((p.low - (centre - size / 2.0)).norm() < 1e-13);
  CHECK((p.high - (centre + size / 2.0)).norm() < 1e-13);
  for (const auto& t : mesh.triangles) {
    const Vector3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const Vector3 outward = (middle - centre).cwiseQuotient(size);
    CHECK(area_vector(mesh, t).dot(outward) > 0.0);
  }
  // Edges along the box are at most a panel, diagonals of two of them.
  CHECK(p.longest_edge <= 9.0 * std::sqrt(2.0));
  CHECK(p.longest_edge > 9.0);
}

TEST_CASE("a box mesh is mirrored about its middle planes, diagonals included") {
  const Mesh mesh = box_mesh({11.0, 5.0, 3.0}, {1.0, 2.0, 3.0}, 1.3);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::array<long, 9>> here, mirrored;
    for (const auto& t : mesh.triangles)
      for (const bool flip : {false, true}) {
        std::array<std::array<long, 3>, 3> corners;
        for (int c = 0; c < 3; ++c)
          for (int i = 0; i < 3; ++i) {
            const double relative = mesh.vertices[t[c]][i] - (1.0 + i);
            corners[c][i] = std::lround(1e6 * (flip && i == axis ? -relative : relative));
          }
        std::ranges::sort(corners);
        std::array<long, 9> flat;
        for (int k = 0; k < 9; ++k) flat[k] = corners[k / 3][k % 3];
        (flip ? mirrored : here).push_back(flat);
      }
    std::ranges::sort(here);
    std::ranges::sort(mirrored);
    CHECK(here == mirrored);
  }
}

TEST_CASE("the automatic panel length gives the reference hull 250 to 500 vertices") {
  const double area = 2.0 * (110.0 * 46.0 + 46.0 * 7.5 + 7.5 * 110.0);
  const Mesh mesh = box_mesh({110.0, 46.0, 7.5}, Vector3::Zero(), automatic_panel_length(area));
  CHECK(mesh.vertices.size() == 434);
  CHECK(automatic_panel_length(100.0) == 2.5);
}

TEST_CASE("a tetrahedron has its closed-form volume and centroid") {
  const MeshProperties p = properties_of(tetrahedron());
  CHECK(complaint(tetrahedron()) == "");
  CHECK(p.volume == Approx(2.0 * 3.0 * 5.0 / 6.0).epsilon(1e-14));
  CHECK((p.centroid - Vector3(0.5, 0.75, 1.25)).norm() < 1e-14);
}

TEST_CASE("refinement keeps the surface and halves every long edge") {
  for (const Mesh& coarse : {tetrahedron(), box_mesh({30.0, 4.0, 2.0}, {1.0, 0.0, 0.0}, 20.0)}) {
    const Mesh fine = refined_mesh(coarse, 0.7);
    const MeshProperties before = properties_of(coarse), after = properties_of(fine);
    CHECK(complaint(fine) == "");
    CHECK(after.longest_edge <= 0.7);
    CHECK(after.volume == Approx(before.volume).epsilon(1e-12));
    CHECK(after.area == Approx(before.area).epsilon(1e-12));
    CHECK((after.centroid - before.centroid).norm() < 1e-11);
    CHECK(refined_mesh(fine, 0.7).triangles.size() == fine.triangles.size());
  }
  CHECK_THROWS_WITH(refined_mesh(tetrahedron(), 1e-3), Contains("more than a million triangles"));
  CHECK_THROWS_WITH(refined_mesh(tetrahedron(), 0.0), Contains("must be > 0"));
}

TEST_CASE("welding joins what belongs together and drops what collapses") {
  const Mesh box = box_mesh({4.0, 3.0, 2.0}, {0.5, 0.5, 0.5}, 1.0);
  Mesh loose;  // every triangle with vertices of its own, moved by less than the tolerance
  for (const auto& t : box.triangles) {
    for (const int v : t) {
      const double shake = 1e-7 * std::sin(12.9 * static_cast<double>(loose.vertices.size()));
      loose.vertices.push_back(box.vertices[v] + Vector3::Constant(shake));
    }
    const int n = static_cast<int>(loose.vertices.size());
    loose.triangles.push_back({n - 3, n - 2, n - 1});
  }
  loose.triangles.push_back({0, 1, 1});
  CHECK_THAT(complaint(loose), Contains("hull: "));
  const Mesh whole = welded_mesh(loose, 1e-6);
  CHECK(complaint(whole) == "");
  CHECK(whole.vertices.size() == box.vertices.size());
  CHECK(whole.triangles.size() == box.triangles.size());
}

TEST_CASE("a mesh that is no hull is refused with the fault and its count") {
  const Mesh box = box_mesh({4.0, 3.0, 2.0}, {0.5, 0.5, 0.5}, 1.0);
  const std::string all = std::to_string(box.triangles.size());
  CHECK_THAT(complaint(Mesh{}), Contains("no triangles"));

  Mesh open = box;
  open.triangles.pop_back();
  CHECK_THAT(complaint(open), Contains("open, 3 edges belong to one triangle only"));

  Mesh inverted = box;
  for (std::size_t t = 0; t < box.triangles.size(); ++t) turn(inverted, t);
  CHECK_THAT(complaint(inverted), Contains("inverted, all " + all + " triangles face inwards"));

  Mesh partly = box;
  for (const std::size_t t : {3, 8, 20}) turn(partly, t);
  CHECK_THAT(complaint(partly), Contains("inverted in parts, 3 of " + all + " triangles face inwards"));

  // A second body of its own, inverted as a whole.
  Mesh second = tetrahedron();
  for (std::size_t t = 0; t < 4; ++t) turn(second, t);
  for (Vector3& v : second.vertices) v.x() += 20.0;
  CHECK_THAT(complaint(joined(box, second)), Contains("inverted in parts, 4 of"));

  Mesh crowded = box;
  crowded.triangles.push_back(box.triangles[0]);
  CHECK_THAT(complaint(crowded), Contains("3 edges are shared by more than two triangles"));

  Mesh flat = box;
  flat.triangles.push_back({0, 1, 0});
  CHECK_THAT(complaint(flat), Contains("1 triangle has no area"));

  Mesh wild = box;
  wild.vertices[5].y() = std::nan("");
  CHECK_THAT(complaint(wild), Contains("1 vertex has a coordinate that is not a number"));

  Mesh lost = box;
  lost.triangles[0][0] = 5000;
  CHECK_THAT(complaint(lost), Contains("refers to vertex 5000"));

  // A Moebius strip thickened to nothing has one side; closed, that is a Klein bottle or the projective plane: the
  // latter with 6 vertices and 10 triangles, every edge shared by two.
  Mesh plane;
  for (int i = 0; i < 6; ++i) plane.vertices.push_back({std::cos(1.3 * i), std::sin(2.1 * i), 0.3 * i * i});
  plane.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                     {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  CHECK_THAT(complaint(plane), Contains("only one side"));
}

// Two triangles a face and no other corners, so that no vertex of one box need lie in another.
Mesh plain_box(const Vector3& size, const Vector3& centre) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(centre + 0.5 * Vector3(i & 1 ? size.x() : -size.x(), i & 2 ? size.y() : -size.y(),
                                                i & 4 ? size.z() : -size.z()));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

TEST_CASE("closed surfaces inside others or overlapping are refused", "[mesh]") {
  const Mesh hull = plain_box({20.0, 8.0, 6.0}, {0.0, 0.0, 0.0});
  CHECK_THAT(complaint(joined(hull, plain_box({4.0, 3.0, 2.0}, {5.0, 0.0, 0.0}))),
             Contains("1 closed surface lies inside another") && Contains("mesh_mend = true"));
  // Plating 20 mm thick: whichever way the inner side faces.
  Mesh inside = plain_box({19.96, 7.96, 5.96}, {0.0, 0.0, 0.0});
  CHECK_THAT(complaint(joined(hull, inside)), Contains("1 closed surface lies inside another"));
  for (std::size_t t = 0; t < inside.triangles.size(); ++t) turn(inside, t);
  CHECK_THAT(complaint(joined(hull, inside)), Contains("1 closed surface lies inside another"));
  CHECK_THAT(complaint(joined(joined(hull, inside), plain_box({4.0, 3.0, 2.0}, {5.0, 0.0, 0.0}))),
             Contains("2 closed surfaces lie inside"));
  // A deckhouse pushed into the deck, and beams that cross, of which none has a corner inside the other.
  CHECK_THAT(complaint(joined(hull, plain_box({4.0, 4.0, 4.0}, {-6.0, 0.0, 4.0}))),
             Contains("1 pair of closed surfaces overlaps") && Contains("unite"));
  const Mesh cross = joined(plain_box({20.0, 2.0, 2.0}, {0.0, 0.0, 0.0}), plain_box({3.0, 14.0, 1.0}, {0.3, 0.1, 0.2}));
  CHECK_THAT(complaint(cross), Contains("1 pair of closed surfaces overlaps"));
  CHECK_THAT(complaint(joined(hull, plain_box({20.0, 8.0, 6.0}, {0.1, 0.0, 0.0}))), Contains("overlaps"));
}

TEST_CASE("closed surfaces side by side, around or on each other are one hull", "[mesh]") {
  const Mesh hull = plain_box({20.0, 8.0, 6.0}, {0.0, 0.0, 0.0});
  // A catamaran; one in the box around the other, as a boat in a dock is; touching by a part of a face, an edge, a corner.
  CHECK(complaint(joined(hull, plain_box({20.0, 8.0, 6.0}, {0.0, 12.0, 0.0}))) == "");
  Mesh dock = joined(plain_box({30.0, 20.0, 2.0}, {0.0, 0.0, -8.0}), plain_box({30.0, 2.0, 12.0}, {0.0, 12.0, -3.0}));
  CHECK(complaint(joined(dock, hull)) == "");
  CHECK(complaint(joined(hull, plain_box({4.0, 4.0, 3.0}, {-6.0, 0.0, 4.5}))) == "");
  CHECK(complaint(joined(hull, plain_box({20.0, 4.0, 4.0}, {20.0, 6.0, 5.0}))) == "");
  // A step of 1e-6 of the size into each other, as coordinates of single precision have it.
  CHECK(complaint(joined(hull, plain_box({4.0, 4.0, 3.0}, {-6.0, 0.0, 4.49998}))) == "");
}

TEST_CASE("a box that cannot be divided is refused") {
  CHECK_THROWS_AS(box_mesh({0.0, 1.0, 1.0}, Vector3::Zero(), 1.0), MeshError);
  CHECK_THROWS_AS(box_mesh({std::nan(""), 1.0, 1.0}, Vector3::Zero(), 1.0), MeshError);
  CHECK_THROWS_AS(box_mesh({1.0, 1.0, 1.0}, Vector3::Zero(), 0.0), MeshError);
  CHECK_THROWS_WITH(box_mesh({100.0, 100.0, 1.0}, Vector3::Zero(), 0.01), Contains("more than a million triangles"));
  CHECK_THROWS_AS(box_mesh({1e300, 1.0, 1.0}, Vector3::Zero(), 1e-3), MeshError);
}

}  // namespace
}  // namespace stillhook

namespace stillhook {

TEST_CASE("mending leaves out what lies inside, and never turns it outwards", "[mesh]") {
  const Mesh hull = box_mesh({20.0, 8.0, 6.0}, {0.0, 0.0, 0.0}, 2.0);
  Mesh both = hull;
  const Mesh inside = box_mesh({19.9, 7.9, 5.9}, {0.0, 0.0, 0.0}, 2.0);
  const int n = static_cast<int>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), inside.vertices.begin(), inside.vertices.end());
  for (const auto& t : inside.triangles) both.triangles.push_back({t[1] + n, t[0] + n, t[2] + n});  // into the room
  std::string done;
  const Mesh mended = mended_mesh(both, done);
  CHECK(done == "1 closed surface inside another left out");
  CHECK_NOTHROW(check_mesh(mended, "box"));
  CHECK(mended.vertices.size() == hull.vertices.size());
  CHECK(properties_of(mended).volume == Approx(20.0 * 8.0 * 6.0).epsilon(1e-12));  // of the outer side: rounding
}

TEST_CASE("a mesh with small faults is mended when that is asked for", "[mesh]") {
  const Mesh good = box_mesh(Vector3(20.0, 10.0, 6.0), Vector3(0.0, 0.0, 0.0), 1.0);
  std::string done;
  const Mesh same = mended_mesh(good, done);
  CHECK(done.empty());
  CHECK(same.triangles == good.triangles);

  Mesh bad = good;
  bad.triangles.erase(bad.triangles.begin() + 40);                           // one triangle missing
  for (int i = 100; i < 110; ++i) std::swap(bad.triangles[i][1], bad.triangles[i][2]);  // ten turned
  CHECK_THROWS_AS(check_mesh(bad, "box"), MeshError);
  const Mesh mended = mended_mesh(bad, done);
  CHECK(done == "1 hole closed, 10 triangles turned outwards");
  CHECK_NOTHROW(check_mesh(mended, "box"));
  CHECK(properties_of(mended).volume == Approx(1200.0).epsilon(1e-12));

  Mesh inside_out = good;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  CHECK(properties_of(mended_mesh(inside_out, done)).volume == Approx(1200.0));

  // A missing side is no small hole: it is left open, and named.
  Mesh open = good;
  std::erase_if(open.triangles, [&](const auto& t) {
    return good.vertices[t[0]].z() > 2.99 && good.vertices[t[1]].z() > 2.99 && good.vertices[t[2]].z() > 2.99;
  });
  const Mesh left = mended_mesh(open, done);
  CHECK(done.empty());
  CHECK_THROWS_WITH(check_mesh(left, "box"), Catch::Contains("open"));
}

}  // namespace stillhook
