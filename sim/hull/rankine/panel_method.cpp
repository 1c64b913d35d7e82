#include "sim/hull/rankine/panel_method.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "sim/hull/linear_froude_krylov.h"
#include "sim/hull/rankine/band_joints.h"
#include "sim/hull/rankine/bands.h"
#include "sim/hull/rankine/hull_modes.h"
#include "sim/hull/rankine/memory.h"
#include "sim/interrupted.h"
#include "sim/sea/dispersion.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

using namespace rankine;
// Added inertia below this share of the displaced mass times the square of half the length is noise of the panels.
constexpr double kStill = 1e-3;
// Phase of the wave at half the hull's length from one frequency of the excitation to the next, rad.
constexpr double kPhaseStep = 0.5;
// Largest difference between the damping of the pressure and that of the radiated energy, as "haskind" measures it. The
// pressure's is a small difference of large numbers where sides and bottom work against each other: in the roll of a
// box of 120 x 25 x 6 m it is 10 % off on the panels of the default and 1 % on panels 0.6 times as long, in the yaw of a
// box of 30 x 30 x 2.5 m 9 % and 6 %, while the energy's changes by 1.5 % at most. A wrong sign or symmetry gives 100 %.
constexpr double kEnergyBalance = 0.25;

/// Weights of the cubic through the four nodes around x (fewer nodes: of lower order), first node and weights.
std::pair<int, std::vector<double>> cubic_weights(const std::vector<double>& nodes, double x) {
  const int n = static_cast<int>(nodes.size()), order = std::min(4, n);
  int first = static_cast<int>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin()) - order / 2;
  first = std::clamp(first, 0, n - order);
  std::vector<double> weights(order, 1.0);
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j)
      if (i != j) weights[i] *= (x - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
  return {first, weights};
}

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Rows and columns of a class's modes into the matrix of all.
template <class Scalar>
void scatter(const Matrix<Scalar>& block, const std::vector<int>& modes, Matrix<Scalar>& all) {
  for (std::size_t i = 0; i < modes.size(); ++i)
    for (std::size_t j = 0; j < modes.size(); ++j) all(modes[i], modes[j]) = block(i, j);
}

class Computation {
 public:
  Computation(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options, PanelMethodReport& report,
              const std::function<bool(double, const std::string&)>& progress)
      : hulls_(hulls), options_(options), report_(report), progress_(progress), layout_(place(hulls)),
        to_middle_(to_middle(layout_)), modes_(6 * static_cast<int>(hulls.size())) {}

  HydrodynamicCoefficients run() {
    require_clearance(hulls_, layout_, options_.depth);
    report_.bands = bands_of(layout_, options_);
    measure_parts(hulls_, layout_, options_, report_.bands);
    describe();
    limits();
    double done = 0.0, all = 0.0;
    for (const PanelBand& band : report_.bands) all += static_cast<double>(band.frequencies.size());
    for (PanelBand& band : report_.bands) {
      const double share = static_cast<double>(band.frequencies.size());
      solve(band, [&](double within) { tell((done + within * share) / all, band); });
      done += share;
    }
    join_all_parts();
    add_froude_krylov();
    if (hulls_.size() == 1) take_radiated_damping();
    keep_wanted_headings();
    set_.gap_rise = report_.gap_rise;
    set_.gap_frequency = report_.gap_frequency;
    if (progress_) progress_(1.0, "done");
    return std::move(set_);
  }

 private:
  void tell(double share, const PanelBand& band) const {
    if (!progress_) return;
    std::ostringstream text;
    text.precision(3);
    text << band.from << " to " << band.to << " rad/s";
    if (!progress_(share, text.str())) throw Interrupted();
  }

  bool deep() const { return std::isinf(options_.depth); }

  std::string water() const {
    if (deep()) return "deep water";
    std::ostringstream text;
    text << "water " << options_.depth << " m deep";
    return text.str();
  }

  void describe() {
    set_.source = "panel method";
    set_.description = "Rankine panel method of stillhook, zero speed, " + water() + ", upright at the mean draft";
    set_.density = options_.density;
    set_.gravity = options_.gravity;
    set_.depth = options_.depth;
    set_.waterline = hulls_[0].waterline;
    for (const Placement& p : layout_.hulls) set_.length = std::max({set_.length, p.length, p.breadth});
    set_.excitation.modes = modes_;
    // As many as the energy needs that is radiated all around, a multiple of those that are wanted.
    PanelMethodOptions around = options_;
    around.headings = 0;
    const int wanted = headings_for(layout_, options_);
    headings_kept_ = (headings_for(layout_, around) + wanted - 1) / wanted;
    const int headings = wanted * headings_kept_;
    for (int h = 0; h < headings; ++h) set_.excitation.headings.push_back(2.0 * std::numbers::pi * h / headings);
    for (const PanelBand& band : report_.bands)
      for (std::size_t f = 0; f + 1 < band.frequencies.size(); ++f) {
        const double a = band.frequencies[f], b = band.frequencies[f + 1];
        const double phase = 0.5 * set_.length *
                             (deep() ? (b * b - a * a) / options_.gravity
                                     : wave_number(b, options_.gravity, options_.depth) -
                                           wave_number(a, options_.gravity, options_.depth));
        const int parts = std::max(1, static_cast<int>(std::ceil(phase / kPhaseStep)));
        for (int i = 0; i < parts; ++i) set_.excitation.frequencies.push_back(a + i * (b - a) / parts);
      }
    set_.excitation.frequencies.push_back(report_.bands.back().to);
    set_.excitation.value.resize(set_.excitation.frequencies.size() * set_.excitation.headings.size() * modes_);
  }

  /// A(0) and A_inf, on panels half as long as those of the band.
  void limits() {
    const HullPanels panels = panels_of(hulls_, layout_, 0.5 * report_.bands.front().panel_length);
    const VectorX weight = panel_weights(panels, options_.density);
    for (std::size_t k = 0; k < hulls_.size(); ++k) {
      const HullPanels one = only(panels, static_cast<int>(k));
      set_.volume.push_back(panels.volume(static_cast<int>(k)));
      set_.waterplane.push_back(waterplane_area(one));
    }
    FrequencyCoefficients zero;
    zero.A = zero.B = set_.A_inf = MatrixX::Zero(modes_, modes_);
    for (const BoundaryClass& c : limit_problem(panels, bed_within(report_.bands.front().width, layout_, options_))) {
      const ClassModes modes = modes_of(panels, layout_, c.parity);
      if (modes.modes.empty()) continue;
      scatter<double>(inertia_of(c.local, modes, weight), modes.modes, set_.A_inf);
      scatter<double>(inertia_of(c.hull_response, modes, weight), modes.modes, zero.A);
    }
    symmetrise(zero.A, zero.A);
    symmetrise(set_.A_inf, zero.A);
    still_.assign(modes_, false);
    for (int i = 0; i < modes_; ++i) {
      const Placement& p = layout_.hulls[i / 6];
      still_[i] = i % 6 >= 3 && zero.A(i, i) < kStill * options_.density * set_.volume[i / 6] *
                                                   std::pow(0.5 * std::max(p.length, p.breadth), 2);
    }
    scale_ = zero.A;
    clear_still(zero.A);
    clear_still(set_.A_inf);
    A_inf_middle_ = set_.A_inf;
    set_.A_inf = about_origin(set_.A_inf);
    zero.A = about_origin(zero.A);
    // Over a bed A_33 grows like -ln w: there is no A(0).
    if (deep()) set_.frequency.push_back(std::move(zero));
  }

  /// A, B and X_D of one part of the band. `tell_share` hears the share of it that is done; ends it by throwing.
  void solve(PanelBand& band, const std::function<void(double)>& tell_share) {
    tell_share(0.0);
    const HullPanels panels = panels_of(hulls_, layout_, band.panel_length);
    SurfacePanels surface = free_surface(panels, grid_of(band));
    mark_gap(layout_, panels, surface);
    const VectorX weight = panel_weights(panels, options_.density);
    const std::size_t count = band.frequencies.size();
    MatrixX A_inf = MatrixX::Zero(modes_, modes_);
    std::vector<Matrix<Complex>> A(count, Matrix<Complex>::Zero(modes_, modes_));
    std::vector<MatrixX> gap(count, MatrixX::Zero(modes_, modes_));
    // Influences of all classes are computed together; after that each class is a share of the rest.
    const std::vector<BoundaryClass> classes =
        boundary_problem(panels, surface, bed_within(band.width, layout_, options_));
    constexpr double kInfluences = 0.4;
    int solved = 0;
    for (const BoundaryClass& c : classes) {
      tell_share(kInfluences + (1.0 - kInfluences) * solved++ / static_cast<double>(classes.size()));
      const ClassModes modes = modes_of(panels, layout_, c.parity);
      if (modes.modes.empty()) continue;
      scatter<double>(inertia_of(c.local, modes, weight), modes.modes, A_inf);
      const std::vector<Matrix<Complex>> v(count, modes.normal.cast<Complex>());
      const std::vector<FrequencyResponse> responses =
          frequency_responses(c, surface, beach_of(band, options_), options_.gravity, band.frequencies, v);
      watch_gap(surface, modes, responses);
      std::vector<Matrix<Complex>> weighted;
      for (std::size_t f = 0; f < count; ++f) {
        weighted.push_back(weight.cast<Complex>().asDiagonal() * responses[f].hull);
        scatter<Complex>(-modes.normal.transpose().cast<Complex>() * weighted[f], modes.modes, A[f]);
        if (responses[f].taken_by_gap.size() > 0)
          scatter<double>(band.frequencies[f] * options_.density * panels.symmetry.images() * responses[f].taken_by_gap,
                          modes.modes, gap[f]);
        band.iterations = std::max(band.iterations, responses[f].iterations);
      }
      excite(panels, c.parity, modes, weighted, band);
    }
    std::vector<FrequencyCoefficients>& part = parts_.emplace_back();
    for (std::size_t f = 0; f < count; ++f) {
      // The error of the panels is nearly the same at every frequency: it goes with A_inf of the same panels.
      FrequencyCoefficients at{band.frequencies[f], A_inf_middle_ + A[f].real() - A_inf,
                               band.frequencies[f] * A[f].imag()};
      symmetrise(at.A, scale_);
      symmetrise(at.B, band.frequencies[f] * scale_);
      clear_still(at.A);
      clear_still(at.B);
      if (hulls_.size() > 1) {
        at.gap = std::move(gap[f]);
        clear_still(at.gap);
      }
      part.push_back(std::move(at));
    }
  }

  /// The parts of the band as one table.
  void join_all_parts() {
    join_parts(report_.bands, parts_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t f = p > 0 ? 1 : 0; f < parts_[p].size(); ++f) {
        const FrequencyCoefficients& at = parts_[p][f];
        set_.frequency.push_back({at.frequency, about_origin(at.A), about_origin(at.B)});
        if (at.gap.size() > 0) set_.frequency.back().gap = about_origin(at.gap);
      }
  }

  /// eta = i w phi/g, and a unit velocity is a motion of 1/w.
  void watch_gap(const SurfacePanels& surface, const ClassModes& modes,
                 const std::vector<FrequencyResponse>& responses) {
    for (const FrequencyResponse& response : responses)
      for (std::size_t k = 0; k < modes.modes.size(); ++k) {
        if (modes.modes[k] % 6 >= 3) continue;
        for (std::size_t j = 0; j < surface.in_gap.size(); ++j) {
          const double rise = std::pow(response.frequency, 2) / options_.gravity *
                              std::abs(response.surface(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)));
          if (!surface.in_gap[j] || rise <= report_.gap_rise) continue;
          report_.gap_rise = rise;
          report_.gap_frequency = response.frequency;
        }
      }
  }

  /// X_D by Haskind's relation from the weighted potentials of the modes at the band's frequencies.
  void excite(const HullPanels& panels, const Parity& parity, const ClassModes& modes,
              const std::vector<Matrix<Complex>>& weighted, const PanelBand& band) {
    ExcitationTable& X = set_.excitation;
    const std::size_t part = static_cast<std::size_t>(&band - report_.bands.data());
    const Matrix<Complex> before = excitation_at(X, band.from, modes.modes);
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
      const double w = X.frequencies[f];
      if (w < band.from || w > band.to) continue;
      const auto [first, weights] = cubic_weights(band.frequencies, w);
      Matrix<Complex> potential = weights[0] * weighted[first];
      for (std::size_t i = 1; i < weights.size(); ++i) potential += weights[i] * weighted[first + i];
      for (std::size_t h = 0; h < X.headings.size(); ++h) {
        const Eigen::VectorXcd velocity =
            incident_velocity(panels, parity, w, X.headings[h], options_.gravity, options_.depth);
        const Eigen::VectorXcd X_D = Complex(0.0, w) * (potential.transpose() * velocity);
        for (std::size_t k = 0; k < modes.modes.size(); ++k)
          X.at(static_cast<int>(f), static_cast<int>(h), modes.modes[k]) =
              (still_[modes.modes[k]] ? 0.0 : X_D(k)) *
              phase_at_origin(layout_.hulls[modes.modes[k] / 6], w, X.headings[h], options_.gravity, options_.depth);
      }
    }
    if (part > 0) join_excitation(report_.bands, part - 1, before, modes.modes, X);
  }

  /// Carries X_D to Bo and adds X_FK.
  void add_froude_krylov() {
    ExcitationTable& X = set_.excitation;
    for (std::size_t k = 0; k < hulls_.size(); ++k) {
      const LinearFroudeKrylov incident(hulls_[k].mesh, hulls_[k].waterline, options_.density, options_.gravity,
                                        options_.depth);
      const Vector3 arm = layout_.hulls[k].from_Bo;
      std::vector<double> headings(X.headings);
      for (double& heading : headings) heading -= layout_.hulls[k].reference.yaw;
#pragma omp parallel for schedule(dynamic, 1)
      for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
        const auto froude_krylov = incident.excitations(X.frequencies[f], headings);
        for (std::size_t h = 0; h < X.headings.size(); ++h) {
          Eigen::Map<Eigen::Matrix<Complex, 6, 1>> at(&X.at(static_cast<int>(f), static_cast<int>(h), 6 * k));
          at.tail<3>() += cross_matrix(arm).cast<Complex>() * at.head<3>();
          at += froude_krylov.col(h);
          // A turn that moves no water has no moment about the middle either.
          const Eigen::Vector3cd about_middle = cross_matrix(arm).cast<Complex>() * at.head<3>();
          for (int i = 3; i < 6; ++i)
            if (still_[6 * k + i]) at(i) = about_middle(i - 3);
        }
      }
    }
  }

  /// B from the energy that the waves carry away, k/(8 pi rho g c_g) int X_i conj X_j db (Newman 1962), in place of
  /// that of the pressure on the hull, which counts what beach and panels take near the hull as well and is small
  /// against the pressure itself. Where the two are too far apart to be the same hull's, the pressure's stays and the
  /// self-check "haskind" refuses the set.
  void take_radiated_damping() {
    const std::vector<SelfCheck> checks = self_checks(set_);
    const auto balance = std::find_if(checks.begin(), checks.end(), [](const auto& c) { return c.key == "haskind"; });
    if (balance == checks.end()) return;
    report_.energy_balance = balance->value;
    if (!(balance->value <= kEnergyBalance)) return;
    const ExcitationTable& X = set_.excitation;
    const int headings = static_cast<int>(X.headings.size());
    for (FrequencyCoefficients& at : set_.frequency) {
      const auto f = std::find(X.frequencies.begin(), X.frequencies.end(), at.frequency);
      if (f == X.frequencies.end()) continue;  // A(0)
      const Eigen::Map<const Matrix<Complex>> x(&X.at(static_cast<int>(f - X.frequencies.begin()), 0, 0), modes_, headings);
      at.B = radiated_share(at.frequency, options_.gravity, options_.depth) / (2.0 * options_.density * headings) *
             (x * x.adjoint()).real();
    }
    std::ostringstream text;
    text.precision(2);
    text << "; damping from the radiated energy, from which that of the pressure differs by "
         << 100.0 * balance->value << " % at most (" << balance->detail << ")";
    set_.description += text.str();
  }

  void keep_wanted_headings() {
    if (headings_kept_ == 1) return;
    ExcitationTable kept;
    kept.modes = modes_;
    kept.frequencies = set_.excitation.frequencies;
    for (std::size_t h = 0; h < set_.excitation.headings.size(); h += headings_kept_)
      kept.headings.push_back(set_.excitation.headings[h]);
    for (std::size_t f = 0; f < kept.frequencies.size(); ++f)
      for (std::size_t h = 0; h < kept.headings.size(); ++h)
        for (int i = 0; i < modes_; ++i)
          kept.value.push_back(set_.excitation.at(static_cast<int>(f), static_cast<int>(h) * headings_kept_, i));
    set_.excitation = std::move(kept);
  }

  /// A turn that moves no water, as of a body of revolution about its axis: what the panels leave of it is noise.
  void clear_still(MatrixX& M) const {
    for (int i = 0; i < modes_; ++i)
      if (still_[i]) {
        M.row(i).setZero();
        M.col(i).setZero();
      }
  }

  MatrixX about_origin(const MatrixX& M) const { return to_middle_.transpose() * M * to_middle_; }

  /// Replaces M by its symmetric part and keeps the largest difference, relative to the diagonal of `scale`.
  void symmetrise(MatrixX& M, const MatrixX& scale) {
    for (int i = 0; i < modes_; ++i)
      for (int j = 0; j < i; ++j) {
        const double s = std::sqrt(scale(i, i) * scale(j, j));
        report_.asymmetry = std::max(report_.asymmetry, std::abs(M(i, j) - M(j, i)) / s);
        M(i, j) = M(j, i) = 0.5 * (M(i, j) + M(j, i));
      }
  }

  const std::vector<PanelHull>& hulls_;
  const PanelMethodOptions& options_;
  PanelMethodReport& report_;
  const std::function<bool(double, const std::string&)>& progress_;
  Layout layout_;
  MatrixX to_middle_;
  int modes_;
  MatrixX A_inf_middle_;
  std::vector<std::vector<FrequencyCoefficients>> parts_;  // of the band, about the middles; ends are in both
  int headings_kept_ = 1;    // every n-th heading is wanted
  MatrixX scale_;            // A(0) about the middles; over a bed that of no flow through the water's surface
  std::vector<bool> still_;  // of each mode
  HydrodynamicCoefficients set_;
};

}  // namespace

std::vector<PanelBand> planned_bands(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options) {
  require_options(options);
  const Layout layout = place(hulls);
  require_clearance(hulls, layout, options.depth);
  std::vector<PanelBand> bands = bands_of(layout, options);
  measure_parts(hulls, layout, options, bands);
  return bands;
}

HydrodynamicCoefficients panel_method(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options,
                                      PanelMethodReport* report,
                                      const std::function<bool(double, const std::string&)>& progress) {
  require_options(options);
  PanelMethodReport own;
  return Computation(hulls, options, report ? *report : own, progress).run();
}

}  // namespace stillhook
