// Springs, dampers and drives in the free coordinate of a joint: derivatives, sign, energy.
#include "sim/multibody/joint_drive.h"

#include <catch2/catch.hpp>

#include "tests/truth/general_motion.h"

using namespace stillhook;
using truth::central_differences;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

constexpr double kStiffness = 7.0, kDamping = 1.3, kRest = 0.2;

// Parent and child that satisfy the joint in position (coordinate s) and in velocity (rate s_dot).
struct Driven {
  std::vector<BodyKinematics> at;
  std::vector<DriveState> drive{{0.35, -0.6}};
  Joint joint;

  Instant now(const std::vector<BodyKinematics>& bodies) const { return {0.0, bodies, drive}; }
  Instant now() const { return now(at); }
};

Driven make_driven(Type type, bool on_world, double s, double s_dot, unsigned seed) {
  GeneralMotion draw(seed);
  Driven d;
  const int parent = on_world ? kWorld : 0, child = on_world ? 0 : 1;
  for (int i = 0; i <= child; ++i) d.at.push_back(draw.body());
  JointSpec spec;
  spec.type = type;
  spec.axis = draw.unit();
  spec.point_on_parent = draw.vector(2);
  spec.point_on_child = draw.vector(2);
  BodyKinematics& c = d.at.back();
  const BodyKinematics p = on_world ? BodyKinematics{} : d.at[0];
  c.p_WC = p.p_WC + p.R_WB * spec.point_on_parent - c.R_WB * spec.point_on_child;  // centres of gravity at the origins
  d.joint = make_joint(spec, parent, child, Vector3::Zero(), Vector3::Zero(), d.now());
  // Move along the free coordinate, then set velocities that agree.
  const Vector3 e1 = d.joint.axis(d.now()), hinge = p.p_WC + p.R_WB * spec.point_on_parent;
  const Vector3 w_P = p.R_WB * p.w_B;
  const bool turns = type == Type::revolute;
  const Matrix3 turn = Eigen::AngleAxisd(turns ? s : 0.0, e1).toRotationMatrix();
  const Vector3 at = turns ? hinge : Vector3(hinge + s * e1);
  c.p_WC = at + turn * (c.p_WC - hinge);
  c.R_WB = turn * c.R_WB;
  const Vector3 w_C = w_P + (turns ? s_dot : 0.0) * e1;
  c.w_B = c.R_WB.transpose() * w_C;
  c.v_WC = p.v_WC + w_P.cross(at - p.p_WC) + w_C.cross(c.p_WC - at);
  if (!turns) c.v_WC += s_dot * e1;
  return d;
}

VectorX force_of(const JointDrive& drive, const Instant& now) {
  ForceSum sum(static_cast<int>(now.body.size()));
  drive.add_forces(now, 0.01, {}, sum);
  return sum.value();
}

VectorX velocities(const std::vector<BodyKinematics>& at) {
  VectorX u(6 * static_cast<int>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) u.segment<6>(6 * i) << at[i].v_WC, at[i].w_B;
  return u;
}

}  // namespace

TEST_CASE("joint drive: K and C against central differences where the joint is satisfied") {
  for (const Type type : {Type::revolute, Type::prismatic})
    for (const bool on_world : {false, true})
      for (unsigned seed = 1; seed < 6; ++seed) {
        const Driven d = make_driven(type, on_world, 0.9, 0.7, seed);
        const JointDrive drive("d", d.joint, kStiffness, kDamping, kRest, 0);
        CAPTURE(static_cast<int>(type), on_world, seed);
        JacobianSum sum(static_cast<int>(d.at.size()));
        drive.add_jacobian(d.now(), 0.01, {}, sum);
        const auto f = [&](const auto& at) { return force_of(drive, d.now(at)); };
        // Forces of size 10 over a step of 1e-5: good to 1e-9.
        CHECK((sum.stiffness() - central_differences(d.at, truth::moved, f)).cwiseAbs().maxCoeff() < 1e-8);
        CHECK((sum.damping() - central_differences(d.at, truth::hastened, f)).cwiseAbs().maxCoeff() < 1e-8);
        CHECK(sum.stiffness().norm() > 1.0);
      }
}

TEST_CASE("joint drive: load, sign, action and reaction, energy") {
  for (const Type type : {Type::revolute, Type::prismatic})
    for (const bool on_world : {false, true})
      for (unsigned seed = 11; seed < 14; ++seed) {
        const double s = 0.9, s_dot = 0.7;
        const Driven d = make_driven(type, on_world, s, s_dot, seed);
        const JointDrive drive("d", d.joint, kStiffness, kDamping, kRest, 0);
        const double stretch = s - kRest - 0.35, rate = s_dot + 0.6, load = -kStiffness * stretch - kDamping * rate;
        double measured = 0.0;
        drive.measure(d.now(), {}, {&measured, 1});
        CHECK(measured == Approx(load));
        CHECK(measured < 0.0);  // stretched and stretching: it pulls back
        const VectorX Q = force_of(drive, d.now());
        const Vector3 e1 = d.joint.axis(d.now());
        const BodyKinematics& c = d.at.back();
        const int row = on_world ? 0 : 6;
        if (type == Type::revolute)
          CHECK((c.R_WB * Q.segment<3>(row + 3) - load * e1).norm() < 1e-12);
        else
          CHECK((Q.segment<3>(row) - load * e1).norm() < 1e-12);
        if (!on_world) {  // no net force, no net moment about the origin
          CHECK((Q.segment<3>(0) + Q.segment<3>(6)).norm() < 1e-12);
          Vector3 moment = Vector3::Zero();
          for (int i = 0; i < 2; ++i)
            moment += d.at[i].p_WC.cross(Q.segment<3>(6 * i)) + d.at[i].R_WB * Q.segment<3>(6 * i + 3);
          CHECK(moment.norm() < 1e-11);
        }
        // Power: given to the bodies + stored + heat = what the drive puts in, load times its rate.
        const double stored_rate = kStiffness * stretch * rate;
        CHECK(drive.potential_energy(d.now(), {}) == Approx(0.5 * kStiffness * stretch * stretch));
        CHECK(drive.dissipated_power(d.now(), {}) == Approx(kDamping * rate * rate));
        CHECK(Q.dot(velocities(d.at)) + stored_rate + kDamping * rate * rate ==
              Approx(load * d.drive[0].rate).epsilon(1e-10));
      }
}

TEST_CASE("joint drive: a hinge may be driven past half a turn") {
  // Coordinates end at pi and begin again at -pi; the spring between commanded and true angle must not notice.
  for (const double s : {3.0, 3.3, 6.0, 9.5, -4.0}) {
    Driven d = make_driven(Type::revolute, false, s, 0.0, 21);
    d.drive[0] = {s - 0.05 - kRest, 0.0};
    const JointDrive drive("d", d.joint, kStiffness, 0.0, kRest, 0);
    double load = 0.0;
    drive.measure(d.now(), {}, {&load, 1});
    CHECK(load == Approx(-kStiffness * 0.05).epsilon(1e-9));
  }
}

TEST_CASE("joint drive: without a drive it is a spring to its rest") {
  const Driven d = make_driven(Type::prismatic, false, 0.9, 0.0, 31);
  const JointDrive drive("d", d.joint, kStiffness, 0.0, kRest, -1);
  double load = 0.0;
  drive.measure(d.now(), {}, {&load, 1});
  CHECK(load == Approx(-kStiffness * (0.9 - kRest)));
  REQUIRE(drive.channels().size() == 1);
  CHECK(drive.channels()[0].unit == "N");
}
