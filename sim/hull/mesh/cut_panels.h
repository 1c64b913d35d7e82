// Panels that the surface cuts, gathered four at a time, one to a lane of the processor's vectors, for clipped_panel.h.
// Each begins with the corner that is alone: the only wet one, or the only dry one.
#pragma once

#include "sim/hull/rankine/panel_strips.h"

namespace stillhook {

inline constexpr int kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

struct CutPanels {
  /// True when the lanes are full. `lone`: the corner that is alone, 0 to 2.
  bool add(const Panel& panel, int lone) {
    for (int c = 0; c < 3; ++c) corner[c][count] = panel.corner[(lone + c) % 3];
    for (int axis = 0; axis < 3; ++axis) S[axis][count] = panel.S_B[axis];
    return ++count == kLanes;
  }
  /// Lanes left over repeat the first one without its area.
  void fill() {
    for (; count < kLanes; ++count)
      for (int i = 0; i < 3; ++i) {
        corner[i][count] = corner[i][0];
        S[i][count] = 0.0;
      }
  }
  Lanes gathered(const double* values, int c) const {
    return {values[corner[c][0]], values[corner[c][1]], values[corner[c][2]], values[corner[c][3]]};
  }
  int count = 0;
  int corner[3][kLanes];
  Lanes S[3];  // m2
};

/// n (m3) and rn (m4) of hydrostatics.cpp, summed in each lane on its own.
struct LaneIntegrals {
  Lanes n[3] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
  Lanes rn[3][3] = {{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()},
                    {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()},
                    {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()}};
};

// The corner that differs from the other two, by the bits of clipped_panel::wet_corners.
inline constexpr int kLoneCorner[8] = {0, 0, 1, 2, 2, 1, 0, 0};

}  // namespace stillhook
