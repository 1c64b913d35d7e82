// A lift whose signals are written down in closed form, so that every metric is known without the code under test.
//
// One crane, one load on two hoist wires, a barge. Phases: settle 0-60 s (on_barge), transfer 60-120, hoist_up 120-420
// and turn 420-720 (hanging), lower 720-900 (set_down), hold 900-960 (landed); samples every 0.2 s. The load swings as
// x: Ax sin(w t), y: Ay cos(w t) about its static path; w = 2 pi / 20 s, so every phase holds whole periods. Tensions
// are T0 (1 + d sin(wt t)), wt = 2 pi / 10 s. `record_samples = false` leaves only extremes and contacts.
#pragma once

#include <numbers>

#include "results/limits.h"
#include "sim/trajectory.h"

namespace stillhook::truth {

struct SyntheticLift {
  // What the signals are made of, and hence what the metrics must be.
  static constexpr double kSwing = 2.0 * std::numbers::pi / 20.0;  // rad/s
  static constexpr double kWave = 2.0 * std::numbers::pi / 10.0;   // rad/s
  static constexpr double kSwayX = 1.2, kSwayY = 0.7;              // m
  static constexpr double kStatic = 4.9033e6;                      // N, one hoist wire
  static constexpr double kDynamicPort = 0.05, kDynamicStarboard = 0.03;
  static constexpr double kRoll = 1.5e-2, kPitch = 8.0e-3;  // rad, crane
  static constexpr double kTrim = 1.48e-2;                  // rad, crane, static while loaded
  static constexpr double kTurnTravel = -8.0;               // m, static x of the load in `turn`
  static constexpr double kRelative = 0.4;                  // m, boom tip against the waiting load

  Specification specification;
  Trajectory trajectory;
  std::vector<LimitSpec> limits;

  explicit SyntheticLift(bool record_samples = true);
};

}  // namespace stillhook::truth
