// From the solution of a fit to what is reported of it.
#pragma once

#include "tuning/identification.h"
#include "tuning/record_unit.h"

namespace stillhook {

/// The solution: values of the keys and of the records' own unknowns, weights, the prediction at the start values, and the
/// residuals with their derivatives (the records' units in order).
struct EstimateInput {
  const Case& c;
  const FitParameters& parameters;
  const std::vector<RecordModel>& models;
  const VectorX& values;
  const std::vector<VectorX>& own;
  const std::vector<std::vector<double>>& sigma;
  const std::vector<Prediction>& before;
  const std::vector<UnitValues>& units;
};

/// Estimates with intervals, correlations, records with their residuals.
void fill_estimates(const EstimateInput& input, Identification& result);

/// Warnings, and whether the fit can be trusted.
void judge(const Case& c, Identification& result);

}  // namespace stillhook
