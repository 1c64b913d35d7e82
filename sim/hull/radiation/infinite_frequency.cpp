#include "sim/hull/radiation/infinite_frequency.h"

#include <algorithm>

#include "sim/hull/radiation/damping_transform.h"

namespace stillhook {
namespace {

constexpr double kLowerPart = 0.6;  // of the highest frequency

}  // namespace

MatrixX infinite_added_mass(const std::vector<FrequencyCoefficients>& table) {
  const RetardationFunctions K = retardation_from_damping(table);
  const double highest = table.back().frequency;
  std::vector<MatrixX> found;
  for (const FrequencyCoefficients& f : table)
    if (f.frequency > 0.0 && (f.frequency <= kLowerPart * highest || found.empty()))
      found.push_back(f.A - added_mass_from_kernels(MatrixX::Zero(f.A.rows(), f.A.cols()), K, f.frequency));
  MatrixX A_inf(found[0].rows(), found[0].cols());
  std::vector<double> values(found.size());
  for (Eigen::Index i = 0; i < A_inf.rows(); ++i)
    for (Eigen::Index j = 0; j < A_inf.cols(); ++j) {
      for (std::size_t n = 0; n < found.size(); ++n) values[n] = found[n](i, j);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      A_inf(i, j) = *middle;
    }
  return A_inf;
}

}  // namespace stillhook
