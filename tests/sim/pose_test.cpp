// Rotations: exponential, logarithm, right Jacobian, Euler angles.
#include "sim/spatial/pose.h"

#include <catch2/catch.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include "tests/truth/general_motion.h"

using namespace stillhook;
using truth::GeneralMotion;

TEST_CASE("exp_rotation is the matrix exponential and a rotation") {
  GeneralMotion draw(11);
  // Down to 1e-9 rad: below 1e-4 the series takes over, both sides of the change are visited.
  for (const double size : {1e-9, 0.9e-4, 1.1e-4, 0.01, 1.0, 3.1, 6.0}) {
    const Vector3 phi = size * draw.unit();
    const Matrix3 R = exp_rotation(phi), expected = cross_matrix(phi).exp();
    CHECK((R - expected).norm() < 2e-14);  // rounding of a dozen operations
    CHECK((R.transpose() * R - Matrix3::Identity()).norm() < 1e-14);
    CHECK(R.determinant() == Approx(1.0).margin(1e-14));
  }
  // Sign: a positive turn about z brings x to y.
  CHECK((exp_rotation({0, 0, M_PI / 2}) * Vector3::UnitX() - Vector3::UnitY()).norm() < 1e-15);
}

TEST_CASE("log_rotation inverts exp_rotation below half a turn") {
  GeneralMotion draw(12);
  for (const double size : {1e-10, 1e-6, 1e-3, 0.5, 2.0, 3.0, 3.14159}) {
    const Vector3 phi = size * draw.unit();
    // Rounding of R, 1e-16; near half a turn the axis and angle keep it to within a small factor.
    CHECK((log_rotation(exp_rotation(phi)) - phi).norm() < 2e-14);
  }
  CHECK(log_rotation(Matrix3::Identity()).norm() == 0.0);
}

TEST_CASE("right_jacobian is the derivative of the exponential") {
  GeneralMotion draw(13);
  const double step = 1e-6;
  for (const double size : {1e-6, 0.9e-4, 1.1e-4, 0.3, 2.0, 5.0}) {
    const Vector3 phi = size * draw.unit();
    const Matrix3 J = right_jacobian(phi);
    for (int k = 0; k < 3; ++k) {
      const Vector3 d = step * Vector3::Unit(k);
      const Matrix3 dR = (cross_matrix(phi + d).exp() - cross_matrix(phi - d).exp()) / (2.0 * step);
      // exp(-phi) d(exp(phi)) = [J d]x; a central difference of step 1e-6 is good to 1e-10
      CHECK((exp_rotation(phi).transpose() * dR - cross_matrix(J.col(k))).norm() < 1e-9);
    }
  }
}

TEST_CASE("Euler angles make the round trip and have the signs of the conventions") {
  GeneralMotion draw(14);
  for (int i = 0; i < 50; ++i) {
    const RollPitchYaw a{draw.number(-3.1, 3.1), draw.number(-1.5, 1.5), draw.number(-3.1, 3.1)};
    const RollPitchYaw b = roll_pitch_yaw(rotation_from(a));
    // cos(1.5 rad) = 0.07 magnifies rounding 14 times.
    CHECK(b.roll == Approx(a.roll).margin(1e-13));
    CHECK(b.pitch == Approx(a.pitch).margin(1e-13));
    CHECK(b.yaw == Approx(a.yaw).margin(1e-13));
  }
  CHECK((rotation_from({0.1, 0, 0}) * Vector3::UnitY()).z() > 0.0);  // roll+: port side up
  CHECK((rotation_from({0, 0.1, 0}) * Vector3::UnitX()).z() < 0.0);  // pitch+: bow down
  CHECK((rotation_from({0, 0, 0.1}) * Vector3::UnitX()).y() > 0.0);  // yaw+: bow to port
  // The order of the turns, typed out: R = Rz Ry Rx.
  const double f = 0.4, t = -0.7, p = 1.9;
  const Matrix3 R = rotation_from({f, t, p});
  CHECK(R(0, 0) == Approx(std::cos(p) * std::cos(t)));
  CHECK(R(2, 1) == Approx(std::cos(t) * std::sin(f)));
  CHECK(R(0, 1) == Approx(std::cos(p) * std::sin(t) * std::sin(f) - std::sin(p) * std::cos(f)));
}

TEST_CASE("Euler angles near the singular pitch still give the same rotation") {
  for (const double sign : {1.0, -1.0})
    for (const double gap : {1e-3, 1e-7, 1e-10, 0.0}) {
      const Matrix3 R = rotation_from({0.3, sign * (M_PI / 2 - gap), -1.1});
      const RollPitchYaw a = roll_pitch_yaw(R);
      CHECK(std::isfinite(a.roll + a.pitch + a.yaw));
      // At the singularity (taken from 1e-9 on) roll is given to yaw, which moves R by no more than that gap.
      CHECK((rotation_from(a) - R).norm() < 3e-9);
      if (gap == 0.0) CHECK(a.roll == 0.0);
      CHECK(a.pitch == Approx(sign * M_PI / 2).margin(2e-3));
    }
}

TEST_CASE("poses compose, invert and act as their letters say") {
  GeneralMotion draw(15);
  const Pose X_AB{draw.rotation(), draw.vector(7)}, X_BC{draw.rotation(), draw.vector(3)};
  const Vector3 p_C = draw.vector(2);
  CHECK(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm() < 1e-14);
  CHECK((X_AB.inverse() * (X_AB * p_C) - p_C).norm() < 1e-14);
}

TEST_CASE("orthonormalised removes drift to second order and leaves a rotation alone") {
  GeneralMotion draw(16);
  const Matrix3 R = draw.rotation();
  CHECK((orthonormalised(R) - R).norm() < 1e-15);
  const Matrix3 drifted = R + 1e-6 * Matrix3::Ones();
  const Matrix3 back = orthonormalised(drifted);
  CHECK((back.transpose() * back - Matrix3::Identity()).norm() < 1e-10);  // a few (1e-6)^2
  CHECK((back - R).norm() < 3e-6);
}

TEST_CASE("heading_rotation keeps the yaw alone") {
  const Matrix3 H = heading_rotation(rotation_from({0.4, -0.6, 2.2}));
  CHECK((H - rotation_from({0, 0, 2.2})).norm() < 1e-14);
}
