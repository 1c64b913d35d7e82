#include "sim/hull/radiation/causal_kernels.h"

#include <algorithm>
#include <cmath>

#include "sim/hull/radiation/damping_transform.h"
#include "sim/hull/radiation/state_space_fit.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kInterval = 0.1, kDuration = 60.0;  // s

/// int_0^T K dt, modes x modes.
MatrixX integral(const StateSpaceFit& fit, double T) {
  MatrixX sum = MatrixX::Zero(fit.modes, fit.modes);
  for (const StateSpaceBlock& block : fit.blocks)
    for (std::size_t k = 0; k < block.K.poles.size(); ++k) {
      const Complex p = block.K.poles[k], of_pole = (std::exp(p * T) - 1.0) / p;
      sum(block.modes, block.modes) += (p.imag() == 0.0 ? 1.0 : 2.0) * (of_pole * block.K.residues[k]).real();
    }
  return sum;
}

}  // namespace

RetardationFunctions causal_kernels(const HydrodynamicCoefficients& set) {
  StateSpaceOptions options;
  options.tolerance = 0.02;
  options.acceptable = 0.2;
  StateSpaceFit fit;
  try {
    fit = fit_state_space(set, options).fit;
  } catch (const SpecificationError&) {
    return retardation_from_damping(set.frequency, {kDuration, kInterval});
  }
  const int samples = static_cast<int>(std::lround(kDuration / kInterval)) + 1;
  std::vector<MatrixX> values;
  for (int m = 0; m < samples; ++m) values.push_back(fit.retardation(m * kInterval));
  MatrixX of_samples = -0.5 * (values.front() + values.back());
  for (const MatrixX& value : values) of_samples += value;
  values.front() += 2.0 / kInterval * (integral(fit, kDuration) - kInterval * of_samples);
  RetardationFunctions K;
  K.interval = kInterval;
  for (int i = 0; i < set.modes(); ++i)
    for (int j = 0; j < set.modes(); ++j) {
      RetardationKernel kernel{i, j, {}};
      for (const MatrixX& value : values) kernel.value.push_back(value(i, j));
      if (std::any_of(kernel.value.begin(), kernel.value.end(), [](double v) { return v != 0.0; }))
        K.kernels.push_back(std::move(kernel));
    }
  return K;
}

}  // namespace stillhook
