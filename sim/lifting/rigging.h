// A hook block with slings, and a spreader between them if there is one: what a case says in one entry and the bodies
// and wires that it stands for.
//
//   E(h, X_WS) = sum_i 1/2 (EA_i/L_i) <d_i - L_i>^2 + m_S g z_S - F h_z            L_i = length + length error
//
// The block hangs at the place h of the hook where the slings are in balance under the pull F: the minimum of E over h
// and, with a spreader S, over its pose X_WS; the load is held in its given pose, or turns about its centre of gravity
// until that lies under the hook. d_i is the distance of the ends of sling i; <x> is x where it is positive, else 0. A
// sling that is too long then hangs slack, and four slings to one hook of a stiff load share its weight by their
// lengths: an error e in one of them changes the tensions by EA e/(4 L), two up and two down.
#pragma once

#include <string>
#include <vector>

#include "sim/specification.h"

namespace stillhook {

struct SlingSpec {
  std::string name;
  Vector3 from = Vector3::Zero();  // m, upper end in the frame of the spreader; slings from the hook do not say it
  Vector3 to = Vector3::Zero();    // m, lower end in the frame of the load, or of the spreader
  double length = 0.0;             // m, without load
  double length_error = 0.0;       // m, by which it is longer
  double axial_stiffness = 0.0;    // EA, N
  double damping_ratio = 0.02;     // share of critical, of the sling's share of the load
  double breaking_load = 0.0;      // N; 0 = not given
};

struct SpreaderSpec {
  std::string name;                // of its body
  double mass = 0.0;               // kg
  Vector3 size = Vector3::Zero();  // m, of the box that its inertia is that of
  Vector3 cog = Vector3::Zero();   // m
  std::vector<SlingSpec> slings;   // from the hook
};

struct RiggingSpec {
  std::string name;                       // of the block, a body that hoist wires name
  std::string load;                       // body that the slings hold
  double mass = 0.0;                      // kg, of the block
  Vector3 size = Vector3(1.0, 1.0, 1.5);  // m, of the box that its inertia is that of
  Vector3 cog = Vector3::Zero();          // m, in the frame of the block
  Vector3 hook = Vector3::Zero();         // m, where the slings hang, in the frame of the block
  std::vector<SlingSpec> slings;          // to the load: from the hook, or from the spreader
  SpreaderSpec spreader;                  // without name: there is none
  bool may_be_slack = false;              // slings may be slack with the load hanging
  double least_angle = 0.25 * 3.14159265358979323846;  // rad, of a sling to the horizontal
};

struct RiggingPose {
  struct Sling {
    std::string name;
    double distance = 0.0, tension = 0.0;  // m, N
    double angle = 0.0;                    // rad, to the horizontal
  };
  Vector3 hook = Vector3::Zero();   // m, in W
  Pose spreader;                    // of its body; without a spreader of no meaning
  Pose load;                        // of its body
  std::vector<Sling> slings;        // those of the spreader first
  double vertical_stiffness = 0.0;  // N/m, of the hook against the load
};

enum class RiggingLoad {
  held,  // in the pose that the specification gives
  turns  // about its centre of gravity, from that pose on
};

/// Where the hook is while the slings carry the share `share` (0 to 1] of the load's weight beside that of the
/// spreader. Throws SpecificationError with the entry "rigging.<name>" where no balance is found: slings that run to
/// one place, or that do not reach.
RiggingPose rigging_pose(const RiggingSpec& rigging, const Specification& spec, double share, RiggingLoad load);

/// True if the load stands at the start: it has a contact of role pickup that acts from the start.
bool load_stands(const RiggingSpec& rigging, const Specification& spec);

/// Adds block, spreader and slings to the bodies and wires of `spec`, which has the load already. The slings carry the
/// load at the start, or are just straight where it stands.
void add_rigging(const RiggingSpec& rigging, Specification& spec);

}  // namespace stillhook
