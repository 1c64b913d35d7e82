#include "results/deck_corners.h"

#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <type_traits>

#include "sim/hull/mesh/mesh_file.h"

namespace stillhook {
namespace {

constexpr double kFacesUp = 0.866;  // cos 30 deg: camber and sheer are less, flare and a raked bow are more

std::vector<Vector3> corners_of(const Mesh& mesh) {
  const MeshProperties box = properties_of(mesh);
  const double middle = 0.5 * (box.low.z() + box.high.z());
  std::set<int> kept;
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    const Vector3 area = area_vector(mesh, triangle);
    if (!(area.z() > kFacesUp * area.norm())) continue;
    for (const int v : triangle)
      if (mesh.vertices[static_cast<std::size_t>(v)].z() > middle) kept.insert(v);
  }
  std::vector<Vector3> corners;
  for (const int v : kept) corners.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return corners;
}

std::vector<Vector3> corners_of_file(const HullSpec& hull) {
  const RollPitchYaw& a = hull.mesh_attitude;
  const auto key = std::make_tuple(hull.mesh_file, hull.mesh_scale,
                                   std::vector<double>{hull.mesh_origin.x(), hull.mesh_origin.y(), hull.mesh_origin.z(),
                                                       a.roll, a.pitch, a.yaw, hull.mesh_deck_height},
                                   hull.mesh_mend, hull.mesh_mirror);
  // Metrics are asked for after every run of a search, from several threads.
  static std::mutex mutex;
  static std::map<std::remove_cv_t<decltype(key)>, std::vector<Vector3>> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  std::vector<Vector3> corners;
  try {
    corners = corners_of(read_mesh(hull.mesh_file, {hull.mesh_scale, hull.mesh_origin, hull.mesh_attitude,
                                                    hull.mesh_mend, hull.mesh_deck_height, hull.mesh_mirror}));
  } catch (const MeshError&) {  // the run had it; it is gone since
  }
  return known.emplace(key, std::move(corners)).first->second;
}

}  // namespace

std::vector<Vector3> deck_corners(const HullSpec& hull) {
  if (hull.shape == HullSpec::Shape::mesh) return corners_of_file(hull);
  std::vector<Vector3> corners;
  if (hull.shape == HullSpec::Shape::box)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) corners.push_back(hull.centre + hull.size.cwiseProduct(Vector3(x, y, 0.5)));
  return corners;
}

}  // namespace stillhook
