#include "sim/lifting/restoring.h"

#include <cmath>

#include "sim/element_site.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kSmallTurn = 0.05;     // rad: below, series to the next power are exact to 1e-13
constexpr double kRoundedInput = 1e-6;  // of the largest entry: matrices are typed with a few digits

/// J_r(phi)^-1 = 1 + [phi]x/2 + c [phi]x^2 with c = (1 - g)/phi^2, g = (phi/2) cot(phi/2); and c' / phi.
struct TurnSeries {
  double c, slope;
};
TurnSeries turn_series(double angle) {
  const double a2 = angle * angle;
  if (angle < kSmallTurn)
    return {1.0 / 12.0 + a2 * (1.0 / 720.0 + a2 / 30240.0), 1.0 / 360.0 + a2 * (1.0 / 7560.0 + a2 / 201600.0)};
  const double half = 0.5 * angle, cot = 1.0 / std::tan(half), g = half * cot;
  const double g_slope = 0.5 * (cot - half / std::pow(std::sin(half), 2));
  return {(1.0 - g) / a2, (-g_slope / a2 - 2.0 * (1.0 - g) / (a2 * angle)) / angle};
}

Matrix3 inverse_right_jacobian(const Vector3& phi) {
  const Matrix3 turn = cross_matrix(phi);
  return Matrix3::Identity() + 0.5 * turn + turn_series(phi.norm()).c * (turn * turn);
}

/// d(J_r(phi)^-T couple)/d phi at a constant couple.
Matrix3 couple_slope(const Vector3& phi, const Vector3& couple) {
  const TurnSeries s = turn_series(phi.norm());
  const Vector3 once = phi.cross(couple), twice = phi.cross(once);
  return 0.5 * cross_matrix(couple) - s.c * (cross_matrix(once) + cross_matrix(phi) * cross_matrix(couple)) +
         s.slope * twice * phi.transpose();
}

}  // namespace

Restoring::Restoring(RestoringOptions options) : ForceElement(options.name), options_(std::move(options)) {
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("restoring." + name(), field, rule);
  };
  const auto symmetric = [](const Matrix6& M) {
    return M.allFinite() && (M - M.transpose()).cwiseAbs().maxCoeff() <= kRoundedInput * M.cwiseAbs().maxCoeff();
  };
  require(symmetric(options_.stiffness), "stiffness_matrix_kN_m", "must be symmetric");
  require(symmetric(options_.damping), "damping_matrix_kN_s_m", "must be symmetric");
  options_.stiffness = 0.5 * (options_.stiffness + options_.stiffness.transpose()).eval();
  options_.damping = 0.5 * (options_.damping + options_.damping.transpose()).eval();
  const Vector6 own = Eigen::SelfAdjointEigenSolver<Matrix6>(options_.damping).eigenvalues();  // ascending
  require(own[0] >= -kRoundedInput * std::abs(own[5]), "damping_matrix_kN_s_m",
          "must be positive semidefinite, this one would drive the body");
}

bool Restoring::same_as(const ForceElement& other) const {
  const auto* restoring = dynamic_cast<const Restoring*>(&other);
  return restoring && restoring->options_ == options_;
}

Restoring::Motion Restoring::motion(const Instant& now) const {
  const RestoringOptions& o = options_;
  const BodyKinematics& b = now.body[o.point.body];
  const PointMotion P = motion_of(o.point, now);
  Motion m;
  m.R_WB = b.R_WB;
  m.phi = log_rotation(o.rest_R_WB.transpose() * b.R_WB);
  m.x << o.axes.transpose() * (P.p - o.rest_point), o.axes.transpose() * (o.rest_R_WB * m.phi);
  m.V << o.axes.transpose() * P.v, o.axes.transpose() * (b.R_WB * b.w_B);
  m.spring = -(o.stiffness * m.x);
  m.damper = -(o.damping * m.V);
  m.couple_R = o.rest_R_WB.transpose() * (o.axes * m.spring.tail<3>());
  m.force_W = o.force_at_rest + o.axes * (m.spring.head<3>() + m.damper.head<3>());
  m.moment_B =
      inverse_right_jacobian(m.phi).transpose() * m.couple_R + b.R_WB.transpose() * (o.axes * m.damper.tail<3>());
  return m;
}

void Restoring::add_forces(const Instant& now, double, Memory, ForceSum& out) const {
  const Motion m = motion(now);
  add_point_force(options_.point, now, m.force_W, out);
  out.add(options_.point.body, Vector3::Zero(), m.moment_B);
}

void Restoring::add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const {
  using Rows36 = Eigen::Matrix<double, 3, 6>;
  const RestoringOptions& o = options_;
  const int body = o.point.body;
  const Motion m = motion(now);
  const Matrix3 inverse = inverse_right_jacobian(m.phi), R_HB = o.axes.transpose() * m.R_WB;
  const Matrix3 R_HR = o.axes.transpose() * o.rest_R_WB;
  const Rows36 P = position_jacobian(o.point, now);
  // dx = X xi, dV = B du + S xi
  Matrix6 X = Matrix6::Zero(), B = Matrix6::Zero(), S = Matrix6::Zero();
  X.topRows<3>() = o.axes.transpose() * P;
  X.bottomRightCorner<3, 3>() = R_HR * inverse;
  B.topRows<3>() = X.topRows<3>();
  B.bottomRightCorner<3, 3>() = R_HB;
  S.topRows<3>() = o.axes.transpose() * velocity_stiffness(o.point, now);
  S.bottomRightCorner<3, 3>() = -R_HB * cross_matrix(now.body[body].w_B);
  const Matrix6 spring_x = -(o.stiffness * X), damper_x = -(o.damping * S), damper_u = -(o.damping * B);

  const Rows36 F_x = o.axes * (spring_x.topRows<3>() + damper_x.topRows<3>());
  const Rows36 F_u = o.axes * damper_u.topRows<3>();
  add_force_jacobian(o.point, now, m.force_W, body, F_x, F_u, true, out);

  Matrix6 K = Matrix6::Zero(), C = Matrix6::Zero();
  K.bottomRows<3>() =
      inverse.transpose() * (R_HR.transpose() * spring_x.bottomRows<3>()) + R_HB.transpose() * damper_x.bottomRows<3>();
  K.bottomRightCorner<3, 3>() +=
      couple_slope(m.phi, m.couple_R) * inverse + cross_matrix(R_HB.transpose() * m.damper.tail<3>());
  C.bottomRows<3>() = R_HB.transpose() * damper_u.bottomRows<3>();
  out.add_stiffness(body, body, K);
  out.add_damping(body, body, C);
}

double Restoring::potential_energy(const Instant& now, Memory) const {
  const Motion m = motion(now);
  return -0.5 * m.x.dot(m.spring) - options_.force_at_rest.dot(options_.axes * m.x.head<3>());
}

double Restoring::dissipated_power(const Instant& now, Memory) const {
  const Motion m = motion(now);
  return -m.V.dot(m.damper);
}

std::vector<Channel> Restoring::channels() const { return channels_of(name(), restoring_channels::all); }

void Restoring::measure(const Instant& now, Memory, std::span<double> out) const {
  const Motion m = motion(now);
  const Vector3 moment_W = m.R_WB * m.moment_B;
  for (int i = 0; i < 3; ++i) {
    out[static_cast<std::size_t>(i)] = m.force_W[i];
    out[static_cast<std::size_t>(i + 3)] = moment_W[i];
  }
}

std::unique_ptr<const ForceElement> make_element(const RestoringSpec& r, const ElementSite& site) {
  const BodySpec& body = site.specification().bodies[static_cast<std::size_t>(site.body(r.body))];
  RestoringOptions o;
  o.name = r.name;
  o.point = site.point(r.body, r.point);
  // The given pose, not the one that joints or an equilibrium made of it: the case says where it is at rest.
  o.rest_R_WB = rotation_from(r.rest_attitude.value_or(body.attitude));
  o.rest_point = r.rest_point.value_or(Vector3(body.position + rotation_from(body.attitude) * r.point));
  o.axes = rotation_from({0.0, 0.0, r.axes_heading.value_or(roll_pitch_yaw(o.rest_R_WB).yaw)});
  o.stiffness = r.stiffness;
  o.damping = r.damping;
  o.force_at_rest = r.force_at_rest;
  return std::make_unique<const Restoring>(o);
}

}  // namespace stillhook
