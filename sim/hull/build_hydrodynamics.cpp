// From a body's specification to its hydrodynamic force element.
#include <cmath>
#include <sstream>

#include "sim/hull/coefficient_file.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/hull/radiation_memory.h"

namespace stillhook {
namespace {

std::string entry_of(const BodySpec& spec) { return "bodies." + spec.name + ".hydrodynamics"; }

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

HydrodynamicCoefficients read_for(const BodySpec& spec) {
  try {
    HydrodynamicCoefficients c = read_coefficient_file(spec.hydrodynamics.coefficient_file);
    require_self_checks(c);
    if (c.hulls() != 1)
      throw SpecificationError(c.source, "", "holds the coefficients of several hulls, one body needs those of one");
    return c;
  } catch (const SpecificationError& error) {
    throw SpecificationError(entry_of(spec), "coefficient_file", error.what());
  }
}

void require_close(double value, double expected, double tolerance, const char* what, const char* unit,
                   const BodySpec& spec) {
  if (std::abs(value / expected - 1.0) <= tolerance) return;
  std::ostringstream sentence;
  sentence << "holds for " << what << " " << value << " " << unit << ", the case has " << expected << " " << unit;
  throw SpecificationError(entry_of(spec), "coefficient_file", sentence.str());
}

std::unique_ptr<const Diffraction> build_diffraction(const BodySpec& spec, const HydrodynamicCoefficients& c,
                                                     double heading, const Mesh& hull,
                                                     std::shared_ptr<const WaveField> waves,
                                                     const HydrodynamicsOptions& options) {
  try {
    const LinearFroudeKrylov incident(hull, c.waterline, c.density, c.gravity);
    require_close(c.volume[0], incident.volume(), options.volume_tolerance, "a displaced volume of", "m3", spec);
    if (c.excitation.empty() || !waves || waves->calm()) return nullptr;
    const DiffractionTable table(c.excitation, {&incident, 1}, {&heading, 1}, c.length);
    return std::make_unique<const Diffraction>(std::move(waves), table, std::span<const double>{&heading, 1},
                                               options.negligible_energy, entry_of(spec));
  } catch (const MeshError& error) {
    throw SpecificationError(entry_of(spec), "coefficient_file", error.what());
  }
}

}  // namespace

std::unique_ptr<ForceElement> build_hydrodynamics(const BodySpec& spec, int body, double heading, const Mesh& hull,
                                                  std::shared_ptr<const WaveField> waves, const SeaSpec& sea,
                                                  const Vector6& critical_damping,
                                                  const HydrodynamicsOptions& options) {
  const HydrodynamicsSpec& h = spec.hydrodynamics;
  require_not_negative(h.linear_damping, spec, "linear_damping");
  require_not_negative(h.quadratic_damping, spec, "quadratic_damping");
  require_not_negative(critical_damping, spec, "critical_fraction");
  HydrodynamicsHull part{spec.name, HeadingFrame(body, spec.cog, heading),
                         ViscousDamping{h.linear_damping + critical_damping, h.quadratic_damping}};
  MatrixX A_inf = MatrixX::Zero(6, 6);
  std::unique_ptr<const Radiation> radiation;
  std::unique_ptr<const Diffraction> diffraction;
  switch (h.kind) {
    case HydrodynamicsSpec::Kind::none:
      if (part.viscous.none()) return nullptr;
      break;
    case HydrodynamicsSpec::Kind::constant:
      require_physical(h.added_mass, true, spec, "added_mass");
      require_physical(h.damping, false, spec, "damping");
      A_inf = h.added_mass;
      radiation = std::make_unique<ConstantRadiation>(h.damping);
      break;
    case HydrodynamicsSpec::Kind::table: {
      const HydrodynamicCoefficients c = read_for(spec);
      require_close(c.density, sea.density, options.density_tolerance, "water of", "kg/m3", spec);
      require_close(c.gravity, sea.gravity, options.density_tolerance, "a gravity of", "m/s2", spec);
      A_inf = c.A_inf;
      if (!c.retardation.empty())
        radiation = std::make_unique<RadiationMemory>(truncated(c.retardation, options.kernel_tolerance), 6);
      diffraction = build_diffraction(spec, c, heading, hull, std::move(waves), options);
      break;
    }
  }
  return std::make_unique<HydrodynamicsElement>(spec.name + ".hydrodynamics",
                                                std::vector<HydrodynamicsHull>{std::move(part)}, std::move(A_inf),
                                                std::move(radiation), std::move(diffraction));
}

std::function<Matrix6(double)> added_mass_of(const BodySpec& spec) {
  switch (spec.hydrodynamics.kind) {
    case HydrodynamicsSpec::Kind::none:
      break;
    case HydrodynamicsSpec::Kind::constant:
      return [A = about_point(spec.hydrodynamics.added_mass, spec.cog)](double) { return A; };
    case HydrodynamicsSpec::Kind::table:
      return [c = read_for(spec), cog = spec.cog](double frequency) {
        if (std::isinf(frequency)) return about_point(c.A_inf, cog);
        return about_point(added_mass_from_kernels(c.A_inf, c.retardation, frequency), cog);
      };
  }
  return [](double) -> Matrix6 { return Matrix6::Zero(); };
}

Matrix6 added_mass_at(const BodySpec& spec, double frequency) { return added_mass_of(spec)(frequency); }

}  // namespace stillhook
