// The self-checks of a coefficient set.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/coefficients/motion_scales.h"
#include "sim/sea/dispersion.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

// Of the largest B_ii: panels leave an error of up to 3 % of that in the short waves that hardly reach the hull's
// bottom, where B_33 itself has all but gone.
constexpr double kHaskindFloor = 0.4;
constexpr double kLongWave = 1.0;  // k length/2
// Keys of the section panel_method that several checks share.
constexpr const char* kSymmetryKey = "symmetry_tolerance";
constexpr const char* kNegativeDampingKey = "negative_damping_tolerance";
// Grids of frequencies leave a factor 2.3 between neighbours at most; an added mass that was divided by w^2 has no
// limit.
constexpr double kLowFrequencyLimit = 3.0;
// A slender spar has 1/30 of its displaced mass as added mass in heave, a raft 100 times.
constexpr double kLeastHeaveMass = 0.01, kLargestHeaveMass = 300.0;

std::string pair_name(const char* matrix, int i, int j) {
  std::ostringstream out;
  out << matrix << '(' << i + 1 << ',' << j + 1 << ')';
  return out.str();
}

std::string at_frequency(double w) {
  std::ostringstream out;
  out << "at " << w << " rad/s";
  return out.str();
}

std::string at_frequency(const char* matrix, int i, int j, double w) {
  return pair_name(matrix, i, j).append(" ").append(at_frequency(w));
}

/// X_ij / sqrt(s_i s_j) with s the diagonal of `scale`; rows of modes without scale are left as they are.
MatrixX normalised(const MatrixX& X, const VectorX& scale) {
  VectorX d(scale.size());
  for (int i = 0; i < d.size(); ++i) d(i) = scale(i) > 0.0 ? 1.0 / std::sqrt(scale(i)) : 1.0;
  return d.asDiagonal() * X * d.asDiagonal();
}

/// Keeps the worst of several deviations.
void worsen(SelfCheck& check, double value, const std::string& detail) {
  if (!(value <= check.value)) {  // also true for NaN, which then fails the check
    check.value = value;
    check.detail = detail;
  }
}

void worsen_symmetry(SelfCheck& check, const MatrixX& X, const char* matrix, const std::string& where) {
  const MatrixX n = normalised(X, X.diagonal().cwiseMax(0.0));
  for (int i = 0; i < n.rows(); ++i)
    for (int j = 0; j < i; ++j) worsen(check, std::abs(n(i, j) - n(j, i)), pair_name(matrix, i, j).append(where));
}

double smallest_eigenvalue(const MatrixX& X) {
  return Eigen::SelfAdjointEigenSolver<MatrixX>(0.5 * (X + X.transpose()), Eigen::EigenvaluesOnly).eigenvalues()(0);
}

/// Largest B_ii over all frequencies: what damping is compared with.
VectorX largest_diagonal(const HydrodynamicCoefficients& c) {
  VectorX largest = VectorX::Zero(c.modes());
  for (const FrequencyCoefficients& f : c.frequency) largest = largest.cwiseMax(f.B.diagonal());
  return largest;
}

SelfCheck check_finite(const HydrodynamicCoefficients& c) {
  SelfCheck check{"finite", "all numbers are finite", "", 0.0, 0.0};
  if (!c.A_inf.allFinite()) worsen(check, 1.0, "A_inf");
  for (const FrequencyCoefficients& f : c.frequency)
    if (!f.A.allFinite() || !f.B.allFinite()) worsen(check, 1.0, at_frequency(f.frequency));
  for (const RetardationKernel& k : c.retardation.kernels)
    for (double v : k.value)
      if (!std::isfinite(v)) worsen(check, 1.0, pair_name("K", k.i, k.j));
  for (const Complex& x : c.excitation.value)
    if (!std::isfinite(std::abs(x))) worsen(check, 1.0, "X");
  return check;
}

SelfCheck check_kernel_damping(const HydrodynamicCoefficients& c, const SelfCheckTolerances& t) {
  SelfCheck check{"kernel_damping", "B(w) >= 0 of the retardation functions", "", 0.0, t.negative_damping,
                  kNegativeDampingKey};
  // Up to 2.5 rad/s: the sea has no energy above, and panel methods little to say there.
  const int points = 50;
  const double highest = 2.5;
  std::vector<MatrixX> B;
  VectorX largest = VectorX::Zero(c.modes());
  for (int n = 1; n <= points; ++n) {
    B.push_back(damping_from_kernels(c.retardation, c.modes(), highest * n / points));
    largest = largest.cwiseMax(B.back().diagonal());
  }
  for (int n = 1; n <= points; ++n)
    worsen(check, -smallest_eigenvalue(normalised(B[n - 1], largest)), at_frequency(highest * n / points));
  return check;
}

SelfCheck check_kramers_kronig(const HydrodynamicCoefficients& c, const SelfCheckTolerances& t) {
  const bool several = c.hulls() > 1;
  SelfCheck check{"kramers_kronig", "Kramers-Kronig: A(w), B(w) of the table against the retardation functions", "",
                  0.0, several ? t.coupled_kramers_kronig : t.kramers_kronig,
                  several ? "coupled_kramers_kronig_tolerance" : "kramers_kronig_tolerance"};
  const VectorX largest_damping = largest_diagonal(c);
  for (const FrequencyCoefficients& f : c.frequency) {
    if (f.frequency <= 0.0) continue;
    const MatrixX A = added_mass_from_kernels(c.A_inf, c.retardation, f.frequency);
    const MatrixX B = damping_from_kernels(c.retardation, c.modes(), f.frequency);
    // A(w) of a flat hull passes near zero, even below: A_inf is the least that its errors are compared with. Of
    // coupled hulls the resonance of the gap is in A - A_inf and in B/w alike, as parts of one complex number: there
    // B/w counts.
    VectorX A_scale = f.A.diagonal().cwiseMax(c.A_inf.diagonal());
    if (c.hulls() > 1) A_scale = A_scale.cwiseMax(f.B.diagonal() / f.frequency);
    VectorX B_scale = largest_damping;
    for (int i = 0; i < c.modes(); ++i) {
      B_scale(i) = std::max(B_scale(i), least_damping_scale(c, i, f.frequency, f.A(i, i)));
      A_scale(i) = std::max(A_scale(i), least_inertia_scale(c, i, f.frequency, f.A(i, i)));
    }
    const MatrixX dA = normalised(A - f.A, A_scale);
    const MatrixX dB = normalised(B - f.B, B_scale);
    for (int i = 0; i < c.modes(); ++i)
      for (int j = 0; j < c.modes(); ++j) {
        worsen(check, std::abs(dA(i, j)), at_frequency("A", i, j, f.frequency));
        worsen(check, std::abs(dB(i, j)), at_frequency("B", i, j, f.frequency));
      }
  }
  return check;
}

SelfCheck check_tails(const RetardationFunctions& K, const SelfCheckTolerances& t) {
  SelfCheck check{"kernel_tail", "retardation functions have died out at their end", "", 0.0, t.kernel_tail,
                  "kernel_tail_tolerance"};
  std::map<int, double> largest;  // of each K_ii
  const auto peak_of = [](const RetardationKernel& kernel, std::size_t from) {
    double peak = 0.0;
    for (std::size_t m = from; m < kernel.value.size(); ++m) peak = std::max(peak, std::abs(kernel.value[m]));
    return peak;
  };
  for (const RetardationKernel& kernel : K.kernels)
    if (kernel.i == kernel.j) largest[kernel.i] = peak_of(kernel, 0);
  for (const RetardationKernel& kernel : K.kernels) {
    const double own = peak_of(kernel, 0), tail = peak_of(kernel, (9 * kernel.value.size() + 9) / 10);
    // What couples two modes weakly is measured by what it couples.
    const double scale = std::max(own, std::sqrt(largest[kernel.i] * largest[kernel.j]));
    if (scale > 0.0) worsen(check, tail / scale, pair_name("K", kernel.i, kernel.j));
  }
  return check;
}

SelfCheck check_displaced_mass(const HydrodynamicCoefficients& c) {
  SelfCheck check{"displaced_mass", "added mass in heave of the order of the displaced mass", "", 0.0, 1.0};
  for (int hull = 0; hull < c.hulls(); ++hull) {
    const int heave = 6 * hull + 2;
    const double ratio = c.A_inf(heave, heave) / (c.density * c.volume[hull]);
    if (ratio == 0.0) continue;  // not given
    std::ostringstream detail;
    detail << pair_name("A_inf", heave, heave) << " is " << ratio << " of it";
    worsen(check, std::max(ratio / kLargestHeaveMass, kLeastHeaveMass / ratio), detail.str());
  }
  return check;
}

SelfCheck check_low_frequency(const HydrodynamicCoefficients& c) {
  SelfCheck check{"low_frequency", "finite added mass at low frequency", "", 0.0, kLowFrequencyLimit};
  VectorX others = c.A_inf.diagonal();
  for (std::size_t f = 1; f < c.frequency.size(); ++f) others = others.cwiseMax(c.frequency[f].A.diagonal());
  const FrequencyCoefficients& lowest = c.frequency[0];
  for (int i = 0; i < c.modes(); ++i)
    if (others(i) > 0.0 && (std::isinf(c.depth) || is_free(i)))
      worsen(check, lowest.A(i, i) / others(i), at_frequency("A", i, i, lowest.frequency));
  return check;
}

/// A and B at a frequency: of the table where it has it, else of the retardation functions; false without either. `gap`
/// is empty where it is not known.
bool radiation_at(const HydrodynamicCoefficients& c, double w, MatrixX& A, MatrixX& B, MatrixX& gap) {
  gap.resize(0, 0);
  for (const FrequencyCoefficients& f : c.frequency)
    if (std::abs(f.frequency - w) <= 1e-6 * w) {
      A = f.A;
      B = f.B;
      gap = f.gap;
      return true;
    }
  if (c.retardation.empty()) return false;
  A = added_mass_from_kernels(c.A_inf, c.retardation, w);
  B = damping_from_kernels(c.retardation, c.modes(), w);
  return true;
}

/// Between the frequencies of its table a set is known by its retardation functions, less well than at them.
bool between_table_frequencies(const HydrodynamicCoefficients& c, double w) {
  if (c.frequency.size() < 20 || w < c.frequency.front().frequency || w > c.frequency.back().frequency) return false;
  return std::none_of(c.frequency.begin(), c.frequency.end(),
                      [&](const FrequencyCoefficients& f) { return std::abs(f.frequency - w) <= 1e-6 * w; });
}

/// The headings go round the circle in even steps.
bool all_around(const std::vector<double>& headings) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(headings.size());
  for (std::size_t h = 0; h < headings.size(); ++h)
    if (std::abs(headings[h] - headings[0] - step * static_cast<double>(h)) > 1e-5) return false;
  return headings.size() > 2;
}

/// m, of the largest hull's water plane, where its area is known: a box of this length and area has it.
double diagonal_of(const HydrodynamicCoefficients& c) {
  double breadth = 0.0;
  for (const double area : c.waterplane) breadth = std::max(breadth, area / c.length);
  return std::hypot(c.length, std::min(breadth, c.length));
}

/// Pairs of one hull only: the positions of hulls to each other are not part of a set. What the damped water between
/// coupled hulls takes is not in the waves; it counts where the set knows it.
SelfCheck check_haskind(const HydrodynamicCoefficients& c, const SelfCheckTolerances& t) {
  const bool several = c.hulls() > 1;
  SelfCheck check{"haskind", "Haskind and Newman: B(w) against the energy of X from all around", "", 0.0,
                  several ? t.coupled_haskind : t.haskind,
                  several ? "coupled_haskind_tolerance" : "haskind_tolerance"};
  const ExcitationTable& X = c.excitation;
  const double headings = static_cast<double>(X.headings.size());
  MatrixX A, B, gap;
  VectorX largest = largest_diagonal(c);
  for (double w : X.frequencies)
    if (radiation_at(c, w, A, B, gap)) largest = largest.cwiseMax(B.diagonal());
  for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
    const double w = X.frequencies[f], k = wave_number(w, c.gravity, c.depth);
    if (between_table_frequencies(c, w)) continue;
    if (headings < 2.0 * (0.5 * k * diagonal_of(c) * c.hulls() + 1.0) || !radiation_at(c, w, A, B, gap)) continue;
    VectorX scale = B.diagonal().cwiseMax(kHaskindFloor * largest);
    for (int i = 0; i < c.modes(); ++i) scale(i) = std::max(scale(i), least_damping_scale(c, i, w, A(i, i)));
    const double factor =
        radiated_share(w, c.gravity, c.depth) / (2.0 * c.density * headings);  // 2 pi/headings/(4 pi ...)
    for (int i = 0; i < c.modes(); ++i)
      for (int j = 6 * (i / 6); j <= i; ++j) {
        double energy = 0.0;
        for (std::size_t h = 0; h < X.headings.size(); ++h)
          energy += (X.at(static_cast<int>(f), static_cast<int>(h), i) *
                     std::conj(X.at(static_cast<int>(f), static_cast<int>(h), j)))
                        .real();
        const double size = std::sqrt(std::max(scale(i), 0.0) * std::max(scale(j), 0.0));
        const double taken = gap.size() > 0 ? gap(i, j) : 0.0;
        const double difference = std::abs(factor * energy + taken - 0.5 * (B(i, j) + B(j, i)));
        if (difference > 0.0) worsen(check, size > 0.0 ? difference / size : 1.0, at_frequency("B", i, j, w));
      }
  }
  return check;
}

/// Adds the checks of the excitation in long waves, where the lowest frequency is one.
void add_long_wave_checks(const HydrodynamicCoefficients& c, const SelfCheckTolerances& t,
                          std::vector<SelfCheck>& checks) {
  const ExcitationTable& X = c.excitation;
  const double w = X.frequencies[0];
  MatrixX A, B, gap;
  if (0.5 * wave_number(w, c.gravity, c.depth) * c.length > kLongWave || !radiation_at(c, w, A, B, gap)) return;
  SelfCheck phase{"long_wave_phase", "phase of the excitation in long waves", "", 0.0, t.long_wave_phase,
                  "long_wave_phase_tolerance"};
  SelfCheck heave{"long_wave_heave", "heave force in long waves against the water plane", "", 0.0, t.long_wave_heave,
                  "long_wave_heave_tolerance"};
  const VectorX B_largest = largest_diagonal(c);
  const int headings = static_cast<int>(X.headings.size());
  for (int hull = 0; hull < c.hulls(); ++hull) {
    for (int i = 0; i < 2; ++i) {
      double along = 0.0, force = 0.0, direction = 0.0;
      for (int h = 0; h < headings; ++h) {
        const double d = i == 0 ? std::cos(X.headings[h]) : std::sin(X.headings[h]);
        const Complex x = X.at(0, h, 6 * hull + i);
        along -= x.imag() * d;  // Re(x conj(-i d))
        force += std::norm(x);
        direction += d * d;
      }
      if (force > 0.0 && direction > 1e-6)
        worsen(phase, 1.0 - along / std::sqrt(force * direction),
               "of X" + std::to_string(6 * hull + i + 1) + " " + at_frequency(w));
    }
    Complex mean = 0.0;
    double A_33 = 0.0, B_33 = 0.0;
    const int mode = 6 * hull + 2;
    for (int h = 0; h < headings; ++h) mean += X.at(0, h, mode) / static_cast<double>(headings);
    for (int other = 2; other < c.modes(); other += 6) A_33 += A(mode, other), B_33 += B(mode, other);
    const std::string detail = "of X" + std::to_string(mode + 1) + " " + at_frequency(w);
    if (B(mode, mode) > kHaskindFloor * B_largest(mode) && B_33 > 0.0 && mean != 0.0)
      worsen(phase, std::abs(mean.imag() / (w * B_33) + 1.0), detail);
    if (hull < static_cast<int>(c.waterplane.size()) && c.waterplane[hull] > 0.0) {
      // The water's acceleration, w^2 where the hull's mean depth is small beside the wave, pulls at the displaced and
      // the added mass: rho g A_w - w^2 (rho V + A_33). A hull of upright walls has exp(-k V/A_w) of both sums at its
      // bottom, which is the same in the limit. What a column or a spar leaves of it is a small difference of the two
      // parts: their sum is the scale.
      const double spring = c.density * c.gravity * c.waterplane[hull], mass = c.density * c.volume[hull];
      const double at_bottom = std::exp(-w * w / c.gravity * c.volume[hull] / c.waterplane[hull]);
      worsen(heave,
             std::abs(mean.real() - (spring - w * w * A_33) * at_bottom) / (spring + w * w * (mass + std::abs(A_33))),
             detail);
    }
  }
  checks.push_back(phase);
  if (!c.waterplane.empty()) checks.push_back(heave);
}

void add_table_checks(const HydrodynamicCoefficients& c, const SelfCheckTolerances& t, std::vector<SelfCheck>& checks) {
  SelfCheck symmetry{"symmetry", "symmetry of A(w) and B(w)", "", 0.0, t.symmetry, kSymmetryKey};
  SelfCheck damping{"damping", "B(w) >= 0", "", 0.0, t.negative_damping, kNegativeDampingKey};
  const VectorX B_scale = largest_diagonal(c);
  for (const FrequencyCoefficients& f : c.frequency) {
    worsen_symmetry(symmetry, f.A, "A", std::string(" ").append(at_frequency(f.frequency)));
    const MatrixX B = normalised(f.B, B_scale);
    worsen(symmetry, (B - B.transpose()).cwiseAbs().maxCoeff(), at_frequency(f.frequency));
    worsen(damping, -smallest_eigenvalue(B), at_frequency(f.frequency));
  }
  checks.push_back(symmetry);
  checks.push_back(damping);
  checks.push_back(check_low_frequency(c));
}

}  // namespace

std::vector<SelfCheck> self_checks(const HydrodynamicCoefficients& c, const SelfCheckTolerances& tolerances) {
  std::vector<SelfCheck> checks = {check_finite(c)};
  if (!checks[0].passed()) return checks;  // the others would say nothing
  SelfCheck symmetry{"symmetry_infinite", "symmetry of A_inf", "", 0.0, tolerances.symmetry, kSymmetryKey};
  worsen_symmetry(symmetry, c.A_inf, "A_inf", "");
  checks.push_back(symmetry);
  SelfCheck positive{"positive_infinite", "A_inf is positive semidefinite", "", 0.0, 1e-6};
  worsen(positive, -smallest_eigenvalue(normalised(c.A_inf, c.A_inf.diagonal().cwiseMax(0.0))), "");
  checks.push_back(positive);
  checks.push_back(check_displaced_mass(c));
  if (!c.frequency.empty()) add_table_checks(c, tolerances, checks);
  if (!c.retardation.empty()) {
    checks.push_back(check_kernel_damping(c, tolerances));
    checks.push_back(check_tails(c.retardation, tolerances));
    if (!c.frequency.empty()) checks.push_back(check_kramers_kronig(c, tolerances));
  }
  if (!c.excitation.empty()) {
    if (all_around(c.excitation.headings)) checks.push_back(check_haskind(c, tolerances));
    add_long_wave_checks(c, tolerances, checks);
  }
  return checks;
}

const std::vector<std::string>& acceptable_self_checks() {
  static const std::vector<std::string> keys = {
      "symmetry_infinite", "positive_infinite", "displaced_mass", "symmetry", "damping",         "low_frequency",
      "kernel_damping",    "kernel_tail",       "kramers_kronig", "haskind",  "long_wave_phase", "long_wave_heave"};
  return keys;
}

void require_self_checks(const HydrodynamicCoefficients& coefficients, const std::vector<std::string>& accepted,
                         const SelfCheckTolerances& tolerances) {
  const std::vector<std::string>& known = acceptable_self_checks();
  for (const std::string& key : accepted)
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string list;
      for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
      throw SpecificationError(coefficients.source, "",
                               "\"" + key + "\" is not a self-check that can be accepted; there are " + list);
    }
  for (const SelfCheck& check : self_checks(coefficients, tolerances)) {
    if (check.passed() || std::find(accepted.begin(), accepted.end(), check.key) != accepted.end()) continue;
    std::ostringstream sentence;
    sentence << "the coefficients fail \"" << check.name << "\" (" << check.key << ") " << check.detail
             << ": deviation " << check.value << ", allowed " << check.limit;
    if (!check.tolerance_key.empty()) sentence << " by panel_method." << check.tolerance_key;
    sentence << "; panel_method.accept_failed_checks = \"" << check.key << "\" uses them as they are, with a warning";
    throw SpecificationError(coefficients.source, "", sentence.str());
  }
}

}  // namespace stillhook
