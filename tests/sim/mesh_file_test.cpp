#include "sim/hull/mesh/mesh_file.h"

#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

// A folder of its own for each test case, gone afterwards.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("stillhook_mesh_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& bytes) const {
    const std::string path = (path_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string complaint(const std::string& path, const MeshFileOptions& options = {}) {
  try {
    read_mesh(path, options);
  } catch (const MeshError& e) {
    return e.what();
  }
  return "";
}

const Mesh& box() {
  static const Mesh mesh = box_mesh({8.0, 6.0, 3.0}, {1.0, -0.5, 0.25}, 1.5);
  return mesh;
}

std::string ascii_stl(const Mesh& mesh) {
  std::ostringstream s;
  s << "solid hull of test\r\n";
  for (const auto& t : mesh.triangles) {
    s << "  facet normal 0 0 0\r\n    outer loop\r\n";
    for (const int v : t)
      s << "      vertex " << mesh.vertices[v].x() << " +" << mesh.vertices[v].y() + 100.0 << " " << std::scientific
        << mesh.vertices[v].z() << std::defaultfloat << "\r\n";
    s << "    endloop\r\n  endfacet\r\n";
  }
  s << "endsolid hull of test\r\n";
  return s.str();
}

void put(std::string& bytes, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(word >> (8 * i)));
}
void put(std::string& bytes, float value) { put(bytes, std::bit_cast<std::uint32_t>(value)); }

// The header begins with "solid" and the normals point the wrong way, as some programs write them.
std::string binary_stl(const Mesh& mesh) {
  std::string bytes = "solid binary";
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Vector3 wrong = -area_vector(mesh, t).normalized();
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(wrong[i]));
    for (const int v : t)
      for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(mesh.vertices[v][i]));
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::string kObj =
    "# a box of quadrilaterals\nmtllib x.mtl\no box\n"
    "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\n"
    "vn 0 0 1\ns off\nf 1 4 3 2\nf 5//1 6//1 7//1 8//1\nf 1/1 2/1 6/1 5/1\nf 2 3 7 6 # side\nf 3 4 8 7\nf -8 -4 -1\n";

// A quarter of a box 8 x 4 x 3 m, closed by its own deck, with both planes of symmetry. Vertices counter-clockwise
// seen from the water.
const std::string kGdf =
    "quarter of a box\n1.0 9.80665\n1 1\n4\n"
    "0 0 -2  0 2 -2  4 2 -2  4 0 -2\n"
    "4 0 -2  4 2 -2  4 2 1  4 0 1\n"
    "0 2 -2  0 2 1  4 2 1  4 2 -2\n"
    "0 0 1  4 0 1  4.0D0 2 1  0 2 1\n";

TEST_CASE("STL files, ascii and binary, give back the box") {
  const Folder folder;
  const MeshProperties truth = properties_of(box());
  {
    const Mesh mesh = read_mesh(folder.write("a.stl", ascii_stl(box())));
    const MeshProperties p = properties_of(mesh);
    CHECK(mesh.vertices.size() == box().vertices.size());
    CHECK(mesh.triangles.size() == box().triangles.size());
    CHECK(p.volume == Approx(truth.volume).epsilon(1e-12));  // coordinates written in full
    CHECK((p.centroid - truth.centroid - Vector3(0.0, 100.0, 0.0)).norm() < 1e-10);
  }
  {
    const MeshFileOptions options{0.3048, {10.0, 20.0, 30.0}};
    const Mesh mesh = read_mesh(folder.write("B.STL", binary_stl(box())), options);
    CHECK(mesh.vertices.size() == box().vertices.size());
    const MeshProperties p = properties_of(mesh);
    CHECK(p.volume == Approx(truth.volume * std::pow(0.3048, 3)).epsilon(1e-6));  // single precision
    CHECK((p.centroid - (options.origin + 0.3048 * truth.centroid)).norm() < 1e-5);
  }
}

TEST_CASE("a hull longer than any vessel is refused with the scale that would do") {
  const Folder folder;
  Mesh millimetres = box();
  for (Vector3& v : millimetres.vertices) v *= 1000.0;
  const std::string path = folder.write("mm.stl", binary_stl(millimetres));
  CHECK_THAT(complaint(path), Contains("the hull is 8000 m long") && Contains("With mesh_scale = 0.001 (millimetres) it is 8 m"));
  CHECK(complaint(path, {0.001}) == "");
  CHECK_THAT(complaint(path, {0.5}), Contains("is 4000 m long") && Contains("mesh_scale = 0.0005 (millimetres) it is 4 m"));
}

// The wetted surface of half a box 20 x 8 x 3 m, with its plane of symmetry y = 0 (ISY) and open at z = 0.
const std::string kWetted =
    "wetted surface\n1.0 9.80665\n0 1\n4\n"
    "-10 0 -3  -10 4 -3  10 4 -3  10 0 -3\n"
    "-10 4 -3  -10 4 0  10 4 0  10 4 -3\n"
    "10 0 -3  10 4 -3  10 4 0  10 0 0\n"
    "-10 0 -3  -10 0 0  -10 4 0  -10 4 -3\n";

TEST_CASE("a wetted surface is closed by sides drawn up to a deck") {
  const Folder folder;
  const std::string path = folder.write("wetted.gdf", kWetted);
  CHECK_THAT(complaint(path), Contains("open at its top alone") && Contains("mesh_deck_height_m"));
  MeshFileOptions options;
  options.deck_height = 2.5;
  options.origin = Vector3(1.0, 0.0, 0.5);
  const MeshProperties p = properties_of(read_mesh(path, options));
  CHECK(p.volume == Approx(20.0 * 8.0 * 5.5).epsilon(1e-12));  // rounding
  CHECK((p.centroid - Vector3(1.0, 0.0, 0.25)).norm() < 1e-12);
  CHECK(p.high.z() == Approx(3.0));
  // The lid of the water surface, which codes use against irregular frequencies, makes no deck at z = 0.
  std::string lid = kWetted;
  lid.replace(lid.find("\n4\n"), 3, "\n5\n");
  lid += "-10 0 0  10 0 0  10 4 0  -10 4 0\n";
  CHECK(properties_of(read_mesh(folder.write("lid.gdf", lid), options)).volume == Approx(20.0 * 8.0 * 5.5).epsilon(1e-12));
  std::string doubt;
  read_mesh(folder.write("lid.gdf", lid), {}, &doubt);
  CHECK_THAT(doubt, Contains("ends at z = 0") && Contains("mesh_deck_height_m"));
  // A whole hull needs none; a hole lower down is no rim.
  CHECK_THAT(complaint(folder.write("box.gdf", kGdf), options), Contains("it needs no mesh_deck_height_m"));
  std::string hole = kWetted;
  hole.replace(hole.find("\n4\n"), 3, "\n3\n");
  hole.resize(hole.find("-10 0 -3  -10 0 0"));
  CHECK_THAT(complaint(folder.write("hole.gdf", hole), options), Contains("of its 8 open edges some lie below"));
}

TEST_CASE("a deck that is not convex has its own area") {
  const Folder folder;
  // An L of 12 x 10 m with a foot of 4 x 4 m taken away, 2 m deep, seen from above counter-clockwise.
  const double corner[][2] = {{0, 0}, {12, 0}, {12, 4}, {4, 4}, {4, 10}, {0, 10}};
  std::ostringstream obj;
  for (const double z : {-2.0, 0.0})
    for (const auto& c : corner) obj << "v " << c[0] << ' ' << c[1] << ' ' << z << '\n';
  obj << "f 4 3 2 1\nf 6 5 4 1\n";  // bottom, facing down
  for (int i = 1; i <= 6; ++i) obj << "f " << i << ' ' << i % 6 + 1 << ' ' << i % 6 + 7 << ' ' << i + 6 << '\n';
  MeshFileOptions options;
  options.deck_height = 1.0;
  CHECK(properties_of(read_mesh(folder.write("l.obj", obj.str()), options)).volume ==
        Approx((12.0 * 4.0 + 4.0 * 6.0) * 3.0).epsilon(1e-12));
}

TEST_CASE("OBJ polygons, negative indices and GDF symmetry give closed hulls") {
  const Folder folder;
  // The last face has three of the four corners of the side x = 0; the fourth makes it a quadrilateral.
  CHECK_THAT(complaint(folder.write("open.obj", kObj)), Contains("open, 3 edges"));
  const Mesh obj = read_mesh(folder.write("box.obj", kObj + "f -8 -1 -5\n"));
  CHECK(obj.vertices.size() == 8);
  CHECK(obj.triangles.size() == 12);
  CHECK(properties_of(obj).volume == Approx(8.0).epsilon(1e-14));

  const Mesh gdf = read_mesh(folder.write("box.gdf", kGdf));
  const MeshProperties p = properties_of(gdf);
  CHECK(p.volume == Approx(8.0 * 4.0 * 3.0).epsilon(1e-14));
  CHECK((p.centroid - Vector3(0.0, 0.0, -0.5)).norm() < 1e-13);
  CHECK(gdf.triangles.size() == 32);
}

TEST_CASE("broken mesh files get a sentence") {
  const Folder folder;
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_THAT(complaint(folder.path() + "/none.stl"), Contains("none.stl: there is no such file"));
  CHECK_THAT(complaint(folder.path()), Contains("extension must be"));
  std::filesystem::create_directories(folder.path() + "/folder.stl");
  CHECK_THAT(complaint(folder.path() + "/folder.stl"), Contains("is not a file"));
  CHECK_THAT(complaint(folder.write("hull.step", "ISO")), Contains("extension must be .stl, .obj or .gdf"));
  for (const char* name : {"e.stl", "e.obj", "e.gdf"}) CHECK_THAT(complaint(folder.write(name, "")), Contains("empty"));
  CHECK_THAT(complaint(folder.write("a.obj", kObj), {0.0, Vector3::Zero()}), Contains("scale"));

  // STL
  const std::string ascii = ascii_stl(box()), binary = binary_stl(box());
  CHECK_THAT(complaint(folder.write("t.stl", ascii.substr(0, ascii.size() / 2))),
             Contains("ends early") || Contains("coordinates are needed") || Contains("not a number"));
  CHECK_THAT(complaint(folder.write("n.stl", with(ascii, "vertex ", "vertex nan "))),
             Contains("n.stl:4: \"nan\" is not a number"));
  CHECK_THAT(complaint(folder.write("w.stl", with(ascii, "outer loop", "outer loop\nvortex 1 2 3"))),
             Contains("w.stl:4: \"vortex\" is not a word"));
  CHECK_THAT(
      complaint(folder.write(
          "m.stl",
          "once upon a time there was a hull that nobody had ever drawn to the end, and it is longer than a header")),
      Contains("is not an STL file"));
  CHECK_THAT(complaint(folder.write("s.stl", "solid\nendsolid\n")), Contains("no triangles"));
  CHECK_THAT(complaint(folder.write("bt.stl", binary.substr(0, binary.size() - 77))),
             Contains("announces " + std::to_string(box().triangles.size()) + " triangles, but has room for " +
                      std::to_string(box().triangles.size() - 2)));
  std::string lying = binary;
  for (int i = 80; i < 84; ++i) lying[i] = '\xff';
  CHECK_THAT(complaint(folder.write("bl.stl", lying)), Contains("announces 4294967295 triangles"));
  std::string nan = binary;
  for (int i = 0; i < 4; ++i) nan[84 + 12 + i] = '\xff';
  CHECK_THAT(complaint(folder.write("bn.stl", nan)), Contains("triangle 1 has a coordinate that is not a number"));
  Mesh inverted = box();
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  CHECK_THAT(complaint(folder.write("bi.stl", binary_stl(inverted))), Contains("inverted, all"));

  // OBJ
  CHECK_THAT(complaint(folder.write("i.obj", with(kObj, "f 1 4", "f 1 44"))),
             Contains("i.obj:14: vertex 44 does not exist, there are 8"));
  CHECK_THAT(complaint(folder.write("z.obj", with(kObj, "f 1 4", "f 0 4"))), Contains("vertex 0 does not exist"));
  CHECK_THAT(complaint(folder.write("p.obj", with(kObj, "f 1 4 3 2", "f 1 4"))), Contains("at least 3 vertices"));
  CHECK_THAT(complaint(folder.write("v.obj", with(kObj, "v 4 0 0", "v 4 0"))),
             Contains("v.obj:5: three coordinates are needed, found 2"));
  CHECK_THAT(complaint(folder.write("k.obj", "curv 1 2\n")), Contains("\"curv\" is not a word of an OBJ file"));
  CHECK_THAT(complaint(folder.write("h.obj", with(kObj, "v 4 0 0", "v 4e99 0 0"))), Contains("the hull is 4e+99 m long"));

  // GDF
  CHECK_THAT(complaint(folder.write("o.gdf", with(kGdf, "\n4\n", "\n3\n"))),
             Contains("more numbers follow the 3 panels"));
  CHECK_THAT(complaint(folder.write("s.gdf", with(kGdf, "\n4\n", "\n999999999\n"))),
             Contains("ends before panel 999999999"));
  CHECK_THAT(complaint(folder.write("n.gdf", with(kGdf, "\n4\n", "\n-4\n"))), Contains("must be at least 1"));
  CHECK_THAT(complaint(folder.write("h.gdf", with(kGdf, "\n4\n", "\n4 1\n"))), Contains("higher-order"));
  CHECK_THAT(complaint(folder.write("f.gdf", with(kGdf, "9.80665", "32.174"))), Contains("in feet"));
  CHECK_THAT(complaint(folder.write("x.gdf", with(kGdf, "1 1\n4", "1 2\n4"))), Contains("ISX and ISY must be 0 or 1"));
  CHECK_THAT(complaint(folder.write("y.gdf", with(kGdf, "1 1\n4", "0 1\n4"))), Contains("open"));
  const std::string below = with(with(kGdf, "\n4\n", "\n3\n"), "0 0 1  4 0 1  4.0D0 2 1  0 2 1\n", "");
  CHECK_THAT(complaint(folder.write("b.gdf", below)), Contains("a hull must be closed, deck included"));
  std::string garbage;
  for (int i = 0; i < 5000; ++i) garbage.push_back(static_cast<char>((i * 7919) >> 3));
  for (const char* name : {"g.stl", "g.obj", "g.gdf"}) CHECK(complaint(folder.write(name, garbage)) != "");
}

TEST_CASE("a file cut off anywhere is refused, never read beyond its end") {
  const Folder folder;
  const Mesh small = box_mesh({2.0, 2.0, 2.0}, Vector3::Zero(), 2.0);
  const std::string files[3] = {ascii_stl(small), binary_stl(small), kGdf};
  const char* names[3] = {"c.stl", "c.stl", "c.gdf"};
  for (int f = 0; f < 3; ++f)
    // The last word may lose its line end, so stop before it.
    for (std::size_t length = 0; length + 25 < files[f].size(); length += 37)
      CHECK(complaint(folder.write(names[f], files[f].substr(0, length))) != "");
}

}  // namespace
}  // namespace stillhook
