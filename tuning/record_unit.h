// From records to units of a least-squares problem: weighted differences between simulation and measurement.
//
//   r = (z(p, own) - y) / sigma
//
// Block 0 holds the case keys as shares of their bounds, x = (p - lower)/(upper - lower).
#pragma once

#include "tuning/fit.h"
#include "tuning/prediction.h"

namespace stillhook {

/// The case keys of a fit and what is known of them.
struct FitParameters {
  std::vector<FitParameterSpec> specs;

  VectorX scaled(const VectorX& values) const;
  VectorX values(const VectorX& scaled) const;
  VectorX span() const;  // upper - lower
  /// Of the keys that matter to a record.
  VectorX of(const RecordModel& model, const VectorX& values) const;
};

/// Samples of a record that are there: which channel and which sample each residual belongs to.
struct SampleIndex {
  std::vector<int> channel;
  std::vector<Eigen::Index> sample;
  std::size_t size() const { return channel.size(); }
};
SampleIndex valid_samples(const MeasuredRecord& record);

/// A record as one simulation; blocks: the keys, the record's own. `sigma`: of its channels.
FitUnit record_unit(const RecordModel& model, const FitParameters& parameters, const std::vector<double>& sigma,
                    int own_block, const RunOptions& options = {});

/// What is known beforehand, as residuals of block 0; no residuals if nothing is.
FitUnit prior_unit(const FitParameters& parameters);

}  // namespace stillhook
