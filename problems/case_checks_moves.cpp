// The box of a search lies within the limits of the drives, so that every profile it can propose is one they can
// follow.
#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {
namespace {

class VariedMoves {
 public:
  VariedMoves(const Case& c, const Node& root, Findings& findings) : case_(c), root_(root), findings_(findings) {}

  void run() {
    for (const PhaseSpec& phase : case_.specification.operation.phases)
      for (const MoveSpec& move : phase.moves)
        for (const DriveSpec& drive : case_.specification.drives)
          if (drive.name == move.drive) check(phase, move, drive);
  }

 private:
  /// The variable that changes a number of the move whose key begins with `stem`.
  const VariableSpec* variable_of(const PhaseSpec& phase, const MoveSpec& move, const std::string& stem) const {
    for (const VariableSpec& v : case_.plan.variables) {
      const std::vector<std::string> steps = steps_of(v.key);
      const auto meets = [&](std::size_t i, const std::string& name) { return steps[i] == "*" || steps[i] == name; };
      if (steps.size() == 6 && steps[0] == "operation" && steps[1] == "phases" && meets(2, phase.name) &&
          steps[3] == "moves" && meets(4, move.drive) && steps[5].starts_with(stem))
        return &v;
    }
    return nullptr;
  }

  /// A bound of a variable in SI units.
  double si(const VariableSpec& v, double bound) const {
    try {
      Node copy = root_;
      return bound * find_targets(copy, v.key).front().field->unit.factor;
    } catch (const KeyError&) {
      return 0.0;  // refused as a key already
    }
  }

  void check(const PhaseSpec& phase, const MoveSpec& move, const DriveSpec& drive) {
    const VariableSpec *speed = variable_of(phase, move, "speed"), *ramp = variable_of(phase, move, "ramp");
    const double fastest = speed ? si(*speed, speed->upper) : move.speed;
    const double shortest = ramp ? si(*ramp, ramp->lower) : move.profile.ramp;
    if (speed && drive.speed_max > 0.0 && fastest > drive.speed_max * kSlack)
      return report(*speed, "max",
                    fmt::format("is above the limit of drive \"{}\": {:.6g} times its largest speed", drive.name,
                                fastest / drive.speed_max));
    if ((!speed && !ramp) || !(drive.acceleration_max > 0.0)) return;
    // The steepest of an s-curve; knots are never closer than their ramps allow, a shaper only spreads.
    const double steepness = move.profile.shape == ProfileSpec::Shape::s_curve ? 0.5 * std::numbers::pi : 1.0;
    const auto least_ramp = [&](double at) { return steepness * at / drive.acceleration_max; };
    const double least = least_ramp(fastest);
    const bool broken_as_it_is = move.profile.ramp * kSlack < least_ramp(move.speed);  // told when the lift is built
    if (shortest * kSlack >= least || broken_as_it_is) return;
    report(ramp ? *ramp : *speed, ramp ? "min" : "max",
           fmt::format("asks drive \"{}\" for more than its largest acceleration: at full speed its ramp must be at "
                       "least {:.6g} s, got {:.6g}",
                       drive.name, least, shortest));
  }

  void report(const VariableSpec& v, const std::string& key, const std::string& sentence) {
    const std::string entry = "plan.variables." + as_step(v.key);
    findings_.add(position_of_key(root_, entry, key), entry, key, sentence);
  }

  static constexpr double kSlack = 1.0 + 1e-9;  // a profile may use its drive's limits to the full
  const Case& case_;
  const Node& root_;
  Findings& findings_;
};

}  // namespace

void check_varied_moves(const Case& c, const Node& root, Findings& findings) { VariedMoves(c, root, findings).run(); }

}  // namespace stillhook
