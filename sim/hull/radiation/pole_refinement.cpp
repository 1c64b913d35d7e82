#include "sim/hull/radiation/pole_refinement.h"

#include <algorithm>
#include <cmath>

#include "sim/hull/radiation/passivity.h"

namespace stillhook {
namespace {

using Complex = std::complex<double>;

constexpr int kRefinementSteps = 25;
constexpr double kStep = 1e-4;          // of the coordinates, for differences
constexpr double kEnough = 1e-3;        // relative gain of an iteration below which the search ends
constexpr double kLargestStep = 0.3;    // of a coordinate: poles change by no more than a third at a time
constexpr double kLeastZeta = 0.02;  // -Re p/|p|, as in vector fitting

/// Coordinates in which every value is a stable pole: log |p|, and for a pair log(zeta/(1 - zeta)), zeta = -Re p/|p|.
VectorX coordinates(const std::vector<Complex>& poles) {
  std::vector<double> x;
  for (const Complex& p : poles) {
    x.push_back(std::log(std::abs(p)));
    if (p.imag() == 0.0) continue;
    const double zeta = -p.real() / std::abs(p);
    x.push_back(std::log(zeta / (1.0 - zeta)));
  }
  return Eigen::Map<const VectorX>(x.data(), static_cast<int>(x.size()));
}

std::vector<Complex> poles_at(const VectorX& x, const std::vector<Complex>& like, double fastest) {
  std::vector<Complex> poles;
  int n = 0;
  for (const Complex& p : like) {
    const double size = std::min(std::exp(x(n++)), fastest);
    if (p.imag() == 0.0) {
      poles.push_back({-size, 0.0});
    } else {
      const double zeta = std::clamp(1.0 / (1.0 + std::exp(-x(n++))), kLeastZeta, 0.9999);
      poles.push_back(size * Complex(-zeta, std::sqrt(1.0 - zeta * zeta)));
    }
  }
  return poles;
}

class Residual {
 public:
  Residual(const std::vector<Complex>& like, const TransferSamples& samples, int m, double w0, double floor)
      : like_(like), samples_(samples), m_(m), w0_(w0), floor_(floor), fastest_(10.0 * samples.frequency.back()) {}

  std::vector<Complex> poles(const VectorX& x) const { return poles_at(x, like_, fastest_); }
  VectorX operator()(const VectorX& x) const {
    const PoleResidue model = fit_nearly_passive_residues(PoleBasis(poles(x)), samples_, m_, w0_, floor_);
    const int n = static_cast<int>(samples_.frequency.size());
    VectorX r(2 * n * static_cast<int>(samples_.entries.size()));
    for (int k = 0; k < n; ++k) {
      const MatrixXc K = model.transfer({0.0, samples_.frequency[k]});
      const double weight = std::sqrt(samples_.weight[k]);
      for (int i = 0, e = 0; i < m_; ++i)
        for (int j = i; j < m_; ++j, ++e) {
          const Complex error = weight * (K(i, j) - samples_.entries[e][k]);
          r(2 * (n * e + k)) = error.real();
          r(2 * (n * e + k) + 1) = error.imag();
        }
    }
    return r;
  }

 private:
  const std::vector<Complex>& like_;
  const TransferSamples& samples_;
  int m_;
  double w0_, floor_, fastest_;
};

}  // namespace

std::vector<Complex> refine_poles(const std::vector<Complex>& poles, const TransferSamples& samples, int m, double w0,
                                  double floor) {
  const Residual residual(poles, samples, m, w0, floor);
  VectorX x = coordinates(poles);
  VectorX r = residual(x);
  double damping = 1e-3;
  for (int n = 0; n < kRefinementSteps; ++n) {
    MatrixX J(r.size(), x.size());
    for (int c = 0; c < x.size(); ++c) {
      VectorX moved = x;
      moved(c) += kStep;
      J.col(c) = (residual(moved) - r) / kStep;
    }
    const MatrixX H = J.transpose() * J;
    const VectorX gradient = J.transpose() * r;
    const double before = r.squaredNorm();
    double after = before;
    while (after >= before && damping < 1e4) {
      MatrixX damped = H;
      damped.diagonal().array() += damping * (H.diagonal().array() + 1e-3 * H.diagonal().maxCoeff());
      VectorX step = -damped.ldlt().solve(gradient);
      const double longest = step.cwiseAbs().maxCoeff();
      if (longest > kLargestStep) step *= kLargestStep / longest;
      const VectorX tried = residual(x + step);
      if (tried.squaredNorm() < before) {
        x += step;
        r = tried;
        after = r.squaredNorm();
        damping = std::max(1e-7, 0.2 * damping);
      } else {
        damping *= 5.0;
      }
    }
    if (after > (1.0 - kEnough) * before) break;
  }
  return residual.poles(x);
}

}  // namespace stillhook
