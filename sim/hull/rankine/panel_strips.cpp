#include "sim/hull/rankine/panel_strips.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace stillhook {

namespace {
constexpr int kPanelsInStrip = 16;
}

void sort_upwards(std::vector<Panel>& panels, std::vector<Vector3>& r) {
  const auto middle = [&](const Panel& p) -> Vector3 { return r[p.corner[0]] + r[p.corner[1]] + r[p.corner[2]]; };
  std::ranges::stable_sort(panels, [&](const Panel& a, const Panel& b) {
    const Vector3 u = middle(a), v = middle(b);
    return std::tuple(u.z(), u.x(), u.y()) < std::tuple(v.z(), v.x(), v.y());
  });
  std::vector<int> place(r.size(), -1);
  std::vector<Vector3> sorted;
  for (Panel& panel : panels)
    for (int& corner : panel.corner) {
      if (place[corner] < 0) {
        place[corner] = static_cast<int>(sorted.size());
        sorted.push_back(r[corner]);
      }
      corner = place[corner];
    }
  r = std::move(sorted);
}

std::vector<PanelStrip> strips_of(const std::vector<Panel>& panels, const std::vector<Vector3>& r) {
  std::vector<PanelStrip> strips;
  int vertices = 0;
  const int count = static_cast<int>(panels.size());
  for (int first = 0; first < count; first += kPanelsInStrip) {
    const int end = std::min(first + kPanelsInStrip, count);
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (int i = first; i < end; ++i)
      for (const int corner : panels[i].corner) {
        low = low.cwiseMin(r[corner]);
        high = high.cwiseMax(r[corner]);
        vertices = std::max(vertices, corner + 1);
      }
    strips.push_back({first, end, vertices, 0.5 * (low + high), 0.5 * (high - low)});
  }
  return strips;
}

MatrixX head_weights(const std::vector<Panel>& panels, const std::vector<Vector3>& r) {
  MatrixX weights = MatrixX::Zero(static_cast<Eigen::Index>(r.size()), 12);
  for (const Panel& panel : panels) {
    const Vector3 sum = r[panel.corner[0]] + r[panel.corner[1]] + r[panel.corner[2]];
    for (const int v : panel.corner) {
      const Matrix3 rn = (sum + r[v]) / 12.0 * panel.S_B.transpose();
      weights.row(v).head<3>() += panel.S_B.transpose() / 3.0;
      weights.row(v).tail<9>() += Eigen::Map<const Eigen::Matrix<double, 1, 9>>(rn.data());
    }
  }
  return weights;
}

}  // namespace stillhook
