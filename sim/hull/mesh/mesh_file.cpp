#include "sim/hull/mesh/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/hull/mesh/mesh_deck.h"
#include "sim/hull/mesh/mesh_formats.h"
#include "sim/hull/mesh/mesh_seams.h"

namespace stillhook {
namespace {

constexpr double kLongest = 1000.0, kShortest = 0.5;  // m: twice the longest ship there is; a model in a basin
constexpr double kFarthest = 1e5;                     // m, a hull does not reach further from its origin
constexpr double kWeld = 1e-6;                        // of the mesh's size

[[noreturn]] void fail_file(const std::string& path, const std::string& sentence) {
  throw MeshError(path + ": " + sentence);
}

/// A hull in the wrong unit floats nowhere, and what fails then does not tell why.
void check_size(double length, double scale, const std::string& path) {
  if (length <= kLongest) return;
  std::ostringstream sentence;
  sentence << "the hull is " << length << " m long, more than the " << kLongest
           << " m that any vessel has: in which unit is the file?";
  for (const auto& [factor, unit] : {std::pair{1e-3, "millimetres"}, std::pair{1e-2, "centimetres"}})
    if (length * factor >= kShortest && length * factor <= kLongest)
      sentence << " With mesh_scale = " << scale * factor << " (" << unit << ") it is " << length * factor
               << " m long.";
  fail_file(path, sentence.str());
}

/// Joins corners to edges further away than rounding explains, as little as it needs, and says so.
Mesh with_mended_seams(const Mesh& mesh, double size, std::string& done) {
  if (const EdgeMap edges = edges_of(mesh); is_closed(edges) || open_at_top_only(mesh, edges)) return mesh;
  for (const double tolerance : {1e-4, 3e-4, 1e-3}) {
    double moved = 0.0;
    const double weld = std::min(tolerance, 1e-4) * size;
    const Mesh welded = welded_mesh(mesh, weld);
    const Mesh result = joined_seams(welded, tolerance * size, &moved);
    const EdgeMap edges = edges_of(result);
    if (!is_closed(edges) && !open_at_top_only(result, edges)) continue;
    std::ostringstream sentence;
    sentence.precision(2);
    sentence << "corners up to " << std::max(moved, welded.vertices.size() < mesh.vertices.size() ? weld : 0.0)
             << " m apart from their neighbours joined to them";
    done = sentence.str();
    return result;
  }
  return mesh;
}

void note(const std::string& sentence, std::string& remarks) {
  if (!sentence.empty()) remarks += (remarks.empty() ? "" : ", ") + sentence;
}

/// Closed as the options ask for.
Mesh closed_mesh(Mesh mesh, const MeshFileOptions& options, bool at_water, const std::string& path,
                 std::string& remarks) {
  std::string done;
  const MeshProperties p = properties_of(mesh);
  if (options.mend) {
    mesh = with_mended_seams(mesh, (p.high - p.low).norm(), done);
    note(done, remarks);
  }
  if (options.deck_height > 0.0) mesh = decked_mesh(mesh, options.deck_height, at_water, path);
  if (options.mend) {
    done.clear();
    mesh = mended_mesh(mesh, done);
    note(done, remarks);
  }
  check_mesh(mesh, path);
  return mesh;
}

/// Open edges lie in the plane through `point` with this normal.
bool is_open_at(const Mesh& mesh, const Vector3& point, const Vector3& normal, double tolerance) {
  const auto in_plane = [&](std::uint64_t vertex) {
    return std::abs(normal.dot(mesh.vertices[static_cast<std::size_t>(vertex)] - point)) <= tolerance;
  };
  return std::ranges::any_of(edges_of(mesh), [&](const auto& edge) {
    return edge.second.count == 1 && in_plane(edge.first >> 32) && in_plane(edge.first & 0xffffffffu);
  });
}

/// What would make a hull of a mesh that is open, as the rest of a sentence; empty when nothing known would.
std::string remedy(const Mesh& mesh, MeshFileOptions options, bool one_sided, bool at_water, const std::string& path) {
  if (one_sided)
    return ". All of it lies on one side of y = 0 in the file: if that is half of the hull, mesh_mirror = true adds "
           "the "
           "other half";
  if (options.mend) return "";
  options.mend = true;
  const double deck = options.deck_height;
  for (const double height : {deck, deck > 0.0 ? deck : 1.0}) {
    options.deck_height = height;
    try {
      std::string done;
      closed_mesh(mesh, options, at_water, path, done);
      if (done.empty()) return "";  // the deck alone closes it, which the sentence says already
      return std::string(". mesh_mend = true ") + (height == deck ? "" : "with mesh_deck_height_m ") +
             "would close it: " + done;
    } catch (const MeshError&) {
      // Not in this way.
    }
  }
  return "";
}

}  // namespace

Mesh read_mesh(const std::string& path, const MeshFileOptions& options, std::string* mended) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) fail_file(path, "the scale of a mesh must be > 0");
  Mesh mesh = mesh_in_file(path, options.scale);
  bool one_sided = !options.mirror && is_one_sided(mesh);
  if (options.mirror) mesh = mirrored_mesh(mesh, path);
  const MeshProperties in_file = properties_of(mesh);
  const Matrix3 R = rotation_from(options.attitude);
  for (Vector3& v : mesh.vertices) v = options.origin + options.scale * (R * v);
  const MeshProperties p = properties_of(mesh);
  check_size((p.high - p.low).maxCoeff(), options.scale, path);
  if (!(std::max(p.low.cwiseAbs().maxCoeff(), p.high.cwiseAbs().maxCoeff()) < kFarthest))
    fail_file(path, "a vertex lies more than 100 km from the origin of the body; check mesh_origin_m and mesh_scale");
  const double length = (p.high - p.low).norm();
  const Mesh joined = joined_seams(welded_mesh(mesh, kWeld * length), kSameSeam * length);
  const double top = in_file.high.z(), size = (in_file.high - in_file.low).norm();
  const bool at_water = std::abs(top) < 1e-4 * size;  // of the file, where such codes have the still water at z = 0
  const bool closed = is_closed(edges_of(joined));
  one_sided = one_sided && is_open_at(joined, options.origin, R.col(1), kWeld * length);
  std::string remarks;
  try {
    mesh = closed_mesh(joined, options, at_water, path, remarks);
  } catch (const MeshError& error) {
    if (closed) throw;
    throw MeshError(error.what() + remedy(joined, options, one_sided, at_water, path));
  }
  if (path.size() > 4 && (path.ends_with(".gdf") || path.ends_with(".GDF")) && options.deck_height == 0.0 && at_water)
    remarks += std::string(remarks.empty() ? "" : "; ") +
               "the mesh ends at z = 0, where such files have the still water: if that is a lid against irregular "
               "frequencies and not the deck, mesh_deck_height_m draws the sides up to the deck";
  if (mended && !remarks.empty()) *mended = path + ": " + remarks;
  return mesh;
}

}  // namespace stillhook
