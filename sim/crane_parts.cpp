#include "sim/crane_parts.h"
#include "sim/specification.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kShortOutreach = 1e-3;  // m: a line no longer than this has no direction
constexpr double kUpright = 0.7;         // a hinge axis closer to the vertical than 45 deg slews, any other luffs

const BodySpec* body_named(const Specification& s, const std::string& name) {
  const auto found = std::find_if(s.bodies.begin(), s.bodies.end(), [&](const BodySpec& b) { return b.name == name; });
  return found == s.bodies.end() ? nullptr : &*found;
}

const JointSpec* joint_under(const Specification& s, const std::string& body) {
  const auto found = std::find_if(s.joints.begin(), s.joints.end(), [&](const JointSpec& j) { return j.child == body; });
  return found == s.joints.end() ? nullptr : &*found;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && name != "world" && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// Mean of the upper ends of the hoist wires on a body, in its axes.
Vector3 mean_upper_end(const Specification& s, const std::string& body) {
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const WireSpec& wire : s.wires) {
    if (wire.role != WireSpec::Role::hoist || wire.from != body) continue;
    sum += wire.point_from;
    ++count;
  }
  return count > 0 ? Vector3(sum / count) : sum;
}

}  // namespace

std::vector<std::string> boom_bodies(const Specification& s) {
  std::vector<std::string> names;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist) add_once(names, wire.from);
  return names;
}

std::string vessel_under(const Specification& s, const std::string& body) {
  std::string name = body;
  for (std::size_t step = 0; step <= s.joints.size(); ++step) {  // a ring of joints ends the walk as well
    const JointSpec* joint = joint_under(s, name);
    if (!joint) break;
    name = joint->parent;
  }
  return name;
}

std::vector<std::string> crane_vessels(const Specification& s) {
  std::vector<std::string> names;
  if (!s.operation.crane.empty()) add_once(names, vessel_under(s, s.operation.crane));
  for (const std::string& boom : boom_bodies(s)) add_once(names, vessel_under(s, boom));
  return names;
}

std::vector<std::string> operation_vessels(const Specification& s) {
  std::vector<std::string> names = crane_vessels(s);
  for (const ContactSpec& contact : s.contacts)
    if (contact.role != ContactSpec::Role::other && contact.surface_body != s.operation.load)
      add_once(names, vessel_under(s, contact.surface_body));
  std::erase_if(names, [&](const std::string& name) {
    const BodySpec* body = body_named(s, name);
    return !body || (body->hull.shape == HullSpec::Shape::none && !body->moved_by_sea());
  });
  return names;
}

std::vector<std::string> crane_bodies(const Specification& s) {
  std::vector<std::string> names = boom_bodies(s);
  for (const std::string& vessel : crane_vessels(s)) add_once(names, vessel);
  return names;
}

std::vector<std::string> hoist_wires(const Specification& s) {
  std::vector<std::string> names;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist) names.push_back(wire.name);
  return names;
}

std::vector<std::string> hoist_wires_of(const Specification& s, const std::string& crane) {
  std::vector<std::string> names;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist && (wire.from == crane || vessel_under(s, wire.from) == crane))
      names.push_back(wire.name);
  return names;
}

std::optional<PlaceOnBody> boom_axis(const Specification& s, const std::string& boom) {
  const JointSpec* hinge = joint_under(s, boom);
  if (!hinge) return std::nullopt;
  std::string body = boom;
  for (std::size_t step = 0; step <= s.joints.size(); ++step) {
    const JointSpec* joint = joint_under(s, body);
    if (!joint) break;
    if (joint->type == JointSpec::Type::revolute && joint->axis.norm() > 0.0 &&
        std::abs(joint->axis.normalized().z()) > kUpright)
      return PlaceOnBody{joint->parent, joint->point_on_parent};
    body = joint->parent;
  }
  return PlaceOnBody{hinge->parent, hinge->point_on_parent};
}

CraneReach crane_reach(const Specification& s, const std::string& crane) {
  CraneReach reach;
  for (const std::string& boom : boom_bodies(s)) {
    if (boom != crane && vessel_under(s, boom) != crane) continue;
    const std::optional<PlaceOnBody> axis = boom_axis(s, boom);
    if (!axis) continue;
    reach.axes.push_back(*axis);
    for (const WireSpec& wire : s.wires)
      if (wire.role == WireSpec::Role::hoist && wire.from == boom) reach.hooks.push_back({wire.to, wire.point_to});
  }
  return reach;
}

Vector3 boom_athwart(const Specification& s, const std::string& body) {
  const BodySpec* boom = body_named(s, body);
  const JointSpec* joint = joint_under(s, body);
  if (!boom || !joint) return Vector3::UnitY();
  const Matrix3 R_WB = rotation_from(boom->attitude);
  Vector3 outreach_W = R_WB * (mean_upper_end(s, body) - joint->point_on_child);
  outreach_W.z() = 0.0;
  if (joint->type == JointSpec::Type::revolute && joint->axis.norm() > 0.0) {
    const BodySpec* parent = body_named(s, joint->parent);
    const Vector3 axis = joint->axis.normalized();
    const Vector3 axis_W = parent ? Vector3(rotation_from(parent->attitude) * axis) : axis;
    if (std::abs(axis_W.z()) < kUpright) {
      // Forward is athwart x up. Of a boom that stands upright the x axis of what carries its hinge says where that is.
      const Vector3 ahead = outreach_W.norm() > kShortOutreach ? outreach_W
                            : parent                           ? Vector3(rotation_from(parent->attitude).col(0))
                                                               : Vector3(Vector3::UnitX());
      const double sign = axis_W.cross(Vector3::UnitZ()).dot(ahead) < 0.0 ? -1.0 : 1.0;
      return sign * (R_WB.transpose() * axis_W);
    }
  }
  if (outreach_W.norm() < kShortOutreach) return Vector3::UnitY();
  return R_WB.transpose() * Vector3::UnitZ().cross(outreach_W.normalized());
}

}  // namespace stillhook
