#include "sim/element_builder.h"

#include "sim/crane_parts.h"
#include "sim/lifting/ballast.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/mooring.h"
#include "sim/lifting/restoring.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"

namespace stillhook {

BodyPoint ElementBuilder::point(const std::string& body, const Vector3& p_B) const {
  return ElementSite(model_).point(body, p_B);
}

double ElementBuilder::end_distance(const WireSpec& w) const {
  return (motion_of(point(w.from, w.point_from), now()).p - motion_of(point(w.to, w.point_to), now()).p).norm();
}

std::unique_ptr<const ForceElement> ElementBuilder::wire(const WireSpec& w, double unstretched_length) const {
  WireOptions o;
  o.name = w.name;
  o.from = point(w.from, w.point_from);
  o.to = point(w.to, w.point_to);
  o.axial_stiffness = w.axial_stiffness;
  o.unstretched_length = unstretched_length;
  o.damping = w.damping > 0.0 ? w.damping
                              : wire_damping(w.damping_ratio, w.damping_mass, w.axial_stiffness, o.unstretched_length);
  o.drive = drive_or_none(w.winch);
  if (const std::vector<std::string> vessels = crane_vessels(spec()); !vessels.empty())
    o.crane = model_.body_index(vessels.front());
  if (w.role == WireSpec::Role::hoist && model_.body_index(w.from) != kWorld) {
    o.boom = model_.body_index(w.from);
    o.boom_athwart = boom_athwart(spec(), w.from);
  }
  return std::make_unique<const Wire>(o);
}

std::unique_ptr<const ForceElement> ElementBuilder::tagline(const TaglineSpec& t) const {
  TaglineOptions o;
  o.name = t.name;
  o.from = point(t.from, t.point_from);
  o.to = point(t.to, t.point_to);
  for (const WireSpec& w : spec().wires)
    if (w.name == t.wire) {
      o.hoist_upper = point(w.from, w.point_from);
      o.hoist_lower = point(w.to, w.point_to);
    }
  o.kp = t.kp;
  o.kd = t.kd;
  for (const GainPointSpec& g : t.gain_schedule) o.schedule.push_back({g.fall, g.kp_factor, g.kd_factor});
  o.set_point = t.set_point;
  o.pretension = t.pretension;
  o.tension_max = t.tension_max;
  o.speed_max = t.speed_max;
  o.time_constant = t.time_constant;
  o.axial_stiffness = t.axial_stiffness;
  o.active = t.active;
  o.active_from_phase = phase_index(t.active_from, "taglines." + t.name);
  return std::make_unique<const Tagline>(o, now());
}

std::unique_ptr<const ForceElement> ElementBuilder::mooring(const MooringSpec& m) const {
  MooringOptions o;
  o.name = m.name;
  o.type = m.type == MooringSpec::Type::catenary ? MooringOptions::Type::catenary : MooringOptions::Type::linear;
  o.fairlead = point(m.body, m.fairlead);
  o.anchor = m.anchor;
  o.azimuth = m.azimuth;
  o.pretension = m.pretension;
  o.line.length = m.length;
  o.line.weight = m.weight;
  o.line.axial_stiffness = m.axial_stiffness;
  o.line.seabed_friction = m.seabed_friction;
  o.depth = spec().sea.depth;
  o.stiffness = m.stiffness;
  o.anchor_distance = m.anchor_distance;
  o.tow_drive = drive_or_none(m.tow);
  if (o.tow_drive >= 0) o.tow_direction = m.tow_direction.normalized();
  return std::make_unique<const Mooring>(o, now());
}

std::unique_ptr<const ForceElement> ElementBuilder::restoring(const RestoringSpec& r) const {
  const BodySpec& body = spec().bodies[static_cast<std::size_t>(model_.body_index(r.body))];
  RestoringOptions o;
  o.name = r.name;
  o.point = point(r.body, r.point);
  // The given pose, not the one that joints or an equilibrium made of it: the case says where it is at rest.
  o.rest_R_WB = rotation_from(r.rest_attitude.value_or(body.attitude));
  o.rest_point = r.rest_point.value_or(Vector3(body.position + rotation_from(body.attitude) * r.point));
  o.axes = rotation_from({0.0, 0.0, r.axes_heading.value_or(roll_pitch_yaw(o.rest_R_WB).yaw)});
  o.stiffness = r.stiffness;
  o.damping = r.damping;
  o.force_at_rest = r.force_at_rest;
  return std::make_unique<const Restoring>(o);
}

std::unique_ptr<const ForceElement> ElementBuilder::contact(const ContactSpec& c) const {
  ContactOptions o;
  o.name = c.name;
  o.body = model_.body_index(c.body);
  for (const Vector3& p : c.points) o.points.push_back(point(c.body, p).c_B);
  o.surface = point(c.surface_body, c.surface_centre);
  o.length = c.surface_length;
  o.breadth = c.surface_breadth;
  o.stiffness = c.stiffness;
  o.damping = c.damping;
  o.damping_depth = c.damping_depth;
  o.friction = c.friction;
  o.active_from_phase = phase_index(c.active_from, "contacts." + c.name);
  return std::make_unique<const Contact>(o);
}

// Index of the phase an element begins to act with, 0 when none is named.
int ElementBuilder::phase_index(const std::string& name, const std::string& entry) const {
  if (name.empty()) return 0;
  const auto& phases = spec().operation.phases;
  for (std::size_t i = 0; i < phases.size(); ++i)
    if (phases[i].name == name) return static_cast<int>(i);
  throw SpecificationError(entry, "active_from", "there is no phase '" + name + "'");
}

std::unique_ptr<const ForceElement> ElementBuilder::ballast(const BallastSpec& b) const {
  BallastOptions o;
  o.name = b.name;
  o.from = point(b.body, b.from);
  o.to = point(b.body, b.to);
  o.mass = b.mass;
  o.gravity = spec().sea.gravity;
  o.drive = model_.drive_index(b.drive);
  return std::make_unique<const Ballast>(o);
}

}  // namespace stillhook
