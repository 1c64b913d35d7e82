// How well a least-squares fit knows what it found, with residuals that may be coloured.
//
//   Cov = H^-1 M H^-1      H = J^T D J + P      M = sum over records and channels, lags l  of  gamma_l w_l J_i^T J_(i+l)  + P
//
// J derivatives of the weighted residuals, D 1 where Huber's loss is quadratic and 0 beyond, P the priors' part, gamma_l
// the autocovariance of the residuals as the loss bends them, w_l Bartlett's taper over twice the lags on which it is
// distinguishable from zero (Newey & West 1987; Huber 1981, ch. 6). White residuals leave the usual s^2 (J^T J)^-1; an
// interval is never made narrower than that. Unknowns that are held at a bound have no interval: Cov is of the others.
#pragma once

#include <string>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

/// The residuals of one channel of one record, on even samples.
struct ResidualSeries {
  VectorX r;                            // weighted; only those that are there
  std::vector<Eigen::Index> sample;     // index of each on the even grid
  MatrixX J;                            // rows as r, columns all unknowns
};

struct Autocorrelation {
  std::vector<double> rho;  // by lag from 0; as long as it is distinguishable from zero
  double variance = 0.0;
  /// Samples that tell as much as one independent one.
  double time() const;
};

/// Of a series with gaps; `bent`: as the loss bends it.
Autocorrelation autocorrelation(const VectorX& bent, const std::vector<Eigen::Index>& sample);

struct Uncertainty {
  MatrixX covariance;         // of all unknowns; zero rows for those that are held
  MatrixX white;              // the same if residuals were white
  std::vector<bool> unknown;  // no data say anything about it
  /// Directions that the data leave open: unit vectors in unknowns scaled to equal weight.
  std::vector<VectorX> open;
  VectorX sd() const { return covariance.diagonal().cwiseMax(0.0).cwiseSqrt(); }
  MatrixX correlation() const;
};

/// `robust`: Huber's threshold. `prior`: P. `held`: unknowns at a bound.
Uncertainty uncertainty_of(const std::vector<ResidualSeries>& series, const MatrixX& prior, double robust,
                           const std::vector<bool>& held);

}  // namespace stillhook
