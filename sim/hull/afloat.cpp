#include "sim/hull/afloat.h"

#include "sim/hull/immersion.h"
#include "sim/multibody/assembly.h"
#include "sim/specification.h"

namespace stillhook {

double waterline_through_middle(const Mesh& mesh, const Vector3& p_WBo, const Matrix3& R_WB) {
  const MeshProperties size = properties_of(mesh);
  const Vector3 middle = 0.5 * (size.low + size.high);
  return -(p_WBo.z() + R_WB(2, 0) * middle.x() + R_WB(2, 1) * middle.y()) / R_WB(2, 2);
}

HullAfloat hull_afloat(const Specification& spec, const MultibodySystem& system, const SystemState& state,
                       std::size_t body, const Mesh& mesh) {
  const BodyKinematics& b = state.body[body];
  const Vector3 Bo = b.p_WC - b.R_WB * spec.bodies[body].cog;
  HullAfloat hull{&spec.bodies[body], &mesh, 0.0, Bo.x(), Bo.y(), roll_pitch_yaw(b.R_WB).yaw};
  if (mesh.vertices.empty()) return hull;
  if (spec.solver.static_start) {
    hull.waterline = waterline_through_middle(mesh, Bo, b.R_WB);
    return hull;
  }
  double mass = 0.0;
  const std::vector<bool> rigid = jointed_to(system, static_cast<int>(body));
  for (std::size_t i = 0; i < rigid.size(); ++i)
    if (rigid[i]) mass += spec.bodies[i].mass;
  hull.waterline = floating_height(mesh, mass / spec.sea.density);
  return hull;
}

}  // namespace stillhook
