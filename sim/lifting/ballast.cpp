#include "sim/lifting/ballast.h"

#include <cmath>

#include "sim/element_site.h"
#include "sim/specification.h"

namespace stillhook {

Ballast::Ballast(BallastOptions options) : ForceElement(options.name), options_(std::move(options)) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("ballast." + name(), field, rule);
  };
  require(std::isfinite(options_.mass) && options_.mass >= 0.0, "mass", "must be >= 0 kg");
  require(options_.drive >= 0, "drive", "a ballast transfer needs a drive");
  require(options_.from.body == options_.to.body, "body", "both tanks must be on one body");
}

bool Ballast::same_as(const ForceElement& other) const {
  const auto* ballast = dynamic_cast<const Ballast*>(&other);
  return ballast && ballast->options_ == options_;
}

double Ballast::weight_moved(const Instant& now) const {
  return options_.mass * options_.gravity * now.drive[options_.drive].position;
}

void Ballast::add_forces(const Instant& now, double, Memory, ForceSum& out) const {
  const Vector3 lifted = weight_moved(now) * Vector3::UnitZ();
  add_point_force(options_.from, now, lifted, out);
  add_point_force(options_.to, now, -lifted, out);
}

void Ballast::add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const {
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  const Vector3 lifted = weight_moved(now) * Vector3::UnitZ();
  const Matrix36 none = Matrix36::Zero();  // the forces are constant in W; only their moments turn with the body
  add_force_jacobian(options_.from, now, lifted, options_.from.body, none, none, true, out);
  add_force_jacobian(options_.to, now, -lifted, options_.to.body, none, none, true, out);
}

double Ballast::potential_energy(const Instant& now, Memory) const {
  return weight_moved(now) * (motion_of(options_.to, now).p.z() - motion_of(options_.from, now).p.z());
}

std::vector<Channel> Ballast::channels() const { return channels_of(name(), ballast_channels::all); }

void Ballast::measure(const Instant& now, Memory, std::span<double> out) const { out[0] = weight_moved(now); }

std::unique_ptr<const ForceElement> make_element(const BallastSpec& b, const ElementSite& site) {
  BallastOptions o;
  o.name = b.name;
  o.from = site.point(b.body, b.from);
  o.to = site.point(b.body, b.to);
  o.mass = b.mass;
  o.gravity = site.specification().sea.gravity;
  o.drive = site.drive(b.drive);
  return std::make_unique<const Ballast>(o);
}

}  // namespace stillhook
