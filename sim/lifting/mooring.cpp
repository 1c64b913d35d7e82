#include "sim/lifting/mooring.h"

#include <algorithm>
#include <cmath>

#include "sim/element_site.h"
#include "sim/number_text.h"
#include "sim/specification.h"

namespace stillhook {

namespace {
constexpr double kNearAnchor = 1e-6;   // share of the length below which H is taken linear in x
constexpr double kOnTheBottom = 0.05;  // m: an anchor no higher than this lies on the sea bed
constexpr double kLargestStrain = 0.2;
constexpr double kStraight = 1e-3;  // m, of a line that would lie at the surface or on the bottom
}  // namespace

Mooring::Mooring(MooringOptions options, const Instant& initial)
    : ForceElement(options.name), options_(std::move(options)) {
  const MooringOptions& o = options_;
  const auto require = [&](bool holds, const char* field, const std::string& rule) {
    if (!holds) throw SpecificationError("moorings." + name(), field, rule);
  };
  const Vector3 fairlead = motion_of(o.fairlead, initial).p;
  if (o.type == MooringOptions::Type::linear)
    place_linear(fairlead, require);
  else
    place_catenary(fairlead, require);
  if (o.tow_drive >= 0) {
    require(std::abs(o.tow_direction.norm() - 1.0) < 1e-9, "tow_direction", "must be a unit vector");
    anchor_ -= initial.drive[o.tow_drive].position * o.tow_direction;
  }
}

template <class Require>
void Mooring::place_linear(const Vector3& fairlead, const Require& require) {
  MooringOptions& o = options_;
  require(std::isfinite(o.pretension) && o.pretension >= 0.0, "pretension", "must be >= 0 N");
  require(std::isfinite(o.stiffness) && o.stiffness > 0.0, "stiffness", "must be > 0 N/m");
  if (o.anchor) o.anchor_distance = (*o.anchor - fairlead).head<2>().norm();
  require(std::isfinite(o.anchor_distance) && o.anchor_distance > 0.0, o.anchor ? "anchor" : "anchor_distance",
          "must be > 0 m from the fairlead, in the horizontal");
  anchor_ =
      o.anchor.value_or(Vector3(fairlead + o.anchor_distance * Vector3(std::cos(o.azimuth), std::sin(o.azimuth), 0.0)));
}

template <class Require>
void Mooring::place_catenary(const Vector3& fairlead, const Require& require) {
  MooringOptions& o = options_;
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  require(positive(o.line.length), "length", "must be > 0 m");
  require(std::isfinite(o.line.weight) && o.line.weight != 0.0, "weight",
          "must not be 0: a line as heavy as water is straight, which a wire from \"world\" says, with its stiffness");
  require(positive(o.line.axial_stiffness), "axial_stiffness", "must be > 0 N");
  require(std::isfinite(o.line.seabed_friction) && o.line.seabed_friction >= 0.0, "seabed_friction", "must be >= 0");
  require(positive(o.depth), "depth", "a catenary needs a water depth > 0 m");
  const bool buoyant = o.line.weight < 0.0;
  if (o.anchor) {
    anchor_ = *o.anchor;
    require(anchor_.z() >= -o.depth - kOnTheBottom, "anchor",
            "lies " + number_text(-o.depth - anchor_.z()) + " m below the sea bed, which is " + number_text(o.depth) +
                " m deep");
    o.line.on_seabed = !buoyant && anchor_.z() <= -o.depth + kOnTheBottom;
  } else {
    require(positive(o.pretension), "pretension", "a catenary needs a horizontal pretension > 0 N");
    const double height = fairlead.z() + o.depth;
    require(height > 0.0, "fairlead", "must lie above the seabed at the initial pose");
    const double distance = catenary_distance(o.line, o.pretension, height);
    require(distance > 0.0, "length", "too short to reach the seabed with this pretension");
    anchor_ = fairlead + distance * Vector3(std::cos(o.azimuth), std::sin(o.azimuth), 0.0);
    anchor_.z() = -o.depth;
  }
  const Vector3 r = fairlead - anchor_;
  require(r.norm() <= (1.0 + kLargestStrain) * o.line.length, "length",
          "is too short: the fairlead is " + number_text(r.norm()) + " m from the anchor, the line is " +
              number_text(o.line.length) + " m long");
  const double x = std::max(std::hypot(r.x(), r.y()), kNearAnchor * o.line.length);
  const double over = catenary_overhang(o.line, solve_catenary(o.line, x, r.z()));
  require(
      !buoyant || over <= kStraight || fairlead.z() + over <= 0.0, "length",
      "the line is buoyant and so long that it would rise above its fairlead and float at the surface, which is not "
      "modelled: shorten it or move its anchor away, or give it as a linear line");
  require(buoyant || o.line.on_seabed || anchor_.z() - over >= -o.depth - kStraight, "length",
          "the line hangs from an anchor above the sea bed and is so long that it would lie on it between its ends, "
          "which is not modelled: shorten it, or put the anchor on the sea bed where it comes up");
}

bool Mooring::same_as(const ForceElement& other) const {
  const auto* mooring = dynamic_cast<const Mooring*>(&other);
  return mooring && mooring->options_ == options_ && mooring->anchor_ == anchor_;
}

BodyPoint Mooring::anchor_now(const Instant& now) const {
  BodyPoint point{kWorld, anchor_};
  if (options_.tow_drive >= 0) point.c_B += now.drive[options_.tow_drive].position * options_.tow_direction;
  return point;
}

Mooring::Load Mooring::linear_load(double x, const Instant& now) const {
  Load load;
  const double H = options_.pretension + options_.stiffness * (x - options_.anchor_distance);
  if (now.on(H <= 0.0)) return load;
  load.H = H;
  load.H_x = options_.stiffness;
  load.energy = 0.5 * H * H / options_.stiffness;
  return load;
}

Mooring::Load Mooring::catenary_load(double x, double z, Memory m) const {
  const CatenaryLoad c = solve_catenary(options_.line, x, z, m.state[0], m.state[1]);
  Load load;
  load.H = c.H;
  load.V = c.V;
  load.H_x = c.stiffness(0, 0);
  load.H_z = c.stiffness(0, 1);
  load.V_x = c.stiffness(1, 0);
  load.V_z = c.stiffness(1, 1);
  load.energy = catenary_energy(options_.line, c, x, z);
  return load;
}

Mooring::Load Mooring::load(const Instant& now, Memory m) const {
  const Vector3 r = motion_of(options_.fairlead, now).p - anchor_now(now).c_B;
  const double x = std::hypot(r.x(), r.y());
  const bool linear = options_.type == MooringOptions::Type::linear;
  const double nearest = kNearAnchor * (linear ? options_.anchor_distance : options_.line.length);
  const bool near = now.on(x < nearest);
  const double reach = near ? nearest : x;
  Load load = linear ? linear_load(reach, now) : catenary_load(reach, r.z(), m);
  load.H_over_x = load.H / reach;
  if (near) {
    const double share = x / nearest;
    load.H *= share;
    load.H_z *= share;
    load.H_x = load.H_over_x;
    load.V_x = 0.0;
  }
  if (x > 0.0) load.u = Vector3(-r.x() / x, -r.y() / x, 0.0);
  return load;
}

void Mooring::start(const Instant& now, Memory m) const {
  m.state[0] = m.state[1] = 0.0;
  end_step(now, 0.0, m);
}

void Mooring::end_step(const Instant& now, double, Memory m) const {
  const Load l = load(now, m);
  m.state[0] = l.H;
  m.state[1] = l.V;
}

void Mooring::add_forces(const Instant& now, double, Memory m, ForceSum& out) const {
  add_point_force(options_.fairlead, now, load(now, m).force(), out);
}

void Mooring::add_jacobian(const Instant& now, double, Memory m, JacobianSum& out) const {
  // F = -H r_h/x - V e_z with r from the anchor to the fairlead, so dx = -u . dr_h and dz = dr_z.
  const Load l = load(now, m);
  const Vector3 up = Vector3::UnitZ();
  Matrix3 level = Matrix3::Identity();
  level(2, 2) = 0.0;
  const Matrix3 along = l.u * l.u.transpose();
  const Matrix3 dF_dr = -l.H_x * along - l.H_over_x * (level - along) + l.H_z * l.u * up.transpose() +
                        l.V_x * up * l.u.transpose() - l.V_z * up * up.transpose();
  add_pair_jacobian(options_.fairlead, anchor_now(now), now, l.force(), dF_dr, Matrix3::Zero(), out);
}

double Mooring::potential_energy(const Instant& now, Memory m) const { return load(now, m).energy; }

std::vector<Channel> Mooring::channels() const { return channels_of(name(), mooring_channels::all); }

void Mooring::measure(const Instant& now, Memory m, std::span<double> out) const {
  const Load l = load(now, m);
  out[0] = std::hypot(l.H, l.V);
  out[1] = l.H;
}

std::unique_ptr<const ForceElement> make_element(const MooringSpec& m, const ElementSite& site) {
  MooringOptions o;
  o.name = m.name;
  o.type = m.type == MooringSpec::Type::catenary ? MooringOptions::Type::catenary : MooringOptions::Type::linear;
  o.fairlead = site.point(m.body, m.fairlead);
  o.anchor = m.anchor;
  o.azimuth = m.azimuth;
  o.pretension = m.pretension;
  o.line.length = m.length;
  o.line.weight = m.weight;
  o.line.axial_stiffness = m.axial_stiffness;
  o.line.seabed_friction = m.seabed_friction;
  o.depth = site.specification().sea.depth;
  o.stiffness = m.stiffness;
  o.anchor_distance = m.anchor_distance;
  o.tow_drive = site.drive_or_none(m.tow);
  if (o.tow_drive >= 0) o.tow_direction = m.tow_direction.normalized();
  return std::make_unique<const Mooring>(o, site.now());
}

}  // namespace stillhook
