// Hilber-Hughes-Taylor integration of the index-3 equations of motion, with the rotation advanced on the group.
//
//   M a1/(1+al) - F1 + al/(1+al) F0 = 0,   F = Q - h - C_q^T lambda          C(q1)/(beta dt^2) = 0
//   p1 = p0 + dt v0 + dt^2 ((1/2 - beta) a0 + beta a1)       v1 = v0 + dt ((1 - gamma) a0 + gamma a1)
//   R1 = R0 exp(dt w0 + dt^2 ((1/2 - beta) w0' + beta w1'))  gamma = 1/2 - al, beta = (1 - al)^2 / 4, -1/3 <= al <= 0
//
// Hilber, Hughes & Taylor (1977); Negrut, Rampalli, Ottarsson & Sajdak (2007) for the index-3 form; Bruls & Cardona
// (2010) for the update of rotations. Unknowns of Newton's method are a1 and lambda1; its matrix is assembled from the
// elements' own derivatives and its factorisation is kept while it converges fast.
//
// The method's a_n is the acceleration at t_n + al h, not at t_n (Jay & Negrut 2007): a run that starts with the
// acceleration at t_0, or changes h, without moving it there loses the second order of the multipliers. start() and
// step() move it with the rate of the acceleration. lambda_n belongs to t_n. What is left of a start (a first-order
// share of the multipliers, because velocities settle h^2 away from C_q u = 0) dies out by (1 + al)/(1 - al) a step.
#pragma once

#include <array>

#include "sim/multibody/system.h"

namespace stillhook {

struct HhtOptions {
  double alpha = -0.1;  // in [-1/3, 0]; 0 is the trapezoidal rule, -1/3 damps most. With joints below 0: an error in
                        // a multiplier shrinks by (1 + al)/(1 - al) a step, and grows at 0 (Cardona & Geradin 1989)
  double tolerance = 1e-6;  // Newton: share of g (and of g per m) that a further iteration would still change any
                            // acceleration; one in m would let the error grow with 1/dt^2
  int max_iterations = 12;  // Newton, per attempt
};

class HhtStepper {
 public:
  HhtStepper(const MultibodySystem& system, const HhtOptions& options);

  /// Prepares for a state: accelerations and multipliers that satisfy the equations of motion (Eq. 3) at it, so that
  /// a run may start in motion. The elements' states must have been started.
  void start(SystemState& state);

  /// One step of length h to state.t + h, where the drives stand at `drives`. On failure the state is as before and
  /// failed_body() is the index of the body whose iterate moved most or whose forces are not finite. Allocates nothing
  /// after the first step. The state must be the one that start() or the last step left.
  bool step(SystemState& state, double h, std::span<const DriveState> drives);

  int failed_body() const { return failed_body_; }
  long residuals() const { return residuals_; }
  long factorisations() const { return factorisations_; }
  SystemWorkspace& workspace() { return work_; }

 private:
  friend class HhtTangent;
  // When the matrix of Newton's method is made anew: not at all, at the predicted state, in every iteration.
  enum class Renew { never, once, always };

  void solve_motion(SystemState& state, VectorX& acceleration, VectorX& lambda, VectorX& F);
  void follow_mass(SystemState& state);
  void predict(const SystemState& from, double h);
  void choose_prediction(const SystemState& from, double h);
  void apply(const SystemState& from, double h);
  bool residual(double h);
  void factorise(double h);
  bool multipliers_settled(double left) const;
  bool iterate(const SystemState& from, double h, Renew renew);
  bool converge(const SystemState& from, double h);

  const MultibodySystem& system_;
  HhtOptions options_;
  double beta_, gamma_, lambda_scale_;
  double least_lambda_ = 0.0;  // N: the weight of the heaviest body on a joint; multipliers are right to a share of it
  const MatrixX* mass_ = nullptr;  // of the phase
  SystemWorkspace work_;
  SystemState next_;
  VectorX F0_, F1_, C_, r_, delta_;  // F0_ belongs to the state reached by the last step
  VectorX a0_, jerk_;                // a0_ belongs to t + al h of this step; jerk_ is its rate over the last one
  MatrixX C_q_, J_;
  std::vector<Vector3> turn_;  // rotation increment of each body over the step
  Eigen::PartialPivLU<MatrixX> lu_;
  double factorised_h_ = 0.0, rate_ = 1.0;
  double last_h_ = 0.0;  // the step that state.acceleration comes from; 0 after start()
  double reach_ = 1.0;   // largest coordinate of a body, m
  // Differences of accelerations and multipliers over the last step and the one before, and how many of them the
  // prediction of the next step takes: as many as would have predicted the last one best.
  struct Differences {
    VectorX acceleration, lambda;
  };
  std::array<Differences, 2> differences_;
  int known_differences_ = 0, prediction_order_ = 0, multiplier_order_ = 0;
  double differences_h_ = 0.0;  // s, the step that they belong to
  bool started_ = false;
  int failed_body_ = -1;
  long residuals_ = 0, factorisations_ = 0;
};

}  // namespace stillhook
