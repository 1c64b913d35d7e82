#include "planner/verbs/hydro/hydro_files.h"

#include <cmath>

#include "sim/hull/coefficients/bemio_file.h"
#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/wamit_file.h"
#include "sim/hull/heading_frame.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/immersion.h"

namespace stillhook {
namespace {

constexpr double kCalm = -1.0;      // s
constexpr double kParallel = 1e-3;  // rad

/// -dQ/dxi of a hull's pressure in calm water at the initial equilibrium about its centre of gravity, axes of its
/// heading frame: the restoring matrix of databases, with the weight of the displaced water in the centre of gravity.
Matrix6 restoring(const Model& model, int body) {
  const MultibodySystem& system = model.system();
  const int e = model.element_index(system.bodies[body].name + ".hydrostatics");
  if (e < 0) return Matrix6::Zero();
  SystemWorkspace work = system.make_workspace();
  SystemState state = model.initial_state();
  state.t = kCalm;
  system.start_elements(state, work);
  const Memory m = system.memory(e, state, work);
  system.elements[e]->add_forces(state.instant(), 0.0, m, work.forces);
  system.elements[e]->add_jacobian(state.instant(), 0.0, m, work.jacobian);
  Matrix6 T = Matrix6::Identity();
  T.topLeftCorner<3, 3>() = heading_rotation(state.body[body].R_WB);
  const Matrix6 K = -T.transpose() * work.jacobian.stiffness().block<6, 6>(6 * body, 6 * body) * T;
  return 0.5 * (K + K.transpose());
}

/// One hull in the frame of the databases.
struct DatabaseHull {
  Vector3 origin, cg, cb;         // m
  Vector3 xbody;                  // m, what WAMIT's moments are about: over Bo in the water plane
  Matrix6 about_cg, about_xbody;  // N/m, N, N m
  double turned = 0.0;             // rad, its heading from that of the first
};

std::vector<DatabaseHull> database_hulls(const Model& model, const HydroSet& set) {
  const Specification& spec = model.specification();
  std::vector<DatabaseHull> hulls;
  const auto pose = [&](int body) { return pose_of(model.initial_state().body[body], model.system().bodies[body]); };
  const Pose first = pose(set.bodies.front());
  const Matrix3 R_HW = heading_rotation(first.R).transpose();
  for (const int body : set.bodies) {
    const Pose X_WB = pose(body);
    const double height = model.coefficients(body).reference_height;
    DatabaseHull hull;
    hull.origin = R_HW * (X_WB.p - first.p);
    hull.origin.z() = -set.set->waterline;
    const Vector3 cog = spec.bodies[body].cog - Vector3(0.0, 0.0, height);
    hull.xbody = Vector3(hull.origin.x(), hull.origin.y(), 0.0);
    hull.cg = hull.origin + cog;
    Mesh mesh = build_hull_mesh(spec.bodies[body].hull);
    for (Vector3& vertex : mesh.vertices) vertex.z() -= height;
    hull.cb = immersion_of(mesh, Pose{Matrix3::Identity(), hull.origin}).centre_of_buoyancy;
    hull.about_cg = restoring(model, body);
    const Matrix6 back = HeadingFrame(body, hull.cg - hull.xbody, 0.0).transform().inverse();
    hull.about_xbody = back.transpose() * hull.about_cg * back;
    hull.turned = std::remainder(roll_pitch_yaw(X_WB.R).yaw - roll_pitch_yaw(first.R).yaw, 2.0 * M_PI);
    hulls.push_back(hull);
  }
  return hulls;
}

/// The set with a table of A and B, which the formats of databases need.
HydrodynamicCoefficients tabulated(const HydrodynamicCoefficients& set) {
  HydrodynamicCoefficients result = set;
  if (result.frequency.size() < 2 && !result.excitation.empty())
    result.frequency = sampled(set, set.excitation.frequencies);
  return result;
}

}  // namespace

std::vector<std::string> write_coefficient_files(const std::string& folder, const Model& model, const HydroSet& set,
                                                 std::vector<std::string>& left_out) {
  std::vector<std::string> written;
  const std::string base = "coefficients-" + set.name(), path = folder + "/" + base;
  const auto attempt = [&](const char* what, std::vector<std::string> endings, const auto& write) {
    try {
      write();
      for (const std::string& ending : endings) written.push_back(base + ending);
    } catch (const SpecificationError& error) {
      left_out.push_back(std::string(what) + " not written: " + error.what());
    }
  };
  attempt("coefficient file", {".csv"}, [&] { write_coefficient_file(path + ".csv", *set.set); });

  const std::vector<DatabaseHull> hulls = database_hulls(model, set);
  for (const DatabaseHull& hull : hulls)
    if (std::abs(hull.turned) > kParallel) {
      left_out.push_back("BEMIO and WAMIT files not written: " + set.title() +
                         " do not lie parallel, which these formats cannot say");
      return written;
    }
  DatabaseFrame frame;
  frame.bodies.clear();
  frame.length = set.set->length;
  std::vector<BemioBody> bodies;
  std::vector<Matrix6> stiffness;
  WamitUnits units;
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    frame.bodies.push_back({hulls[k].origin, set.set->volume[k]});
    bodies.push_back({set.names[k], hulls[k].cg, hulls[k].cb, hulls[k].about_cg});
    stiffness.push_back(hulls[k].about_xbody);
    units.reference.push_back(hulls[k].xbody);
  }
  units.density = set.set->density;
  units.gravity = set.set->gravity;
  attempt("BEMIO file", {".h5"}, [&] { write_bemio(path + ".h5", tabulated(*set.set), frame, bodies); });
  std::vector<std::string> endings = {".1"};
  if (!set.set->excitation.empty()) endings.push_back(".3");
  endings.push_back(".hst");
  attempt("WAMIT files", endings, [&] { write_wamit(path, tabulated(*set.set), units, frame, stiffness); });
  return written;
}

}  // namespace stillhook
