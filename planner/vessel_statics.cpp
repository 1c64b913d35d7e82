#include "planner/vessel_statics.h"

#include <numbers>

#include "planner/text_number.h"
#include "sim/hull/hydrostatics.h"

namespace stillhook {
namespace {

/// The middle of the hull's bottom, in B.
Vector3 keel_point(const HullSpec& hull) {
  const MeshProperties box = properties_of(build_hull_mesh(hull));
  return {0.5 * (box.low.x() + box.high.x()), 0.5 * (box.low.y() + box.high.y()), box.low.z()};
}

}  // namespace

std::vector<ReportTable> vessel_tables(const Model& model, const std::vector<StaticPose>& poses) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  std::vector<ReportTable> tables;
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].hull.shape == HullSpec::Shape::none) continue;
    ReportTable table;
    table.title = "Hull of " + bodies[i].name;
    table.note = "Draft at the middle of the hull; heel + port side up, trim + bow down.";
    table.header = {"pose", "draft m", "heel deg", "trim deg", "x m", "y m", "z m", "heading deg"};
    const Vector3 keel = keel_point(bodies[i].hull);
    for (const StaticPose& pose : poses) {
      const Pose& X_WB = pose.bodies[i];
      const RollPitchYaw attitude = roll_pitch_yaw(X_WB.R);
      table.rows.push_back({pose.name, cell(-(X_WB * keel).z(), 3), cell(attitude.roll / kDegree, 3),
                            cell(attitude.pitch / kDegree, 3), cell(X_WB.p.x(), 2), cell(X_WB.p.y(), 2),
                            cell(X_WB.p.z(), 3), cell(attitude.yaw / kDegree, 2)});
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace stillhook
