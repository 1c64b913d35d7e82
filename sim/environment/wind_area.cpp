#include "sim/environment/wind_area.h"

#include <algorithm>
#include <cmath>

#include "sim/element_site.h"

namespace stillhook {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double kReferenceHeight = 10.0, kLowestWind = 1.0;  // m

}  // namespace

WindSpeed wind_speed(const WindSpec& wind, double z, const Instant& now) {
  if (!now.on(z > kLowestWind)) {
    const Instant plain;
    return {wind_speed(wind, std::nextafter(kLowestWind, 2.0), plain).value, 0.0};
  }
  switch (wind.profile) {
    case WindSpec::Profile::iso: {
      const double C = 0.0573 * std::sqrt(1.0 + 0.148 * wind.speed);
      return {wind.speed * (1.0 + C * std::log(z / kReferenceHeight)), wind.speed * C / z};
    }
    case WindSpec::Profile::power: {
      const double value = wind.speed * std::pow(z / kReferenceHeight, wind.exponent);
      return {value, value * wind.exponent / z};
    }
    case WindSpec::Profile::constant:
      break;
  }
  return {wind.speed, 0.0};
}

WindArea::WindArea(const WindAreaSpec& area, const WindSpec& wind, const BodyPoint& centre)
    : ForceElement(area.name), centre_(centre), wind_(wind) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("wind_areas." + name(), field, rule);
  };
  require(centre.body != kWorld, "body", "must be a body that can move");
  require(area.areas.minCoeff() >= 0.0 && area.areas.maxCoeff() > 0.0, "areas", "must be >= 0, one of them > 0");
  require(area.drag.minCoeff() >= 0.0, "drag", "must be >= 0");
  require(wind.speed >= 0.0 && wind.density > 0.0, "", "needs a wind of speed >= 0 in air of density > 0");
  resistance_ = 0.5 * wind.density * area.drag.cwiseProduct(area.areas);
  half_height_ = 0.5 * area.height.value_or(std::sqrt(area.areas.head<2>().maxCoeff()));
  require(half_height_ > 0.0, "height", "must be > 0 m, or follow from an area across x or y");
  direction_ = Vector3(std::cos(wind.towards()), std::sin(wind.towards()), 0.0);
}

bool WindArea::same_as(const ForceElement& other) const {
  const auto* area = dynamic_cast<const WindArea*>(&other);
  return area && area->centre_ == centre_ && area->wind_ == wind_ && area->resistance_ == resistance_ &&
         area->half_height_ == half_height_;
}

WindArea::Flow WindArea::flow(const Instant& now) const {
  const PointMotion centre = motion_of(centre_, now);
  const WindSpeed wind = wind_speed(wind_, centre.p.z(), now);
  Flow f;
  f.R_WB = now.body[static_cast<std::size_t>(centre_.body)].R_WB;
  f.w = f.R_WB.transpose() * (wind.value * direction_ - centre.v);
  const double speed = f.w.norm();
  f.full = speed * resistance_.cwiseProduct(f.w);
  f.slope = Matrix3::Zero();
  if (speed > 0.0) f.slope = resistance_.asDiagonal() * (speed * Matrix3::Identity() + f.w * f.w.transpose() / speed);
  const double x = std::clamp((centre.p.z() + half_height_) / (2.0 * half_height_), 0.0, 1.0);
  f.share = x * x * (3.0 - 2.0 * x);
  f.share_by_z = 6.0 * x * (1.0 - x) / (2.0 * half_height_);
  f.wind_by_z = wind.slope;
  return f;
}

void WindArea::add_forces(const Instant& now, double, Memory, ForceSum& out) const {
  const Flow f = flow(now);
  add_point_force(centre_, now, f.R_WB * (f.share * f.full), out);
}

// With w = R' u:  dw = R' (U' e dz - dv) + [w]x dtheta,  dF_W = R (s G dw + s' F dz) - R [s F]x dtheta.
void WindArea::add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const {
  const Flow f = flow(now);
  const Matrix36 P = position_jacobian(centre_, now), V = velocity_stiffness(centre_, now);
  const Matrix36 wind_by_pose = f.R_WB.transpose() * (f.wind_by_z * direction_ * P.row(2) - V);
  Matrix36 by_pose = f.share * f.slope * wind_by_pose + f.share_by_z * f.full * P.row(2);
  by_pose.rightCols<3>() += f.share * (f.slope * cross_matrix(f.w) - cross_matrix(f.full));
  const Matrix36 by_velocity = -f.share * f.slope * f.R_WB.transpose() * P;
  add_force_jacobian(centre_, now, f.R_WB * (f.share * f.full), centre_.body, f.R_WB * by_pose, f.R_WB * by_velocity,
                     true, out);
}

std::vector<Channel> WindArea::channels() const { return channels_of(name(), wind_channels::all); }

void WindArea::measure(const Instant& now, Memory, std::span<double> out) const {
  const Flow f = flow(now);
  const Vector3 force = f.R_WB * (f.share * f.full);
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = force[i];
  out[3] = f.w.norm();
}

std::unique_ptr<const ForceElement> make_element(const WindAreaSpec& area, const ElementSite& site) {
  return std::make_unique<const WindArea>(area, site.specification().wind, site.point(area.body, area.centre));
}

}  // namespace stillhook
