#include "sim/hull/wave_window.h"

#include <algorithm>

namespace stillhook {

namespace {

// Below this many components two direct samples cost less than an expansion and its use.
constexpr std::size_t kFewComponents = 8;
constexpr double kNever = -1e30;  // s, the time of a node that is none
constexpr double kTouch = 1e-9;   // s

// offset + r direction, point by point.
auto along(const Eigen::Ref<const MatrixX>& r, double offset, const Vector3& direction) {
  return offset + direction[0] * r.col(0).array() + direction[1] * r.col(1).array() + direction[2] * r.col(2).array();
}

}  // namespace

struct WaveWindow::Node {
  double t;
  Vector3 p;
  Matrix3 R;

  static Node of(const double* s) { return {s[0], Eigen::Map<const Vector3>(s + 1), Eigen::Map<const Matrix3>(s + 4)}; }
  void write(double* s) const {
    s[0] = t;
    Eigen::Map<Vector3> position(s + 1);
    Eigen::Map<Matrix3> attitude(s + 4);
    position = p;
    attitude = R;
  }
  // Where the body will be after dt (s) if nothing pushes it.
  static Node expected(double t, const BodyKinematics& b, double dt) {
    return {t + dt, b.p_WC + dt * b.v_WC, b.R_WB * exp_rotation(dt * b.w_B)};
  }
};

// A part of the scratch: the node that the series belong to, how many vertices have one, the series.
struct WaveWindow::Slot {
  double* node;
  double* count;
  double* terms;
};

WaveWindow::WaveWindow(std::shared_ptr<const WaveField> waves, std::size_t vertices, double radius)
    : vertices_(vertices), radius_(radius) {
  if (waves->components().size() > kFewComponents) expansion_ = std::make_shared<WaveExpansion>(std::move(waves));
}

int WaveWindow::scratch_size() const {
  if (!used()) return 0;
  const std::size_t slot = kNodeSize + 1 + kExpansionTerms * vertices_;
  return static_cast<int>(2 * slot + 3 * vertices_);
}

void WaveWindow::start(std::span<double> state) const { state[0] = state[kNodeSize] = kNever; }

bool WaveWindow::holds(double t, std::span<const double> state) const {
  return t >= state[0] - kTouch && t <= state[kNodeSize] + kTouch;
}

void WaveWindow::begin_step(double t, double h, const BodyKinematics& body, std::span<double> state) const {
  double *first = state.data(), *second = first + kNodeSize;
  const double H = expansion_->interval();
  if (h > H) return start(state);  // steps longer than the interval take the sea as it is
  if (holds(t, state)) {
    const Node a = Node::of(first), b = Node::of(second);
    const double s = (t - a.t) / (b.t - a.t);
    const double away =
        (body.p_WC - (1.0 - s) * a.p - s * b.p).norm() + radius_ * (body.R_WB - (1.0 - s) * a.R - s * b.R).norm();
    if (away > expansion_->reach()) start(state);
  }
  if (!holds(t, state)) {
    Node::expected(t, body, 0.0).write(first);
    Node::expected(t, body, H).write(second);
  }
  if (holds(t + h, state)) return;
  std::copy(second, second + kNodeSize, first);
  Node::expected(t, body, *first + H - t).write(second);
}

WaveWindow::Slot WaveWindow::slot_of(const Node& node, const double* other, const Eigen::Ref<const MatrixX>& r,
                                     std::span<double> scratch) const {
  double wanted[kNodeSize];
  node.write(wanted);
  const std::size_t size = kNodeSize + 1 + kExpansionTerms * vertices_;
  Slot slots[2];
  for (int i = 0; i < 2; ++i) {
    double* at = scratch.data() + static_cast<std::size_t>(i) * size;
    slots[i] = {at, at + kNodeSize, at + kNodeSize + 1};
  }
  const auto belongs = [](const Slot& s, const double* n) { return std::equal(n, n + kNodeSize, s.node); };
  int i = belongs(slots[0], wanted) ? 0 : belongs(slots[1], wanted) ? 1 : belongs(slots[0], other) ? 1 : 0;
  Slot& slot = slots[i];
  if (!belongs(slot, wanted)) {
    std::copy(wanted, wanted + kNodeSize, slot.node);
    *slot.count = 0.0;
  }
  const auto have = static_cast<std::size_t>(*slot.count), want = static_cast<std::size_t>(r.rows());
  if (have >= want) return slot;
  // The last part of the scratch is for places.
  double* place = scratch.data() + 2 * size;
  std::span<double> x[3];
  const auto rest = static_cast<Eigen::Index>(want - have);
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] = {place + static_cast<std::size_t>(axis) * vertices_, want - have};
    VectorX::Map(x[axis].data(), rest).array() = along(r.bottomRows(rest), node.p[axis], node.R.row(axis));
  }
  expansion_->expand(node.t, x[0], x[1], x[2], vertices_, slot.terms + have);
  *slot.count = static_cast<double>(want);
  return slot;
}

void WaveWindow::sample(double t, const BodyKinematics& body, const Eigen::Ref<const MatrixX>& r, bool gradients,
                        Memory m, const WaveSamples& out) const {
  for (const std::span<double> v : {out.elevation, out.head}) std::ranges::fill(v, 0.0);
  if (gradients)
    for (const std::span<double> v : {out.elevation_x, out.elevation_y, out.head_x, out.head_y, out.head_z})
      std::ranges::fill(v, 0.0);
  const double *first = m.state.data(), *second = first + kNodeSize;
  const Node nodes[2] = {Node::of(first), Node::of(second)};
  const double H = nodes[1].t - nodes[0].t;
  const auto [a, b] = quintic_hermite((t - nodes[0].t) / H, H);
  double* place = m.scratch.data() + m.scratch.size() - 3 * vertices_;
  for (int i = 0; i < 2; ++i) {
    const Slot slot = slot_of(nodes[i], i == 0 ? second : first, r, m.scratch);
    std::span<double> d[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = {place + static_cast<std::size_t>(axis) * vertices_, static_cast<std::size_t>(r.rows())};
      VectorX::Map(d[axis].data(), r.rows()).array() =
          along(r, body.p_WC[axis] - nodes[i].p[axis], (body.R_WB - nodes[i].R).row(axis));
    }
    WaveExpansion::add(slot.terms, vertices_, i == 0 ? a : b, d[0], d[1], d[2], gradients, out);
  }
}

}  // namespace stillhook
