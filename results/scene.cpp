#include "results/scene.h"

#include <algorithm>
#include <cmath>

#include "results/scene_builder.h"
#include "sim/crane_parts.h"
#include "sim/hull/mesh/mesh_file.h"

namespace stillhook {
namespace {

constexpr std::size_t kMostTriangles = 1'000'000;
/// Section of a member whose clearance does not give it, as a share of its length.
constexpr double kSlenderness = 0.02;
/// Points of a body closer together than this (m) are one.
constexpr double kSamePoint = 0.5;

Mesh plain_box(const Vector3& low, const Vector3& high) {
  const Vector3 size = high - low;
  return box_mesh(size, 0.5 * (low + high), 2.0 * size.maxCoeff());
}

Mesh hull_mesh(const HullSpec& hull) {
  if (hull.shape == HullSpec::Shape::box)
    return plain_box(hull.centre - 0.5 * hull.size, hull.centre + 0.5 * hull.size);
  if (hull.shape != HullSpec::Shape::mesh) return {};
  try {
    Mesh mesh = read_mesh(hull.mesh_file, {hull.mesh_scale, hull.mesh_origin, hull.mesh_attitude, hull.mesh_mend,
                                           hull.mesh_deck_height, hull.mesh_mirror});
    if (mesh.triangles.size() <= kMostTriangles) return mesh;
  } catch (const MeshError&) {  // the run had it; it is gone since
  }
  return {};
}

/// Every clearance shape of a body.
std::vector<ClearanceSpec::Shape> shapes_of(const Specification& s, const std::string& body) {
  std::vector<ClearanceSpec::Shape> shapes;
  for (const ClearanceSpec& c : s.clearances)
    for (const ClearanceSpec::Shape* shape : {&c.a, &c.b})
      if (shape->body == body) shapes.push_back(*shape);
  return shapes;
}

/// Where wires and lines are fixed to a body.
std::vector<Vector3> line_points(const Specification& s, const std::string& body) {
  std::vector<Vector3> points;
  const auto add = [&](const std::string& name, const Vector3& p) {
    if (name == body) points.push_back(p);
  };
  for (const WireSpec& w : s.wires) {
    add(w.from, w.point_from);
    add(w.to, w.point_to);
  }
  for (const TaglineSpec& t : s.taglines) {
    add(t.from, t.point_from);
    add(t.to, t.point_to);
  }
  for (const MooringSpec& m : s.moorings) add(m.body, m.fairlead);
  return points;
}

/// The box that a clearance gives; empty without one.
Mesh clearance_box(const Specification& s, const std::string& body) {
  for (const ClearanceSpec::Shape& shape : shapes_of(s, body))
    if (!(shape.radius > 0.0)) return plain_box(shape.from.cwiseMin(shape.to), shape.from.cwiseMax(shape.to));
  return {};
}

/// The box of a clearance, or the one around contact and lift points; empty without either.
Mesh known_box(const Specification& s, const std::string& body) {
  if (Mesh box = clearance_box(s, body); !box.triangles.empty()) return box;
  std::vector<Vector3> points;
  for (const ContactSpec& c : s.contacts)
    if (c.body == body) points.insert(points.end(), c.points.begin(), c.points.end());
  if (points.empty()) return {};
  for (const Vector3& p : line_points(s, body)) points.push_back(p);
  Vector3 low = points.front(), high = points.front();
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (int i = 0; i < 3; ++i)  // points in a plane: give the box a thickness
    if (high[i] - low[i] < kSamePoint) {
      low[i] -= 0.5 * kSamePoint;
      high[i] += 0.5 * kSamePoint;
    }
  return plain_box(low, high);
}

std::vector<SceneBody::Member> members_of(const Specification& s, const std::string& body) {
  std::vector<SceneBody::Member> members;
  const auto add = [&](const Vector3& from, const Vector3& to, double radius) {
    for (const SceneBody::Member& m : members)
      if ((m.from - from).norm() < kSamePoint && (m.to - to).norm() < kSamePoint) return;
    members.push_back({from, to, radius});
  };
  for (const ClearanceSpec::Shape& shape : shapes_of(s, body))
    if (shape.radius > 0.0) add(shape.from, shape.to, shape.radius);
  if (!members.empty()) return members;
  Vector3 root = Vector3::Zero();
  for (const JointSpec& j : s.joints)
    if (j.child == body) root = j.point_on_child;
  for (const Vector3& p : line_points(s, body)) {
    const double length = (p - root).norm();
    if (length >= kSamePoint) add(root, p, kSlenderness * length);
  }
  return members;
}

/// The highest point of a mesh below a point, straight down in B; NaN if there is none.
double height_under(const Mesh& mesh, const Vector3& p) {
  double highest = std::numeric_limits<double>::quiet_NaN();
  for (const auto& t : mesh.triangles) {
    const Vector3 &a = mesh.vertices[static_cast<std::size_t>(t[0])],
                  &b = mesh.vertices[static_cast<std::size_t>(t[1])],
                  &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const double area = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (area == 0.0) continue;  // an upright side
    const double v = ((p - a).x() * (c - a).y() - (p - a).y() * (c - a).x()) / area,
                 w = ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x()) / area;
    if (v < 0.0 || w < 0.0 || v + w > 1.0) continue;
    const double z = a.z() + v * (b - a).z() + w * (c - a).z();
    if (z < p.z() && !(highest >= z)) highest = z;
  }
  return highest;
}

/// What stands between a body's deck and the hinges that the case puts above it: it knows of no structure there, but a
/// crane that hovers is no picture of one.
std::vector<SceneBody::Member> pedestals_of(const Specification& s, const SceneBody& body) {
  std::vector<SceneBody::Member> pedestals;
  for (const JointSpec& joint : s.joints) {
    if (joint.parent != body.name || joint.type != JointSpec::Type::revolute || !(joint.axis.norm() > 0.0)) continue;
    const Vector3& hinge = joint.point_on_parent;
    const double deck = height_under(body.mesh, hinge), height = hinge.z() - deck;
    if (!(height > kSamePoint)) continue;
    const bool slews = std::abs(joint.axis.normalized().z()) > 0.7;  // nearer to upright than 45 deg
    const double radius = slews ? std::clamp(0.3 * height, 1.0, 2.5) : std::clamp(0.12 * height, 0.3, 0.8);
    pedestals.push_back({Vector3(hinge.x(), hinge.y(), deck), hinge, radius});
  }
  return pedestals;
}

SceneBody scene_body(const Specification& s, const BodySpec& body) {
  SceneBody out;
  out.name = body.name;
  out.mesh = hull_mesh(body.hull);
  out.floats = !out.mesh.triangles.empty();
  const std::vector<std::string> cranes = crane_vessels(s);
  const bool is_crane = std::find(cranes.begin(), cranes.end(), body.name) != cranes.end();
  out.kind = body.name == s.operation.load ? SceneBody::Kind::load
             : is_crane                    ? SceneBody::Kind::crane
             : out.floats                  ? SceneBody::Kind::vessel
                                           : SceneBody::Kind::member;
  if (body.hull.shape == HullSpec::Shape::mesh && out.floats && out.kind == SceneBody::Kind::load)
    out.envelope = clearance_box(s, body.name);
  if (out.mesh.triangles.empty()) out.mesh = known_box(s, body.name);
  if (out.mesh.triangles.empty()) out.members = members_of(s, body.name);
  out.pedestals = pedestals_of(s, out);
  return out;
}

}  // namespace

Scene build_scene(const Specification& s, const Trajectory& trajectory) {
  Scene scene;
  for (const BodySpec& body : s.bodies) scene.bodies.push_back(scene_body(s, body));
  SceneBuilder builder(s, trajectory, scene);
  for_each_element_kind([&](const auto& kind) {
    for (const auto& entry : s.*kind.entries) add_shapes(entry, builder);
  });
  return scene;
}

}  // namespace stillhook
