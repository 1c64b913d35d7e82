#include "sim/hull/radiation/radiation_memory.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

/// A step that ends this close to a node (in intervals) ends on it.
constexpr double kOnNode = 1e-9;

}  // namespace

RadiationMemory::RadiationMemory(const RetardationFunctions& kernels, int modes)
    : Radiation(modes), interval_(kernels.interval), capacity_(2), force_unit_(modes, 0.0) {
  for (const RetardationKernel& kernel : kernels.kernels) {
    if (std::all_of(kernel.value.begin(), kernel.value.end(), [](double k) { return k == 0.0; })) continue;
    Pair pair{kernel.i, kernel.j, kernel.value, {}, 0.0, 0.0};
    cell_integrals(pair, interval_, pair.cell_new, pair.cell_old);
    // Weights of I_1: the hat function of node m against K one interval later, int K(interval + s) hat(s - m interval).
    const int nodes = static_cast<int>(pair.K.size());
    pair.weights.resize(nodes);
    for (int m = 0; m < nodes; ++m) {
      const double here = sample(pair, m + 1), older = sample(pair, m + 2), newer = sample(pair, m);
      pair.weights[nodes - 1 - m] =
          m == 0 ? interval_ * (2.0 * here + older) / 6.0 : interval_ * (newer + 4.0 * here + older) / 6.0;
    }
    capacity_ = std::max(capacity_, nodes);
    for (const double K : pair.K) force_unit_[pair.i] = std::max(force_unit_[pair.i], std::abs(K));
    pairs_.push_back(std::move(pair));
  }
  layout_.head = 0;
  layout_.offset = 1;
  layout_.sum = clock_size();
  layout_.moment = layout_.sum + modes;
  layout_.at_node = layout_.moment + modes;
  layout_.at_next = layout_.at_node + modes;
  layout_.velocity = layout_.at_next + modes;
  layout_.ring = layout_.velocity + modes;
  layout_.size = layout_.ring + modes * capacity_;
}

double RadiationMemory::sample(const Pair& pair, int m) const {
  return m < static_cast<int>(pair.K.size()) ? pair.K[m] : 0.0;
}

double RadiationMemory::kernel(const Pair& pair, double time) const {
  const double u = time / interval_;
  const int m = static_cast<int>(u);
  const double f = u - m;
  return (1.0 - f) * sample(pair, m) + f * sample(pair, m + 1);
}

void RadiationMemory::cell_integrals(const Pair& pair, double h, double& of_new, double& of_old) const {
  of_new = of_old = 0.0;
  // Products of two straight lines: Simpson's rule is exact on each piece.
  for (double from = 0.0; from < h;) {
    const double to = std::min(h, interval_ * (std::floor(from / interval_ + kOnNode) + 1.0));
    const double middle = 0.5 * (from + to), width = (to - from) / 6.0;
    const double Ka = kernel(pair, from), Kb = kernel(pair, to), Km = 0.5 * (Ka + Kb);
    of_new += width * (Ka * (1.0 - from / h) + 4.0 * Km * (1.0 - middle / h) + Kb * (1.0 - to / h));
    of_old += width * (Ka * from + 4.0 * Km * middle + Kb * to) / h;
    from = to;
  }
}

double RadiationMemory::convolve(const Pair& pair, const double* state) const {
  // The ring holds one row a mode; the newest node is at `head`, so the history lies in at most two stretches.
  const int head = static_cast<int>(state[layout_.head]);
  const int nodes = static_cast<int>(pair.weights.size());
  const int recent = std::min(nodes, head + 1), wrapped = nodes - recent;
  const double* row = state + layout_.ring + pair.j * capacity_;
  using Map = Eigen::Map<const VectorX>;
  double sum = Map(pair.weights.data() + wrapped, recent).dot(Map(row + head + 1 - recent, recent));
  if (wrapped > 0) sum += Map(pair.weights.data(), wrapped).dot(Map(row + capacity_ - wrapped, wrapped));
  return sum;
}

double RadiationMemory::convolve_shifted(const Pair& pair, const double* state, int shift) const {
  const int nodes = std::min(capacity_, static_cast<int>(pair.K.size()) + 1 - shift);
  const double* row = state + layout_.ring + pair.j * capacity_;
  int node = static_cast<int>(state[layout_.head]);
  double sum = 0.0;
  for (int m = 0; m < nodes; ++m) {
    const double newer = m == 0 ? 0.0 : sample(pair, shift + m - 1);
    const double here = (m == 0 ? 2.0 : 4.0) * sample(pair, shift + m);
    sum += (newer + here + sample(pair, shift + m + 1)) * row[node];
    node = node == 0 ? capacity_ - 1 : node - 1;
  }
  return interval_ / 6.0 * sum;
}

double RadiationMemory::stored_force(const double* state, int i, double f) const {
  return force_unit_[i] * ((1.0 - f) * state[layout_.at_node + i] + f * state[layout_.at_next + i]);
}

double RadiationMemory::history_far_ahead(const Pair& pair, const double* state, double u) const {
  const int q = static_cast<int>(u + kOnNode);
  const double f = std::max(0.0, u - q);
  double result = (1.0 - f) * convolve_shifted(pair, state, q);
  if (f > kOnNode) result += f * convolve_shifted(pair, state, q + 1);
  return result;
}

void RadiationMemory::start(std::span<const double> V, Memory m) const {
  std::fill(m.state.begin(), m.state.end(), 0.0);
  double* state = m.state.data();
  std::copy(V.begin(), V.end(), state + layout_.velocity);
  add_node(V.data(), state);
}

void RadiationMemory::begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const {
  const double* state = m.state.data();
  const double offset = state[layout_.offset];
  const double u = (offset + h) / interval_;
  std::fill(D.begin(), D.end(), 0.0);
  // Up to one interval after the node the two stored sums serve.
  const bool stored = u <= 1.0 + kOnNode;
  const double f = std::min(u, 1.0);
  for (int i = 0; i < modes(); ++i) past[i] = stored ? -stored_force(state, i, f) : 0.0;
  for (const Pair& pair : pairs_) {
    double of_new, of_old;
    cell_integrals(pair, h, of_new, of_old);
    D[pair.i + modes() * pair.j] += of_new;
    double sum = of_old * state[layout_.velocity + pair.j];
    if (!stored) sum += history_far_ahead(pair, state, u);
    if (offset > 0.0) {
      const double K_start = kernel(pair, h), K_node = kernel(pair, offset + h);
      sum += K_node * state[layout_.sum + pair.j] + (K_start - K_node) / offset * state[layout_.moment + pair.j];
    }
    past[pair.i] -= sum;
  }
}

void RadiationMemory::force(std::span<const double>, Memory m, std::span<double> F) const {
  const double* state = m.state.data();
  const double offset = state[layout_.offset], f = offset / interval_;
  for (int i = 0; i < modes(); ++i) F[i] = -stored_force(state, i, f);
  if (offset <= 0.0) return;
  for (const Pair& pair : pairs_) {
    const double K_now = pair.K[0], K_node = kernel(pair, offset);
    F[pair.i] -= K_node * state[layout_.sum + pair.j] + (K_now - K_node) / offset * state[layout_.moment + pair.j];
  }
}

void RadiationMemory::instantaneous_damping(std::span<double> D) const { std::fill(D.begin(), D.end(), 0.0); }

void RadiationMemory::add_node(const double* V, double* state) const {
  const int old_head = static_cast<int>(state[layout_.head]);
  const int head = (old_head + 1) % capacity_;
  state[layout_.head] = head;
  for (int j = 0; j < modes(); ++j) state[layout_.ring + j * capacity_ + head] = V[j];
  for (int i = 0; i < modes(); ++i) {
    state[layout_.at_node + i] = state[layout_.at_next + i];
    state[layout_.at_next + i] = 0.0;
  }
  for (const Pair& pair : pairs_) {
    const double before = state[layout_.ring + pair.j * capacity_ + old_head];
    const double unit = force_unit_[pair.i];
    state[layout_.at_node + pair.i] += (pair.cell_new * V[pair.j] + pair.cell_old * before) / unit;
    state[layout_.at_next + pair.i] += convolve(pair, state) / unit;
  }
}

void RadiationMemory::end_step(std::span<const double> V, double h, Memory m) const {
  double* state = m.state.data();
  double* V_old = state + layout_.velocity;
  double offset = state[layout_.offset], left = h;
  // Each node the step passes closes a cell.
  while (left > 0.0) {
    const bool reaches_node = offset + left >= interval_ * (1.0 - kOnNode);
    const double width = reaches_node ? interval_ - offset : left;
    const double share = std::min(1.0, width / left);
    for (int j = 0; j < modes(); ++j) {
      const double V_new = V_old[j] + share * (V[j] - V_old[j]);
      state[layout_.sum + j] += 0.5 * width * (V_old[j] + V_new);
      state[layout_.moment + j] +=
          width * (V_old[j] * (offset / 2.0 + width / 6.0) + V_new * (offset / 2.0 + width / 3.0));
      V_old[j] = V_new;
    }
    offset += width;
    left -= width;
    if (!reaches_node) break;
    add_node(V_old, state);
    std::fill_n(state + layout_.sum, modes(), 0.0);
    std::fill_n(state + layout_.moment, modes(), 0.0);
    offset = 0.0;
    if (left < kOnNode * interval_) break;
  }
  std::copy_n(V.data(), modes(), V_old);
  state[layout_.offset] = offset;
}

}  // namespace stillhook
