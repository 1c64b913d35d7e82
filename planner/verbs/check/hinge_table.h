// How far the hinged bodies of a lift are turned, pose by pose.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/operation.h"

namespace stillhook {

/// One column a body that hangs on a revolute joint: of one that luffs the angle of its x axis above the deck, of one
/// that slews the heading of its x axis from the bow. Angles are in the axes of the vessel under the body, deg.
ReportTable hinge_table(const Model& model, const std::vector<StaticPose>& poses);

}  // namespace stillhook
