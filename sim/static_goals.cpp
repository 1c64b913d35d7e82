#include "sim/static_goals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sim/missed_surface.h"
#include "sim/multibody/drive_path.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

// Drive steps for the slope of a goal, m: a small one where the drive has a grip; larger ones, either way, where it
// first has to take up slack. A slope below no_grip() is none.
constexpr double kProbes[] = {1e-3, 0.3, -0.3, 3.0, -3.0};
constexpr double kFirstStep = 3.0;  // of a drive in one iteration, m; it grows while the goals come nearer as foreseen
constexpr double kLongestStep = 400.0;
constexpr int kMaxGoalSteps = 120;
constexpr int kIdleSteps = 8;       // iterations that may pass without coming nearer, once the goals are nearly met
constexpr int kHopelessSteps = 30;  // the same while they are not

// In the unit of the case, six digits.
std::string shown(const Model& model, const CoordinateSpec& c, double value) {
  double factor = 1.0;
  const char* unit = "m";
  if (!c.wire.empty()) {
    factor = 1e-3;
    unit = "kN";
  }
  for (const JointSpec& j : model.specification().joints)
    if (j.name == c.joint && j.type == JointSpec::Type::revolute) {
      factor = 1.0 / kDegree;
      unit = "deg";
    }
  char text[64];
  std::snprintf(text, sizeof text, "%.6g %s", value * factor, unit);
  return text;
}

std::string describe(const CoordinateSpec& c) {
  if (!c.joint.empty()) return "coordinate of joint '" + c.joint + "'";
  if (!c.wire.empty()) return "tension of wire '" + c.wire + "'";
  return std::string(1, "xyz"[c.axis]) + " of a point of '" + c.body + "'";
}

// Tolerance of a goal in its own unit, m, rad or N: two solutions are subtracted where derivatives are wanted.
double tolerance_of(const StaticGoal& goal) { return goal.coordinate.wire.empty() ? 1e-10 : 1e-3; }

// What rounding may leave of a goal when it comes no nearer: a stiff wire on a softly moored hull turns 1e-9 of the
// weight into some newtons.
double roughly(const StaticGoal& goal) {
  return goal.coordinate.wire.empty() ? 1e-7 : std::max(1.0, 1e-6 * std::abs(goal.value));
}

// Of a drive on a coordinate, per m: rounding alone gives less than a newton of tension.
double no_grip(const StaticGoal& goal) { return goal.coordinate.wire.empty() ? 5e-3 : 10.0; }

class GoalSearch {
 public:
  GoalSearch(const Model& model, SystemState& state, const std::vector<StaticGoal>& goals, const std::string& entry)
      : model_(model), state_(state), goals_(goals), entry_(entry), n_(static_cast<int>(goals.size())) {}

  void run() {
    f_ = miss(state_);
    best_ = state_;
    best_f_ = f_;
    int idle = 0;
    for (int iteration = 0; iteration < kMaxGoalSteps && !within(f_, tolerance_of); ++iteration) {
      if (!step()) break;
      f_ = miss(state_);
      if (score(f_) < 0.9 * score(best_f_)) {
        idle = 0;
        best_ = state_;
        best_f_ = f_;
      } else if (++idle > (within(best_f_, roughly) ? kIdleSteps : kHopelessSteps)) {
        break;
      }
    }
    if (within(f_, tolerance_of)) return;
    state_ = best_;
    if (!within(best_f_, roughly)) refuse();
  }

 private:
  VectorX miss(const SystemState& s) const {
    VectorX f(n_);
    for (int i = 0; i < n_; ++i) f[i] = coordinate_value(model_, s, goals_[i].coordinate) - goals_[i].value;
    return f;
  }

  template <class Tolerance>
  bool within(const VectorX& f, Tolerance tolerance) const {
    for (int i = 0; i < n_; ++i)
      if (!(std::abs(f[i]) < tolerance(goals_[i]))) return false;
    return true;
  }

  double score(const VectorX& f) const {
    double worst = 0.0;
    for (int i = 0; i < n_; ++i) worst = std::max(worst, std::abs(f[i]) / tolerance_of(goals_[i]));
    return worst;
  }

  bool move_by(SystemState& state, int drive, double by) const {
    std::vector<DriveState> to = state.drive;
    to[drive].position += by;
    if (std::abs(by) <= kProbes[0]) {
      state.drive = to;
      return solve_equilibrium(model_.system(), state, true).converged;
    }
    return follow_drives(model_.system(), state, to).converged;
  }

  MatrixX slopes() {
    MatrixX slope = MatrixX::Zero(n_, n_);
    grip_ = true;
    for (int j = 0; j < n_; ++j) {
      const bool tension = !goals_[j].coordinate.wire.empty();
      for (const double by : kProbes) {
        SystemState probe = state_;
        if (!move_by(probe, goals_[j].drive, by)) continue;
        slope.col(j) = (miss(probe) - f_) / by;
        if (std::abs(slope(j, j)) > no_grip(goals_[j])) break;
      }
      if (!tension || std::abs(slope(j, j)) > no_grip(goals_[j])) continue;
      // A load that hangs free keeps its wires' tension however far it is lowered: on until it lands, or is off it.
      grip_ = false;
      slope(j, j) = std::abs(f_[j]) / largest_;
    }
    return slope;
  }

  // One step of the drives; false if there is none.
  bool step() {
    VectorX by = -slopes().fullPivLu().solve(f_);
    if (!by.allFinite() || by.isZero(0.0)) return false;
    const double size = by.cwiseAbs().maxCoeff();
    const double factor = std::min(1.0, largest_ / size);
    by *= factor;
    if (n_ == 1) stay_between(by);
    std::vector<DriveState> to = state_.drive;
    for (int j = 0; j < n_; ++j) to[goals_[j].drive].position += by[j];
    const double before = score(f_);
    const EquilibriumReport report = follow_drives(model_.system(), state_, to);
    if (!report.converged) {
      failed_ = report;
      largest_ = 0.25 * largest_;
      return largest_ > 1e-6;
    }
    failed_ = {};
    const double after = score(miss(state_));
    // Nearer by what a straight line foresees, or still without a grip: twice and more as far the next time.
    if (!grip_ || std::abs(after - (1.0 - factor) * before) < 0.3 * factor * before)
      largest_ = std::min(kLongestStep, 3.0 * largest_);
    else
      largest_ = std::max(kFirstStep, largest_ / 3.0);
    return true;
  }

  // The answer of a single goal lies between drive positions with misses of either sign.
  void stay_between(VectorX& by) {
    const double here = state_.drive[goals_[0].drive].position;
    (f_[0] < 0.0 ? below_ : above_) = here;
    if (std::isnan(below_) || std::isnan(above_)) return;
    const double low = std::min(below_, above_), high = std::max(below_, above_);
    const double to = here + by[0];
    if (to <= low || to >= high) by[0] = 0.5 * (low + high) - here;
  }

  [[noreturn]] void refuse() const {
    int worst = 0;
    for (int i = 1; i < n_; ++i)
      if (std::abs(best_f_[i]) / roughly(goals_[i]) > std::abs(best_f_[worst]) / roughly(goals_[worst])) worst = i;
    const StaticGoal& goal = goals_[worst];
    std::string why;
    if (!failed_.motion.empty()) why = "; beyond that there is no stable equilibrium: " + failed_.motion + " gives way";
    throw SpecificationError(entry_, "",
                             "cannot bring the " + describe(goal.coordinate) + " to " +
                                 shown(model_, goal.coordinate, goal.value) + " with drive '" +
                                 model_.specification().drives[goal.drive].name + "': the nearest found is " +
                                 shown(model_, goal.coordinate, best_f_[worst] + goal.value) + why +
                                 missed_surface(model_.system(), state_));
  }

  const Model& model_;
  SystemState& state_;
  const std::vector<StaticGoal>& goals_;
  const std::string& entry_;
  int n_;
  VectorX f_, best_f_;
  SystemState best_;
  EquilibriumReport failed_;  // of the last step, if it did
  double largest_ = kFirstStep;
  double below_ = kNaN, above_ = kNaN;  // drive positions of a single goal
  bool grip_ = true;
};

}  // namespace

void reach_goals(const Model& model, SystemState& state, const std::vector<StaticGoal>& goals,
                 const std::string& entry) {
  if (!goals.empty()) GoalSearch(model, state, goals, entry).run();
}

void refuse_without_equilibrium(const MultibodySystem& system, const SystemState& state,
                                const EquilibriumReport& report, const std::string& entry) {
  std::string sentence = "no stable static equilibrium found: ";
  if (!report.motion.empty()) {
    sentence += report.motion + " goes on moving";
  } else {
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", report.residual);
    sentence += "'" + report.worst_body + "' is out of balance by " + text + " of the largest weight";
  }
  throw SpecificationError(entry, "", sentence + "; check that everything floats, hangs or stands" + missed_surface(system, state));
}

}  // namespace stillhook
