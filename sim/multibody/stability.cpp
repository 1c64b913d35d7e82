#include "sim/multibody/stability.h"

#include <array>
#include <cmath>

namespace stillhook {
namespace {

// 1/s2: a disturbance grows by e in 300 s, no faster than the slowest drift of a mooring; rounding is far below.
constexpr double kUnstable = 1e-5;

// A turn counts as what it moves at the radius of gyration.
int largest_entry(const MultibodySystem& system, const VectorX& xi) {
  int largest = 0;
  double most = -1.0;
  for (int i = 0; i < xi.size(); ++i) {
    const RigidBody& b = system.bodies[static_cast<std::size_t>(i / 6)];
    const double arm = i % 6 < 3 ? 1.0 : std::sqrt(b.inertia.trace() / (3.0 * b.mass));
    if (arm * std::abs(xi[i]) <= most) continue;
    most = arm * std::abs(xi[i]);
    largest = i;
  }
  return largest;
}

}  // namespace

WeakestMotion weakest_motion(const MultibodySystem& system, SystemState& state) {
  const int n = system.coordinates(), m = system.constraints();
  if (m >= n) return {};  // nothing can move
  SystemWorkspace work = system.make_workspace();
  VectorX Q;
  system.forces(state, 0.0, work, Q);
  system.jacobian(state, 0.0, work);
  MatrixX Z = MatrixX::Identity(n, n);
  if (m > 0) {
    MatrixX C_q;
    system.constraint_jacobian(state, C_q);
    const Eigen::HouseholderQR<MatrixX> qr(C_q.transpose());
    Z = MatrixX(qr.householderQ()).rightCols(n - m);
  }
  const MatrixX K = -Z.transpose() * work.jacobian.stiffness() * Z;
  const MatrixX M = Z.transpose() * system.mass(state.phase) * Z;
  if (Eigen::LLT<MatrixX>(0.5 * (K + K.transpose()) + kUnstable * M).info() == Eigen::Success) return {};

  const Eigen::LLT<MatrixX> root(M);
  MatrixX B = root.matrixL().solve(K);
  B = root.matrixL().solve(B.transpose().eval()).transpose().eval();
  const Eigen::EigenSolver<MatrixX> solver(B);
  int least = 0;
  WeakestMotion weakest;
  weakest.stiffness = solver.eigenvalues().real().minCoeff(&least);
  if (weakest.stiffness > -kUnstable) return weakest;
  const VectorX y = root.matrixU().solve(VectorX(solver.eigenvectors().col(least).real()));
  weakest.motion = Z * y;
  int largest = 0;
  weakest.motion.cwiseAbs().maxCoeff(&largest);
  weakest.motion /= weakest.motion[largest];
  return weakest;
}

std::string mover(const MultibodySystem& system, const VectorX& xi) {
  return system.bodies[static_cast<std::size_t>(largest_entry(system, xi) / 6)].name;
}

std::string describe_motion(const MultibodySystem& system, const VectorX& xi) {
  static constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "roll", "pitch", "yaw"};
  const int largest = largest_entry(system, xi);
  return "'" + mover(system, xi) + "' in " + (largest % 6 < 3 && xi[largest] < 0.0 ? "-" : "") + kNames[largest % 6];
}

}  // namespace stillhook
