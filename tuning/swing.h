// The swing of a hanging load and its damping, with taglines and without: linearised, and by a simulated decay.
//
//   linear       M(w) q'' + C q' + K q = 0 about a static pose, C_q q = 0; C: wires, hulls' viscous damping, and the
//                taglines. A line that can only pull acts during half of each swing, so its equivalent linear gains are
//                half of Kp and Kd (the fundamental of a half-wave rectified law).  zeta = -Re s / |s|
//   simulated    the load displaced along the mode's shape in calm water and let go; zeta from the logarithmic decrement
//                of the hoist wires' lead over the first swings
//
// M(w) holds the added mass at the mode's own undamped frequency. Winch lag and limits are in the simulation only: at
// amplitudes where the winch keeps up the two agree. (Cha, Nam & Ha 2018, Eq. 12-14 for the law; Gelb & Vander Velde
// 1968 for the describing function.)
#pragma once

#include <string>
#include <vector>

#include "sim/operation.h"

namespace stillhook {

struct SwingMode {
  std::string pose;       // name of the static pose: the phase it ends
  std::string direction;  // "fore-aft" or "athwart"
  std::string label;      // of the mode: the coordinates that move most
  double period = 0.0;    // s, undamped, without taglines
  // Damping ratios, share of critical; NaN where a decay could not be measured.
  double linear_free = 0.0, linear_lines = 0.0, decay_free = 0.0, decay_lines = 0.0;
};

struct SwingOptions {
  double amplitude = 0.0175;  // rad, of the decay's first swing
  int swings = 3;             // that the decrement is taken over
  bool simulate = true;       // false: linear values alone
  int phase = -1;             // the end of this phase alone; -1: all
};

/// Both swings of the operation's load at the end of every phase in which it hangs and the taglines are connected.
/// Throws SpecificationError when the lift cannot be built without taglines.
std::vector<SwingMode> swing_modes(const Specification& specification, const SwingOptions& options = {});

}  // namespace stillhook
