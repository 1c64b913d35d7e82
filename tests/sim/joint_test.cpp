// Joints of every type at general poses: rows, Jacobian, velocity terms, stiffness, coordinate.
#include "sim/multibody/joint.h"

#include <catch2/catch.hpp>

#include "tests/truth/general_motion.h"

using namespace stillhook;
using truth::central_differences;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

// A joint made at one general pose of its two bodies (or world and body).
struct Pair {
  std::vector<BodyKinematics> at;
  Joint joint;
  JointSpec spec;
  Vector3 parent_cog, child_cog;
};

Pair make_pair(Type type, bool on_world, unsigned seed) {
  GeneralMotion draw(seed);
  Pair pair;
  const int parent = on_world ? kWorld : 0, child = on_world ? 0 : 1;
  for (int i = 0; i <= child; ++i) pair.at.push_back(draw.body());
  pair.parent_cog = on_world ? Vector3::Zero() : draw.vector(2);
  pair.child_cog = draw.vector(2);
  pair.spec.type = type;
  pair.spec.axis = 3.0 * draw.unit();
  pair.spec.point_on_parent = draw.vector(4);
  // The child's point at the same place.
  const Instant now{0.0, pair.at, {}};
  const Vector3 p_W =
      motion_of({parent, on_world ? pair.spec.point_on_parent : pair.spec.point_on_parent - pair.parent_cog}, now).p;
  const BodyKinematics& c = pair.at[child];
  pair.spec.point_on_child = c.R_WB.transpose() * (p_W - c.p_WC) + pair.child_cog;
  pair.joint = make_joint(pair.spec, parent, child, pair.parent_cog, pair.child_cog, now);
  return pair;
}

VectorX values_of(const Joint& joint, const std::vector<BodyKinematics>& at) {
  Joint::Rows C;
  joint.values({0.0, at, {}}, C);
  return C.head(joint.rows());
}

MatrixX jacobian_of(const Joint& joint, const std::vector<BodyKinematics>& at) {
  Joint::Block parent, child;
  joint.jacobian({0.0, at, {}}, parent, child);
  MatrixX C_q = MatrixX::Zero(joint.rows(), 6 * static_cast<int>(at.size()));
  if (joint.on_parent.body != kWorld) C_q.middleCols<6>(6 * joint.on_parent.body) += parent.topRows(joint.rows());
  C_q.middleCols<6>(6 * joint.on_child.body) += child.topRows(joint.rows());
  return C_q;
}

VectorX velocity_terms_of(const Joint& joint, const std::vector<BodyKinematics>& at) {
  Joint::Rows gamma;
  joint.quadratic_velocity({0.0, at, {}}, gamma);
  return gamma.head(joint.rows());
}

VectorX velocities(const std::vector<BodyKinematics>& at) {
  VectorX u(6 * static_cast<int>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) u.segment<6>(6 * i) << at[i].v_WC, at[i].w_B;
  return u;
}

// The bodies a time dt later at constant u, and their rows.
VectorX values_after(const Pair& pair, double dt) {
  std::vector<BodyKinematics> later = pair.at;
  const VectorX u = velocities(pair.at);
  for (std::size_t i = 0; i < later.size(); ++i) later[i] = truth::moved(later[i], dt * u.segment<6>(6 * i));
  return values_of(pair.joint, later);
}

// Away from where the joint closes, so that no term is hidden by a zero.
void disturb(Pair& pair, unsigned seed) {
  GeneralMotion draw(seed);
  for (BodyKinematics& b : pair.at) {
    b.p_WC += draw.vector(1.0);
    b.R_WB = b.R_WB * draw.rotation();
  }
}

constexpr Type kTypes[] = {Type::revolute, Type::fixed, Type::spherical, Type::prismatic};

}  // namespace

TEST_CASE("joints have the rows of their kind and close where they are made") {
  const int rows[] = {5, 6, 3, 5};
  for (int k = 0; k < 4; ++k)
    for (const bool on_world : {false, true}) {
      const Pair pair = make_pair(kTypes[k], on_world, 20 + k);
      CHECK(pair.joint.rows() == rows[k]);
      CHECK(values_of(pair.joint, pair.at).norm() < 1e-13);  // rounding at distances of 10 m
      CHECK(pair.joint.coordinate({0.0, pair.at, {}}) == Approx(0.0).margin(1e-14));
    }
}

TEST_CASE("joint Jacobians, velocity terms and stiffness against central differences") {
  for (const Type type : kTypes)
    for (const bool on_world : {false, true})
      for (unsigned seed = 30; seed < 34; ++seed) {
        Pair pair = make_pair(type, on_world, seed);
        disturb(pair, seed + 100);
        const Joint& joint = pair.joint;
        CAPTURE(static_cast<int>(type), on_world, seed);
        // Differences with a step of 1e-5 on rows of size 10 are good to about 1e-9.
        const MatrixX C_q = jacobian_of(joint, pair.at);
        const MatrixX differences =
            central_differences(pair.at, truth::moved, [&](const auto& at) { return values_of(joint, at); });
        CHECK((C_q - differences).cwiseAbs().maxCoeff() < 2e-9);

        // C_q u and (C_q u)_q u are the first and second rates of the rows in motion at constant u.
        const VectorX u = velocities(pair.at);
        const double dt = 1e-5, dt2 = 1e-3;
        CHECK((C_q * u - (values_after(pair, dt) - values_after(pair, -dt)) / (2 * dt)).norm() < 1e-7);
        const VectorX gamma = velocity_terms_of(joint, pair.at);
        const VectorX second =
            (values_after(pair, dt2) - 2.0 * values_of(joint, pair.at) + values_after(pair, -dt2)) / (dt2 * dt2);
        // second difference: dt2^2 / 12 times a fourth rate of up to 500, and 1e-15 / dt2^2
        CHECK((gamma + second).norm() < 2e-4);
        CHECK(gamma.norm() > 0.1);

        // Stiffness of -C_q^T lambda.
        Joint::Rows lambda = Joint::Rows::Zero();
        GeneralMotion draw(seed + 200);
        for (int r = 0; r < joint.rows(); ++r) lambda[r] = draw.number(-3.0, 3.0);
        const VectorX pull = lambda.head(joint.rows());
        JacobianSum sum(static_cast<int>(pair.at.size()));
        joint.add_stiffness({0.0, pair.at, {}}, lambda, sum);
        const MatrixX K = central_differences(
            pair.at, truth::moved, [&](const auto& at) { return VectorX(-jacobian_of(joint, at).transpose() * pull); });
        CHECK((sum.stiffness() - K).cwiseAbs().maxCoeff() < 1e-8);
        CHECK(sum.damping().norm() == 0.0);
      }
}

TEST_CASE("the rows of a revolute joint about y are the paper's Eq. 2") {
  // Cha, Nam & Ha (2018), Eq. 2, backstay (2) and boom (4): r_O2 + R_2 r_O4/O2 - r_O4 = 0, y_4 . x_2 = 0, y_4 . z_2 =
  // 0.
  GeneralMotion draw(40);
  std::vector<BodyKinematics> made(2);
  JointSpec spec;
  spec.type = Type::revolute;
  spec.axis = Vector3::UnitY();
  spec.point_on_parent = draw.vector(3);
  const Vector3 cog2 = draw.vector(1), cog4 = draw.vector(1);
  made[0] = draw.body();
  made[1].R_WB = made[0].R_WB;  // the paper's frames are parallel when the joint angle is zero
  made[1].p_WC = made[0].p_WC + made[0].R_WB * (spec.point_on_parent - cog2 + cog4);  // boom's origin at the joint
  const Joint joint = make_joint(spec, 0, 1, cog2, cog4, {0.0, made, {}});
  const std::vector<BodyKinematics> at{draw.body(), draw.body()};
  const VectorX C = values_of(joint, at);
  const Matrix3 &R2 = at[0].R_WB, &R4 = at[1].R_WB;
  const Vector3 r_O2 = at[0].p_WC - R2 * cog2, r_O4 = at[1].p_WC - R4 * cog4;
  CHECK((C.head<3>() + (r_O2 + R2 * spec.point_on_parent - r_O4)).norm() < 1e-13);  // written child minus parent here
  const double yx = R4.col(1).dot(R2.col(0)), yz = R4.col(1).dot(R2.col(2));
  // e2, e3 are x and z in some order and sign: each row is one of the paper's.
  const bool in_order = std::abs(std::abs(C[3]) - std::abs(yx)) < 1e-14;
  CHECK(std::abs(C[in_order ? 3 : 4]) == Approx(std::abs(yx)).margin(1e-14));
  CHECK(std::abs(C[in_order ? 4 : 3]) == Approx(std::abs(yz)).margin(1e-14));
}

TEST_CASE("a revolute coordinate counts the child's turn about e1, right-handed, over the full circle") {
  for (const bool on_world : {false, true}) {
    const Pair pair = make_pair(Type::revolute, on_world, 50);
    const Vector3 e1 = pair.joint.axis({0.0, pair.at, {}});
    const Vector3 expected = pair.spec.axis.normalized();
    CHECK((e1 - (on_world ? expected : Vector3(pair.at[0].R_WB * expected))).norm() < 1e-14);
    for (const double angle : {-3.1, -1.0, 0.4, 3.1}) {
      std::vector<BodyKinematics> turned = pair.at;
      BodyKinematics& child = turned.back();
      const Matrix3 turn = Eigen::AngleAxisd(angle, e1).toRotationMatrix();
      const Vector3 hinge = motion_of(pair.joint.on_child, {0.0, pair.at, {}}).p;
      child.R_WB = turn * child.R_WB;
      child.p_WC = hinge + turn * (child.p_WC - hinge);
      CHECK(pair.joint.coordinate({0.0, turned, {}}) == Approx(angle).margin(1e-13));
      CHECK(values_of(pair.joint, turned).norm() < 1e-13);
    }
  }
}

TEST_CASE("a prismatic coordinate is the child's travel along e1") {
  const Pair pair = make_pair(Type::prismatic, false, 60);
  std::vector<BodyKinematics> slid = pair.at;
  const Vector3 e1 = pair.joint.axis({0.0, pair.at, {}});
  slid[1].p_WC += 1.75 * e1;
  CHECK(pair.joint.coordinate({0.0, slid, {}}) == Approx(1.75));
  CHECK(values_of(pair.joint, slid).norm() < 1e-13);
}

TEST_CASE("coordinate_rate is the rate of the coordinate on motions that the joint allows") {
  for (const Type type : {Type::revolute, Type::prismatic})
    for (const bool on_world : {false, true}) {
      Pair pair = make_pair(type, on_world, 70);
      // Velocities made allowable: the child moves with the parent, and along the free coordinate at rate 0.8.
      const Instant now{0.0, pair.at, {}};
      BodyKinematics& child = pair.at.back();
      const Vector3 e1 = pair.joint.axis(now);
      const BodyKinematics parent = on_world ? BodyKinematics{} : pair.at[0];
      const Vector3 w_P = parent.R_WB * parent.w_B, hinge = motion_of(pair.joint.on_child, now).p;
      const bool turns = type == Type::revolute;
      const Vector3 w_C = w_P + (turns ? 0.8 : 0.0) * e1;
      child.w_B = child.R_WB.transpose() * w_C;
      child.v_WC = parent.v_WC + w_P.cross(hinge - parent.p_WC) + w_C.cross(child.p_WC - hinge);
      if (!turns) child.v_WC += 0.8 * e1;
      CHECK(pair.joint.coordinate_rate(now) == Approx(0.8));
      const double dt = 1e-5;
      const auto coordinate_after = [&](double t) {
        std::vector<BodyKinematics> later = pair.at;
        const VectorX u = velocities(pair.at);
        for (std::size_t i = 0; i < later.size(); ++i) later[i] = truth::moved(later[i], t * u.segment<6>(6 * i));
        return pair.joint.coordinate({0.0, later, {}});
      };
      // central difference: 1e-5 squared and 1e-15 / 1e-5
      CHECK((coordinate_after(dt) - coordinate_after(-dt)) / (2 * dt) == Approx(0.8).epsilon(1e-8));
    }
}

namespace {

// A frame that moves and turns in all directions: p, and R = exp(phi(t)) of a rotation vector, with rates by hand from
// R alone (differences), so that nothing of the library's kinematics is used.
class Wandering final : public PrescribedMotion {
 public:
  static Matrix3 R(double t) {
    return exp_rotation(Vector3(0.4, -0.2, 0.7) + Vector3(0.3 * std::sin(1.3 * t), 0.5 * t, 0.2 * std::cos(0.7 * t)));
  }
  static Vector3 p(double t) { return {std::sin(0.8 * t), 2.0 + 0.3 * t * t, -1.0 + std::cos(1.1 * t)}; }
  static Vector3 spin(double t) {
    constexpr double d = 1e-4;  // error d^2/6 of third derivatives of order 1: 2e-9
    const Matrix3 W = (R(t + d) - R(t - d)) / (2.0 * d) * R(t).transpose();
    return {0.5 * (W(2, 1) - W(1, 2)), 0.5 * (W(0, 2) - W(2, 0)), 0.5 * (W(1, 0) - W(0, 1))};
  }
  FrameMotion at(double t) const override {
    constexpr double d = 1e-3;  // of second differences: rounding 1e-16/d^2 = 1e-10, error d^2/12 = 1e-7
    FrameMotion F;
    F.R = R(t);
    F.p = p(t);
    F.v = {0.8 * std::cos(0.8 * t), 0.6 * t, -1.1 * std::sin(1.1 * t)};
    F.a = {-0.64 * std::sin(0.8 * t), 0.6, -1.21 * std::cos(1.1 * t)};
    F.w = spin(t);
    F.w_dot = (spin(t + d) - spin(t - d)) / (2.0 * d);
    return F;
  }
  bool same_as(const PrescribedMotion&) const override { return false; }
};

}  // namespace

TEST_CASE("a joint to a frame that moves by itself: rates of its rows are those of their values over time") {
  for (const Type type : {Type::revolute, Type::spherical, Type::fixed, Type::prismatic}) {
    CAPTURE(static_cast<int>(type));
    Pair pair = make_pair(type, true, 17);
    pair.joint.motion = std::make_shared<const Wandering>();
    disturb(pair, 23);
    const double t0 = 0.6;
    const auto values = [&](double dt, bool child_moves) {
      std::vector<BodyKinematics> later = pair.at;
      const VectorX u = velocities(pair.at);
      if (child_moves)
        for (std::size_t i = 0; i < later.size(); ++i) later[i] = truth::moved(later[i], dt * u.segment<6>(6 * i));
      Joint::Rows C = Joint::Rows::Zero();
      pair.joint.values({t0 + dt, later, {}}, C);
      return VectorX(C.head(pair.joint.rows()));
    };
    const Instant now{t0, pair.at, {}};
    Joint::Rows drift, gamma;
    pair.joint.drift(now, drift);
    pair.joint.quadratic_velocity(now, gamma);
    const double d = 1e-4;
    const VectorX rate = (values(d, false) - values(-d, false)) / (2.0 * d);
    // The square of the step on rows of size 10, and the spin's own 2e-9: 1e-7.
    CHECK((drift.head(pair.joint.rows()) - rate).norm() < 1e-6);
    // At constant u: C'' = C_q u' + ... = -gamma.
    const double e = 1e-3;
    const VectorX curvature = (values(e, true) - 2.0 * values(0.0, true) + values(-e, true)) / (e * e);
    // e^2 / 12 times a fourth rate of up to 500, and 1e-15 / e^2.
    CHECK((gamma.head(pair.joint.rows()) + curvature).norm() < 2e-4);
    // And at rest in time the child's rows are what they were.
    Joint::Block parent, child;
    pair.joint.jacobian(now, parent, child);
    const double s = 1e-5;
    for (int k = 0; k < 6; ++k) {
      std::vector<BodyKinematics> there = pair.at, back = pair.at;
      there[0] = truth::moved(there[0], Vector6::Unit(k) * s);
      back[0] = truth::moved(back[0], Vector6::Unit(k) * -s);
      Joint::Rows up = Joint::Rows::Zero(), down = Joint::Rows::Zero();
      pair.joint.values({t0, there, {}}, up);
      pair.joint.values({t0, back, {}}, down);
      CHECK((child.col(k).head(pair.joint.rows()) - (up - down).head(pair.joint.rows()) / (2.0 * s)).norm() < 1e-8);
    }
  }
}
