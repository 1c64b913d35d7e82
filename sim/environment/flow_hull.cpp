#include "sim/environment/flow_hull.h"

#include <cmath>

#include "sim/element_site.h"
#include "sim/environment/streams.h"
#include "sim/error.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

/// The part of the scratch that is the stream's; the first three numbers are the motion that the step began with.
std::span<double> stream_memory(Memory m) { return m.scratch.subspan(3); }

}  // namespace

FlowHull::FlowHull(FlowHullOptions options, const std::string& entry, std::shared_ptr<const Stream> stream)
    : ForceElement(options.name), options_(std::move(options)), stream_(std::move(stream)) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError(entry, field, rule);
  };
  require(options_.body != kWorld, "body", "must be a body that can move");
  require(options_.area_along > 0.0 && options_.area_across > 0.0 && options_.moment_size > 0.0, "",
          "needs areas > 0 along and across the hull");
  require(options_.length > 0.0, "length", "must be > 0 m");
  require(options_.filter > 0.0, "filter", "must be > 0 s");
}

bool FlowHull::same_as(const ForceElement& other) const {
  const auto* o = dynamic_cast<const FlowHull*>(&other);
  if (!o || !o->stream_->same_as(*stream_)) return false;
  const FlowHullOptions &a = o->options_, &b = options_;
  return a.body == b.body && a.along == b.along && a.across == b.across && a.coefficients == b.coefficients &&
         a.area_along == b.area_along && a.area_across == b.area_across && a.moment_size == b.moment_size &&
         a.length == b.length && a.filter == b.filter && a.distance == b.distance;
}

FlowHull::Load FlowHull::load(const Eigen::Vector2d& u, double r) const {
  const FlowHullOptions& o = options_;
  const double half_density = 0.5 * stream_->density();
  const Vector3 size(o.area_along, o.area_across, o.moment_size);
  Load load;
  load.value.setZero();
  load.by_flow.setZero();
  if (const double square = u.squaredNorm(); square > 0.0) {
    const FlowCoefficients::Values C = o.coefficients.at(std::atan2(-u.y(), -u.x()));
    // d a = (u_x du_y - u_y du_x)/|u|^2, so that the angle's part of the derivative is of first order in |u| too.
    load.value = half_density * square * size.cwiseProduct(C.value);
    load.by_flow = half_density * (2.0 * size.cwiseProduct(C.value) * u.transpose() +
                                   size.cwiseProduct(C.slope) * Eigen::RowVector2d(-u.y(), u.x()));
  }
  const double turning = half_density * o.coefficients.broadside() * o.area_across * std::pow(o.length, 3) / 32.0;
  load.value.z() -= turning * r * std::abs(r);
  load.moment_by_rate = -2.0 * turning * std::abs(r);
  return load;
}

Vector3 FlowHull::motion(const Instant& now) const {
  const BodyKinematics& b = now.body[static_cast<std::size_t>(options_.body)];
  return {b.v_WC.x(), b.v_WC.y(), b.R_WB.row(2).dot(b.w_B)};
}

FlowHull::Matrix36 FlowHull::motion_by_pose(const Instant& now) const {
  const BodyKinematics& b = now.body[static_cast<std::size_t>(options_.body)];
  Matrix36 J = Matrix36::Zero();
  J.bottomRightCorner<1, 3>() = -b.R_WB.row(2) * cross_matrix(b.w_B);  // R (dtheta x w)
  return J;
}

FlowHull::Matrix36 FlowHull::motion_by_velocity(const Instant& now) const {
  const BodyKinematics& b = now.body[static_cast<std::size_t>(options_.body)];
  Matrix36 J = Matrix36::Zero();
  J(0, 0) = J(1, 1) = 1.0;
  J.bottomRightCorner<1, 3>() = b.R_WB.row(2);
  return J;
}

Vector3 FlowHull::slow_motion(const Instant& now, double h, Memory m) const {
  const Eigen::Map<const Vector3> state(m.state.data()), before(m.scratch.data());
  if (h <= 0.0) return state;
  const double w = weight(h);
  return (1.0 - 2.0 * w) * state + w * (before + motion(now));
}

void FlowHull::start(const Instant& now, Memory m) const { Eigen::Map<Vector3>(m.state.data()) = motion(now); }

void FlowHull::begin_step(const Instant& before, double, Memory m) const {
  Eigen::Map<Vector3>(m.scratch.data()) = motion(before);
}

void FlowHull::end_step(const Instant& now, double h, Memory m) const {
  Eigen::Map<Vector3>(m.state.data()) = slow_motion(now, h, m);
}

FlowHull::Flow FlowHull::flow(const Instant& now, const Vector3& slow, Memory m) const {
  const Matrix3& R = now.body[static_cast<std::size_t>(options_.body)].R_WB;
  const Vector3 x = R.col(0);
  const double level = x.x() * x.x() + x.y() * x.y();
  Flow f;
  const double size = std::sqrt(level);
  f.ahead = size > 0.0 ? Vector3(x.x() / size, x.y() / size, 0.0) : Vector3::UnitX().eval();
  f.port = {-f.ahead.y(), f.ahead.x(), 0.0};
  const Matrix3 dx = -R * cross_matrix(Vector3::UnitX());  // d(R e_x) = R (dtheta x e_x)
  f.heading_by_turn.setZero();
  if (level > 0.0) f.heading_by_turn = (x.x() * dx.row(1) - x.y() * dx.row(0)) / level;
  const Vector3 u = stream_->at_hull(options_.distance, now, stream_memory(m)) - Vector3(slow.x(), slow.y(), 0.0);
  f.relative = {f.ahead.dot(u), f.port.dot(u)};
  f.by_slow << -f.ahead.transpose(), -f.port.transpose();
  f.by_slow.col(2).setZero();
  f.load = load(f.relative, slow.z());
  return f;
}

MatrixX FlowHull::generalised(const Instant& now, const Flow& f, const MatrixX& dG) const {
  const Matrix3 R_BW = now.body[static_cast<std::size_t>(options_.body)].R_WB.transpose();
  MatrixX dQ(6, dG.cols());
  dQ.topRows<3>() = f.ahead * dG.row(0) + f.port * dG.row(1);
  dQ.bottomRows<3>() = options_.along.c_B.cross(R_BW * f.ahead) * dG.row(0) +
                       options_.across.c_B.cross(R_BW * f.port) * dG.row(1) + R_BW.col(2) * dG.row(2);
  return dQ;
}

void FlowHull::add_forces(const Instant& now, double h, Memory m, ForceSum& out) const {
  const Flow f = flow(now, slow_motion(now, h, m), m);
  const MatrixX Q = generalised(now, f, f.load.value);
  out.add(options_.body, Q.col(0).head<3>(), Q.col(0).tail<3>());
}

// dG = G_u (u_s d slow + (u_y, -u_x) dpsi) + G_r d slow,  d slow = w (motion_pose xi + motion_velocity du)
void FlowHull::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  const Flow f = flow(now, slow_motion(now, h, m), m);
  const double w = h > 0.0 ? weight(h) : 0.0;
  Matrix3 by_slow = f.load.by_flow * f.by_slow;
  by_slow(2, 2) += f.load.moment_by_rate;
  Matrix36 by_pose = w * by_slow * motion_by_pose(now);
  by_pose.rightCols<3>() += f.load.by_flow * Eigen::Vector2d(f.relative.y(), -f.relative.x()) * f.heading_by_turn;
  Matrix6 K = generalised(now, f, by_pose);
  // The axes turn with the heading, and all of it turns against the body.
  const Matrix3 R_BW = now.body[static_cast<std::size_t>(options_.body)].R_WB.transpose();
  const Vector3 turned_x = f.load.value.x() * f.port, turned_y = -f.load.value.y() * f.ahead;
  K.topRightCorner<3, 3>() += (turned_x + turned_y) * f.heading_by_turn;
  K.bottomRightCorner<3, 3>() +=
      (options_.along.c_B.cross(R_BW * turned_x) + options_.across.c_B.cross(R_BW * turned_y)) * f.heading_by_turn;
  K.bottomRightCorner<3, 3>() += cross_matrix(options_.along.c_B) * cross_matrix(R_BW * (f.load.value.x() * f.ahead)) +
                                 cross_matrix(options_.across.c_B) * cross_matrix(R_BW * (f.load.value.y() * f.port)) +
                                 cross_matrix(f.load.value.z() * R_BW.col(2));
  out.add_stiffness(options_.body, options_.body, K);
  out.add_damping(options_.body, options_.body, generalised(now, f, w * by_slow * motion_by_velocity(now)));
}

bool FlowHull::add_history_tangent(const Instant& before, const Instant& now, double h, Memory m,
                                   const BodyChange& from, const Eigen::Ref<const MatrixX>& state,
                                   Eigen::Ref<MatrixX> dQ) const {
  const Flow f = flow(now, slow_motion(now, h, m), m);
  const int r = 6 * options_.body;
  Matrix3 by_slow = f.load.by_flow * f.by_slow;
  by_slow(2, 2) += f.load.moment_by_rate;
  const MatrixX moved =
      motion_by_pose(before) * from.xi.middleRows<6>(r) + motion_by_velocity(before) * from.u.middleRows<6>(r);
  const MatrixX slow = (1.0 - 2.0 * weight(h)) * state + weight(h) * moved;
  dQ.middleRows<6>(r) += generalised(now, f, by_slow * slow);
  return true;
}

bool FlowHull::advance_state_tangent(const Instant& before, const Instant& now, double h, Memory,
                                     const BodyChange& from, const BodyChange& to, Eigen::Ref<MatrixX> state) const {
  const int r = 6 * options_.body;
  const auto moved = [&](const Instant& at, const BodyChange& by) {
    return MatrixX(motion_by_pose(at) * by.xi.middleRows<6>(r) + motion_by_velocity(at) * by.u.middleRows<6>(r));
  };
  state = ((1.0 - 2.0 * weight(h)) * state + weight(h) * (moved(before, from) + moved(now, to))).eval();
  return true;
}

std::vector<Channel> FlowHull::channels() const { return channels_of(name(), wind_hull_channels::all); }

void FlowHull::measure(const Instant& now, Memory m, std::span<double> out) const {
  const Flow f = flow(now, Eigen::Map<const Vector3>(m.state.data()), m);
  const Vector3 force = f.load.value.x() * f.ahead + f.load.value.y() * f.port;
  out[0] = force.x();
  out[1] = force.y();
  out[2] = f.load.value.z();
  out[3] = f.relative.norm();
  out[4] = std::atan2(-f.relative.y(), -f.relative.x());
}

namespace {

/// What both fluids have alike.
FlowHullOptions options_of(const std::string& name, const FlowHullSpec& hull, FlowCoefficients coefficients,
                           const ElementSite& site) {
  FlowHullOptions o{.name = name,
                    .body = site.body(hull.body),
                    .along = site.point(hull.body, hull.reference),
                    .across = site.point(hull.body, hull.reference),
                    .coefficients = std::move(coefficients)};
  o.length = hull.length;
  o.filter = hull.filter;
  return o;
}

FlowCoefficients from_file(const FlowHullSpec& hull, const std::string& entry) {
  try {
    return read_flow_coefficients(hull.coefficient_file);
  } catch (const FileError& error) {
    throw SpecificationError(entry, "coefficients", error.what());
  }
}

}  // namespace

std::unique_ptr<const ForceElement> make_element(const WindHullSpec& hull, const ElementSite& site) {
  const std::string entry = "wind_hulls." + hull.name;
  const bool ship = hull.ship != WindHullSpec::Ship::none;
  if (!(hull.area_side > 0.0 && hull.length > 0.0))
    throw SpecificationError(entry, "area_side", "must be > 0 m2, and the length > 0 m");
  FlowHullOptions o = options_of(hull.name, hull, ship ? blendermann(hull) : from_file(hull, entry), site);
  o.area_along = hull.area_front;
  o.area_across = hull.area_side;
  o.moment_size = hull.area_side * hull.length;
  o.distance = hull.centroid_height;
  o.along.c_B.z() += hull.centroid_height;
  o.across.c_B.z() += (ship ? blendermann_heeling(hull.ship) : 1.0) * hull.centroid_height;
  return std::make_unique<const FlowHull>(std::move(o), entry, wind_at(site));
}

std::unique_ptr<const ForceElement> make_element(const CurrentHullSpec& hull, const ElementSite& site) {
  const std::string entry = "current_hulls." + hull.name;
  if (hull.coefficient_file.empty() && !hull.drag)
    throw SpecificationError(entry, "drag", "is needed without a file of coefficients");
  FlowHullOptions o = options_of(
      hull.name, hull, hull.drag ? cross_flow((*hull.drag)[0], (*hull.drag)[1]) : from_file(hull, entry), site);
  o.area_along = o.area_across = hull.length * hull.draft;
  o.moment_size = hull.length * hull.length * hull.draft;
  o.distance = 0.5 * hull.draft;
  o.along.c_B.z() -= 0.5 * hull.draft;
  o.across.c_B.z() -= 0.5 * hull.draft;
  return std::make_unique<const FlowHull>(std::move(o), entry, current_at(site));
}

}  // namespace stillhook
