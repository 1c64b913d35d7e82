#include "tuning/start_state.h"

#include "sim/multibody/assembly.h"

namespace stillhook {

const std::vector<std::string>& start_coordinate_names() {
  static const std::vector<std::string> names = {"x",  "y",  "z",  "roll", "pitch", "yaw",
                                                 "vx", "vy", "vz", "wx",   "wy",    "wz"};
  return names;
}

std::string start_coordinate_unit(int coordinate) {
  static constexpr const char* kUnits[4] = {"m", "rad", "m/s", "rad/s"};
  return kUnits[coordinate / 3];
}

DisplacedStart::DisplacedStart(const MultibodySystem& system, int body) : system_(system), body_(body) {
  const std::vector<bool> jointed = jointed_to(system, body);
  for (std::size_t i = 0; i < jointed.size(); ++i)
    if (jointed[i]) members_.push_back(static_cast<int>(i));
}

Vector3 DisplacedStart::origin(const SystemState& state) const {
  const BodyKinematics& k = state.body[body_];
  return k.p_WC - k.R_WB * system_.bodies[body_].cog;
}

SystemState DisplacedStart::state(const SystemState& reference, const Coordinates& q) const {
  SystemState s = reference;
  const Matrix3 R_WB = reference.body[body_].R_WB;
  const Matrix3 R_d = R_WB * exp_rotation(q.segment<3>(3)) * R_WB.transpose();
  const Vector3 o = origin(reference), w_W = R_d * R_WB * q.segment<3>(9);
  for (const int i : members_) {
    const BodyKinematics& from = reference.body[i];
    BodyKinematics& k = s.body[i];
    const Vector3 arm = R_d * (from.p_WC - o);
    k.R_WB = R_d * from.R_WB;
    k.p_WC = o + q.head<3>() + arm;
    k.v_WC = R_d * from.v_WC + q.segment<3>(6) + w_W.cross(arm);
    k.w_B = from.w_B + k.R_WB.transpose() * w_W;
  }
  return s;
}

MatrixX DisplacedStart::by_coordinates(const SystemState& reference, const Coordinates& q) const {
  const SystemState displaced = state(reference, q);
  const Matrix3 R_after = displaced.body[body_].R_WB, J = right_jacobian(q.segment<3>(3));
  const Vector3 o = origin(reference), w_W = R_after * q.segment<3>(9);
  const int bodies = static_cast<int>(system_.bodies.size());
  MatrixX D = MatrixX::Zero(change_size(reference), kStartCoordinates);
  for (const int i : members_) {
    const BodyKinematics& k = displaced.body[i];
    const Vector3 arm = k.p_WC - (o + q.head<3>());
    const Vector3 carried_velocity = k.v_WC - q.segment<3>(6) - w_W.cross(arm);  // R_d v
    const int xi = 6 * i, u = 6 * bodies + 6 * i;
    const Matrix3 to_body = k.R_WB.transpose(), turn_W = R_after * J;
    D.block<3, 3>(xi, 0).setIdentity();
    D.block<3, 3>(xi, 3) = -cross_matrix(arm) * turn_W;
    D.block<3, 3>(xi + 3, 3) = to_body * turn_W;
    // v = R_d v_0 + v_q + w_W x arm, with w_W = R' w_q turning along.
    D.block<3, 3>(u, 3) = -cross_matrix(carried_velocity) * turn_W + cross_matrix(arm) * cross_matrix(w_W) * turn_W -
                          cross_matrix(w_W) * cross_matrix(arm) * turn_W;
    D.block<3, 3>(u, 6).setIdentity();
    D.block<3, 3>(u, 9) = -cross_matrix(arm) * R_after;
    D.block<3, 3>(u + 3, 9) = to_body * R_after;
  }
  return D;
}

MatrixX DisplacedStart::carried(const SystemState& reference, const Coordinates& q, const MatrixX& change) const {
  const SystemState displaced = state(reference, q);
  const Matrix3 R_WB = reference.body[body_].R_WB, turn = exp_rotation(q.segment<3>(3));
  const Matrix3 R_d = R_WB * turn * R_WB.transpose();
  const Vector3 o = origin(reference), w_W = displaced.body[body_].R_WB * q.segment<3>(9);
  const int bodies = static_cast<int>(system_.bodies.size());
  const Vector3& c = system_.bodies[body_].cog;
  MatrixX out = change;
  out.middleRows(6 * bodies, 6 * bodies).setZero();
  for (Eigen::Index j = 0; j < change.cols(); ++j) {
    const Vector3 turned = change.block<3, 1>(6 * body_ + 3, j);
    const Vector3 of_origin = change.block<3, 1>(6 * body_, j) + R_WB * cross_matrix(c) * turned;
    const Vector3 phi = R_WB * (turned - turn * turned);  // the change of R_d is [phi]x R_d
    const Vector3 spin_change = (R_WB * turned).cross(w_W);  // it stands still in the body
    for (const int i : members_) {
      const BodyKinematics& k = displaced.body[i];
      const Vector3 arm = R_d * (reference.body[i].p_WC - o);
      const Vector3 arm_change = phi.cross(arm) + R_d * (change.block<3, 1>(6 * i, j) - of_origin);
      out.block<3, 1>(6 * i, j) = of_origin + arm_change;
      out.block<3, 1>(6 * i + 3, j) = k.R_WB.transpose() * phi + change.block<3, 1>(6 * i + 3, j);
      const Vector3 turned_i = out.block<3, 1>(6 * i + 3, j), w_B = k.R_WB.transpose() * w_W;
      out.block<3, 1>(6 * bodies + 6 * i, j) = spin_change.cross(arm) + w_W.cross(arm_change);
      out.block<3, 1>(6 * bodies + 6 * i + 3, j) = k.R_WB.transpose() * spin_change - turned_i.cross(w_B);
    }
  }
  return out;
}

int change_size(const SystemState& state) {
  return 12 * static_cast<int>(state.body.size()) + static_cast<int>(state.element_state.size());
}

SystemState moved(const SystemState& state, const Eigen::Ref<const VectorX>& delta) {
  SystemState s = state;
  const int bodies = static_cast<int>(state.body.size());
  for (int i = 0; i < bodies; ++i) {
    BodyKinematics& k = s.body[i];
    k.p_WC += delta.segment<3>(6 * i);
    k.R_WB = k.R_WB * exp_rotation(delta.segment<3>(6 * i + 3));
    k.v_WC += delta.segment<3>(6 * bodies + 6 * i);
    k.w_B += delta.segment<3>(6 * bodies + 6 * i + 3);
  }
  for (std::size_t e = 0; e < s.element_state.size(); ++e)
    s.element_state[e] += delta[12 * bodies + static_cast<Eigen::Index>(e)];
  return s;
}

VectorX difference(const SystemState& from, const SystemState& to) {
  VectorX delta(change_size(from));
  const int bodies = static_cast<int>(from.body.size());
  for (int i = 0; i < bodies; ++i) {
    const BodyKinematics &a = from.body[i], &b = to.body[i];
    delta.segment<3>(6 * i) = b.p_WC - a.p_WC;
    delta.segment<3>(6 * i + 3) = log_rotation(a.R_WB.transpose() * b.R_WB);
    delta.segment<3>(6 * bodies + 6 * i) = b.v_WC - a.v_WC;
    delta.segment<3>(6 * bodies + 6 * i + 3) = b.w_B - a.w_B;
  }
  for (std::size_t e = 0; e < from.element_state.size(); ++e)
    delta[12 * bodies + static_cast<Eigen::Index>(e)] = to.element_state[e] - from.element_state[e];
  return delta;
}

}  // namespace stillhook
