// Diffraction forces of first order at the hull's actual position.
//
//   F(t) = r(t) Re sum_j a_j X_D(w_j, b_j - psi) exp(i th_j),   th_j = k_j (x cos b_j + y sin b_j) - w_j t + e_j
//   X_D = X - X_FK
//
// (x, y): the hull's reference point now; psi its mean heading; r(t), a_j, k_j, b_j, e_j of wave_field.h. X is the
// total excitation of the coefficient set. X_FK, the linear Froude-Krylov force on the mean wetted surface, is taken
// off because the pressure integral of the hydrostatics has it already. The headings of a set of several hulls are
// relative to the first hull; the rows of each hull refer to the crest passing that hull's own reference point.
//
// Above the last frequency W of the table X_D is the limit of short waves L (linear_froude_krylov.h) and what the table
// differs from it at W, which fades with the square of the wave number:
//
//   X_D(w, b) = L(w, b) + (X_D(W, b) - L(W, b)) (W/w)^4,   w > W
//
// A set of water with a bed is read at the frequency of the wave. Where a wave feels the bed and the set is one of deep
// water, X_D is read at the frequency sqrt(g k) that a wave
// of its length has in deep water: what a hull throws back depends on its size in wave lengths. Against X of a box
// barge of 110 m x 46 m x 4 m that HAMS computed over a bed, in waves of 8 to 16 s, the sum X_FK + X_D is then wrong by
// 1 to 20 % in 40 m of water and by 5 to 38 % in 20 m; with X_D read at w by up to 30 % and 103 % (heave in head seas,
// whose zero the length decides). The heave force comes out too small: the narrow gap under a hull is not in it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// X_D between the entries of a table: cubic in frequency (three-point slopes), trigonometric in heading. The table is
/// continued to w = 0, where the hull does not disturb the wave, X_D = 0, and X_D ~ w^2; over a bed X_D ~ w there.
///
/// With heading the force of a wave turns in phase like exp(i k (length/2) cos b), which n headings resolve while
/// k length/2 <= n/2; shorter waves can be looked up at the table's own headings only. So can all waves when the
/// headings do not go evenly round the circle by 90 deg or less: what is within kSameDirection of one takes it.
class DiffractionTable {
 public:
  static constexpr double kSameDirection = 0.5 / 180.0 * 3.14159265358979323846;  // rad: 1 % of the force across

  /// `froude_krylov` (in water as deep as the set's) and `headings` (rad) of each hull of the set, in order; `length`:
  /// of the longest hull, m.
  DiffractionTable(const ExcitationTable& total, std::span<const LinearFroudeKrylov> froude_krylov,
                   std::span<const double> headings, double length);

  double highest_frequency() const { return frequencies_.back(); }
  /// The headings go round the circle, so that those between can be looked up.
  bool all_around() const { return all_around_; }
  const std::vector<double>& headings() const { return headings_; }  // rad
  /// The frequency to look a wave up at, rad/s; depth: that the wave feels, m, that of the set when this has one.
  double frequency_of(double frequency, double depth) const;
  /// False above the highest frequency and between headings that are too far apart for the wave length.
  bool resolves(double frequency, double heading) const;
  /// The second of these alone.
  bool resolves_heading(double frequency, double heading) const;
  /// All modes; heading in rad relative to the first hull. Above highest_frequency() by the limit of short waves.
  Eigen::VectorXcd at(double frequency, double heading) const;

 private:
  struct Known;  // values above the table, which every model of a search asks for again
  Eigen::VectorXcd at_heading(int f, double heading) const;
  /// The entry that is closest in heading.
  int closest(double heading) const;
  Eigen::VectorXcd within(double frequency, double heading) const;
  Eigen::VectorXcd short_waves(double frequency, double heading) const;

  std::vector<double> frequencies_;      // rad/s, the first is 0
  std::vector<double> headings_;         // rad
  std::vector<Eigen::MatrixXcd> value_;  // [frequency] headings x modes
  std::vector<LinearFroudeKrylov> hulls_;
  std::vector<double> turned_;  // rad, heading of each hull from that of the first
  double length_, gravity_, depth_;
  bool all_around_ = true;
  std::shared_ptr<Known> known_;
};

/// What becomes of waves above the table: the limit of short waves, or no diffraction.
enum class ShortWaves { limit, left_out };

/// Why a sea is refused that has too much energy where the coefficients say nothing, with the keys that help.
std::string unresolved_sea(double share, bool above, double highest_frequency, double negligible_energy);

class Diffraction {
 public:
  /// `headings`: mean heading of each hull, rad. Components that the table does not resolve (with ShortWaves::limit only
  /// those between its headings) are left out when they hold at most `negligible_energy` of the sea's energy (sum of
  /// a^2) together; otherwise throws SpecificationError(entry).
  Diffraction(std::shared_ptr<const WaveField> waves, const DiffractionTable& table, std::span<const double> headings,
              double negligible_energy, const std::string& entry, ShortWaves above = ShortWaves::left_out);

  /// Multiplies the force on each hull, in order.
  void scale(std::span<const double> factors);

  bool operator==(const Diffraction& other) const { return *waves_ == *other.waves_ && hulls_ == other.hulls_; }
  bool calm() const { return waves_->calm(); }
  /// Of the sea's energy, 1.
  double share_left_out() const { return left_out_; }
  /// The same of the waves that the limit of short waves carries.
  double share_in_limit() const { return in_limit_; }

  /// Force on a hull with its reference point at (x, y) in W, in its heading frame (N, N m), and its derivatives with
  /// respect to x and y in W.
  void evaluate(int hull, double t, double x, double y, Vector6& F, Eigen::Matrix<double, 6, 2>& dF) const;

 private:
  // The waves that act on a hull and their a X_D, as sim/sea/wave_sums.h wants them.
  struct Hull {
    std::size_t waves = 0;
    std::vector<double> wave, force;
    void add(const WaveComponent& component, const Eigen::VectorXcd& X);
    bool operator==(const Hull&) const = default;
  };
  std::shared_ptr<const WaveField> waves_;
  std::vector<Hull> hulls_;
  double left_out_ = 0.0, in_limit_ = 0.0;
};

}  // namespace stillhook
