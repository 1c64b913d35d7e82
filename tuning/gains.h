// Tagline gains by themselves: the plan's objective and limits over the gains alone, by exact gradients; what damping
// they give; and whether the winch can follow them at all.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "problems/evaluator.h"
#include "problems/search/solve.h"
#include "tuning/swing.h"

namespace stillhook {

/// The case with the variables that are to be tuned and the part of the operation as its plan's. Terms and hard limits
/// that the part has not (a set-down in a hoisting phase) are taken out and named in `left_out`. Throws CaseError
/// without taglines or objective, and for a part that does not run.
Case tuning_case(const Case& c, std::vector<std::string>* left_out = nullptr);

struct GainMap {
  std::vector<double> x, y;   // values of the first two variables
  Eigen::MatrixXd objective;  // rows y, columns x; NaN where a run failed
  Eigen::MatrixXd violation;  // largest scaled violation of a limit
};

/// A tagline's winch at the tuned gains, over all scenarios, and what the law would ask of one without limits.
struct WinchDemand {
  std::string line;
  double saturated = 0.0;                        // share of time at a limit, mean over scenarios
  double speed_limit = 0.0, pull_limit = 0.0;    // m/s (0 = none), N
  double speed_wanted = 0.0, pull_wanted = 0.0;  // m/s, N
  bool too_slow() const { return saturated > 0.05 && speed_limit > 0.0 && speed_wanted > speed_limit; }
};

/// Factors on the tuned gains over the length of the falls, tuned in their turn.
struct GainSchedule {
  struct Point {
    std::string name;
    double fall = 0.0;  // m
    double kp_factor = 1.0, kd_factor = 1.0;
  };
  std::string message;  // why there is none; empty if there is
  std::vector<Point> points;
  Evaluation evaluation;  // with it, by the metrics as they are
  bool worth_it = false;  // the objective falls by more than one part in a hundred, no limit is broken for it
  std::optional<Case> scheduled;
};

struct GainTuning {
  SearchReport report;           // on the smooth problem
  Evaluation baseline, tuned;    // by the metrics as they are
  Eigen::VectorXd start, gains;  // in the units of the keys
  bool improved = false;         // tuned is better than the baseline; else gains == start
  double simulations = 0.0;      // whole operations simulated, a gradient charged as three
  std::vector<SwingMode> before, after;
  std::vector<WinchDemand> winches;
  GainMap map;
  std::optional<GainSchedule> schedule;  // if the case asks for one
};

struct TuningOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string& stage, double share)> progress;
};

/// Tunes. The evaluator must have been made of tuning_case(). Throws CaseError if its algorithm cannot solve it.
GainTuning tune_gains(const Evaluator& evaluator, const TuningOptions& options = {});

}  // namespace stillhook
