// What the cranes of a lift consist of, found from its hoist wires and joints: a boom is a body that holds the upper
// end of a hoist wire, its vessel the body at which the joints under it end.
#pragma once

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

/// A point of a body; of "world" it is one in the world.
struct PlaceOnBody {
  std::string body;
  Vector3 point = Vector3::Zero();  // m, in its frame
};

/// Where the radius of a boom is measured from: a point of the first upright axis on the way down to the vessel, about which
/// it slews, else the joint under the boom; nothing of a boom without one.
std::optional<PlaceOnBody> boom_axis(const Specification& s, const std::string& boom);

/// What the radius of a crane lies between: the axes of its booms and the lower ends of their hoist wires. It is the
/// horizontal distance of their means, so that two booms side by side have the radius of what hangs between them. Empty of
/// a crane of which no boom has an axis.
struct CraneReach {
  std::vector<PlaceOnBody> axes, hooks;
};
CraneReach crane_reach(const Specification& s, const std::string& crane);

/// Unit normal of the plane of a boom, in the axes of its body, to port of someone who looks from the joint under it
/// towards the hoist wires. A boom that luffs has its plane square to the axis of the hinge. Of one that only slews,
/// or has no hinge, the plane is that of the vertical and of the line from the joint to the upper ends of its hoist
/// wires, as they stand in the case. A body without a joint under it (a hull) has its own x-z plane.
Vector3 boom_athwart(const Specification& s, const std::string& body);

}  // namespace stillhook
