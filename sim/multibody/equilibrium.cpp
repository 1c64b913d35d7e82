#include "sim/multibody/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kForceTolerance = 1e-9;  // out-of-balance force over the largest weight
// Then it is polished while each iteration takes away this factor, down to rounding: derivatives of an equilibrium are
// differences of two of them.
constexpr double kPolish = 0.2;
constexpr double kSmallestShift = 1e-6;  // 1/s2, against (0.09 rad/s)^2 = 8e-3 of a slow mooring mode
constexpr double kLargestShift = 20.0;   // 1/s2, above the frequencies of a lift as a whole
constexpr double kLargestMove = 3.0;     // m a step
constexpr double kLargestTurn = 0.1;     // rad a step

// What the element exerts at rest.
const VectorX& static_force(const MultibodySystem& system, int element, SystemState& state, SystemWorkspace& work) {
  work.forces.clear();
  system.elements[static_cast<std::size_t>(element)]->add_forces(state.instant(), 0.0,
                                                                 system.memory(element, state, work), work.forces);
  return work.forces.value();
}

}  // namespace

void move_bodies(SystemState& state, const VectorX& xi) {
  for (std::size_t i = 0; i < state.body.size(); ++i) {
    state.body[i].p_WC += xi.segment<3>(6 * i);
    state.body[i].R_WB = orthonormalised(state.body[i].R_WB * exp_rotation(xi.segment<3>(6 * i + 3)));
  }
}

double limit_motion(VectorX& xi) {
  double factor = 1.0;
  for (int i = 0; i < xi.size(); i += 6) {
    factor = std::min(factor, kLargestMove / std::max(kLargestMove, xi.segment<3>(i).norm()));
    factor = std::min(factor, kLargestTurn / std::max(kLargestTurn, xi.segment<3>(i + 3).norm()));
  }
  xi *= factor;
  return factor;
}

BalanceMeasure::BalanceMeasure(const MultibodySystem& system) : system_(system), scale_(system.coordinates()) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const RigidBody& b = system.bodies[i];
    weight_ = std::max(weight_, b.mass * std::max(system.gravity, 1e-3));
    scale_.segment<3>(6 * i).setOnes();
    scale_.segment<3>(6 * i + 3).setConstant(1.0 / std::max(1e-3, std::sqrt(b.inertia.trace() / (3.0 * b.mass))));
  }
}

double BalanceMeasure::out_of_balance(const VectorX& Q, const MatrixX& C_q, const VectorX& lambda,
                                      std::string& worst_body) const {
  const VectorX forces = (Q - C_q.transpose() * lambda).cwiseProduct(scale_) / weight_;
  int worst = 0;
  const double largest = forces.cwiseAbs().maxCoeff(&worst);
  worst_body = system_.bodies[static_cast<std::size_t>(worst / 6)].name;
  return largest;
}

bool same_statics(const MultibodySystem& a, const MultibodySystem& b, const SystemState& at) {
  if (a.gravity != b.gravity || a.bodies.size() != b.bodies.size() || a.joints.size() != b.joints.size() ||
      a.elements.size() > b.elements.size())
    return false;
  for (std::size_t i = 0; i < a.bodies.size(); ++i)
    if (a.bodies[i].mass != b.bodies[i].mass || a.bodies[i].cog != b.bodies[i].cog) return false;
  const Instant now = at.instant();
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    Joint::Rows rows_a, rows_b;
    a.joints[j].values(now, rows_a);
    b.joints[j].values(now, rows_b);
    const int rows = a.joints[j].rows();
    if (rows != b.joints[j].rows() || rows_a.head(rows) != rows_b.head(rows) ||
        a.joints[j].coordinate(now) != b.joints[j].coordinate(now))
      return false;
  }
  SystemState state = at;
  SystemWorkspace work_a = a.make_workspace(), work_b = b.make_workspace();
  for (std::size_t k = 0; k < a.elements.size(); ++k) {
    const ForceElement &p = *a.elements[k], &q = *b.elements[k];
    if (&p == &q || p.same_as(q)) continue;
    const int e = static_cast<int>(k);
    if (p.state_size() != q.state_size() || static_force(a, e, state, work_a) != static_force(b, e, state, work_b))
      return false;
  }
  return true;
}

EquilibriumReport solve_equilibrium(const MultibodySystem& system, SystemState& state, bool close_to_it,
                                    int max_iterations) {
  const int n = system.coordinates(), m = system.constraints();
  SystemWorkspace work = system.make_workspace();
  for (BodyKinematics& b : state.body) b.v_WC = b.w_B = Vector3::Zero();
  for (DriveState& d : state.drive) d.rate = 0.0;
  state.acceleration = VectorX::Zero(n);
  if (state.lambda.size() != m) state.lambda = VectorX::Zero(m);

  const BalanceMeasure measure(system);
  const double lambda_scale = system.mass().trace() / std::max(1, n);

  EquilibriumReport report;
  MatrixX A(n + m, n + m), C_q;
  VectorX Q(n), C, b(n + m);
  double shift = close_to_it ? kSmallestShift : 1.0, last = -1.0, polished = 0.0;
  if (static_cast<int>(state.element_state.size()) != system.element_state_size()) system.start_elements(state, work);
  for (report.iterations = 0; report.iterations < max_iterations; ++report.iterations) {
    system.forces(state, 0.0, work, Q);
    system.constraint_jacobian(state, C_q);
    system.constraint_values(state, C);
    report.residual = measure.out_of_balance(Q, C_q, state.lambda, report.worst_body);
    if (!std::isfinite(report.residual)) return report;
    const double gap = m > 0 ? C.cwiseAbs().maxCoeff() : 0.0;
    const bool close = report.residual < kForceTolerance && gap < 1e-10;
    if (close && report.converged && !(report.residual < kPolish * polished)) {
      system.settle_elements(state, work);
      return report;
    }
    if (close) {
      report.converged = true;
      polished = report.residual;
    }
    const double size = report.residual + gap;
    // Rising faster than it falls, the shift leaves every cycle between two sides of a kink.
    if (last > 0.0)
      shift =
          std::clamp(shift * (size < last ? std::clamp(size / last, 0.1, 0.5) : 6.0), kSmallestShift, kLargestShift);
    last = size;

    system.jacobian(state, 0.0, work);
    A.topLeftCorner(n, n) = shift * system.mass() - work.jacobian.stiffness();
    A.topRightCorner(n, m) = lambda_scale * C_q.transpose();
    A.bottomLeftCorner(m, n) = lambda_scale * C_q;
    A.bottomRightCorner(m, m).setZero();
    b << Q, -lambda_scale * C;
    const VectorX x = A.partialPivLu().solve(b);
    if (!x.allFinite()) return report;
    VectorX xi = x.head(n);
    const double factor = limit_motion(xi);
    move_bodies(state, xi);
    state.lambda += factor * (lambda_scale * x.tail(m) - state.lambda);
  }
  return report;
}

double assemble_joints(const MultibodySystem& system, SystemState& state, std::string& joint) {
  double worst = 0.0;
  VectorX C;
  MatrixX C_q;
  for (int k = 0; k < 20; ++k) {
    system.constraint_values(state, C);
    int row = 0;
    worst = C.size() ? C.cwiseAbs().maxCoeff(&row) : 0.0;
    if (C.size()) joint = system.row_joint(row);
    if (worst < 1e-12) break;
    system.constraint_jacobian(state, C_q);
    VectorX xi = -C_q.completeOrthogonalDecomposition().solve(C);
    limit_motion(xi);
    move_bodies(state, xi);
  }
  return worst;
}

}  // namespace stillhook
