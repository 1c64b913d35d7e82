// Specifications of small lifts for tests, part by part, in SI units.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/multibody/relaxation.h"
#include "sim/multibody/stability.h"
#include "sim/operation.h"
#include "sim/statics.h"

namespace stillhook {

struct LiftParts {
  Specification spec;

  BodySpec& body(const std::string& name, double mass, const Vector3& at, double gyration = 1.0) {
    BodySpec b;
    b.name = name;
    b.mass = mass;
    b.inertia = mass * gyration * gyration * Matrix3::Identity();
    b.position = at;
    spec.bodies.push_back(b);
    return spec.bodies.back();
  }
  /// A floating box whose origin is the middle of its volume.
  BodySpec& barge(const std::string& name, double mass, const Vector3& size, double cog_z) {
    BodySpec& b = body(name, mass, Vector3(0, 0, 0), 0.3 * size.x());
    b.cog = Vector3(0, 0, cog_z);
    b.inertia =
        mass * Vector3(0.1 * size.y() * size.y(), 0.1 * size.x() * size.x(), 0.1 * size.x() * size.x()).asDiagonal();
    b.hull.shape = HullSpec::Shape::box;
    b.hull.size = size;
    b.position.z() = 0.5 * size.z() - mass / (spec.sea.density * size.x() * size.y());
    return b;
  }
  WireSpec& wire(const std::string& name, const std::string& from, const Vector3& at_from, const std::string& to,
                 const Vector3& at_to, double EA, const std::string& winch = "") {
    WireSpec w;
    w.name = name;
    w.role = winch.empty() ? WireSpec::Role::sling : WireSpec::Role::hoist;
    w.from = from;
    w.to = to;
    w.point_from = at_from;
    w.point_to = at_to;
    w.axial_stiffness = EA;
    w.winch = winch;
    spec.wires.push_back(w);
    return spec.wires.back();
  }
  void winch(const std::string& name) {
    DriveSpec d;
    d.name = name;
    spec.drives.push_back(d);
  }
  /// Four corners at `below` under the body's origin, on a level place of the world or of a body.
  ContactSpec& feet(const std::string& body, double half, double below, const std::string& on, const Vector3& centre,
                    double stiffness) {
    ContactSpec c;
    c.name = body + "_feet";
    c.body = body;
    for (const double x : {-half, half})
      for (const double y : {-half, half}) c.points.push_back(Vector3(x, y, -below));
    c.surface_body = on;
    c.surface_centre = centre;
    c.surface_length = c.surface_breadth = 40.0;
    c.stiffness = stiffness;
    c.friction = 0.3;
    spec.contacts.push_back(c);
    return spec.contacts.back();
  }
  /// Four soft springs at the corners of the water plane of a barge.
  void moor(const std::string& body, double stiffness) {
    int i = 0;
    for (const double azimuth : {0.7854, 2.3562, -2.3562, -0.7854}) {
      MooringSpec m;
      m.name = body + "_line_" + std::to_string(++i);
      m.type = MooringSpec::Type::linear;
      m.body = body;
      m.fairlead = 10.0 * Vector3(std::cos(azimuth), std::sin(azimuth), 0.0);
      m.azimuth = azimuth;
      m.pretension = 5e4;
      m.stiffness = stiffness;
      m.anchor_distance = 500.0;
      spec.moorings.push_back(m);
    }
  }
  PhaseSpec& phase(const std::string& name) {
    PhaseSpec p;
    p.name = name;
    spec.operation.phases.push_back(p);
    return spec.operation.phases.back();
  }
  void travel(const std::string& name, const std::string& drive, double by) {
    MoveSpec m;
    m.drive = drive;
    m.speed = 0.1;
    m.travel = by;
    phase(name).moves.push_back(m);
  }
  void goal(const std::string& name, const std::string& drive, const CoordinateSpec& coordinate, double value) {
    MoveSpec m;
    m.drive = drive;
    m.speed = 0.1;
    m.goal = coordinate;
    m.goal_value = value;
    phase(name).moves.push_back(m);
  }
};

inline CoordinateSpec height_of(const std::string& body) {
  CoordinateSpec c;
  c.body = body;
  return c;
}

inline CoordinateSpec tension_of(const std::string& wire) {
  CoordinateSpec c;
  c.wire = wire;
  return c;
}

/// True if a small push comes back: the equilibrium is stable, and dynamic relaxation from beside it ends in it.
inline bool relaxation_confirms(const Model& model, const SystemState& equilibrium, double push, double tolerance) {
  SystemState state = equilibrium;
  state.t = -1.0;  // calm water
  if (!weakest_motion(model.system(), state).stable()) return false;
  for (std::size_t i = 0; i < state.body.size(); ++i)
    state.body[i].p_WC += push * Vector3(std::sin(1.0 + 2.0 * i), std::cos(3.0 * i), 0.3);
  if (!relax(model.system(), state).converged) return false;
  double worst = 0.0;
  for (std::size_t i = 0; i < state.body.size(); ++i)
    worst = std::max(worst, (state.body[i].p_WC - equilibrium.body[i].p_WC).norm());
  return worst < tolerance;
}

}  // namespace stillhook
