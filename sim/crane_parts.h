// What the cranes of a lift consist of, found from its hoist wires and joints: a boom is a body that holds the upper
// end of a hoist wire, its vessel the body at which the joints under it end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/specification.h"

namespace stillhook {

/// The bodies that hold the upper ends of hoist wires, in the order of the wires; never "world".
std::vector<std::string> boom_bodies(const Specification& s);

/// The body at which the joints under `body` end: from child to parent until a body that hangs on no joint. "world" if
/// they end there.
std::string vessel_under(const Specification& s, const std::string& body);

/// The vessels under the booms and under operation.crane, that one first; each once, "world" left out.
std::vector<std::string> crane_vessels(const Specification& s);

/// The floating bodies that the operation hangs or stands on: crane vessels, and those under a pickup or target contact.
std::vector<std::string> operation_vessels(const Specification& s);

/// Booms and vessels together, each once: whatever a hook load can be asked of.
std::vector<std::string> crane_bodies(const Specification& s);

/// The names of all hoist wires, in the order of the case.
std::vector<std::string> hoist_wires(const Specification& s);

/// The hoist wires that hang on a boom, or on any boom of a vessel.
std::vector<std::string> hoist_wires_of(const Specification& s, const std::string& crane);

/// Where the radius of a boom is measured from: a point of the upright axis that it slews about, or of the hinge under it.
struct BoomAxis {
  std::string body;  // that the point belongs to; may be "world"
  Vector3 point = Vector3::Zero();  // m, in its frame
};

/// Of the first upright joint on the way down to the vessel, else of the joint under the boom; nothing of a boom without
/// one.
std::optional<BoomAxis> boom_axis(const Specification& s, const std::string& boom);

/// Horizontal distance of the hooks from the axes, m: the means over the hoist wires and over the booms of a crane, so
/// that two booms side by side have the radius of what hangs between them. `place` says where a point of a body stands in
/// the world. Nothing of a crane of which no boom has an axis.
std::optional<double> crane_radius(const Specification& s, const std::string& crane,
                                   const std::function<Vector3(const std::string& body, const Vector3& point)>& place);

/// Unit normal of the plane of a boom, in the axes of its body, to port of someone who looks from the joint under it
/// towards the hoist wires. A boom that luffs has its plane square to the axis of the hinge. Of one that only slews,
/// or has no hinge, the plane is that of the vertical and of the line from the joint to the upper ends of its hoist
/// wires, as they stand in the case. A body without a joint under it (a hull) has its own x-z plane.
Vector3 boom_athwart(const Specification& s, const std::string& body);

}  // namespace stillhook
