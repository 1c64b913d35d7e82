// The hydrodynamics of a model's hulls, as they float in its equilibrium.
#include <algorithm>
#include <cmath>

#include "sim/hull/afloat.h"
#include "sim/hull/coefficients/sea_band.h"
#include "sim/hull/damping.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/immersion.h"
#include "sim/hull/parting_hydrodynamics.h"
#include "sim/model_builder.h"
#include "sim/multibody/assembly.h"

namespace stillhook {
namespace {

constexpr double kBeforeTheWaves = -1.0;  // s

}  // namespace

// Hydrodynamics come last: coefficients are those of the hulls as they float, and the share of critical damping is of
// the modes about the equilibrium.
void ModelBuilder::add_hydrodynamics() {
  const std::vector<BodySpec>& bodies = spec().bodies;
  std::vector<Mesh> meshes;
  for (const BodySpec& b : bodies) {
    std::string mended;
    meshes.push_back(b.hull.shape == HullSpec::Shape::none ? Mesh{} : build_hull_mesh(b.hull, &mended));
    if (!mended.empty()) model_.warnings_.push_back(mended);
  }
  model_.coefficients_.resize(bodies.size());
  std::vector<HydrodynamicsGroup> groups;
  for (const std::vector<std::size_t>& hulls : coupled_hulls(bodies))
    if (!bodies[hulls.front()].moved_by_sea()) groups.push_back(prepare_group(hulls, meshes));
  // The elements only now: the shares of critical damping were found with the system as it was laid out.
  for (const HydrodynamicsGroup& group : groups)
    if (auto element = element_of(group)) system().elements.push_back(std::move(element));
  system().finish();
  system().select_independent_rows(state());
}

std::unique_ptr<const ForceElement> ModelBuilder::element_of(const HydrodynamicsGroup& group) {
  auto together =
      build_hydrodynamics(group.hulls, group.set, model_.waves_, spec().sea, spec().panel_method, model_.warnings_);
  const std::string& until = group.hulls.front().afloat.body->hydrodynamics.coupled_until;
  if (until.empty() || group.hulls.size() == 1) return together;
  const std::vector<PhaseSpec>& phases = spec().operation.phases;
  const auto parting =
      std::find_if(phases.begin(), phases.end(), [&](const PhaseSpec& phase) { return phase.name == until; });
  if (parting == phases.end() || parting == phases.begin())
    throw SpecificationError("bodies." + group.hulls.front().afloat.body->name + ".hydrodynamics", "coupled_until",
                             "must be a phase of the operation after the first, got '" + until + "'");
  std::vector<std::unique_ptr<const ForceElement>> apart;
  for (const HydrodynamicsBody& hull : group.hulls) {
    const auto set = coefficient_set({&hull.afloat, 1}, spec().sea, spec().panel_method, model_.warnings_, progress_);
    apart.push_back(
        build_hydrodynamics({hull}, set, model_.waves_, spec().sea, spec().panel_method, model_.warnings_));
  }
  return std::make_unique<const PartingHydrodynamics>(std::move(together), std::move(apart),
                                                      static_cast<int>(parting - phases.begin()));
}

ModelBuilder::HydrodynamicsGroup ModelBuilder::prepare_group(const std::vector<std::size_t>& hulls, const std::vector<Mesh>& meshes) {
  HydrodynamicsGroup group;
  std::vector<HullAfloat> afloat;
  for (const std::size_t k : hulls)
    afloat.push_back(hull_afloat(spec(), model_.system_, state(), k, meshes[k]));
  if (model_.waves_)
    require_resolved_sea(afloat, *model_.waves_, spec().sea, spec().panel_method,
                         HydrodynamicsOptions().negligible_energy);
  group.set = coefficient_set(afloat, spec().sea, spec().panel_method, model_.warnings_, progress_);
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    const int body = static_cast<int>(hulls[k]);
    model_.coefficients_[body] = {group.set, static_cast<int>(k), reference_height(afloat, afloat[k])};
    group.hulls.push_back({afloat[k], body, Vector6::Zero()});
    if (!spec().bodies[body].hydrodynamics.critical_fraction.isZero())
      group.hulls.back().critical_damping = critical_part(body);
  }
  return group;
}

// Linear damping that is the wanted share of critical for heave, roll and pitch of everything jointed to the hull,
// each mode alone, with the added mass at its own frequency.
Vector6 ModelBuilder::critical_part(int hull) {
  const BodySpec& body = spec().bodies[hull];
  Vector6 stiffness = hydrostatic_stiffness(hull).diagonal();
  Vector6 inertia;
  inertia << Vector3::Constant(body.mass), body.inertia.diagonal();
  const Vector3 C = state().body[hull].p_WC;
  const std::vector<bool> rigid = jointed_to(system(), hull);
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    if (!rigid[i] || static_cast<int>(i) == hull) continue;
    const RigidBody& b = system().bodies[i];
    const Vector3 r = state().body[i].p_WC - C;
    const Matrix3 J = state().body[i].R_WB * b.inertia * state().body[i].R_WB.transpose() +
                      b.mass * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
    inertia.head<3>().array() += b.mass;
    inertia.tail<3>() += J.diagonal();
    stiffness.segment<2>(3).array() -= b.mass * system().gravity * r.z();  // weights above C tip the hull
  }
  for (int dof = 2; dof < 5; ++dof) {
    if (body.hydrodynamics.critical_fraction[dof] == 0.0) continue;
    if (stiffness[dof] <= 0.0)
      throw SpecificationError("bodies." + body.name, "critical_fraction",
                               "the hull is not stable in this degree of freedom, so it has no critical damping");
    const double frequency = natural_frequency(stiffness[dof], inertia[dof],
                                               [&](double w) { return model_.added_mass(hull, w)(dof, dof); });
    inertia[dof] = stiffness[dof] / (frequency * frequency);
  }
  return critical_damping(body.hydrodynamics.critical_fraction, stiffness, inertia);
}

// -dQ/dxi of the hull's pressure alone, about its C, in calm water.
Matrix6 ModelBuilder::hydrostatic_stiffness(int hull) {
  const int e = model_.element_index(spec().bodies[hull].name + ".hydrostatics");
  if (e < 0) throw SpecificationError("bodies." + spec().bodies[hull].name, "critical_fraction", "needs a hull");
  SystemWorkspace work = system().make_workspace();
  SystemState calm = state();
  calm.t = kBeforeTheWaves;
  system().start_elements(calm, work);
  const Memory m = system().memory(e, calm, work);
  system().elements[e]->add_forces(calm.instant(), 0.0, m, work.forces);
  system().elements[e]->add_jacobian(calm.instant(), 0.0, m, work.jacobian);
  return -work.jacobian.stiffness().block<6, 6>(6 * hull, 6 * hull);
}

}  // namespace stillhook
