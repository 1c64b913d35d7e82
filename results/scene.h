// What a lift looks like: the shapes of its bodies, its wires and lines and where they are fixed, its supports. For the
// replay and for the drawings of the static poses. A body with a hull is its hull; one without is drawn from what the
// specification knows of its shape: the boxes and capsules of its clearances, the corners of its contacts, or members
// from its joint to the points where wires are fixed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/hull/mesh/mesh.h"
#include "sim/trajectory.h"

namespace stillhook {

/// Index of a body; the fixed world.
inline constexpr int kSceneWorld = -1;

struct SceneBody {
  enum class Kind { crane, load, vessel, member };
  struct Member {
    Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m, in B: its axis
    double radius = 0.0;                                   // m, half its section
  };
  std::string name;
  Kind kind = Kind::member;
  Mesh mesh;            // m, in B; empty if the body is drawn by its members
  bool floats = false;  // the mesh is a hull
  Mesh envelope;        // m, in B: the box of its clearances where the mesh is another; empty if there is none
  std::vector<Member> members;
  std::vector<Member> pedestals;  // what carries the hinges on it that lie above its deck, upright in B
};

struct SceneLine {
  enum class Kind { hoist, luffing, stay, sling, other, tagline };
  std::string name;
  Kind kind = Kind::other;
  int from = kSceneWorld, to = kSceneWorld;
  Vector3 point_from = Vector3::Zero(), point_to = Vector3::Zero();  // m, in B of each
  double reference = 0.0;   // N, largest static tension of a wire, limit of a tagline; 0 if there is none
  double shown_from = 0.0;  // s
  std::string tension;      // the channel of its tension
};

struct SceneMooring {
  std::string name;
  int body = kSceneWorld;
  Vector3 fairlead = Vector3::Zero();       // m, in B
  Vector3 anchor = Vector3::Zero();         // m, in W, with the tow's drive at zero
  double weight = 0.0;                      // N/m in water; 0 = drawn straight
  std::string tow;                          // drive that moves the anchor; empty = fixed
  Vector3 tow_direction = Vector3::Zero();  // in W
};

/// A rectangle that something is set down on.
struct SceneSurface {
  std::string name;
  ContactSpec::Role role = ContactSpec::Role::other;
  int body = kSceneWorld;
  Vector3 centre = Vector3::Zero();    // m, in B
  double length = 0.0, breadth = 0.0;  // m, along x and y of B
};

/// A force that is drawn as an arrow: its channels in W, N, at a point of a body.
struct SceneArrow {
  std::string name;
  int body = kSceneWorld;
  Vector3 point = Vector3::Zero();   // m, in B
  std::array<std::string, 3> force;  // channels
  double reference = 0.0;            // N: the force that is drawn at full length
};

struct Scene {
  std::vector<SceneBody> bodies;  // in the order of the specification
  std::vector<SceneLine> lines;
  std::vector<SceneMooring> moorings;
  std::vector<SceneSurface> surfaces;
  std::vector<SceneArrow> arrows;
};

/// Reads the hull meshes again; one that is missing or has more than a million triangles is drawn from its clearances
/// and contacts instead.
Scene build_scene(const Specification& specification, const Trajectory& trajectory);

}  // namespace stillhook
