#include "sim/environment/flow_area.h"

#include <algorithm>
#include <cmath>

#include "sim/element_site.h"
#include "sim/environment/streams.h"
#include "sim/error.h"

namespace stillhook {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

}  // namespace

FlowArea::FlowArea(const std::string& element_name, const std::string& entry, const FlowAreaSpec& area,
                   std::shared_ptr<const Stream> stream, const BodyPoint& centre)
    : ForceElement(element_name), centre_(centre), stream_(std::move(stream)) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError(entry, field, rule);
  };
  require(centre.body != kWorld, "body", "must be a body that can move");
  require(area.areas.minCoeff() >= 0.0 && area.areas.maxCoeff() > 0.0, "areas", "must be >= 0, one of them > 0");
  require(area.drag.minCoeff() >= 0.0, "drag", "must be >= 0");
  resistance_ = 0.5 * stream_->density() * area.drag.cwiseProduct(area.areas);
  half_height_ = 0.5 * area.height.value_or(std::sqrt(area.areas.head<2>().maxCoeff()));
  require(half_height_ > 0.0, "height", "must be > 0 m, or follow from an area across x or y");
}

bool FlowArea::same_as(const ForceElement& other) const {
  const auto* area = dynamic_cast<const FlowArea*>(&other);
  return area && area->centre_ == centre_ && area->stream_->same_as(*stream_) && area->resistance_ == resistance_ &&
         area->half_height_ == half_height_;
}

FlowArea::Flow FlowArea::flow(const Instant& now, Memory m) const {
  const PointMotion centre = motion_of(centre_, now);
  const StreamPoint fluid = stream_->at(centre.p, now, m.scratch);
  Flow f;
  f.R_WB = now.body[static_cast<std::size_t>(centre_.body)].R_WB;
  f.w = f.R_WB.transpose() * (fluid.velocity - centre.v);
  const double speed = f.w.norm();
  f.full = speed * resistance_.cwiseProduct(f.w);
  f.slope = Matrix3::Zero();
  if (speed > 0.0) f.slope = resistance_.asDiagonal() * (speed * Matrix3::Identity() + f.w * f.w.transpose() / speed);
  const double x = std::clamp((fluid.inside + half_height_) / (2.0 * half_height_), 0.0, 1.0);
  f.share = x * x * (3.0 - 2.0 * x);
  f.share_by_place = 6.0 * x * (1.0 - x) / (2.0 * half_height_) * fluid.inside_by_place;
  f.by_place = fluid.by_place;
  return f;
}

void FlowArea::add_forces(const Instant& now, double, Memory m, ForceSum& out) const {
  const Flow f = flow(now, m);
  add_point_force(centre_, now, f.R_WB * (f.share * f.full), out);
}

// With w = R' u:  dw = R' (u_W' dp - dv) + [w]x dtheta,  dF_W = R (s G dw + s' F dp) - R [s F]x dtheta.
void FlowArea::add_jacobian(const Instant& now, double, Memory m, JacobianSum& out) const {
  const Flow f = flow(now, m);
  const Matrix36 P = position_jacobian(centre_, now), V = velocity_stiffness(centre_, now);
  const Matrix36 flow_by_pose = f.R_WB.transpose() * (f.by_place * P - V);
  Matrix36 by_pose = f.share * f.slope * flow_by_pose + f.full * (f.share_by_place.transpose() * P);
  by_pose.rightCols<3>() += f.share * (f.slope * cross_matrix(f.w) - cross_matrix(f.full));
  const Matrix36 by_velocity = -f.share * f.slope * f.R_WB.transpose() * P;
  add_force_jacobian(centre_, now, f.R_WB * (f.share * f.full), centre_.body, f.R_WB * by_pose, f.R_WB * by_velocity,
                     true, out);
}

std::vector<Channel> FlowArea::channels() const { return channels_of(name(), wind_channels::all); }

void FlowArea::measure(const Instant& now, Memory m, std::span<double> out) const {
  const Flow f = flow(now, m);
  const Vector3 force = f.R_WB * (f.share * f.full);
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = force[i];
  out[3] = f.w.norm();
}

std::unique_ptr<const ForceElement> make_element(const WindAreaSpec& area, const ElementSite& site) {
  return std::make_unique<const FlowArea>(area.name, "wind_areas." + area.name, area, wind_at(site),
                                          site.point(area.body, area.centre));
}

std::unique_ptr<const ForceElement> make_element(const CurrentAreaSpec& area, const ElementSite& site) {
  return std::make_unique<const FlowArea>(area.name, "current_areas." + area.name, area, current_at(site),
                                          site.point(area.body, area.centre));
}

}  // namespace stillhook
