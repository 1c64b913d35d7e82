#include "sim/lifting/wire.h"

#include <ceres/jet.h>

#include <cmath>

#include "sim/crane_parts.h"
#include "sim/element_site.h"
#include "sim/lifting/line.h"
#include "sim/specification.h"

namespace stillhook {

namespace {
constexpr double kShortestShare = 0.01;  // of the unstretched length at the start: block on sheave
}

double wire_damping(double damping_ratio, double mass, double axial_stiffness, double unstretched_length) {
  return 2.0 * damping_ratio * std::sqrt(axial_stiffness / unstretched_length * mass);
}

Wire::Wire(WireOptions options) : ForceElement(options.name), options_(std::move(options)) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("wires." + name(), field, rule);
  };
  const WireOptions& o = options_;
  require(std::isfinite(o.axial_stiffness) && o.axial_stiffness > 0.0, "axial_stiffness", "must be > 0 N");
  require(std::isfinite(o.unstretched_length) && o.unstretched_length > 0.0, "unstretched_length", "must be > 0 m");
  require(std::isfinite(o.damping) && o.damping >= 0.0, "damping", "must be >= 0 N s/m");
  require(std::isfinite(o.damping_strain) && o.damping_strain > 0.0, "damping_strain", "must be > 0");
}

Wire::Unstretched Wire::unstretched(const Instant& now) const {
  if (options_.drive < 0) return {options_.unstretched_length, 0.0};
  const DriveState& drive = now.drive[options_.drive];
  const double length = options_.unstretched_length - drive.position;
  const double shortest = kShortestShare * options_.unstretched_length;
  if (now.on(length < shortest)) return {shortest, 0.0};
  return {length, -drive.rate};
}

bool Wire::same_as(const ForceElement& other) const {
  const auto* wire = dynamic_cast<const Wire*>(&other);
  return wire && wire->options_ == options_;
}

double Wire::unstretched_length(const Instant& now) const { return unstretched(now).length; }

double Wire::tension(const Instant& now) const {
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const Unstretched L = unstretched(now);
  return wire_tension(line.length, line.rate, L.length, L.rate, options_, now.branches);
}

void Wire::add_forces(const Instant& now, double, Memory, ForceSum& out) const {
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const Unstretched L = unstretched(now);
  const double tension = wire_tension(line.length, line.rate, L.length, L.rate, options_, now.branches);
  if (tension != 0.0) add_line_forces(options_.from, options_.to, now, line, tension, out);
}

void Wire::add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const {
  using Dual = ceres::Jet<double, 2>;
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const Unstretched L = unstretched(now);
  const Dual tension = wire_tension(Dual(line.length, 0), Dual(line.rate, 1), Dual(L.length), Dual(L.rate), options_);
  if (tension.a > 0.0)
    add_line_jacobian(options_.from, options_.to, now, line, tension.a, tension.v[0], tension.v[1], out);
}

double Wire::potential_energy(const Instant& now, Memory) const {
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const double L = unstretched(now).length;
  return unilateral_energy(line.length - L, options_.axial_stiffness / L);
}

double Wire::dissipated_power(const Instant& now, Memory) const {
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const Unstretched L = unstretched(now);
  const double tension = wire_tension(line.length, line.rate, L.length, L.rate, options_);
  return unilateral_dissipation(tension, line.length - L.length, line.rate - L.rate,
                                options_.axial_stiffness / L.length);
}

std::vector<Channel> Wire::channels() const { return channels_of(name(), wire_channels::all); }

/// Columns: along the boom in plan, to port of it, up. R_WH is the heading that the offsets are measured in.
Matrix3 Wire::lead_axes(const Instant& now, const Matrix3& R_WH) const {
  if (options_.boom == kWorld) return R_WH;
  Vector3 ahead = (now.body[options_.boom].R_WB * options_.boom_athwart).cross(Vector3::UnitZ());
  const double length = ahead.norm();
  if (length < 1e-6) return R_WH;  // a boom that lies on its side has no heading
  ahead /= length;
  Matrix3 R_WL;
  R_WL << ahead, Vector3::UnitZ().cross(ahead), Vector3::UnitZ();
  return R_WL;
}

void Wire::measure(const Instant& now, Memory, std::span<double> out) const {
  const LineMotion line = line_motion(options_.from, options_.to, now);
  const Unstretched L = unstretched(now);
  const Matrix3 R_WH =
      options_.crane == kWorld ? Matrix3(Matrix3::Identity()) : heading_rotation(now.body[options_.crane].R_WB);
  const Vector3 offset_W = -line.length * line.e;  // lower end from upper end
  const Vector3 offset_H = R_WH.transpose() * offset_W, offset_L = lead_axes(now, R_WH).transpose() * offset_W;
  out[0] = wire_tension(line.length, line.rate, L.length, L.rate, options_, now.branches);
  out[1] = line.length;
  out[2] = L.length;
  out[3] = L.rate;
  out[4] = offset_H.x();
  out[5] = offset_H.y();
  out[6] = std::atan2(offset_L.x(), -offset_L.z());
  out[7] = std::atan2(offset_L.y(), -offset_L.z());
}

double end_distance(const WireSpec& wire, const ElementSite& site) {
  return site.distance(site.point(wire.from, wire.point_from), site.point(wire.to, wire.point_to));
}

std::unique_ptr<const ForceElement> make_element(const WireSpec& w, const ElementSite& site) {
  WireOptions o;
  o.name = w.name;
  o.from = site.point(w.from, w.point_from);
  o.to = site.point(w.to, w.point_to);
  o.axial_stiffness = w.axial_stiffness;
  o.unstretched_length = site.initial_length(w.name);
  o.damping = w.damping > 0.0 ? w.damping
                              : wire_damping(w.damping_ratio, w.damping_mass, w.axial_stiffness, o.unstretched_length);
  o.drive = site.drive_or_none(w.winch);
  if (const std::vector<std::string> vessels = crane_vessels(site.specification()); !vessels.empty())
    o.crane = site.body(vessels.front());
  if (w.role == WireSpec::Role::hoist && site.body(w.from) != kWorld) {
    o.boom = site.body(w.from);
    o.boom_athwart = boom_athwart(site.specification(), w.from);
  }
  return std::make_unique<const Wire>(o);
}

}  // namespace stillhook
