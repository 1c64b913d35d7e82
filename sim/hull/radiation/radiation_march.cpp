#include "sim/hull/radiation/radiation_march.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace stillhook {
namespace {

// State: time since the last node; then six or twelve numbers each: force at the three latest middles, oldest first;
// velocity at the instant; then the waves.
constexpr int kForces = 3;
constexpr std::size_t kMostModes = 24;

}  // namespace

RadiationMarch::RadiationMarch(std::shared_ptr<const rankine::PanelMarch> march, const VectorX& factor)
    : Radiation(march->modes()), march_(std::move(march)), factor_(factor.data(), factor.data() + factor.size()) {}

int RadiationMarch::state_size() const { return 1 + (kForces + 1) * modes() + march_->state_size(); }

void RadiationMarch::start(std::span<const double> V, Memory m) const {
  std::fill(m.state.begin(), m.state.end(), 0.0);
  const int n = modes();
  step(V, m.state);
  std::copy(V.begin(), V.end(), m.state.begin() + 1 + kForces * n);
}

void RadiationMarch::step(std::span<const double> V, std::span<double> state) const {
  const std::size_t n = static_cast<std::size_t>(modes());
  std::array<double, kMostModes> felt;
  for (std::size_t i = 0; i < n; ++i) felt[i] = factor_[i] * V[i];
  const std::span<double> newest = state.subspan(1 + (kForces - 1) * n, n);
  march_->step({felt.data(), n}, state.subspan(1 + (kForces + 1) * n), newest);
  for (std::size_t i = 0; i < n; ++i) newest[i] *= factor_[i];
}

void RadiationMarch::force_at(const double* state, double time, std::span<double> F) const {
  // Middles at -3/2, -1/2, 1/2 of the march's step from the last node.
  const double u = time / march_->dt();
  const std::array<double, kForces> weight{0.5 * (u + 0.5) * (u - 0.5), -(u + 1.5) * (u - 0.5),
                                           0.5 * (u + 1.5) * (u + 0.5)};
  const int n = modes();
  for (int i = 0; i < n; ++i) {
    F[i] = 0.0;
    for (int k = 0; k < kForces; ++k) F[i] += weight[k] * state[1 + k * n + i];
  }
}

void RadiationMarch::begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const {
  force_at(m.state.data(), m.state[0] + h, past);
  std::fill(D.begin(), D.end(), 0.0);
}

void RadiationMarch::end_step(std::span<const double> V, double h, Memory m) const {
  const int n = modes();
  double* before = m.state.data() + 1 + kForces * n;
  double time = m.state[0] + h;
  // 1e-9 s: steps that add up to the march's own but for rounding reach the node.
  while (time >= march_->dt() - 1e-9) {
    time -= march_->dt();
    // Velocity at the node, linear within the step.
    std::array<double, kMostModes> at_node;
    const double late = std::clamp(time / h, 0.0, 1.0);
    for (int i = 0; i < n; ++i) at_node[i] = V[i] + late * (before[i] - V[i]);
    double* forces = m.state.data() + 1;
    std::copy(forces + n, forces + kForces * n, forces);
    step({at_node.data(), static_cast<std::size_t>(n)}, m.state);
  }
  m.state[0] = std::max(0.0, time);
  std::copy(V.begin(), V.end(), before);
}

void RadiationMarch::force(std::span<const double> /*V*/, Memory m, std::span<double> F) const {
  force_at(m.state.data(), m.state[0], F);
}

void RadiationMarch::instantaneous_damping(std::span<double> D) const { std::fill(D.begin(), D.end(), 0.0); }

}  // namespace stillhook
