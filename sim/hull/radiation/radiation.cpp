#include "sim/hull/radiation/radiation.h"

#include <algorithm>
#include <utility>

namespace stillhook {

using VectorMap = Eigen::Map<const VectorX>;

ConstantRadiation::ConstantRadiation(MatrixX B) : Radiation(static_cast<int>(B.rows())), B_(std::move(B)) {}

void ConstantRadiation::begin_step(double, Memory, std::span<double> past, std::span<double> D) const {
  std::fill(past.begin(), past.end(), 0.0);
  instantaneous_damping(D);
}

void ConstantRadiation::force(std::span<const double> V, Memory, std::span<double> F) const {
  Eigen::Map<VectorX>(F.data(), modes()).noalias() = -B_ * VectorMap(V.data(), modes());
}

void ConstantRadiation::instantaneous_damping(std::span<double> D) const {
  std::copy_n(B_.data(), B_.size(), D.begin());
}

double ConstantRadiation::radiated_power(std::span<const double> V) const {
  double power = 0.0;
  for (int j = 0; j < modes(); ++j)
    for (int i = 0; i < modes(); ++i) power += V[i] * B_(i, j) * V[j];
  return power;
}

}  // namespace stillhook
