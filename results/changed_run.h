// A run as it would be, to first order, with one parameter a little changed: so any number computed from a run can be
// differentiated by computing it twice.
//
//   z(t; p + by) = z(t) + by dz/dp        extremes, phase times and static poses likewise; contact events are kept
//
// `by` is of the size that a twin lift differs by (tangent.h), so what is left out is of second order in 1e-4.
#pragma once

#include "sim/tangent.h"

namespace stillhook {

/// The part of a run that its tangents know: the channels of the request, in its order.
Trajectory reduced_run(const Trajectory& run, const Tangents& tangents);

/// `reduced` with parameter j changed by `by`; `poses` are the static poses for that value. Throws
/// std::invalid_argument if run and tangents do not belong together.
Trajectory changed_run(const Trajectory& reduced, const Tangents& tangents, int j, double by,
                       const std::vector<StaticPose>& poses);

}  // namespace stillhook
