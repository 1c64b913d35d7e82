// The tangent of a run against a discrete adjoint of the same steps.
//
// The adjoint is written here from the equations of hht.h: the step is linearised as
//
//   J (a1, lambda1)' = rhs(x0', p'),  x1' = what the updates and the elements' histories make of x0' and a1'
//   x = (xi, u, a, F0, s)             s  the elements' states
//
// and run backwards with transposed matrices and one transposed solve a step, from the weights that a functional of the
// trajectory gives to every state. It shares with the tangent the elements' own derivatives, the constraint Jacobian
// and the pairs of lifts that a parameter stands for, and nothing of its propagation: not the assembly of the
// right-hand sides, not the predictor, not the columns that wake up, not the stepper's matrix. So it checks the
// recursion; that the elements' derivatives are right is checked by the suite of force elements, and the whole by
// differences of runs (tangent_run_test.cpp). The tangent's start and first step, which moves the acceleration to t +
// alpha h, are taken over, and phases with their timing are left out: the drives follow a function of time that is
// given here.
#include <catch2/catch.hpp>

#include <cmath>

#include "problems/case.h"
#include "sim/model.h"
#include "sim/multibody/hht_tangent.h"

namespace stillhook {
namespace {

constexpr double kStep = 0.05, kAlpha = -0.1;
constexpr double kBeta = (1.0 - kAlpha) * (1.0 - kAlpha) / 4.0, kGamma = 0.5 - kAlpha;
constexpr double kNow = 1.0 / (1.0 + kAlpha), kPast = kAlpha / (1.0 + kAlpha);
constexpr int kSteps = 400;
const std::string kHoistSpeed = "speed of the hoist";

struct Parameter {
  std::string name;
  std::array<std::shared_ptr<const Model>, 2> side;
  double width = 1.0;
};

// Hauls in smoothly, p times a function of time.
std::vector<DriveState> drives_at(double t, double p) {
  return {{p * (t - 2.0 * std::sin(0.5 * t)), p * (1.0 - std::cos(0.5 * t))}};
}
constexpr double kHaul = 0.1;  // m/s

// The functional: sum over the steps of weight . (xi, u) and of weight . lambda at the step's end.
VectorX weight_at(int step, int rows) {
  VectorX w(rows);
  for (int i = 0; i < rows; ++i) w[i] = std::cos(0.7 * i + 0.13 * step);
  return w;
}

class Adjoint {
 public:
  Adjoint(const MultibodySystem& system, const std::vector<Parameter>& parameters)
      : system_(system), parameters_(parameters), work_(system.make_workspace()), n_(system.coordinates()) {
    xi_ = u_ = a_ = F_ = VectorX::Zero(n_);
    s_ = VectorX::Zero(system.element_state_size());
    sum_ = VectorX::Zero(static_cast<Eigen::Index>(parameters.size()));
  }

  // Back over the step from `before` to `after`, the functional's weights at whose end are w.
  void back(const SystemState& before, const SystemState& after, const VectorX& w, const VectorX& w_lambda) {
    const double h = kStep;
    linearise(before, after);
    const int states = static_cast<int>(s_.size());
    const MatrixX& M = system_.mass(after.phase);
    const MatrixX &K = work_.jacobian.stiffness(), &C = work_.jacobian.damping();
    xi_ += w.head(n_);
    u_ += w.tail(n_);
    VectorX xi = S_from_.leftCols(n_).transpose() * s_, u = S_from_.rightCols(n_).transpose() * s_;
    xi_ += S_to_.leftCols(n_).transpose() * s_;
    u_ += S_to_.rightCols(n_).transpose() * s_;
    VectorX s = S_states_.transpose() * s_;
    VectorX F = kPast * F_;
    const VectorX at_G = G_.transpose() * xi_;
    VectorX a = h * (1.0 - kGamma) * u_ + h * h * (0.5 - kBeta) * at_G;
    const VectorX a1 = a_ + kNow * (M * F_) + h * kGamma * u_ + h * h * kBeta * at_G;
    xi += P_.transpose() * xi_;
    u += u_ + h * at_G;

    const int m = system_.constraints();
    // Constraint rows and multipliers are brought to the size of the masses.
    const double scale = M.trace() / n_;
    MatrixX J = MatrixX::Zero(n_ + m, n_ + m);
    J.topLeftCorner(n_, n_) = kNow * M - h * kGamma * C - h * h * kBeta * (K * G_);
    J.topRightCorner(n_, m) = scale * C_q_.transpose();
    J.bottomLeftCorner(m, n_) = scale * (C_q_ * G_);
    VectorX rhs(n_ + m);
    rhs << a1, scale * w_lambda;
    const VectorX y = J.transpose().partialPivLu().solve(rhs);
    const VectorX mu = y.head(n_), nu = scale / (h * h * kBeta) * y.tail(m);

    for (std::size_t j = 0; j < parameters_.size(); ++j) inject(j, before, after, mu, F_);
    const VectorX q = K.transpose() * mu - C_q_.transpose() * nu, r = C.transpose() * mu, at_q = G_.transpose() * q;
    xi += P_.transpose() * q + H_from_.leftCols(n_).transpose() * mu;
    u += h * at_q + r + H_from_.rightCols(n_).transpose() * mu;
    a += h * h * (0.5 - kBeta) * at_q + h * (1.0 - kGamma) * r;
    if (states > 0) s += H_states_.transpose() * mu;
    F -= kPast * mu;
    xi_ = xi, u_ = u, a_ = a, F_ = F, s_ = s;
  }

  /// The derivative of the functional by parameter j, with the tangent of the state that the first step back ended in.
  double total(std::size_t j, const StateTangent& x, int column) const {
    double sum = sum_[static_cast<Eigen::Index>(j)];
    if (column < 0) return sum;
    return sum + xi_.dot(x.body.xi.col(column)) + u_.dot(x.body.u.col(column)) + a_.dot(x.acceleration.col(column)) +
           F_.dot(x.F0.col(column)) + s_.dot(x.element_state.col(column));
  }

 private:
  void linearise(const SystemState& before, const SystemState& after) {
    SystemState middle = after;  // the memories belong to the step's beginning
    middle.element_state = before.element_state;
    SystemState begun = before;
    system_.begin_step(begun, kStep, work_);
    system_.jacobian(middle, kStep, work_);
    system_.constraint_jacobian(after, C_q_);
    P_ = G_ = MatrixX::Identity(n_, n_);
    for (std::size_t i = 0; i < before.body.size(); ++i) {
      const Matrix3 turn = before.body[i].R_WB.transpose() * after.body[i].R_WB;
      const int r = 6 * static_cast<int>(i) + 3;
      P_.block<3, 3>(r, r) = turn.transpose();
      G_.block<3, 3>(r, r) = right_jacobian(log_rotation(turn));
    }
    const int states = static_cast<int>(s_.size());
    H_from_ = MatrixX::Zero(n_, 2 * n_);
    H_states_ = MatrixX::Zero(n_, states);
    S_from_ = S_to_ = MatrixX::Zero(states, 2 * n_);
    S_states_ = MatrixX::Zero(states, states);
    for (std::size_t k = 0; k < system_.elements.size(); ++k) elements_of_step(static_cast<int>(k), before, middle);
  }

  // Every coordinate of the beginning, every coordinate of the end, every state moved by one.
  void elements_of_step(int e, const SystemState& before, SystemState& middle) {
    const ForceElement& element = *system_.elements[e];
    if (!element.has_history()) return;
    const int first = system_.state_offset(e), count = element.state_size(), all = 4 * n_ + count;
    BodyChange from{MatrixX::Zero(n_, all), MatrixX::Zero(n_, all)}, to = from;
    from.xi.leftCols(n_).setIdentity();
    from.u.middleCols(n_, n_).setIdentity();
    to.xi.middleCols(2 * n_, n_).setIdentity();
    to.u.middleCols(3 * n_, n_).setIdentity();
    MatrixX dQ = MatrixX::Zero(n_, all), state = MatrixX::Zero(count, all);
    state.rightCols(count).setIdentity();
    const Memory m = system_.memory(e, middle, work_);
    REQUIRE(element.add_history_tangent(before.instant(), middle.instant(), kStep, m, from, state, dQ));
    REQUIRE(element.advance_state_tangent(before.instant(), middle.instant(), kStep, m, from, to, state));
    H_from_ += dQ.leftCols(2 * n_);
    H_states_.middleCols(first, count) += dQ.rightCols(count);
    S_from_.middleRows(first, count) = state.leftCols(2 * n_);
    S_to_.middleRows(first, count) = state.middleCols(2 * n_, 2 * n_);
    S_states_.block(first, first, count, count) = state.rightCols(count);
  }

  // What the parameter itself adds at this step, by the differences of its pair of lifts; times the adjoint. Element by
  // element: the hull's 16 MN would round away a tagline's newtons.
  void inject(std::size_t j, const SystemState& before, const SystemState& after, const VectorX& mu, const VectorX& F) {
    const Parameter& p = parameters_[j];
    if (p.name == kHoistSpeed) return inject_drive(j, before, after, mu);
    const MultibodySystem* system[2] = {&p.side[0]->system(), &p.side[1]->system()};
    SystemState from[2] = {before, before}, to[2] = {after, after};
    SystemWorkspace work[2] = {system[0]->make_workspace(), system[1]->make_workspace()};
    to[0].element_state = to[1].element_state = before.element_state;
    double sum = 0.0;
    for (int e = 0; e < static_cast<int>(system_.elements.size()); ++e) {
      ForceSum force[2] = {ForceSum(n_ / 6), ForceSum(n_ / 6)};
      for (int side = 0; side < 2; ++side) {
        const ForceElement& element = *system[side]->elements[e];
        const Memory m = system[side]->memory(e, to[side], work[side]);
        element.begin_step(from[side].instant(), kStep, m);
        element.add_forces(to[side].instant(), kStep, m, force[side]);
        element.end_step(to[side].instant(), kStep, m);
      }
      sum += mu.dot(force[1].value() - force[0].value());
      if (!system_.elements[e]->has_history()) continue;  // states that only help to compute have no derivative
      for (int k = system_.state_offset(e); k < system_.state_offset(e) + system_.elements[e]->state_size(); ++k)
        sum += s_[k] * (to[1].element_state[k] - to[0].element_state[k]);
    }
    const VectorX inertia = kNow * ((system[1]->mass(after.phase) - system[0]->mass(after.phase)) * after.acceleration);
    sum += (F - mu).dot(inertia);
    for (int i = 0; i < n_ / 6; ++i) {
      const RigidBody &low = system[0]->bodies[i], &high = system[1]->bodies[i];
      const Vector3& w = after.body[i].w_B;
      sum -= mu[6 * i + 2] * (high.mass - low.mass) * system_.gravity;
      sum -= mu.segment<3>(6 * i + 3).dot(w.cross((high.inertia - low.inertia) * w));
    }
    sum_[static_cast<Eigen::Index>(j)] += sum / p.width;
  }

  // The same for the drive. The differences by its position and rate are as wide as the tangent's, so that both round
  // alike: a metre's last digit is 4e-8 N in the fall.
  void inject_drive(std::size_t j, const SystemState& before, const SystemState& after, const VectorX& mu) {
    constexpr double kWide = 1e-5;
    const DriveState by_speed = drives_at(after.t, 1.0).front();  // the drive is linear in it
    for (int e = 0; e < static_cast<int>(system_.elements.size()); ++e) {
      if (system_.elements[e]->drives().empty()) continue;
      const auto slope = [&](double DriveState::*part) {
        ForceSum force[2] = {ForceSum(n_ / 6), ForceSum(n_ / 6)};
        for (int side = 0; side < 2; ++side) {
          SystemState to = after;
          to.element_state = before.element_state;
          to.drive.front().*part += side == 0 ? -kWide : kWide;
          system_.elements[e]->add_forces(to.instant(), kStep, system_.memory(e, to, work_), force[side]);
        }
        return mu.dot(force[1].value() - force[0].value()) / (2.0 * kWide);
      };
      sum_[static_cast<Eigen::Index>(j)] +=
          slope(&DriveState::position) * by_speed.position + slope(&DriveState::rate) * by_speed.rate;
    }
  }

  const MultibodySystem& system_;
  const std::vector<Parameter>& parameters_;
  SystemWorkspace work_;
  int n_;
  VectorX xi_, u_, a_, F_, s_;  // of the state at the beginning of the last step gone back
  VectorX sum_;
  MatrixX C_q_, P_, G_;  // xi1 = P xi0 + G (h u0 + ...)
  MatrixX H_from_, H_states_, S_from_, S_to_, S_states_;
};

// The barge hangs on a pin, so that there are constraints; the load stands on no deck, but could.
Case pinned_lift() {
  return read_case(
      std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml",
      {{"solver.newton_tolerance", "1e-13"},
       {"joints",
        "[{ name = \"pin\", type = \"spherical\", parent = \"world\", child = \"barge\", point_on_parent_m = "
        "[-20.0, 0.0, 0.0], point_on_child_m = [-20.0, 0.0, 0.0] }]"}});
}

std::vector<Parameter> parameters_of(const Case& c, const std::shared_ptr<const Model>& model) {
  std::vector<Parameter> all;
  for (const char* key : {"wires.fall.axial_stiffness_kN", "wires.fall.damping_ratio", "taglines.tagline.kp_kN_per_deg",
                          "taglines.tagline.kd_kN_s_per_deg", "taglines.tagline.time_constant_s",
                          "moorings.bow.stiffness_kN_per_m", "bodies.load.mass_t", "sea.states.swell.amplitude_m"}) {
    const double x = key_value(c, key), half = 1e-3 * x;
    Parameter p{key, {}, 2.0 * half};
    for (int side = 0; side < 2; ++side)
      p.side[side] = std::make_shared<const Model>(
          build_model(with_values(c, {{key, x + (side == 0 ? -half : half)}}).specification));
    all.push_back(p);
  }
  all.push_back({kHoistSpeed, {model, model}, 1e-3});
  return all;
}

TEST_CASE("The tangent agrees with a discrete adjoint of the same steps", "[tangent]") {
  const Case c = pinned_lift();
  const auto model = std::make_shared<const Model>(build_model(c.specification));
  const MultibodySystem& system = model->system();
  REQUIRE(system.constraints() == 3);
  const std::vector<Parameter> parameters = parameters_of(c, model);
  const int n = system.coordinates(), m = system.constraints();

  HhtOptions options;
  options.alpha = kAlpha;
  options.tolerance = 1e-13;
  HhtStepper stepper(system, options);
  std::vector<SystemTwin> twins;
  std::vector<std::array<SystemState, 2>> starts;
  for (const Parameter& p : parameters) {
    twins.push_back({{&p.side[0]->system(), &p.side[1]->system()}, p.width});
    starts.push_back({p.side[0]->initial_state(), p.side[1]->initial_state()});
  }
  SystemState state = model->initial_state();
  stepper.start(state);
  HhtTangent tangent(stepper, twins);
  tangent.start(state, starts);

  const auto twin_drives = [&](double t) {
    HhtTangent::TwinDrives drives;
    for (const Parameter& p : parameters) {
      const double half = p.name == kHoistSpeed ? 0.5 * p.width : 0.0;
      drives.push_back({drives_at(t, kHaul - half), drives_at(t, kHaul + half)});
    }
    return drives;
  };
  std::vector<SystemState> states;
  StateTangent after_first;
  std::vector<int> live_first;
  VectorX forward = VectorX::Zero(static_cast<Eigen::Index>(parameters.size()));
  for (int k = 0; k < kSteps; ++k) {
    const double t = state.t;
    tangent.begin(state);
    REQUIRE(stepper.step(state, kStep, drives_at(t + kStep, kHaul)));
    tangent.end(state, kStep, twin_drives(t), twin_drives(state.t));
    states.push_back(state);
    if (k == 0) {
      after_first = tangent.tangent();
      live_first = tangent.live();
      continue;
    }
    const VectorX w = weight_at(k, 2 * n), w_lambda = weight_at(k, m);
    for (std::size_t column = 0; column < tangent.live().size(); ++column) {
      const Eigen::Index i = static_cast<Eigen::Index>(column);
      const StateTangent& x = tangent.tangent();
      forward[tangent.live()[column]] +=
          w.head(n).dot(x.body.xi.col(i)) + w.tail(n).dot(x.body.u.col(i)) + w_lambda.dot(x.lambda.col(i));
    }
  }

  Adjoint adjoint(system, parameters);
  for (int k = kSteps - 1; k > 0; --k)
    adjoint.back(states[static_cast<std::size_t>(k - 1)], states[static_cast<std::size_t>(k)], weight_at(k, 2 * n),
                 weight_at(k, m));
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto at = std::find(live_first.begin(), live_first.end(), static_cast<int>(j));
    const double backward =
        adjoint.total(j, after_first, at == live_first.end() ? -1 : static_cast<int>(at - live_first.begin()));
    CAPTURE(parameters[j].name, forward[static_cast<Eigen::Index>(j)], backward);
    CHECK(forward[static_cast<Eigen::Index>(j)] != 0.0);
    CHECK(std::abs(forward[static_cast<Eigen::Index>(j)] - backward) <= 1e-10 * std::abs(backward));
  }
}

}  // namespace
}  // namespace stillhook
