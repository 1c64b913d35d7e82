// Where a measured run began: the reference state of a lift with one body, and everything jointed to it, displaced and
// moving as a rigid whole, and what that does to the state to first order.
//
//   q = (d in W, r about B's axes, v in W, w in B)      R' = R exp(r)      p_Co' = o + d + R_d (p_C - o)
//
// o the body's origin, R_d = R exp(r) R^T. Changes of a state have 6 rows a body of xi, 6 rows a body of u, then the
// elements' states, as in problems/tangent_run.h.
#pragma once

#include <string>
#include <vector>

#include "sim/multibody/system.h"

namespace stillhook {

inline constexpr int kStartCoordinates = 12;

/// "x" ... "yaw", "vx" ... "wz", in the order of q.
const std::vector<std::string>& start_coordinate_names();
/// Unit of a coordinate of q, SI.
std::string start_coordinate_unit(int coordinate);

class DisplacedStart {
 public:
  DisplacedStart(const MultibodySystem& system, int body);

  using Coordinates = Eigen::Matrix<double, kStartCoordinates, 1>;
  SystemState state(const SystemState& reference, const Coordinates& q) const;
  /// d state / d q, a column a coordinate.
  MatrixX by_coordinates(const SystemState& reference, const Coordinates& q) const;
  /// The change of state() when the reference changes by `change`, whose velocities are taken for zero.
  MatrixX carried(const SystemState& reference, const Coordinates& q, const MatrixX& change) const;

 private:
  Vector3 origin(const SystemState& state) const;

  const MultibodySystem& system_;
  int body_;
  std::vector<int> members_;
};

/// The state changed by delta: positions and rates added, rotations R exp(dtheta).
SystemState moved(const SystemState& state, const Eigen::Ref<const VectorX>& delta);
/// What moved() would have to be given to lead from `from` to `to`.
VectorX difference(const SystemState& from, const SystemState& to);
/// Number of rows of a change of the state.
int change_size(const SystemState& state);

}  // namespace stillhook
