// Meshes as panel codes and drawing programs write them: corners that do not meet, one side alone, comments.
#include "sim/hull/mesh/mesh_seams.h"

#include <catch2/catch.hpp>

#include "sim/hull/mesh/mesh_edges.h"
#include "sim/hull/mesh/mesh_file.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

std::string refusal(const std::string& path, const MeshFileOptions& options = {}) {
  try {
    read_mesh(path, options);
  } catch (const MeshError& e) {
    return e.what();
  }
  return "";
}

// A box 8 x 4 x 3 m, its side y = 4 of two panels side by side and the others of one: the corners in the middle of that
// side lie on edges of the bottom and of the deck. `off` moves them off those edges, into the side's plane.
std::string two_panels(double off) {
  const std::string low = std::to_string(-2.0 + off), high = std::to_string(1.0 - off);
  return "box\n1 9.81\n0 0\n7\n"
         "0 0 -2  0 4 -2  8 4 -2  8 0 -2\n"
         "0 0 1  8 0 1  8 4 1  0 4 1\n"
         "0 0 -2  8 0 -2  8 0 1  0 0 1\n"
         "0 0 -2  0 0 1  0 4 1  0 4 -2\n"
         "8 0 -2  8 4 -2  8 4 1  8 0 1\n"
         "0 4 -2  0 4 1  5 4 " +
         high + "  5 4 " + low +
         "\n"
         "5 4 " +
         low + "  5 4 " + high + "  8 4 1  8 4 -2\n";
}

TEST_CASE("panels whose corners lie on edges of their neighbours are one surface") {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.write("exact.gdf", two_panels(0.0)));
  CHECK(is_closed(edges_of(mesh)));
  CHECK(properties_of(mesh).volume == Approx(96.0).epsilon(1e-13));  // rounding
  // As far off as six printed digits allow: 5e-5 m of 9.4 m.
  CHECK(properties_of(read_mesh(folder.write("rounded.gdf", two_panels(5e-5)))).volume == Approx(96.0).epsilon(1e-4));
  // Further off it is the user's decision, and no more than that distance times the side's length is at stake.
  const std::string gap = folder.write("gap.gdf", two_panels(0.004));
  CHECK_THAT(refusal(gap),
             Contains("the mesh is open") &&
                 Contains("mesh_mend = true would close it: corners up to 0.004 m apart from their neighbours"));
  MeshFileOptions mend;
  mend.mend = true;
  std::string done;
  CHECK(properties_of(read_mesh(gap, mend, &done)).volume == Approx(96.0).margin(2.0 * 0.004 * 8.0 * 4.0));
  CHECK_THAT(done, Contains("corners up to 0.004 m apart from their neighbours joined to them"));
  // A hole is no seam.
  CHECK_THAT(refusal(folder.write("hole.gdf", two_panels(0.2))), Contains("the mesh is open"));
}

TEST_CASE("a triangle of no area that fills such a seam is left out") {
  const TemporaryFolder folder;
  // A tetrahedron of unit legs with a corner (5) in the middle of an edge: one face has it, the other face's edge is
  // filled by the flat triangle 1 2 5.
  const std::string path = folder.write("flat.obj",
                                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\n"
                                        "f 1 3 2\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 1 4 3\nf 1 2 5\n");
  const Mesh mesh = read_mesh(path);
  CHECK(is_closed(edges_of(mesh)));
  CHECK(properties_of(mesh).volume == Approx(1.0 / 6.0).epsilon(1e-13));
}

TEST_CASE("a file of one side is mirrored when the case says so") {
  const TemporaryFolder folder;
  // The starboard half of a box 8 x 4 x 3 m without its middle plane, as NEMOH's meshes are.
  const std::string half =
      "half\n1 9.81\n0 0\n5\n"
      "0 -2 -2  0 0 -2  8 0 -2  8 -2 -2\n"
      "0 -2 1  8 -2 1  8 0 1  0 0 1\n"
      "0 -2 -2  8 -2 -2  8 -2 1  0 -2 1\n"
      "0 -2 -2  0 -2 1  0 0 1  0 0 -2\n"
      "8 -2 -2  8 0 -2  8 0 1  8 -2 1\n";
  const std::string half_path = folder.write("half.gdf", half);
  CHECK_THAT(refusal(half_path), Contains("lies on one side of y = 0") && Contains("mesh_mirror = true"));
  MeshFileOptions mirror;
  mirror.mirror = true;
  mirror.origin = Vector3(1.0, 5.0, 0.0);
  const MeshProperties p = properties_of(read_mesh(half_path, mirror));
  CHECK(p.volume == Approx(96.0).epsilon(1e-13));
  CHECK((p.centroid - Vector3(5.0, 5.0, -0.5)).norm() < 1e-12);
  // With a wall in the middle plane the half is a hull of its own, and the mirrored one has no wall.
  std::string wall = half;
  wall.replace(wall.find("\n5\n"), 3, "\n6\n");
  wall += "0 0 -2  0 0 1  8 0 1  8 0 -2\n";
  const std::string wall_path = folder.write("wall.gdf", wall);
  CHECK(properties_of(read_mesh(wall_path)).volume == Approx(48.0).epsilon(1e-13));
  const Mesh whole = read_mesh(wall_path, mirror);
  CHECK(properties_of(whole).volume == Approx(96.0).epsilon(1e-13));
  CHECK(whole.triangles.size() == 20);
  // A file that has both sides, by its own symmetry too, has nothing to mirror.
  std::string symmetric = half;
  symmetric.replace(symmetric.find("0 0\n5"), 3, "0 1");
  const std::string symmetric_path = folder.write("symmetric.gdf", symmetric);
  CHECK(properties_of(read_mesh(symmetric_path)).volume == Approx(96.0).epsilon(1e-13));
  CHECK_THAT(refusal(symmetric_path, mirror), Contains("this one reaches from y = -2 to 2"));
}

TEST_CASE("what programs write besides numbers is no fault, and what cannot be read is named") {
  const TemporaryFolder folder;
  const auto said = [&](const char* name, const std::string& text) { return refusal(folder.write(name, text)); };
  std::string commented = two_panels(0.0);
  commented.replace(commented.find("\n7\n"), 3, "\n7   NPAN\n");
  CHECK(said("commented.gdf", commented + "end of file\n") == "");
  CHECK_THAT(said("more.gdf", two_panels(0.0) + "1.0\n"), Contains("more numbers follow the 7 panels"));
  CHECK_THAT(said("higher.gdf", "hull\n1 9.81\n0 1\n12 1\n"), Contains("higher-order file") && Contains("_low.gdf"));
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  CHECK(said("marked.obj", "\xEF\xBB\xBF" + obj) == "");
  std::string inverted = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";
  CHECK_THAT(said("inverted.obj", inverted), Contains("all 4 triangles face inwards; mesh_mend = true turns them"));
  for (const char* name : {"hull.dat", "hull.mar", "hull.msh", "hull.ply", "hull.pnl"})
    CHECK_THAT(said(name, "2 0\n"), Contains(".stl, .obj or .gdf") && Contains("must be converted"));
}

}  // namespace
}  // namespace stillhook
