// What a case says about the operation: phases and moves, poses to report, clearances. SI and radians.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

/// A scalar measured in the model that a goal can ask for.
struct CoordinateSpec {
  std::string body;                        // point of a body ...
  Vector3 point = Vector3::Zero();         // m, in B
  int axis = 2;                            // 0 x, 1 y, 2 z in W
  std::string relative_to;                 // body whose axes and origin are used instead of W; empty = world
  std::string joint;                       // ... or the coordinate of a joint relative to its initial pose
  std::string wire;                        // ... or the tension of a wire, N
};

struct ProfileSpec {
  enum class Shape { trapezoid, s_curve, knots };
  // Input shaping (Singer & Seering 1990): the profile convolved with impulses that leave no residual swing of a
  // pendulum; zvd bears twice the error of its period.
  enum class Shaper { none, zv, zvd };
  Shape shape = Shape::s_curve;
  double ramp = 10.0;                      // s, from rest to full speed and back
  std::vector<double> knots;               // relative speeds at equal times, between the two zeros (knots only)
  Shaper shaper = Shaper::none;
  double shaper_period = 0.0;              // s; 0 = of the pendulum on the hoist falls as long as they are at the middle
                                           // of the move, 2 pi sqrt(l/g)
  double shaper_damping = 0.0;             // 1, damping ratio of that swing
};

struct MoveSpec {
  std::string drive;
  double speed = 0.0;                      // per s, magnitude of the peak speed
  std::optional<double> travel;            // given travel, with sign ...
  std::optional<CoordinateSpec> goal;      // ... or such that this coordinate
  double goal_value = 0.0;                 // reaches this value in static equilibrium at the end of the phase
  ProfileSpec profile;
  double delay = 0.0;                      // s after the start of the phase
  bool background = false;                 // the phase may end before this move
};

struct EventSpec {
  enum class Type { none, clear_of_contact };
  Type type = Type::none;
  std::string contact;                     // clear_of_contact: no force in it ...
  double hold = 0.0;                       // s, ... for this long
  double timeout = 600.0;                  // s, go on after this, with a note in the result
};

struct PhaseSpec {
  enum class Stage { on_barge, transfer, hanging, set_down, landed };
  std::string name;
  Stage stage = Stage::hanging;
  double duration = 0.0;                   // s, at least; the moves may need more
  EventSpec wait_for;                      // before the phase starts
  std::vector<MoveSpec> moves;
};

struct OperationSpec {
  std::string load;                        // the lifted body
  std::string crane;                       // the vessel whose heading defines off-lead and side-lead
  Vector3 target = Vector3::Zero();        // m, in W: where the load's target point should stand
  Vector3 load_reference = Vector3::Zero();  // m, in the load's B: the point that should stand there
  std::vector<PhaseSpec> phases;
};

/// A pose to report: joints held at given coordinates by adjusting wires, drives at given positions.
struct PoseSpec {
  struct DriveSetting { std::string drive; double position = 0.0; };
  struct Hold { std::string joint; double coordinate = 0.0; std::string drive; };  // rad relative to the initial pose
  struct Goal { CoordinateSpec coordinate; double value = 0.0; std::string drive; };
  std::string name;
  std::vector<DriveSetting> drives;
  std::vector<Hold> holds;
  std::vector<Goal> goals;
};

/// Two bodies, as boxes or capsules, whose distance is reported.
struct ClearanceSpec {
  struct Shape {
    std::string body;
    Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m, in B: axis of a capsule, or opposite corners of a box
    double radius = 0.0;                                   // m, > 0: capsule; 0: box
  };
  std::string name;
  Shape a, b;
};

}  // namespace stillhook
