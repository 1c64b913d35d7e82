// A symmetric rational matrix as poles and residues, and the fit of one to samples.
//
//   K(s) = sum_k R_k/(s - p_k) + conj. R_k/(s - conj p_k)        every pole is shared by all entries (i, j)
//
// Poles by relaxed vector fitting (Gustavsen & Semlyen 1999; Gustavsen 2006; one QR an entry as in Deschrijver et al.
// 2008): a rational weight with the poles of the last iteration is fitted together with the entries, and its zeros are
// the next poles. A pole that leaves the left half plane is mirrored back into it, so the result is always stable.
// Residues by least squares, with K(0) = 0 built in: a hull that is displaced and left there feels no radiation force.
#pragma once

#include <complex>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

using MatrixXc = Eigen::MatrixXcd;

struct PoleResidue {
  std::vector<std::complex<double>> poles;  // rad/s, Re < 0; of a conjugate pair the one with Im > 0, else Im = 0
  std::vector<MatrixXc> residues;           // symmetric; real where the pole is

  int size() const { return residues.empty() ? 0 : static_cast<int>(residues[0].rows()); }
  int order() const;  // poles counted with their conjugates
  MatrixXc transfer(std::complex<double> s) const;
  /// The inverse transform at t >= 0.
  MatrixX impulse_response(double t) const;
};

/// Samples of the entries (i, j >= i) of K(i w).
struct TransferSamples {
  std::vector<double> frequency;                           // rad/s, ascending, > 0
  std::vector<double> weight;                              // of the squared error at each frequency
  std::vector<std::vector<std::complex<double>>> entries;  // [entry][frequency]; entries of comparable size
};

/// The real functions of w that multiply the real parameters of a set of poles: one a real pole (its residue), two a
/// pair (real and imaginary part of its residue).
class PoleBasis {
 public:
  explicit PoleBasis(std::vector<std::complex<double>> poles);

  const std::vector<std::complex<double>>& poles() const { return poles_; }
  int order() const { return order_; }
  /// 1/(s - p) of a real pole; 1/(s - p) + 1/(s - conj p) and i/(s - p) - i/(s - conj p) of a pair. Length order.
  Eigen::RowVectorXcd functions(std::complex<double> s) const;
  /// Columns span the parameters with K(0) = 0. order x (order - 1), orthonormal.
  const MatrixX& zero_at_rest() const { return zero_at_rest_; }
  /// The residue of pole k from an entry's parameters.
  std::complex<double> residue(const VectorX& parameters, int k) const;

 private:
  std::vector<std::complex<double>> poles_;
  std::vector<int> first_;  // parameter of each pole
  int order_;
  MatrixX zero_at_rest_;
};

/// Poles for `order` states per input. Throws std::invalid_argument unless 2 <= order < number of frequencies.
std::vector<std::complex<double>> fit_poles(const TransferSamples& samples, int order);

}  // namespace stillhook
