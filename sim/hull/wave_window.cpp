#include "sim/hull/wave_window.h"

#include <algorithm>
#include <cmath>

namespace stillhook {

namespace {

// Below this many components a direct sample costs less than an expansion and its use.
constexpr std::size_t kFewComponents = 8;
constexpr double kNever = -1e30;          // s, the time of a node that is none
constexpr double kTouch = 1e-9;           // s
constexpr double kLinearAccuracy = 1e-4;  // of the rms elevation, at the end of near()
constexpr double kFarthestLinear = 0.1;   // m

// offset + r direction, point by point.
auto along(const Eigen::Ref<const MatrixX>& r, double offset, const Vector3& direction) {
  return offset + direction[0] * r.col(0).array() + direction[1] * r.col(1).array() + direction[2] * r.col(2).array();
}

double linear_reach(const WaveField& waves) {
  double energy = 0.0, second = 0.0;  // sums of a^2, (a k^2)^2
  for (const WaveComponent& c : waves.components()) {
    energy += c.amplitude * c.amplitude;
    second += std::pow(c.amplitude * c.wavenumber * c.wavenumber, 2);
  }
  if (!(second > 0.0)) return kFarthestLinear;
  return std::min(kFarthestLinear, std::sqrt(2.0 * kLinearAccuracy / std::sqrt(second / energy)));
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

// A part of the scratch: the node that the values belong to, how many vertices have them, the largest elevation of a
// step's values, the values.
struct WaveWindow::Slot {
  static constexpr std::size_t kHead = kNodeSize + 2;
  double *node, *count, *highest, *values;

  bool belongs_to(const double* n) const { return std::equal(n, n + kNodeSize, node); }
  void take(const double* n) {
    if (belongs_to(n)) return;
    std::copy(n, n + kNodeSize, node);
    *count = *highest = 0.0;
  }
};

WaveWindow::WaveWindow(std::shared_ptr<const WaveField> waves, std::size_t vertices, double radius)
    : waves_(std::move(waves)), vertices_(vertices), radius_(radius), near_(linear_reach(*waves_)) {
  if (waves_->components().size() > kFewComponents) expansion_ = std::make_shared<WaveExpansion>(waves_);
}

// The step's slot, those of the series, places.
int WaveWindow::scratch_size() const {
  const std::size_t series = expansion_ ? kNodes * (Slot::kHead + kExpansionTerms * vertices_) : 0;
  return static_cast<int>(Slot::kHead + kLinear * vertices_ + series + 3 * vertices_);
}

void WaveWindow::start(std::span<double> state) const {
  for (std::size_t i = 0; i < state.size(); i += kNodeSize) state[i] = kNever;
  for (int i = 1; i <= 2; ++i) state[state.size() - static_cast<std::size_t>(i * kMotionSize)] = kNever;
}

bool WaveWindow::series_hold(double t, std::span<const double> state) const {
  return expansion_ && t >= state[2 * kNodeSize] - kTouch && t <= state[3 * kNodeSize] + kTouch;
}

void WaveWindow::begin_step(double t, double h, const BodyKinematics& body, std::span<double> state) const {
  // Adams and Bashforth's rule of the third order through the velocities of the last two steps, where these were as
  // long.
  double *last = state.data() + state.size() - 2 * kMotionSize, *earlier = last + kMotionSize;
  const auto v = [](double* motion) { return Eigen::Map<Vector3>(motion + 1); };
  const auto w = [](double* motion) { return Eigen::Map<Vector3>(motion + 4); };
  const auto steps_ago = [&](const double* motion, int n) { return std::abs(t - *motion - n * h) < 1e-6 * h; };
  BodyKinematics mean = body;  // over the step to come
  if (steps_ago(last, 1) && steps_ago(earlier, 2)) {
    mean.v_WC = (23.0 * body.v_WC - 16.0 * v(last) + 5.0 * v(earlier)) / 12.0;
    mean.w_B = (23.0 * body.w_B - 16.0 * w(last) + 5.0 * w(earlier)) / 12.0;
  } else if (steps_ago(last, 1)) {
    mean.v_WC = 1.5 * body.v_WC - 0.5 * v(last);
    mean.w_B = 1.5 * body.w_B - 0.5 * w(last);
  }
  std::copy_n(last, kMotionSize, earlier);
  *last = t;
  v(last) = body.v_WC;
  w(last) = body.w_B;
  Node::expected(t, mean, h).write(state.data());
  if (!expansion_) return;
  double *first = state.data() + kNodeSize, *second = first + kNodeSize, *third = second + kNodeSize;
  const double H = expansion_->interval();
  if (h > H) {  // steps longer than the interval take the sea as it is
    *first = *second = *third = kNever;
    return;
  }
  bool lost = !series_hold(t, state);
  if (!lost) {
    const Node a = Node::of(second), b = Node::of(third);
    const double s = (t - a.t) / (b.t - a.t);
    const double away =
        (body.p_WC - (1.0 - s) * a.p - s * b.p).norm() + radius_ * (body.R_WB - (1.0 - s) * a.R - s * b.R).norm();
    lost = away > expansion_->reach();
  }
  if (lost) {
    Node::expected(t, body, -H).write(first);
    Node::expected(t, body, 0.0).write(second);
    Node::expected(t, body, H).write(third);
  }
  if (series_hold(t + h, state)) return;
  std::copy(second, third + kNodeSize, first);
  Node::expected(t, body, *second + H - t).write(third);
}

WaveWindow::Slot WaveWindow::slot(double* at) const {
  return {at, at + kNodeSize, at + kNodeSize + 1, at + Slot::kHead};
}

void WaveWindow::places(const Node& node, const Eigen::Ref<const MatrixX>& r, Memory m,
                        std::span<double> (&x)[3]) const {
  double* place = m.scratch.data() + m.scratch.size() - 3 * vertices_;
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] = {place + static_cast<std::size_t>(axis) * vertices_, static_cast<std::size_t>(r.rows())};
    VectorX::Map(x[axis].data(), r.rows()).array() = along(r, node.p[axis], node.R.row(axis));
  }
}

WaveWindow::Slot WaveWindow::series_of(int node, Memory m, const Eigen::Ref<const MatrixX>& r) const {
  const double* nodes = m.state.data() + kNodeSize;
  const double* wanted = nodes + node * kNodeSize;
  const std::size_t size = Slot::kHead + kExpansionTerms * vertices_;
  double* slots = m.scratch.data() + Slot::kHead + kLinear * vertices_;
  // Its own one, else one that belongs to no other node.
  int chosen = -1;
  for (int i = 0; i < kNodes && chosen < 0; ++i)
    if (slot(slots + static_cast<std::size_t>(i) * size).belongs_to(wanted)) chosen = i;
  for (int i = 0; i < kNodes && chosen < 0; ++i) {
    bool taken = false;
    for (int other = 0; other < kNodes; ++other)
      taken |= slot(slots + static_cast<std::size_t>(i) * size).belongs_to(nodes + other * kNodeSize);
    if (!taken) chosen = i;
  }
  Slot s = slot(slots + static_cast<std::size_t>(chosen) * size);
  s.take(wanted);
  const auto have = static_cast<Eigen::Index>(*s.count), want = r.rows();
  if (have >= want) return s;
  std::span<double> x[3];
  places(Node::of(wanted), r.bottomRows(want - have), m, x);
  expansion_->expand(*wanted, x[0], x[1], x[2], vertices_, s.values + have);
  *s.count = static_cast<double>(want);
  return s;
}

// The sea with its slopes at the vertices from `first` on of a hull at the node `at`.
double WaveWindow::look_up(const Node& at, const Eigen::Ref<const MatrixX>& all, std::size_t first, Memory m,
                           const WaveSamples& out) const {
  const auto skipped = static_cast<Eigen::Index>(first);
  const auto r = all.bottomRows(all.rows() - skipped);
  std::span<double> x[3];
  if (!m.state.empty() && series_hold(at.t, m.state)) {
    for (const std::span<double> v :
         {out.elevation, out.elevation_x, out.elevation_y, out.head, out.head_x, out.head_y})
      std::ranges::fill(v, 0.0);
    std::ranges::fill(out.head_z, -1.0);
    const Node nodes[kNodes] = {Node::of(&m.state[kNodeSize]), Node::of(&m.state[2 * kNodeSize]),
                                Node::of(&m.state[3 * kNodeSize])};
    const double H = expansion_->interval();
    const auto weights = hermite_weights((at.t - nodes[1].t) / H, H);
    for (int i = 0; i < kNodes; ++i) {
      const Slot series = series_of(i, m, all);
      places({0.0, at.p - nodes[i].p, at.R - nodes[i].R}, r, m, x);
      WaveExpansion::add(series.values + first, vertices_, weights[static_cast<std::size_t>(i)], x[0], x[1], x[2], out);
    }
    places(at, r, m, x);
    for (std::size_t i = 0; i < x[2].size(); ++i) out.head[i] -= x[2][i];
  } else {
    places(at, r, m, x);
    waves_->sample(at.t, x[0], x[1], x[2], true, out);
  }
  double highest = 0.0;
  for (std::size_t i = 0; i < x[2].size(); ++i) {
    highest = std::max(highest, std::abs(out.elevation[i]));
    out.elevation[i] -= x[2][i];
  }
  return highest;
}

WaveWindow::Slot WaveWindow::linear_in(const double* node, Memory m, const Eigen::Ref<const MatrixX>& r) const {
  Slot s = slot(m.scratch.data());
  s.take(node);
  const auto have = static_cast<std::size_t>(*s.count), want = static_cast<std::size_t>(r.rows());
  if (have >= want) return s;
  const auto part = [&](std::size_t i) { return std::span(s.values + i * vertices_ + have, want - have); };
  *s.highest = std::max(
      *s.highest, look_up(Node::of(node), r, have, m, {part(0), part(1), part(2), part(3), part(4), part(5), part(6)}));
  *s.count = static_cast<double>(want);
  return s;
}

double WaveWindow::sample(double t, const BodyKinematics& body, const Eigen::Ref<const MatrixX>& r, bool gradients,
                          Memory m, const WaveSamples& out) const {
  const auto n = static_cast<std::size_t>(r.rows());
  if (n == 0) return 0.0;
  const Node here = Node::expected(t, body, 0.0);
  Node at = here;
  if (!m.state.empty() && std::abs(t - m.state[0]) <= kTouch) at = Node::of(m.state.data());
  if ((here.p - at.p).norm() + radius_ * (here.R - at.R).norm() > near_) at = here;
  double key[kNodeSize];
  at.write(key);
  const Slot linear = linear_in(key, m, r);
  const double* v = linear.values;

  const Vector3 d = here.p - at.p;
  const Matrix3 D = here.R - at.R;
  const double *r0 = r.col(0).data(), *r1 = r.col(1).data(), *r2 = r.col(2).data();
  const double *zeta = v, *zeta_x = v + vertices_, *zeta_y = zeta_x + vertices_, *head = zeta_y + vertices_,
               *head_x = head + vertices_, *head_y = head_x + vertices_, *head_z = head_y + vertices_;
  double *to_depth = out.elevation.data(), *to_head = out.head.data();
  const bool heads = !out.head.empty();
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    const double x = d[0] + D(0, 0) * r0[i] + D(0, 1) * r1[i] + D(0, 2) * r2[i];
    const double y = d[1] + D(1, 0) * r0[i] + D(1, 1) * r1[i] + D(1, 2) * r2[i];
    const double z = d[2] + D(2, 0) * r0[i] + D(2, 1) * r1[i] + D(2, 2) * r2[i];
    to_depth[i] = zeta[i] + zeta_x[i] * x + zeta_y[i] * y - z;
    if (heads) to_head[i] = head[i] + head_x[i] * x + head_y[i] * y + head_z[i] * z;
  }
  if (!gradients) return *linear.highest;
  std::copy_n(zeta_x, n, out.elevation_x.data());
  std::copy_n(zeta_y, n, out.elevation_y.data());
  if (!heads) return *linear.highest;
  std::copy_n(head_x, n, out.head_x.data());
  std::copy_n(head_y, n, out.head_y.data());
  std::copy_n(head_z, n, out.head_z.data());
  return *linear.highest;
}

}  // namespace stillhook
