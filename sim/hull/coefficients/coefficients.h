// Hydrodynamic coefficients of one hull, or of several that feel each other, and what every set must satisfy.
//
//   F_radiation(t) = -A_inf a(t) - int_0^inf K(s) V(t - s) ds                                  (Cummins 1962)
//   B(w) = int_0^inf K(s) cos(w s) ds      A(w) = A_inf - (1/w) int_0^inf K(s) sin(w s) ds     (Ogilvie 1964)
//   F_excitation(t) = Re[ X(w, b) a exp(i th) ],   th = k (x cos b + y sin b) - w t + e at the hull's reference point
//
// V holds the six velocities of each hull's reference point Bo in its heading frame H: surge, sway, heave (m/s), roll,
// pitch, yaw (rad/s). H has its origin in Bo; its axes are those of the world turned by the hull's mean yaw. Forces
// (N) and moments about Bo (N m) are in H too. Modes are numbered 0..5 here and 1..6 in files; those of the second
// hull follow as 6..11. Headings b are directions the waves travel towards, relative to H's x axis. The phase of X is
// a lag: the force peaks arg(X)/w after the crest has passed Bo.
#pragma once

#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "sim/hull/coefficients/self_check_tolerances.h"
#include "sim/spatial/pose.h"

namespace stillhook {

using Complex = std::complex<double>;

/// One K_ij(t) on the uniform grid t = m * interval; linear between samples, zero after the last.
struct RetardationKernel {
  int i = 0, j = 0;
  std::vector<double> value;  // N per (m/s or rad/s) and per s; moments N m
};

/// All non-zero K_ij(t). Both (i,j) and (j,i) are listed.
struct RetardationFunctions {
  double interval = 0.0;  // s
  std::vector<RetardationKernel> kernels;

  bool empty() const { return kernels.empty(); }
  double duration() const;  // s, of the longest kernel
};

/// Added mass and radiation damping at one frequency.
struct FrequencyCoefficients {
  double frequency = 0.0;  // rad/s
  MatrixX A, B;            // modes x modes; kg, kg m, kg m2 and the same per s
  MatrixX gap = {};        // of B, what the damped water between coupled hulls takes; empty where it is not known
};

/// Total first-order excitation (Froude-Krylov plus diffraction) per unit wave amplitude, N/m and N m/m.
struct ExcitationTable {
  std::vector<double> frequencies;  // rad/s, ascending, > 0
  std::vector<double> headings;     // rad, ascending in [0, 2 pi)
  int modes = 6;
  std::vector<Complex> value;  // [frequency][heading][mode]

  bool empty() const { return value.empty(); }
  Complex& at(int f, int h, int mode) { return value[(f * headings.size() + h) * modes + mode]; }
  const Complex& at(int f, int h, int mode) const { return value[(f * headings.size() + h) * modes + mode]; }
};

/// The hydrostatic stiffness of a hull as the file of a set has it: N/m, N, N m about a point, axes of H.
struct FileStiffness {
  Matrix6 C = Matrix6::Zero();
  Vector3 about = Vector3::Zero();  // m, from Bo
};

/// A coefficient set with everything that must be known to use it.
struct HydrodynamicCoefficients {
  std::string source;              // where it was read, or what computed it
  std::string description;         // origin of the numbers, for reports
  double density = 0.0;            // kg/m3, of the water it holds for
  double gravity = 0.0;            // m/s2
  double depth = std::numeric_limits<double>::infinity();  // m, of the water it holds for
  double length = 0.0;             // m, the hull's length scale: rotations are compared with translations through it
  double waterline = 0.0;          // m, height of the calm water plane above Bo
  std::vector<double> volume;      // m3, displaced volume of each hull
  std::vector<double> waterplane;  // m2, area of each hull's water plane; empty where it is not known
  std::vector<FileStiffness> stiffness;  // of each hull, for comparison with its mesh; empty where it is not known
  std::vector<std::string> remarks;      // sentences on what was left out or made up in reading, for the user
  // Of coupled hulls: the water between them rises this many times the motion of a hull at most, and where, rad/s. Above
  // kGapResonance times (panel_method.h) it resonates. 0 = not known.
  double gap_rise = 0.0, gap_frequency = 0.0;
  MatrixX A_inf;                   // modes x modes
  RetardationFunctions retardation;
  std::vector<FrequencyCoefficients> frequency;  // ascending; may be empty
  ExcitationTable excitation;                    // may be empty

  int hulls() const { return static_cast<int>(volume.size()); }
  int modes() const { return 6 * hulls(); }
};

/// B(w) from K, exact for the piecewise linear kernels. modes x modes.
MatrixX damping_from_kernels(const RetardationFunctions& K, int modes, double frequency);

/// A(w) from A_inf and K, exact for the piecewise linear kernels; w > 0.
MatrixX added_mass_from_kernels(const MatrixX& A_inf, const RetardationFunctions& K, double frequency);

/// Each kernel cut at the first time T after which int_T |K| dt <= tolerance * int_0 |K| dt; what is lost of int K dt
/// is spread smoothly over the rest, so that B(0), which is zero for a hull, stays as it is: a cut alone leaves a
/// negative damping of slow drift. w A(w) and B(w) change by no more than 2 tolerance int |K| dt, the force by no more
/// than that times max |V_j|.
RetardationFunctions truncated(const RetardationFunctions& K, double tolerance);

/// The matrix of a hull's A or B about another point: from Bo to the point at c (m, in H from Bo).
Matrix6 about_point(const Matrix6& about_origin, const Vector3& c);

/// 4 pi rho B_ij / int_0^2pi Re(X_i conj X_j) db of a lone hull (Newman 1962): k/(2 g c_g), (s/m)^3; in deep water
/// (w/g)^3.
double radiated_share(double frequency, double gravity, double depth);

/// A property every physical set has, measured on this one.
struct SelfCheck {
  std::string key;     // "symmetry_infinite": how a user names it
  std::string name;    // "symmetry of A_inf"
  std::string detail;  // where the worst value is
  double value = 0.0;  // the worst deviation found, dimensionless
  double limit = 0.0;  // a set with value > limit is refused
  std::string tolerance_key = {};  // of the section panel_method, which holds the limit; empty: the limit is fixed
  bool passed() const { return value <= limit; }
};

/// What a set of coefficients must satisfy. Deviations of pair (i,j) are relative to sqrt(X_ii X_jj), which needs no
/// units; checks whose data are missing are left out.
///   finite              finite numbers (else nothing more is checked)
///   symmetry_infinite   A_inf is symmetric, positive_infinite: and positive semidefinite
///   displaced_mass      A_inf in heave is neither < 1/100 nor > 300 of the displaced mass: kg, not tonnes
///   symmetry            of A(w), B(w);  damping: B(w) >= 0
///   low_frequency       A(w) at the lowest frequency is not far above all others: it has a finite limit in deep water;
///                       over a bed in surge, sway and yaw alone, the others grow like -ln w
///   kernel_damping      B(w) >= 0 of the retardation functions;  kernel_tail: they have died out at their end
///   kramers_kronig      the retardation functions against A(w), B(w)
///   haskind             the energy a moving hull radiates is that which waves from all around can give it (Newman
///   1962):
///                         B_ij = k / (8 pi rho g c_g) int_0^2pi Re(X_i conj X_j) db,     c_g = dw/dk,
///                       wherever the headings resolve the integrand: more than 2 (k R + 1), R half the diagonal;
///                       errors relative to B, or to w m of the displaced water where no spring holds the hull, or in
///                       heave to what w (m + A) has above the spring of the water plane
///   long_wave_phase     where k length/2 <= 1, at the lowest frequency: the force of surge and sway leads the crest by
///   a
///                       quarter period, along the direction of the waves, and that of heave lags by w B_33
///   long_wave_heave     there too: X_3 -> rho g A_waterplane - w^2 (rho V + A_33), as of upright walls at the depth
///                       V/A_waterplane; errors relative to the sum of both parts
std::vector<SelfCheck> self_checks(const HydrodynamicCoefficients& coefficients,
                                   const SelfCheckTolerances& tolerances = {});

/// Keys of the checks that a user may name as accepted: all but `finite`.
const std::vector<std::string>& acceptable_self_checks();

/// Throws SpecificationError(coefficients.source) with the first failed check that is not among `accepted`, and when
/// `accepted` names a check that does not exist.
void require_self_checks(const HydrodynamicCoefficients& coefficients, const std::vector<std::string>& accepted = {},
                         const SelfCheckTolerances& tolerances = {});

}  // namespace stillhook
