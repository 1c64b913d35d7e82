#include "sim/hull/mesh/mesh_formats.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace stillhook {

namespace {

constexpr std::uintmax_t kMostBytes = 256u << 20;

[[noreturn]] void fail_mesh(const std::string& where, const std::string& sentence) {
  throw MeshError(where + ": " + sentence);
}

std::string read_bytes(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) fail_mesh(path, "there is no such file");
  if (!std::filesystem::is_regular_file(status)) fail_mesh(path, "is not a file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail_mesh(path, "cannot be read");
  if (size == 0) fail_mesh(path, "the file is empty");
  if (size > kMostBytes) fail_mesh(path, "the file is larger than 256 MB");
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) fail_mesh(path, "cannot be read");
  return bytes;
}

std::string lower(std::string_view text) {
  std::string s(text);
  std::ranges::transform(s, s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Walks a text line by line and word by word, and knows where it is when something is wrong.
class Words {
 public:
  Words(const std::string& path, std::string_view text) : path_(path), rest_(text) {}

  /// Goes to the next line; false at the end of the file.
  bool next_line() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++number_;
    return true;
  }
  /// The next word of the line, empty at its end.
  std::string_view word() {
    while (!line_.empty() && is_space(line_.front())) line_.remove_prefix(1);
    std::size_t n = 0;
    while (n < line_.size() && !is_space(line_[n])) ++n;
    const std::string_view w = line_.substr(0, n);
    line_.remove_prefix(n);
    return w;
  }
  /// The next word of the file, over ends of lines; empty at the end of the file.
  std::string_view word_anywhere() {
    std::string_view w = word();
    while (w.empty() && next_line()) w = word();
    return w;
  }
  double number(std::string_view w) const {
    std::string text(w);
    std::ranges::replace_if(
        text, [](char c) { return c == 'D' || c == 'd'; }, 'e');  // Fortran
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || begin == end || !std::isfinite(value))
      complain(quoted(w) + " is not a number");
    return value;
  }
  /// Whether it is one; a comment is none.
  static bool is_number(std::string_view w) {
    return !w.empty() && (std::isdigit(static_cast<unsigned char>(w.front())) != 0 ||
                          (w.size() > 1 && (w.front() == '-' || w.front() == '+' || w.front() == '.') &&
                           (std::isdigit(static_cast<unsigned char>(w[1])) != 0 || w[1] == '.')));
  }
  long integer(std::string_view w) const {
    const double v = number(w);
    if (v != std::floor(v) || std::abs(v) > 1e9) complain(quoted(w) + " is not a whole number");
    return static_cast<long>(v);
  }
  Vector3 point() {
    Vector3 p;
    for (int i = 0; i < 3; ++i) {
      const std::string_view w = word();
      if (w.empty()) complain("three coordinates are needed, found " + std::to_string(i));
      p[i] = number(w);
    }
    return p;
  }
  [[noreturn]] void complain(const std::string& sentence) const {
    fail_mesh(path_ + ":" + std::to_string(number_), sentence);
  }
  /// A word as it is shown in a message: in quotes, cut short, without control characters.
  static std::string quoted(std::string_view w) {
    std::string s = "\"";
    s.append(w.substr(0, 40));
    std::ranges::replace_if(
        s, [](unsigned char c) { return c < 32 || c > 126; }, '?');
    s.push_back('"');
    return s;
  }

 private:
  std::string path_;
  std::string_view rest_, line_;
  long number_ = 0;
};

// Three vertices of their own for every triangle; merging makes them one mesh.
void add_triangle(Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c, const std::string& path) {
  if (mesh.triangles.size() >= kMostTriangles) fail_mesh(path, "the mesh has more than a million triangles");
  const int n = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.push_back({n, n + 1, n + 2});
}

std::uint32_t little_endian_32(const char* at) {
  unsigned char b[4];
  std::memcpy(b, at, 4);
  return b[0] | (b[1] << 8) | (b[2] << 16) | (static_cast<std::uint32_t>(b[3]) << 24);
}

double little_endian_float(const char* at) {
  const std::uint32_t bits = little_endian_32(at);
  float value;
  std::memcpy(&value, &bits, 4);
  return value;
}

Mesh read_binary_stl(const std::string& path, const std::string& bytes) {
  const std::uint64_t count = little_endian_32(bytes.data() + 80);
  if (count > kMostTriangles) fail_mesh(path, "the mesh has more than a million triangles");
  Mesh mesh;
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + 84 + 50 * i + 12;  // past the normal
    Vector3 corner[3];
    for (int k = 0; k < 9; ++k) {
      const double v = little_endian_float(at + 4 * k);
      if (!std::isfinite(v))
        fail_mesh(path, "triangle " + std::to_string(i + 1) + " has a coordinate that is not a number");
      corner[k / 3][k % 3] = v;
    }
    add_triangle(mesh, corner[0], corner[1], corner[2], path);
  }
  return mesh;
}

Mesh read_ascii_stl(const std::string& path, const std::string& text) {
  Words words(path, text);
  Mesh mesh;
  std::vector<Vector3> loop;
  bool inside = false, ended = false;
  while (words.next_line()) {
    const std::string key = lower(words.word());
    if (key.empty() || key == "solid" || key == "outer" || key == "endloop") continue;
    if (key == "facet") {
      if (inside) words.complain("a facet begins inside another");
      inside = true, loop.clear();
    } else if (key == "vertex") {
      if (!inside) words.complain("a vertex stands outside a facet");
      loop.push_back(words.point());
    } else if (key == "endfacet") {
      if (loop.size() != 3) words.complain("a facet has " + std::to_string(loop.size()) + " vertices, not 3");
      add_triangle(mesh, loop[0], loop[1], loop[2], path);
      inside = false, loop.clear();
    } else if (key == "endsolid") {
      ended = true;
    } else {
      words.complain(Words::quoted(key) + " is not a word of an STL file");
    }
  }
  if (inside || !ended) fail_mesh(path, "the file ends early, \"endsolid\" is missing");
  return mesh;
}

Mesh read_stl(const std::string& path, const std::string& bytes) {
  if (bytes.size() >= 84 && bytes.size() == 84 + 50 * static_cast<std::uint64_t>(little_endian_32(bytes.data() + 80)))
    return read_binary_stl(path, bytes);
  const bool text = bytes.find('\0') == std::string::npos;
  if (text && lower(std::string_view(bytes).substr(0, 200)).find("solid") != std::string::npos)
    return read_ascii_stl(path, bytes);
  if (text || bytes.size() < 84) fail_mesh(path, "is not an STL file");
  fail_mesh(path, "a binary STL file that announces " + std::to_string(little_endian_32(bytes.data() + 80)) +
                      " triangles, but has room for " + std::to_string((bytes.size() - 84) / 50));
}

// "7", "7/1", "7//3" or "7/1/3", counted from 1 or, if negative, from the last vertex.
int obj_index(const Words& words, std::string_view w, std::size_t vertices) {
  const long given = words.integer(w.substr(0, w.find('/')));
  const long index = given > 0 ? given - 1 : static_cast<long>(vertices) + given;
  if (given == 0 || index < 0 || index >= static_cast<long>(vertices))
    words.complain("vertex " + std::to_string(given) + " does not exist, there are " + std::to_string(vertices) +
                   " so far");
  return static_cast<int>(index);
}

Mesh read_obj(const std::string& path, const std::string& text) {
  static constexpr std::string_view passed_over[] = {"vn", "vt", "vp", "o", "g", "s", "usemtl", "mtllib", "l", "p"};
  Words words(path, text);
  Mesh mesh;
  while (words.next_line()) {
    const std::string_view key = words.word();
    if (key.empty() || key.front() == '#' || std::ranges::find(passed_over, key) != std::end(passed_over)) continue;
    if (key == "v") {
      mesh.vertices.push_back(words.point());
    } else if (key == "f") {
      std::vector<int> loop;
      for (std::string_view w = words.word(); !w.empty() && w.front() != '#'; w = words.word())
        loop.push_back(obj_index(words, w, mesh.vertices.size()));
      if (loop.size() < 3) words.complain("a face needs at least 3 vertices, got " + std::to_string(loop.size()));
      for (std::size_t i = 2; i < loop.size(); ++i) mesh.triangles.push_back({loop[0], loop[i - 1], loop[i]});
      if (mesh.triangles.size() > kMostTriangles) fail_mesh(path, "the mesh has more than a million triangles");
    } else {
      words.complain(Words::quoted(key) + " is not a word of an OBJ file");
    }
  }
  return mesh;
}

double gdf_number(Words& words, const std::string& path, const char* what) {
  const std::string_view w = words.word_anywhere();
  if (w.empty()) fail_mesh(path, std::string("the file ends before ") + what);
  return words.number(w);
}

void add_gdf_panel(Mesh& mesh, std::array<Vector3, 4> panel, bool mirror_x, bool mirror_y, const std::string& path) {
  if (mirror_x)
    for (Vector3& p : panel) p.x() = -p.x();
  if (mirror_y)
    for (Vector3& p : panel) p.y() = -p.y();
  if (mirror_x != mirror_y) std::ranges::reverse(panel);
  add_triangle(mesh, panel[0], panel[1], panel[2], path);
  add_triangle(mesh, panel[0], panel[2], panel[3], path);
}

Mesh read_gdf(const std::string& path, const std::string& text, double scale) {
  Words words(path, text);
  words.next_line();  // title
  words.next_line();
  const double length = gdf_number(words, path, "ULEN"), gravity = gdf_number(words, path, "GRAV");
  if (!(length > 0.0)) words.complain("ULEN must be > 0");
  if (gravity > 30.0 && gravity < 34.0 && scale == 1.0)
    words.complain("GRAV is given in ft/s2, so the coordinates are in feet: give the mesh a scale of 0.3048");
  words.next_line();
  const double isx = gdf_number(words, path, "ISX"), isy = gdf_number(words, path, "ISY");
  if ((isx != 0.0 && isx != 1.0) || (isy != 0.0 && isy != 1.0)) words.complain("ISX and ISY must be 0 or 1");
  words.next_line();
  const std::string_view panels_word = words.word_anywhere();
  if (panels_word.empty()) fail_mesh(path, "the file ends before the number of panels");
  const long panels = words.integer(panels_word);
  if (const std::string_view next = words.word(); words.is_number(next))
    words.complain(
        "NPATCH and IGDEF of a higher-order file, which is not read: WAMIT writes its panels as a low-order one, "
        "<name>_low.gdf, with ILOWGDF = 1 in its .cfg file");
  if (panels < 1) words.complain("the number of panels must be at least 1, got " + std::to_string(panels));

  Mesh mesh;
  const std::string end = "panel " + std::to_string(panels) + ", the last that it announces";
  for (long i = 0; i < panels; ++i) {
    std::array<Vector3, 4> panel;
    for (Vector3& p : panel)
      for (int k = 0; k < 3; ++k) p[k] = gdf_number(words, path, end.c_str());
    for (int mirror = 0; mirror < 4; ++mirror) {
      const bool x = mirror & 1, y = mirror & 2;
      if ((!x || isx == 1.0) && (!y || isy == 1.0)) add_gdf_panel(mesh, panel, x, y, path);
    }
  }
  if (words.is_number(words.word_anywhere()))
    words.complain("more numbers follow the " + std::to_string(panels) + " panels that the file announces");
  return mesh;
}

}  // namespace

Mesh mesh_in_file(const std::string& path, double scale) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension != ".stl" && extension != ".obj" && extension != ".gdf")
    fail_mesh(
        path,
        "the extension must be .stl, .obj or .gdf; meshes of other programs (.dat and .mar of NEMOH, .pnl of HAMS, "
        ".msh, .ply) must be converted to one of these, which meshmagick, BEMRosetta and meshio can do");
  std::string bytes = read_bytes(path);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);  // a byte-order mark
  Mesh mesh = extension == ".stl"   ? read_stl(path, bytes)
              : extension == ".obj" ? read_obj(path, bytes)
                                    : read_gdf(path, bytes, scale);
  if (mesh.triangles.empty()) fail_mesh(path, "the file holds no triangles");
  return mesh;
}

}  // namespace stillhook
