// Whether measured values are of the size that the model and the other channels make likely: another size by the factor
// between two usual units is a mistake of units, not a thing to fit.
#pragma once

#include "tuning/prediction.h"

namespace stillhook {

/// Throws CaseError that names the factor when a channel is more than twenty times larger or smaller than simulated, or a
/// rate than the change of its angle, and a usual mistake of units explains it. `simulated`: with the case's own values,
/// from its own start or, where nothing moves then, from the measured one.
void refuse_other_units(const RecordModel& model, const Prediction& simulated);

/// Root mean square about the mean (about zero for one sample), of the values that are there.
double spread_of(const std::vector<double>& values);

}  // namespace stillhook
