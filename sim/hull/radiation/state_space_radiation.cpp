#include "sim/hull/radiation/state_space_radiation.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

// Scratch: h, then six numbers a pole (e, g0, g1), then D of each block.
constexpr int kPropagators = 1;
constexpr int kOfPole = 6;

struct Propagator {
  Complex e, g0, g1;
};

/// The factors of a step of length h for z' = p z + V with V linear.
Propagator propagator(const Complex& p, double h) {
  const Complex x = p * h;
  const Complex e = std::exp(x);
  if (std::abs(x) < 0.05) {
    // The closed forms cancel; the first term left out is x^6/20160 < 1e-12.
    const Complex phi2 =
        1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x / 5040.0))));
    const Complex g1 = h * phi2;
    return {e, h * (1.0 + x * phi2) - g1, g1};
  }
  const Complex phi1 = (e - 1.0) / x;
  const Complex g1 = h * (phi1 - 1.0) / x;
  return {e, h * phi1 - g1, g1};
}

}  // namespace

StateSpaceRadiation::StateSpaceRadiation(const StateSpaceFit& fit) : Radiation(fit.modes) {
  state_size_ = fit.modes;  // the velocity at the last instant comes first
  for (const StateSpaceBlock& b : fit.blocks) {
    const int size = static_cast<int>(b.modes.size()), poles = static_cast<int>(b.K.poles.size());
    blocks_.push_back({static_cast<int>(modes_.size()), size, static_cast<int>(poles_.size()), poles, state_size_,
                       static_cast<int>(residues_.size()), 0});
    modes_.insert(modes_.end(), b.modes.begin(), b.modes.end());
    poles_.insert(poles_.end(), b.K.poles.begin(), b.K.poles.end());
    for (int k = 0; k < poles; ++k) {
      const double factor = b.K.poles[k].imag() == 0.0 ? 1.0 : 2.0;
      const MatrixX re = factor * b.K.residues[k].real(), im = factor * b.K.residues[k].imag();
      residues_.insert(residues_.end(), re.data(), re.data() + re.size());
      residues_.insert(residues_.end(), im.data(), im.data() + im.size());
    }
    state_size_ += 2 * size * poles;
  }
  scratch_size_ = kPropagators + kOfPole * static_cast<int>(poles_.size());
  for (Block& block : blocks_) {
    block.D = scratch_size_;
    scratch_size_ += block.size * block.size;
  }
}

bool StateSpaceRadiation::same_as(const Radiation& other) const {
  const auto* o = dynamic_cast<const StateSpaceRadiation*>(&other);
  return o && o->modes_ == modes_ && o->poles_ == poles_ && o->residues_ == residues_;
}

void StateSpaceRadiation::prepare(double h, double* scratch) const {
  if (scratch[0] == h) return;
  for (const Block& block : blocks_) {
    double* D = scratch + block.D;
    const int entries = block.size * block.size;
    std::fill_n(D, entries, 0.0);
    const double* R = residues_.data() + block.residue;
    for (int k = 0; k < block.poles; ++k, R += 2 * entries) {
      const Propagator of = propagator(poles_[block.first_pole + k], h);
      double* stored = scratch + kPropagators + kOfPole * (block.first_pole + k);
      stored[0] = of.e.real();
      stored[1] = of.e.imag();
      stored[2] = of.g0.real();
      stored[3] = of.g0.imag();
      stored[4] = of.g1.real();
      stored[5] = of.g1.imag();
      for (int n = 0; n < entries; ++n) D[n] += R[n] * stored[4] - R[entries + n] * stored[5];
    }
  }
  scratch[0] = h;
}

void StateSpaceRadiation::start(std::span<const double> V, Memory m) const {
  std::fill(m.state.begin(), m.state.end(), 0.0);
  std::copy(V.begin(), V.end(), m.state.begin());
}

void StateSpaceRadiation::begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const {
  prepare(h, m.scratch.data());
  std::fill(past.begin(), past.end(), 0.0);
  std::fill(D.begin(), D.end(), 0.0);
  const double* V = m.state.data();
  for (const Block& block : blocks_) {
    const int size = block.size;
    const int* mode = modes_.data() + block.first_mode;
    const double* of = m.scratch.data() + kPropagators + kOfPole * block.first_pole;
    const double* z = m.state.data() + block.state;
    const double* R = residues_.data() + block.residue;
    for (int k = 0; k < block.poles; ++k, of += kOfPole, z += 2 * size, R += 2 * size * size)
      for (int j = 0; j < size; ++j) {
        const double v = V[mode[j]];
        const double re = of[0] * z[j] - of[1] * z[size + j] + of[2] * v;
        const double im = of[1] * z[j] + of[0] * z[size + j] + of[3] * v;
        for (int i = 0; i < size; ++i) past[mode[i]] -= R[i + size * j] * re - R[size * (size + j) + i] * im;
      }
    const double* own = m.scratch.data() + block.D;
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) D[mode[i] + modes() * mode[j]] = own[i + size * j];
  }
}

void StateSpaceRadiation::end_step(std::span<const double> V, double h, Memory m) const {
  prepare(h, m.scratch.data());
  double* V_old = m.state.data();
  for (const Block& block : blocks_) {
    const int size = block.size;
    const int* mode = modes_.data() + block.first_mode;
    const double* of = m.scratch.data() + kPropagators + kOfPole * block.first_pole;
    double* z = m.state.data() + block.state;
    for (int k = 0; k < block.poles; ++k, of += kOfPole, z += 2 * size)
      for (int j = 0; j < size; ++j) {
        const double before = V_old[mode[j]], after = V[mode[j]];
        const double re = of[0] * z[j] - of[1] * z[size + j] + of[2] * before + of[4] * after;
        const double im = of[1] * z[j] + of[0] * z[size + j] + of[3] * before + of[5] * after;
        z[j] = re;
        z[size + j] = im;
      }
  }
  std::copy(V.begin(), V.end(), V_old);
}

void StateSpaceRadiation::force(std::span<const double>, Memory m, std::span<double> F) const {
  std::fill(F.begin(), F.end(), 0.0);
  for (const Block& block : blocks_) {
    const int size = block.size;
    const int* mode = modes_.data() + block.first_mode;
    const double* z = m.state.data() + block.state;
    const double* R = residues_.data() + block.residue;
    for (int k = 0; k < block.poles; ++k, z += 2 * size, R += 2 * size * size)
      for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) F[mode[i]] -= R[i + size * j] * z[j] - R[size * (size + j) + i] * z[size + j];
  }
}

void StateSpaceRadiation::instantaneous_damping(std::span<double> D) const { std::fill(D.begin(), D.end(), 0.0); }

}  // namespace stillhook
