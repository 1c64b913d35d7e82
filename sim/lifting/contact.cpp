#include "sim/lifting/contact.h"

#include <algorithm>
#include <cmath>

#include "sim/lifting/contact_touch.h"
#include "sim/lifting/unilateral.h"
#include "sim/specification.h"

namespace stillhook {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

namespace {

// A force cut to a length, and its derivatives with respect to both.
struct Cut {
  Eigen::Vector2d force, by_cone = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_force = Eigen::Matrix2d::Identity();
  bool acts = false;
};

Cut cut(const Eigen::Vector2d& force, double cone, Branches* branches = nullptr) {
  Cut c{.force = force};
  const double size = force.norm();
  if (!on_branch(branches, size > cone) || size == 0.0) return c;
  c.acts = true;
  c.by_cone = force / size;
  c.force = cone * c.by_cone;
  c.by_force = cone / size * (Eigen::Matrix2d::Identity() - c.by_cone * c.by_cone.transpose());
  return c;
}

}  // namespace

double Contact::normal_force(const Touch& t, const Instant& now) const {
  return unilateral_force(t.depth, -t.v_S.z(), k_, c_, options_.damping_depth, now.branches);
}

// By the depth and by its rate.
Contact::Dual Contact::normal_force_by_depth(const Touch& t) const {
  return unilateral_force(Dual(t.depth, 0), Dual(-t.v_S.z(), 1), Dual(k_), Dual(c_), Dual(options_.damping_depth));
}

Contact::Contact(ContactOptions options) : ForceElement(options.name), options_(std::move(options)) {
  const ContactOptions& o = options_;
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("contacts." + name(), field, rule);
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  const auto not_negative = [](double v) { return std::isfinite(v) && v >= 0.0; };
  require(!o.points.empty(), "points", "at least one point is needed");
  require(o.body != o.surface.body, "surface_body", "points and surface must be on different bodies");
  require(positive(o.length), "surface_length", "must be > 0 m");
  require(positive(o.breadth), "surface_breadth", "must be > 0 m");
  require(positive(o.stiffness), "stiffness", "must be > 0 N/m");
  require(not_negative(o.damping), "damping", "must be >= 0 N s/m");
  require(positive(o.damping_depth), "damping_depth", "must be > 0 m");
  require(not_negative(o.friction), "friction", "must be >= 0");
  k_ = o.stiffness / static_cast<double>(o.points.size());
  c_ = o.damping / static_cast<double>(o.points.size());
}

bool Contact::same_as(const ForceElement& other) const {
  const auto* contact = dynamic_cast<const Contact*>(&other);
  return contact && contact->options_ == options_;
}

Contact::Surface Contact::surface(const Instant& now) const {
  if (options_.surface.body == kWorld) return {};
  const BodyKinematics& b = now.body[options_.surface.body];
  return {b.R_WB, b.p_WC, b.v_WC, b.w_B};
}

Contact::Touch Contact::touch(const Vector3& point, const Surface& s, const Instant& now) const {
  Touch t;
  t.point = {options_.body, point};
  t.motion = motion_of(t.point, now);
  t.x_S = s.R_WS.transpose() * (t.motion.p - s.p_WC);
  t.v_S = s.R_WS.transpose() * (t.motion.v - s.v_WC) - s.w_S.cross(t.x_S);
  const Vector3 from_centre = t.x_S - options_.surface.c_B;
  t.depth = -from_centre.z();
  t.beside = std::hypot(std::max(0.0, std::abs(from_centre.x()) - 0.5 * options_.length),
                        std::max(0.0, std::abs(from_centre.y()) - 0.5 * options_.breadth));
  return t;
}

Contact::Seen Contact::seen(const Touch& t, const Surface& s, const Instant& now) const {
  const Matrix3 R_SW = s.R_WS.transpose(), turn = cross_matrix(s.w_S);
  Seen d;
  d.xA = R_SW * position_jacobian(t.point, now);
  d.vA = R_SW * velocity_stiffness(t.point, now) - turn * d.xA;
  d.xS << -R_SW, cross_matrix(t.x_S);
  d.vS = -turn * d.xS;
  d.vS.rightCols<3>() += cross_matrix(R_SW * (t.motion.v - s.v_WC));
  return d;
}

Contact::Grip Contact::grip(const Touch& t, double N, std::span<const double> state, Branches* branches) const {
  const Eigen::Vector2d anchor(state[kAnchorX], state[kAnchorY]);
  const double cone = options_.friction * N;
  const Cut spring = cut(-k_ * (t.x_S.head<2>() - anchor), cone, branches);
  const Cut all = cut(spring.force - c_ * t.v_S.head<2>(), cone, branches);
  Grip g;
  g.spring = spring.force;
  g.force = all.force;
  g.slips = spring.acts;
  g.by_spring = all.by_force * spring.by_force;
  g.by_damper = all.by_force;
  g.by_cone = all.by_force * spring.by_cone + all.by_cone;
  return g;
}

void Contact::start(const Instant& now, Memory m) const {
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    const auto state = m.state.subspan(kStatesPerPoint * i, kStatesPerPoint);
    state[kAnchorX] = t.x_S.x();
    state[kAnchorY] = t.x_S.y();
    state[kSlipX] = state[kSlipY] = 0.0;
  }
}

void Contact::settle(const Instant& now, Memory m) const {
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    const auto state = m.state.subspan(kStatesPerPoint * i, kStatesPerPoint);
    state[kSlipX] = state[kSlipY] = 0.0;
    if (active(now) && t.touching()) continue;
    state[kAnchorX] = t.x_S.x();
    state[kAnchorY] = t.x_S.y();
  }
}

void Contact::end_step(const Instant& now, double h, Memory m) const {
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    const auto state = m.state.subspan(kStatesPerPoint * i, kStatesPerPoint);
    Eigen::Vector2d anchor(state[kAnchorX], state[kAnchorY]);
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();
    if (!active(now) || !now.on(t.touching())) {
      anchor = t.x_S.head<2>();
    } else {
      const Grip g = grip(t, normal_force(t, now), state, now.branches);
      if (g.slips) {
        const Eigen::Vector2d moved = t.x_S.head<2>() + g.spring / k_;
        if (h > 0.0) slip = (moved - anchor) / h;
        anchor = moved;
      }
    }
    state[kAnchorX] = anchor.x();
    state[kAnchorY] = anchor.y();
    state[kSlipX] = slip.x();
    state[kSlipY] = slip.y();
  }
}

void Contact::add_forces(const Instant& now, double, Memory m, ForceSum& out) const {
  if (!active(now)) return;
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (!now.on(t.touching())) continue;
    const double N = normal_force(t, now);
    const Grip g = grip(t, N, m.state.subspan(kStatesPerPoint * i, kStatesPerPoint), now.branches);
    const Vector3 f_S(g.force.x(), g.force.y(), N);
    const Vector3 F_W = s.R_WS * f_S;
    add_point_force(t.point, now, F_W, out);
    out.add(options_.surface.body, -F_W, -t.x_S.cross(f_S));
  }
}

void Contact::add_jacobian(const Instant& now, double, Memory m, JacobianSum& out) const {
  if (!active(now)) return;
  const Surface s = surface(now);
  const int A = options_.body, S = options_.surface.body;
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (!t.touching()) continue;
    const Dual N = normal_force_by_depth(t);
    if (N.a <= 0.0) continue;
    // f_S = (F_t, N) and its derivatives with respect to x_S and v_S.
    const Grip g = grip(t, N.a, m.state.subspan(kStatesPerPoint * i, kStatesPerPoint));
    const Vector3 f_S(g.force.x(), g.force.y(), N.a);
    const Vector3 by_N(options_.friction * g.by_cone.x(), options_.friction * g.by_cone.y(), 1.0);
    Matrix3 f_x = Matrix3::Zero(), f_v = Matrix3::Zero();
    f_x.col(2) = -N.v[0] * by_N;
    f_v.col(2) = -N.v[1] * by_N;
    f_x.topLeftCorner<2, 2>() -= k_ * g.by_spring;
    f_v.topLeftCorner<2, 2>() -= c_ * g.by_damper;

    const auto [xA, vA, xS, vS] = seen(t, s, now);
    Matrix36 swing = Matrix36::Zero();
    swing.rightCols<3>() = -cross_matrix(f_S);  // the force turns with the surface
    const Matrix36 f_A = f_x * xA + f_v * vA, f_A_u = f_v * xA;
    const Matrix36 f_Sx = f_x * xS + f_v * vS, f_S_u = f_v * xS;
    const Vector3 F_W = s.R_WS * f_S;
    add_force_jacobian(t.point, now, F_W, A, s.R_WS * f_A, s.R_WS * f_A_u, true, out);
    add_force_jacobian(t.point, now, F_W, S, s.R_WS * (f_Sx + swing), s.R_WS * f_S_u, false, out);

    // On the surface body: force -F_W, moment -x_S x f_S in its frame.
    const Matrix3 arm = cross_matrix(t.x_S), press = cross_matrix(f_S);
    Matrix6 K, C;
    K << -s.R_WS * f_A, -arm * f_A + press * xA;
    C << -s.R_WS * f_A_u, -arm * f_A_u;
    out.add_stiffness(S, A, K);
    out.add_damping(S, A, C);
    K << -s.R_WS * (f_Sx + swing), -arm * f_Sx + press * xS;
    C << -s.R_WS * f_S_u, -arm * f_S_u;
    out.add_stiffness(S, S, K);
    out.add_damping(S, S, C);
  }
}

// Of what the step begins with only the anchors enter the force.
bool Contact::add_history_tangent(const Instant&, const Instant& now, double, Memory m, const BodyChange&,
                                  const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const {
  if (!active(now)) return true;
  const Surface s = surface(now);
  const int A = options_.body, S = options_.surface.body;
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (!t.touching()) continue;
    const double N = normal_force(t, now);
    if (N <= 0.0) continue;
    const int first = kStatesPerPoint * static_cast<int>(i);
    const Grip g = grip(t, N, m.state.subspan(kStatesPerPoint * i, kStatesPerPoint));
    Eigen::Matrix<double, 3, 2> f_S = Eigen::Matrix<double, 3, 2>::Zero();  // by the anchor
    f_S.topRows<2>() = k_ * g.by_spring;
    const Eigen::Matrix<double, 3, 2> F_W = s.R_WS * f_S;
    Eigen::Matrix<double, 6, 2> Q;
    if (A != kWorld) {
      Q = position_jacobian(t.point, now).transpose() * F_W;
      dQ.middleRows<6>(6 * A) += Q.lazyProduct(state.middleRows<2>(first));
    }
    if (S != kWorld) {
      Q << -F_W, -cross_matrix(t.x_S) * f_S;
      dQ.middleRows<6>(6 * S) += Q.lazyProduct(state.middleRows<2>(first));
    }
  }
  return true;
}

bool Contact::advance_state_tangent(const Instant&, const Instant& now, double h, Memory m, const BodyChange&,
                                    const BodyChange& to, Eigen::Ref<MatrixX> state) const {
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    auto rows = state.middleRows<kStatesPerPoint>(kStatesPerPoint * static_cast<int>(i));
    const Touch t = touch(options_.points[i], s, now);
    const bool touching = active(now) && t.touching();
    Dual N(0.0);
    Cut spring;
    if (touching) {
      N = normal_force_by_depth(t);
      const Eigen::Vector2d anchor(m.state[kStatesPerPoint * i + kAnchorX], m.state[kStatesPerPoint * i + kAnchorY]);
      spring = cut(-k_ * (t.x_S.head<2>() - anchor), options_.friction * N.a);
      if (!spring.acts) {
        rows.bottomRows<2>().setZero();  // it sticks
        continue;
      }
    }
    // What the anchor becomes by x_S, by v_S and by what it was: x_S itself, or as far behind as the cone allows.
    Eigen::Matrix<double, 2, 3> by_x = Eigen::Matrix<double, 2, 3>::Identity(),
                                by_v = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Matrix2d by_anchor = Eigen::Matrix2d::Zero();
    if (touching) {
      by_anchor = spring.by_force;
      by_x.leftCols<2>() -= spring.by_force;
      by_x.col(2) = -(options_.friction * N.v[0] / k_) * spring.by_cone;
      by_v.col(2) = -(options_.friction * N.v[1] / k_) * spring.by_cone;
    }
    const auto [xA, vA, xS, vS] = seen(t, s, now);
    const auto add = [&](int body, const Matrix36& x, const Matrix36& v, auto& sum) {
      if (body == kWorld) return;
      const Eigen::Matrix<double, 2, 6> by_xi = by_x * x + by_v * v, by_u = by_v * x;
      sum += by_xi.lazyProduct(to.xi.middleRows<6>(6 * body));
      sum += by_u.lazyProduct(to.u.middleRows<6>(6 * body));
    };
    const Eigen::Matrix<double, 2, Eigen::Dynamic> before = rows.topRows<2>();
    Eigen::Matrix<double, 2, Eigen::Dynamic> anchor = by_anchor.lazyProduct(before);
    add(options_.body, xA, vA, anchor);
    add(options_.surface.body, xS, vS, anchor);
    rows.topRows<2>() = anchor;
    rows.bottomRows<2>().setZero();
    if (touching && h > 0.0) rows.bottomRows<2>() = (anchor - before) / h;
  }
  return true;
}

}  // namespace stillhook
