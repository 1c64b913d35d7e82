// What a case says about the lifting gear: drives, wires, taglines, moorings, springs, contacts, ballast. SI and radians; B
// is the frame of the body that a point belongs to, W the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/element_kind.h"
#include "sim/spatial/pose.h"

namespace stillhook {

/// Anything that moves by command. Position 0 at the start of the run.
struct DriveSpec {
  enum class Kind { winch, ballast, tow, joint };
  std::string name;
  Kind kind = Kind::winch;      // winch: m hauled in (+ shortens); ballast: share 0..1; tow: m; joint: rad or m
  double speed_max = 0.0;       // per s; 0 = unlimited
  double acceleration_max = 0.0;  // per s2; 0 = unlimited
};

struct WireSpec : ElementEntry<WireSpec> {
  enum class Role { other, hoist, luffing, stay, sling };
  Role role = Role::other;
  std::string from, to;                    // bodies; "from" carries the upper end or the sheave
  Vector3 point_from = Vector3::Zero(), point_to = Vector3::Zero();  // m, in B of each
  double axial_stiffness = 0.0;            // EA, N
  double damping_ratio = 0.0;              // share of critical of the mass below at the initial stiffness EA/L
  double damping_mass = 0.0;               // kg, the mass meant by damping_ratio
  double damping = 0.0;                    // N s/m, instead of damping_ratio
  double unstretched_length = 0.0;         // m; 0 = from `slack` or `hold_*` below
  double slack = 0.0;                      // m, unstretched length minus distance of the ends at the start
  std::string hold_joint;                  // unstretched length such that this joint keeps its initial coordinate in
                                           // the initial static equilibrium (luffing and stay wires)
  std::string winch;                       // name of a drive, empty = fixed length
  double tension_max = 0.0;                // N, limit of the winch (checked, not enforced); 0 = none
  double breaking_load = 0.0;              // N; 0 = not given
};

/// Factors on a tagline's gains while its hoist wire has this length.
struct GainPointSpec {
  std::string name;
  double fall = 0.0;                       // m
  double kp_factor = 1.0, kd_factor = 1.0;

  bool operator==(const GainPointSpec&) const = default;
};

struct TaglineSpec : ElementEntry<TaglineSpec> {
  std::string from, to;                    // winch body, controlled body
  Vector3 point_from = Vector3::Zero(), point_to = Vector3::Zero();  // m, in B of each
  std::string wire;                        // the hoist wire whose angle is controlled
  double kp = 0.0;                         // N/rad
  double kd = 0.0;                         // N s/rad
  std::vector<GainPointSpec> gain_schedule;  // by rising fall; empty = the gains as they are throughout
  double set_point = 0.0;                  // rad, wanted angle of the hoist wire towards the winch's far side
  double pretension = 0.0;                 // N
  double tension_max = 0.0;                // N
  double speed_max = 0.0;                  // m/s; 0 = unlimited
  double time_constant = 0.5;              // s
  double axial_stiffness = 2.0e7;          // EA, N
  bool active = true;
  std::string active_from;                 // phase with which the line is connected; empty = always
};

struct MooringSpec : ElementEntry<MooringSpec> {
  enum class Type { catenary, linear };
  Type type = Type::catenary;
  std::string body;
  Vector3 fairlead = Vector3::Zero();      // m, in B
  std::optional<Vector3> anchor;           // m, in W; absent: found from azimuth, pretension and length or distance
  double azimuth = 0.0;                    // rad, direction from the fairlead to the anchor at the initial pose, in W
  double pretension = 0.0;                 // N, horizontal tension at the initial pose; not of a catenary with an anchor
  double stiffness = 0.0;                  // N/m, linear only
  double anchor_distance = 0.0;            // m, horizontal, linear only
  double length = 0.0;                     // m, unstretched, catenary
  double weight = 0.0;                     // N/m, in water, catenary; < 0: the line is buoyant
  double axial_stiffness = 0.0;            // N, catenary
  double seabed_friction = 0.0;            // 1, catenary
  std::string tow;                         // drive that moves the anchor, empty = fixed
  Vector3 tow_direction = Vector3::Zero(); // unit vector in W
};

/// A linear spring and damper in all six motions between a body and the world, about one point of the body.
struct RestoringSpec : ElementEntry<RestoringSpec> {
  std::string body;
  Vector3 point = Vector3::Zero();          // m, in B
  std::optional<Vector3> rest_point;        // m, in W: where the point is at rest; absent: at the initial pose
  std::optional<RollPitchYaw> rest_attitude;  // rad, of the body at rest; absent: that of the initial pose
  std::optional<double> axes_heading;       // rad, of the axes of the matrices in W; absent: that of the rest attitude
  Matrix6 stiffness = Matrix6::Zero();      // N/m, N, N m/rad; symmetric
  Matrix6 damping = Matrix6::Zero();        // N s/m, N s, N m s/rad; symmetric, positive semidefinite
  Vector3 force_at_rest = Vector3::Zero();  // N, in W, on the body
};

/// Corner points of one body against a horizontal rectangle fixed to another.
struct ContactSpec : ElementEntry<ContactSpec> {
  std::string body;                        // carries the points
  std::vector<Vector3> points;             // m, in B
  std::string surface_body;                // carries the rectangle, may be "world"
  Vector3 surface_centre = Vector3::Zero();   // m, in its B
  double surface_length = 0.0, surface_breadth = 0.0;  // m, along x and y of its B
  double stiffness = 0.0;                  // N/m, all points together
  double damping = 0.0;                    // N s/m, all points together
  double damping_depth = 0.005;            // m, penetration over which the damping grows to its full value
  double friction = 0.0;                   // 1
  enum class Role { other, pickup, target };
  Role role = Role::other;                 // pickup: re-hits are counted; target: set-down is measured
  std::string active_from;                 // phase with which it begins to act; empty = always. No force before.
};

/// A mass of water moved from one tank to another; its weight counts, its inertia does not.
struct BallastSpec : ElementEntry<BallastSpec> {
  std::string body;
  double mass = 0.0;                       // kg, moved when the drive stands at 1
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m, in B
  std::string drive;
};

}  // namespace stillhook
