// From a body's specification to its hydrodynamic force element.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <sstream>

#include "sim/hull/hydrodynamics.h"
#include "sim/hull/radiation/radiation_march.h"
#include "sim/hull/radiation/radiation_memory.h"
#include "sim/hull/radiation/state_space_cache.h"
#include "sim/hull/radiation/state_space_radiation.h"
#include "sim/number_text.h"

namespace stillhook {
namespace {

// Share of the sea's energy in the limit of short waves from which on a report says so, 1.
constexpr double kMuchInLimit = 0.1;

double reference_height_of(const std::vector<HydrodynamicsBody>& bodies, std::size_t i) {
  const std::array<HullAfloat, 1> first{bodies.front().afloat};
  return i == 0 ? 0.0 : reference_height(first, bodies[i].afloat);
}

/// Everything a march depends on.
std::string march_key(const std::vector<HullAfloat>& hulls, const SeaSpec& sea, const PanelMethodSpec& method) {
  std::ostringstream key;
  key.precision(17);
  key << sea.density << ' ' << sea.gravity << ' ' << panel_depth(sea, method) << ' ' << method.direct_step << ' '
      << method.direct_lowest << ' ' << method.direct_highest << ' ' << method.refinement;
  for (const PanelHull& hull : panel_hulls(hulls)) {
    key << ' ' << hull.waterline << ' ' << hull.box_size.transpose() << ' ' << hull.box_centre.transpose();
    if (hulls.size() > 1) key << ' ' << hull.x << ' ' << hull.y << ' ' << hull.yaw;
    for (const Vector3& vertex : hull.mesh.vertices) key << ' ' << vertex.transpose();
  }
  return key.str();
}

template <class Derived>
void require_finite(const Eigen::DenseBase<Derived>& value, const BodySpec& spec, const char* field) {
  if (!value.derived().array().isFinite().all())
    throw SpecificationError(entry_of(spec), field, "must be finite numbers");
}

void require_not_negative(const Vector6& value, const BodySpec& spec, const char* field) {
  require_finite(value, spec, field);
  for (int i = 0; i < 6; ++i)
    if (value(i) < 0.0) {
      std::ostringstream sentence;
      sentence << "must be >= 0 in every degree of freedom, got " << value(i) << " in number " << i + 1;
      throw SpecificationError(entry_of(spec), field, sentence.str());
    }
}

/// Symmetric and positive semidefinite to rounding of the numbers as written in a case (1e-6).
void require_physical(const Matrix6& value, bool symmetric, const BodySpec& spec, const char* field) {
  require_finite(value, spec, field);
  Vector6 scale;
  for (int i = 0; i < 6; ++i) {
    if (value(i, i) < 0.0) throw SpecificationError(entry_of(spec), field, "has a negative number on its diagonal");
    scale(i) = value(i, i) > 0.0 ? 1.0 / std::sqrt(value(i, i)) : 1.0;
  }
  const Matrix6 n = scale.asDiagonal() * value * scale.asDiagonal();
  if (symmetric && (n - n.transpose()).cwiseAbs().maxCoeff() > 1e-6)
    throw SpecificationError(entry_of(spec), field, "must be symmetric");
  const Matrix6 even = 0.5 * (n + n.transpose());
  if (Eigen::SelfAdjointEigenSolver<Matrix6>(even, Eigen::EigenvaluesOnly).eigenvalues()(0) < -1e-6)
    throw SpecificationError(entry_of(spec), field,
                             "must not have a negative eigenvalue: some motion would gain energy from still water");
}

void require_factor(double value, bool open, const BodySpec& spec, const char* field) {
  if (std::isfinite(value) && (open ? value > 0.0 : value >= 0.0)) return;
  throw SpecificationError(entry_of(spec), field,
                           std::string("must be ") + (open ? "> 0" : ">= 0") + ", got " + number_text(value));
}

/// The set's own field, for errors.
const char* field_of(const BodySpec& spec) {
  return spec.hydrodynamics.kind == HydrodynamicsSpec::Kind::panels ? "kind" : "coefficient_file";
}

void require_close(double value, double expected, double tolerance, const char* what, const char* unit,
                   const BodySpec& spec) {
  if (std::abs(value / expected - 1.0) <= tolerance) return;
  std::ostringstream sentence;
  sentence << "holds for " << what << " " << value << " " << unit << ", the case has " << expected << " " << unit;
  throw SpecificationError(entry_of(spec), field_of(spec), sentence.str());
}

/// One for each set and, of coupled hulls, their headings: every model of a search has the same.
std::shared_ptr<const DiffractionTable> table_for(const std::shared_ptr<const HydrodynamicCoefficients>& set,
                                                  const std::vector<LinearFroudeKrylov>& incident,
                                                  const std::vector<double>& headings) {
  struct Entry {
    std::weak_ptr<const HydrodynamicCoefficients> set;
    std::vector<double> relative;
    std::vector<double> volumes;
    std::shared_ptr<const DiffractionTable> table;
  };
  static std::mutex mutex;
  static std::vector<Entry> known;
  std::vector<double> relative, volumes;
  for (const double heading : headings) relative.push_back(heading - headings[0]);
  for (const LinearFroudeKrylov& hull : incident) volumes.push_back(hull.volume());
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const Entry& entry) { return entry.set.expired(); });
  for (const Entry& entry : known)
    if (entry.set.lock() == set && entry.relative == relative && entry.volumes == volumes) return entry.table;
  known.push_back({set, relative, volumes,
                   std::make_shared<const DiffractionTable>(set->excitation, incident, headings, set->length)});
  return known.back().table;
}

std::unique_ptr<Diffraction> build_diffraction(const std::vector<HydrodynamicsBody>& bodies,
                                                     const std::shared_ptr<const HydrodynamicCoefficients>& set,
                                                     std::shared_ptr<const WaveField> waves,
                                                     const PanelMethodSpec& method, std::vector<std::string>& warnings,
                                                     const HydrodynamicsOptions& options) {
  const BodySpec& first = *bodies.front().afloat.body;
  const HydrodynamicCoefficients& c = *set;
  try {
    std::vector<LinearFroudeKrylov> incident;
    std::vector<double> headings;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Mesh mesh = *bodies[i].afloat.mesh;
      const double height = reference_height_of(bodies, i);
      for (Vector3& vertex : mesh.vertices) vertex.z() -= height;
      incident.emplace_back(mesh, c.waterline, c.density, c.gravity, c.depth);
      headings.push_back(bodies[i].afloat.yaw);
      require_close(c.volume[i], incident.back().volume(), options.volume_tolerance, "a displaced volume of", "m3",
                    *bodies[i].afloat.body);
    }
    if (!waves || waves->calm()) return nullptr;
    using Beyond = PanelMethodSpec::Beyond;
    const bool cut = method.beyond == Beyond::cut;
    if (c.excitation.empty()) {
      const std::string sentence = c.source + ": holds no excitation forces (WAMIT: .3 or .2), which waves need";
      if (!cut) throw SpecificationError(entry_of(first), field_of(first), sentence);
      warnings.push_back(sentence + "; they act without diffraction");
      return nullptr;
    }
    const DiffractionTable& table = *table_for(set, incident, headings);
    auto diffraction = std::make_unique<Diffraction>(
        std::move(waves), table, headings, cut ? 1.0 : options.negligible_energy, entry_of(first),
        method.beyond == Beyond::limit ? ShortWaves::limit : ShortWaves::left_out);
    if (diffraction->share_left_out() > 0.0) {
      std::ostringstream sentence;
      sentence.precision(2);
      sentence << first.name << ": " << 100.0 * diffraction->share_left_out()
               << " % of the sea's energy lies beyond the hull's coefficients and acts without diffraction";
      warnings.push_back(sentence.str());
    }
    if (diffraction->share_in_limit() > kMuchInLimit) {
      std::ostringstream sentence;
      sentence.precision(2);
      sentence << first.name << ": " << 100.0 * diffraction->share_in_limit() << " % of the sea's energy lies above "
               << table.highest_frequency()
               << " rad/s and is diffracted as in the limit of short waves; a higher panel_method.highest_rad_per_s "
                  "computes it";
      warnings.push_back(sentence.str());
    }
    return diffraction;
  } catch (const MeshError& error) {
    throw SpecificationError(entry_of(first), field_of(first), error.what());
  }
}

/// Marches are costly to build: one for each set of hulls, kept as long as anything uses it.
std::shared_ptr<const rankine::PanelMarch> march_for(const std::vector<HullAfloat>& hulls, const SeaSpec& sea,
                                                     const PanelMethodSpec& method, const std::string& key) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const rankine::PanelMarch>> known;
  const std::lock_guard lock(mutex);
  if (auto march = known[key].lock()) return march;
  PanelMethodOptions options = panel_options(sea, method, hulls.front().body->hydrodynamics.panel_length);
  options.lowest = method.direct_lowest;
  options.highest = method.direct_highest;
  auto march = std::make_shared<const rankine::PanelMarch>(panel_hulls(hulls), options, method.direct_step);
  known[key] = march;
  return march;
}

RetardationFunctions scaled(RetardationFunctions kernels, const VectorX& S) {
  for (RetardationKernel& kernel : kernels.kernels)
    for (double& K : kernel.value) K *= S[kernel.i] * S[kernel.j];
  return kernels;
}

StateSpaceFit scaled(StateSpaceFit fit, const VectorX& S) {
  for (StateSpaceBlock& block : fit.blocks) {
    VectorX own(static_cast<Eigen::Index>(block.modes.size()));
    for (Eigen::Index i = 0; i < own.size(); ++i) own[i] = S[block.modes[static_cast<std::size_t>(i)]];
    for (MatrixXc& residue : block.K.residues) residue = own.asDiagonal() * residue * own.asDiagonal();
  }
  return fit;
}

/// The reduced model where one meets the tolerance, else the retardation functions, and a warning that says so.
std::unique_ptr<const Radiation> reduced_radiation(const HydrodynamicCoefficients& c, const PanelMethodSpec& method,
                                                   const VectorX& memory, double kernel_tolerance,
                                                   const BodySpec& body, std::vector<std::string>& warnings) {
  const KnownStateSpace known = known_state_space(c, method.fit_tolerance);
  if (known.fit) return std::make_unique<StateSpaceRadiation>(scaled(*known.fit, memory));
  if (c.retardation.empty()) throw SpecificationError(c.source, "", known.fault);
  warnings.push_back(body.name + ": " + known.fault +
                     ". The retardation functions are used instead, which take longer to run; a larger "
                     "panel_method.fit_tolerance accepts a coarser state space");
  return std::make_unique<RadiationMemory>(scaled(truncated(c.retardation, kernel_tolerance), memory), c.modes());
}

}  // namespace

VectorX mode_factors(const std::vector<const BodySpec*>& bodies, double HydrodynamicsSpec::* factor) {
  VectorX S(6 * static_cast<Eigen::Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    S.segment<6>(6 * static_cast<Eigen::Index>(i)).setConstant(std::sqrt(bodies[i]->hydrodynamics.*factor));
  return S;
}

std::unique_ptr<ForceElement> build_hydrodynamics(const std::vector<HydrodynamicsBody>& bodies,
                                                  std::shared_ptr<const HydrodynamicCoefficients> set,
                                                  std::shared_ptr<const WaveField> waves, const SeaSpec& sea,
                                                  const PanelMethodSpec& method, std::vector<std::string>& warnings,
                                                  const HydrodynamicsOptions& options) {
  using RadiationModel = HydrodynamicsSpec::RadiationModel;
  std::vector<HydrodynamicsHull> hulls;
  std::vector<double> diffraction_factors;
  bool nothing = !set;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodySpec& spec = *bodies[i].afloat.body;
    const HydrodynamicsSpec& h = spec.hydrodynamics;
    require_not_negative(h.linear_damping, spec, "linear_damping");
    require_not_negative(h.quadratic_damping, spec, "quadratic_damping");
    require_not_negative(bodies[i].critical_damping, spec, "critical_fraction");
    const Vector3 cog = spec.cog - Vector3(0.0, 0.0, reference_height_of(bodies, i));
    hulls.push_back({spec.name, HeadingFrame(bodies[i].index, cog, bodies[i].afloat.yaw),
                     ViscousDamping{h.linear_damping + bodies[i].critical_damping, h.quadratic_damping}});
    nothing = nothing && h.kind != HydrodynamicsSpec::Kind::constant && hulls.back().viscous.none();
    require_factor(h.added_mass_factor, true, spec, "added_mass_factor");
    require_factor(h.radiation_factor, false, spec, "radiation_factor");
    if (!std::isfinite(h.diffraction_factor))
      throw SpecificationError(entry_of(spec), "diffraction_factor", "must be a finite number");
    diffraction_factors.push_back(h.diffraction_factor);
  }
  if (nothing) return nullptr;
  const BodySpec& first = *bodies.front().afloat.body;
  const HydrodynamicsSpec& h = first.hydrodynamics;
  const int modes = 6 * static_cast<int>(bodies.size());
  MatrixX A_inf = MatrixX::Zero(modes, modes);
  std::unique_ptr<const Radiation> radiation;
  std::unique_ptr<Diffraction> diffraction;
  if (h.kind == HydrodynamicsSpec::Kind::constant) {
    require_physical(h.added_mass, true, first, "added_mass");
    require_physical(h.damping, false, first, "damping");
    A_inf = h.added_mass;
    radiation = std::make_unique<ConstantRadiation>(h.damping);
  } else if (set) {
    const HydrodynamicCoefficients& c = *set;
    require_close(c.density, sea.density, options.density_tolerance, "water of", "kg/m3", first);
    require_close(c.gravity, sea.gravity, options.density_tolerance, "a gravity of", "m/s2", first);
    diffraction = build_diffraction(bodies, set, std::move(waves), method, warnings, options);
    A_inf = c.A_inf;
    const bool table = h.kind == HydrodynamicsSpec::Kind::table;
    std::vector<const BodySpec*> specs;
    for (const HydrodynamicsBody& body : bodies) specs.push_back(body.afloat.body);
    const VectorX memory = mode_factors(specs, &HydrodynamicsSpec::radiation_factor);
    const RadiationModel model = h.radiation != RadiationModel::automatic ? h.radiation : table ? RadiationModel::retardation : RadiationModel::reduced;
    try {
      if (model == RadiationModel::retardation && !c.retardation.empty()) {
        radiation = std::make_unique<RadiationMemory>(
            scaled(truncated(c.retardation, options.kernel_tolerance), memory), modes);
      } else if (model == RadiationModel::reduced) {
        radiation = reduced_radiation(c, method, memory, options.kernel_tolerance, first, warnings);
      } else if (model == RadiationModel::direct) {
        std::vector<HullAfloat> afloat;
        for (const HydrodynamicsBody& body : bodies) afloat.push_back(body.afloat);
        auto march = march_for(afloat, sea, method, march_key(afloat, sea, method));
        A_inf = march->A_inf();
        radiation = std::make_unique<RadiationMarch>(std::move(march), memory);
      }
    } catch (const SpecificationError& error) {
      throw SpecificationError(entry_of(first), "radiation", error.what());
    }
    const VectorX inertia = mode_factors(specs, &HydrodynamicsSpec::added_mass_factor);
    A_inf = inertia.asDiagonal() * A_inf * inertia.asDiagonal();
  }
  if (diffraction) diffraction->scale(diffraction_factors);
  return std::make_unique<HydrodynamicsElement>(first.name + ".hydrodynamics", std::move(hulls), std::move(A_inf),
                                                std::move(radiation), std::move(diffraction));
}

std::vector<std::vector<std::size_t>> coupled_hulls(const std::vector<BodySpec>& bodies) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<bool> taken(bodies.size(), false);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string& other = bodies[i].hydrodynamics.coupled_with;
    if (other.empty()) continue;
    const auto partner =
        std::find_if(bodies.begin(), bodies.end(), [&](const BodySpec& body) { return body.name == other; });
    const std::size_t k = static_cast<std::size_t>(partner - bodies.begin());
    const auto refuse = [&](const std::string& why) {
      throw SpecificationError(entry_of(bodies[i]), "coupled_with",
                               why + ": name one other body with a hull, or leave the key out");
    };
    if (partner == bodies.end()) refuse("there is no body '" + other + "'");
    if (i == k) refuse("a hull cannot be coupled with itself");
    if (taken[i] && std::find(groups.begin(), groups.end(), std::vector{k, i}) != groups.end()) continue;  // said twice
    for (const std::size_t hull : {i, k})
      if (taken[hull])
        refuse("a hull can be coupled with one other hull alone, and '" + bodies[hull].name + "' is coupled already");
    taken[i] = taken[k] = true;
    groups.push_back({i, k});
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!taken[i]) groups.push_back({i});
  return groups;
}

Matrix6 added_mass_at(const HydrodynamicCoefficients& set, int hull, const Vector3& c, double frequency) {
  const auto block = [&](const MatrixX& M) -> Matrix6 { return about_point(M.block<6, 6>(6 * hull, 6 * hull), c); };
  if (std::isinf(frequency) || (set.retardation.empty() && set.frequency.empty())) return block(set.A_inf);
  if (set.frequency.empty()) return block(added_mass_from_kernels(set.A_inf, set.retardation, frequency));
  const auto above = std::lower_bound(set.frequency.begin(), set.frequency.end(), frequency,
                                      [](const FrequencyCoefficients& f, double w) { return f.frequency < w; });
  if (above == set.frequency.begin()) return block(above->A);
  if (above == set.frequency.end()) {
    // A - A_inf falls as the inverse square of the frequency (Ogilvie 1964).
    const FrequencyCoefficients& last = set.frequency.back();
    const double fall = std::pow(last.frequency / frequency, 2);
    return block(set.A_inf + fall * (last.A - set.A_inf));
  }
  const FrequencyCoefficients& below = *(above - 1);
  const double t = (frequency - below.frequency) / (above->frequency - below.frequency);
  return block((1.0 - t) * below.A + t * above->A);
}

}  // namespace stillhook
