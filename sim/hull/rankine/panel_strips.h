// The panels of a hull in the order in which the water reaches them, so that the work goes where the surface is.
//
// Panels are sorted by height and cut into strips, each with a box around it: where the box is out of the reach of
// every crest and trough its panels are wholly wet or wholly dry and need no look of their own. On wholly wet panels
//
//   int h n dS = sum_v h_v N_v        int h r n^T dS = sum_v h_v Q_v
//
// because the head h is linear on a panel: N_v and Q_v are constants of the vertex v (head_weights). With h_v = 0 at
// dry vertices the sums also hold on dry panels, so only panels that the surface cuts are integrated one by one.
#pragma once

#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

struct Panel {
  int corner[3];
  Vector3 S_B;  // m2, area times outward normal
};

struct PanelStrip {
  int first_panel, end_panel;
  int vertices;          // the panels up to here use the first so many vertices
  Vector3 centre, half;  // m, box in B, relative to C
};

/// Sorts panels by the height (in B) of their middle, and vertices r (m, in B) into the order in which these panels
/// need them; vertices that no panel uses are dropped.
void sort_upwards(std::vector<Panel>& panels, std::vector<Vector3>& r);

/// Strips of sorted panels, upwards.
std::vector<PanelStrip> strips_of(const std::vector<Panel>& panels, const std::vector<Vector3>& r);

/// One row a vertex: N_v (3) and, column after column, Q_v (9), m2 and m3.
MatrixX head_weights(const std::vector<Panel>& panels, const std::vector<Vector3>& r);

}  // namespace stillhook
