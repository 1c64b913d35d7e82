// Goes through a whole operation step by step, as simulate() does, and keeps an account of it: energy, constraints,
// multipliers.
//
//   bodies     d(kinetic + weights) = sum over the elements of  Q_e . u  dt
//   gear       Q_e . u dt = -dV_e - heat_e dt + work of its drive      for each wire, tagline, mooring, contact,
//   ballast
//
// Q_e as it stood in the converged step, u the velocities; every integral by the trapezoidal rule. What is left of the
// first is the integrator's and the joints', of the second the element's. A drive works on
//   wire     (T + V/L) per metre hauled in          tagline  -T per metre paid out, but for the slipping brake
//   mooring  the horizontal pull along the tow      ballast  the weight it lifts or lowers
#pragma once

#include <map>

#include "problems/case.h"
#include "sim/lifting/ballast.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/mooring.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"
#include "sim/multibody/hht.h"
#include "sim/multibody/joint_drive.h"
#include "sim/operation_clock.h"
#include "sim/recorder.h"

namespace stillhook {

struct EnergyAccount {
  double stored = 0.0;                 // J, largest change of kinetic + weights + gear from the start
  double bodies = 0.0;                 // J, largest that is missing from the first line
  std::map<std::string, double> gear;  // J, by element, largest that is missing from the second
  double largest_kinetic = 0.0;        // J
  double gap = 0.0, gap_rate = 0.0;    // largest row of C(q) (m) and of C_q u (m/s)
  double tooth = 0.0;                  // N, N m, largest saw-tooth of a joint's multiplier over six steps
  double end = 0.0;                    // s
  std::vector<ContactEvent> contacts;
};

class AccountedRun {
 public:
  explicit AccountedRun(const Case& c)
      : model_(build_model(c.specification)),
        operation_(build_operation(model_)),
        stepper_(model_.system(), options()),
        work_(model_.system().make_workspace()),
        state_(model_.initial_state()),
        board_(model_),
        recorder_(model_, board_, false, run_),
        clock_(operation_) {}

  /// Throws std::runtime_error where a step does not converge.
  EnergyAccount go() {
    const double h = model_.specification().solver.time_step;
    stepper_.start(state_);
    clock_.advance(state_.t, recorder_);
    board_.measure(state_, stepper_.workspace(), 0, true);
    const double first = mechanical() + gear_energy();
    std::vector<DriveState> drives(state_.drive.size());
    for (long k = 1; !clock_.finished(state_.t); ++k) {
      const SystemState before = state_;
      const double mechanical_before = mechanical();
      const std::map<std::string, double> stored_before = stored_;
      clock_.foresee(k * h);
      clock_.drives_at(k * h, drives);
      if (!stepper_.step(state_, h, drives)) throw std::runtime_error("no convergence at " + std::to_string(state_.t));
      state_.t = k * h;
      account(before, mechanical_before, stored_before, h);
      clock_.advance(state_.t, recorder_);
      begin_phase();
      board_.measure(state_, stepper_.workspace(), state_.phase, true);
      recorder_.add(state_.t, h, state_.phase, false);
      result_.stored = std::max(result_.stored, std::abs(mechanical() + gear_energy() - first));
      watch_joints();
    }
    result_.end = state_.t;
    recorder_.close(state_.t);
    result_.contacts = run_.contacts;
    return result_;
  }

 private:
  HhtOptions options() const {
    HhtOptions o;
    o.alpha = model_.specification().solver.hht_alpha;
    o.tolerance = model_.specification().solver.newton_tolerance;
    return o;
  }
  const MultibodySystem& system() const { return model_.system(); }

  double kinetic() const { return system().kinetic_energy(state_); }
  double mechanical() const {
    double E = kinetic();
    for (std::size_t i = 0; i < state_.body.size(); ++i)
      E += system().bodies[i].mass * system().gravity * state_.body[i].p_WC.z();
    return E;
  }
  static bool is_gear(const ForceElement& e) {
    return dynamic_cast<const Wire*>(&e) || dynamic_cast<const Tagline*>(&e) || dynamic_cast<const Mooring*>(&e) ||
           dynamic_cast<const Contact*>(&e) || dynamic_cast<const Ballast*>(&e) || dynamic_cast<const JointDrive*>(&e);
  }
  /// Stored in the gear; the parts are kept in stored_.
  double gear_energy() {
    double sum = 0.0;
    for (std::size_t e = 0; e < system().elements.size(); ++e) {
      const ForceElement& element = *system().elements[e];
      if (!is_gear(element)) continue;
      sum += stored_[element.name()] =
          element.potential_energy(state_.instant(), system().memory(static_cast<int>(e), state_, work_));
    }
    return sum;
  }
  double measured(const std::string& channel) const {
    return board_.values()[static_cast<std::size_t>(board_.find(channel))];
  }

  /// Power of every element in the converged step that began in `before`.
  std::map<std::string, double> powers(SystemState before, double h) {
    system().begin_step(before, h, work_);
    before.t = state_.t;
    before.body = state_.body;
    before.drive = state_.drive;
    std::map<std::string, double> powers;
    for (std::size_t e = 0; e < system().elements.size(); ++e) {
      work_.forces.clear();
      const ForceElement& element = *system().elements[e];
      element.add_forces(before.instant(), h, system().memory(static_cast<int>(e), before, work_), work_.forces);
      double power = 0.0;
      for (std::size_t i = 0; i < state_.body.size(); ++i) {
        const BodyKinematics& b = state_.body[i];
        power += work_.forces.value().segment<3>(6 * static_cast<Eigen::Index>(i)).dot(b.v_WC) +
                 work_.forces.value().segment<3>(6 * static_cast<Eigen::Index>(i) + 3).dot(b.w_B);
      }
      powers[element.name()] += power;  // hull and hydrodynamics may share a name
    }
    return powers;
  }

  /// Power of the drive of a gear element, and its heat, in the state that is measured.
  double drive_power(const ForceElement& element, double heat) const {
    const std::string& name = element.name();
    if (dynamic_cast<const Wire*>(&element))
      return -(measured(name + ".tension") + stored_.at(name) / measured(name + ".unstretched")) *
             measured(name + ".rate");
    if (dynamic_cast<const Tagline*>(&element))
      return -measured(name + ".tension") * measured(name + ".line_speed") + heat;
    if (const auto* mooring = dynamic_cast<const Mooring*>(&element); mooring && !mooring->drives().empty()) {
      const DriveState& d = state_.drive[static_cast<std::size_t>(mooring->drives().front())];
      const Vector3 anchor = mooring->anchor() + d.position * mooring->options().tow_direction;
      const Vector3 reach = anchor - motion_of(mooring->options().fairlead, state_.instant()).p;
      const Vector3 along = Vector3(reach.x(), reach.y(), 0.0).normalized();
      return measured(name + ".horizontal_tension") * along.dot(mooring->options().tow_direction) * d.rate;
    }
    if (const auto* ballast = dynamic_cast<const Ballast*>(&element)) {
      const double moved = state_.drive[static_cast<std::size_t>(ballast->drives().front())].position;
      const double rate = state_.drive[static_cast<std::size_t>(ballast->drives().front())].rate;
      return moved > 0.0 ? stored_.at(name) / moved * rate : 0.0;
    }
    return 0.0;
  }

  void account(const SystemState& before, double mechanical_before, const std::map<std::string, double>& stored_before,
               double h) {
    board_.measure(state_, stepper_.workspace(), state_.phase, true);
    const std::map<std::string, double> now = powers(before, h);
    gear_energy();
    double sum = 0.0;
    for (const auto& [name, power] : now) sum += 0.5 * h * (power + (last_.contains(name) ? last_.at(name) : power));
    missing_ += mechanical() - mechanical_before - sum;
    result_.bodies = std::max(result_.bodies, std::abs(missing_));
    result_.largest_kinetic = std::max(result_.largest_kinetic, kinetic());
    for (std::size_t e = 0; e < system().elements.size(); ++e) {
      const ForceElement& element = *system().elements[e];
      if (!is_gear(element)) continue;
      const std::string& name = element.name();
      const double heat =
          element.dissipated_power(state_.instant(), system().memory(static_cast<int>(e), state_, work_));
      const double lost = now.at(name) + heat - drive_power(element, heat);  // should be -dV/dt
      const double work = 0.5 * h * (lost + (lost_.contains(name) ? lost_.at(name) : lost));
      gear_missing_[name] += work + stored_.at(name) - stored_before.at(name);
      lost_[name] = lost;
      double& worst = result_.gear[name];
      worst = std::max(worst, std::abs(gear_missing_[name]));
    }
    last_ = now;
  }

  /// With a phase the added mass may change, and with it the kinetic energy: no force works there.
  void begin_phase() { state_.phase = std::max(0, clock_.phase()); }

  void watch_joints() {
    VectorX C;
    MatrixX C_q;
    system().constraint_values(state_, C);
    system().constraint_jacobian(state_, C_q);
    VectorX u(system().coordinates());
    for (std::size_t i = 0; i < state_.body.size(); ++i)
      u.segment<6>(6 * static_cast<Eigen::Index>(i)) << state_.body[i].v_WC, state_.body[i].w_B;
    if (C.size() == 0) return;
    result_.gap = std::max(result_.gap, C.cwiseAbs().maxCoeff());
    result_.gap_rate = std::max(result_.gap_rate, (C_q * u).cwiseAbs().maxCoeff());
    // A saw-tooth of amplitude a has third differences of 8 a with alternating signs.
    history_.push_back(state_.lambda);
    if (history_.size() < 9) return;
    for (Eigen::Index row = 0; row < C.size(); ++row) {
      double least = std::numeric_limits<double>::infinity(), sign = 0.0;
      for (std::size_t k = 0; k + 3 < history_.size(); ++k) {
        const double d =
            (history_[k + 3][row] - 3.0 * history_[k + 2][row] + 3.0 * history_[k + 1][row] - history_[k][row]) / 8.0;
        if (d * sign > 0.0) least = 0.0;
        sign = d;
        least = std::min(least, std::abs(d));
      }
      result_.tooth = std::max(result_.tooth, least);
    }
    history_.erase(history_.begin());
  }

  Model model_;
  Operation operation_;
  HhtStepper stepper_;
  SystemWorkspace work_;
  SystemState state_;
  Trajectory run_;
  ChannelBoard board_;
  Recorder recorder_;
  OperationClock clock_;
  EnergyAccount result_;
  std::map<std::string, double> stored_, last_, lost_, gear_missing_;
  double missing_ = 0.0;
  std::vector<VectorX> history_;
};

}  // namespace stillhook
