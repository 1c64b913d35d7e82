// Diffraction forces of first order at the hull's actual position.
//
//   F(t) = r(t) Re sum_j a_j X_D(w_j, b_j - psi) exp(i th_j),   th_j = k_j (x cos b_j + y sin b_j) - w_j t + e_j
//   X_D = X - X_FK
//
// (x, y): the hull's reference point now; psi its mean heading; r(t), a_j, k_j, b_j, e_j of wave_field.h. X is the
// total excitation of the coefficient set. X_FK, the linear Froude-Krylov force on the mean wetted surface, is taken
// off because the pressure integral of the hydrostatics has it already. The headings of a set of several hulls are
// relative to the first hull; the rows of each hull refer to the crest passing that hull's own reference point.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/hull/coefficients.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// X_D between the entries of a table: cubic in frequency (three-point slopes), trigonometric in heading. The table is
/// continued to w = 0, where the hull does not disturb the wave, X_D = 0, and X_D ~ w^2.
///
/// With heading the force of a wave turns in phase like exp(i k (length/2) cos b), which n headings resolve while
/// k length/2 <= n/2; shorter waves can be looked up at the table's own headings only. So can all waves when the
/// headings do not go evenly round the circle by 90 deg or less: what is within kSameDirection of one takes it.
class DiffractionTable {
 public:
  static constexpr double kSameDirection = 0.5 / 180.0 * 3.14159265358979323846;  // rad: 1 % of the force across

  /// `froude_krylov` and `headings` (rad) of each hull of the set, in order; `length`: of the longest hull, m.
  DiffractionTable(const ExcitationTable& total, std::span<const LinearFroudeKrylov> froude_krylov,
                   std::span<const double> headings, double length);

  double highest_frequency() const { return frequencies_.back(); }
  /// The headings go round the circle, so that those between can be looked up.
  bool all_around() const { return all_around_; }
  const std::vector<double>& headings() const { return headings_; }  // rad
  /// False above the highest frequency and between headings that are too far apart for the wave length.
  bool resolves(double frequency, double heading) const;
  /// All modes; frequency in [0, highest_frequency()], heading in rad relative to the first hull.
  Eigen::VectorXcd at(double frequency, double heading) const;

 private:
  Eigen::VectorXcd at_heading(int f, double heading) const;
  /// The entry that is closest in heading.
  int closest(double heading) const;

  std::vector<double> frequencies_;      // rad/s, the first is 0
  std::vector<double> headings_;         // rad
  std::vector<Eigen::MatrixXcd> value_;  // [frequency] headings x modes
  double length_, gravity_;
  bool all_around_ = true;
};

class Diffraction {
 public:
  /// `headings`: mean heading of each hull, rad. Components that the table does not resolve are left out when they hold
  /// at most `negligible_energy` of the sea's energy (sum of a^2) together; otherwise throws SpecificationError(entry).
  Diffraction(std::shared_ptr<const WaveField> waves, const DiffractionTable& table, std::span<const double> headings,
              double negligible_energy, const std::string& entry);

  /// Multiplies the force on each hull, in order.
  void scale(std::span<const double> factors);

  bool operator==(const Diffraction& other) const { return *waves_ == *other.waves_ && hulls_ == other.hulls_; }
  bool calm() const { return waves_->calm(); }
  /// Of the sea's energy, 1.
  double share_left_out() const { return left_out_; }

  /// Force on a hull with its reference point at (x, y) in W, in its heading frame (N, N m), and its derivatives with
  /// respect to x and y in W.
  void evaluate(int hull, double t, double x, double y, Vector6& F, Eigen::Matrix<double, 6, 2>& dF) const;

 private:
  struct Component {
    Vector6 real, imag;  // a X_D
    double kx, ky, frequency, phase;
    bool operator==(const Component&) const = default;
  };
  std::shared_ptr<const WaveField> waves_;
  std::vector<std::vector<Component>> hulls_;
  double left_out_ = 0.0;
};

}  // namespace stillhook
