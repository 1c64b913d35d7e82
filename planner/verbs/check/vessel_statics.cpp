#include "planner/verbs/check/vessel_statics.h"


#include "planner/text_number.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/immersion.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/wire.h"
#include "sim/multibody/assembly.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// The middle of the hull's bottom, in B.
Vector3 keel_point(const HullSpec& hull) {
  const MeshProperties box = properties_of(build_hull_mesh(hull));
  return {0.5 * (box.low.x() + box.high.x()), 0.5 * (box.low.y() + box.high.y()), box.low.z()};
}

/// Mass and first moment of what a vessel carries.
struct Burden {
  double mass = 0.0;                 // kg
  Vector3 moment = Vector3::Zero();  // kg m, about Wo
  void add(double m, const Vector3& p) {
    mass += m;
    moment += m * p;
  }
};

/// What the hull carries in a pose: its joined bodies; what hangs from them on wires, at the upper ends; what stands on
/// them, at its centre of gravity.
Burden burden_of(const Model& model, const StaticPose& pose, int hull) {
  const Specification& s = model.specification();
  const std::vector<bool> joined = jointed_to(model.system(), hull);
  const auto carried = [&](const std::string& body) { return body != "world" && joined[model.body_index(body)]; };
  Burden burden;
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (joined[i]) burden.add(s.bodies[i].mass, pose.bodies[i] * s.bodies[i].cog);
  for (const WireSpec& w : s.wires) {
    if (!carried(w.from) || carried(w.to) || w.to == "world") continue;
    const Vector3 upper = pose.bodies[model.body_index(w.from)] * w.point_from;
    const Vector3 lower = pose.bodies[model.body_index(w.to)] * w.point_to;
    const double vertical = pose.values.at(wire_channels::tension.of(w)) * (upper - lower).normalized().z();
    burden.add(vertical / s.sea.gravity, upper);
  }
  for (const ContactSpec& c : s.contacts) {
    if (!carried(c.surface_body) || carried(c.body)) continue;
    const int body = model.body_index(c.body);
    burden.add(pose.values.at(contact_channels::force.of(c)) / s.sea.gravity, pose.bodies[body] * s.bodies[body].cog);
  }
  return burden;
}

}  // namespace

std::vector<ReportTable> vessel_tables(const Model& model, const std::vector<StaticPose>& poses) {
  std::vector<ReportTable> tables;
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].floats()) continue;
    ReportTable table;
    table.title = "Hull of " + bodies[i].name;
    table.note =
        "Draft at the middle of the hull; heel + port side up, trim + bow down. GM with hanging loads at their upper "
        "ends; tanks count as solid.";
    table.header = {"pose", "draft m", "heel deg", "trim deg",   "GM transverse m", "GM longitudinal m",
                    "x m",  "y m",     "z m",      "heading deg"};
    const Mesh mesh = build_hull_mesh(bodies[i].hull);
    const Vector3 keel = keel_point(bodies[i].hull);
    for (const StaticPose& pose : poses) {
      const Pose& X_WB = pose.bodies[i];
      const RollPitchYaw attitude = roll_pitch_yaw(X_WB.R);
      const Burden burden = burden_of(model, pose, static_cast<int>(i));
      const MetacentricHeights GM = metacentric_heights(immersion_of(mesh, X_WB), burden.mass,
                                                        burden.moment / burden.mass, model.specification().sea.density);
      table.rows.push_back({pose.name, cell(-(X_WB * keel).z(), 3), cell(attitude.roll / kDegree, 3),
                            cell(attitude.pitch / kDegree, 3), cell(GM.transverse, 2), cell(GM.longitudinal, 1),
                            cell(X_WB.p.x(), 2), cell(X_WB.p.y(), 2), cell(X_WB.p.z(), 3),
                            cell(attitude.yaw / kDegree, 2)});
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace stillhook
