#include "planner/verbs/hydro/hydro_convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kRatio = 1.4142135623730951;
constexpr double kLowestOrder = 1.0, kHighestOrder = 2.0;

/// Numbers of one curve and how far they lie from those of another.
struct Curve {
  std::vector<Complex> value;
  double largest() const {
    double most = 0.0;
    for (const Complex& v : value) most = std::max(most, std::abs(v));
    return most;
  }
};

struct Difference {
  double most = 0.0, mean = 0.0;  // of the absolute values; the mean is the root mean square
};

Difference difference(const Curve& a, const Curve& b) {
  Difference d;
  const std::size_t count = std::min(a.value.size(), b.value.size());
  for (std::size_t i = 0; i < count; ++i) {
    d.most = std::max(d.most, std::abs(a.value[i] - b.value[i]));
    d.mean += std::norm(a.value[i] - b.value[i]) / static_cast<double>(count);
  }
  d.mean = std::sqrt(d.mean);
  return d;
}

Curve curve_of(const HydrodynamicCoefficients& set, const std::string& quantity, int mode) {
  Curve curve;
  if (quantity == "X") {
    const ExcitationTable& X = set.excitation;
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      for (std::size_t h = 0; h < X.headings.size(); ++h)
        curve.value.push_back(X.at(static_cast<int>(f), static_cast<int>(h), mode));
    return curve;
  }
  for (const FrequencyCoefficients& at : set.frequency)
    curve.value.push_back(quantity == "A" ? at.A(mode, mode) : at.B(mode, mode));
  return curve;
}

void count_panels(const std::vector<PanelBand>& bands, int& hull, int& surface) {
  for (const PanelBand& band : bands)
    if (band.hull_panels + band.surface_panels > hull + surface) hull = band.hull_panels, surface = band.surface_panels;
}

}  // namespace

ConvergenceRow convergence_row(const std::array<const HydrodynamicCoefficients*, 3>& grids, const std::string& quantity,
                               int mode) {
  const Curve coarse = curve_of(*grids[0], quantity, mode), middle = curve_of(*grids[1], quantity, mode),
              fine = curve_of(*grids[2], quantity, mode);
  const double scale = std::max(fine.largest(), std::numeric_limits<double>::min());
  const Difference first = difference(coarse, middle), second = difference(middle, fine);
  ConvergenceRow row{quantity, mode, first.most / scale, second.most / scale};
  const double order = second.mean > 0.0 ? std::log(first.mean / second.mean) / std::log(kRatio) : 0.0;
  if (order >= kLowestOrder) {
    row.order = order;
    row.error = row.second / (1.0 - std::pow(kRatio, -std::min(order, kHighestOrder)));
  } else {
    row.error = std::max(row.first, row.second);
  }
  return row;
}

const ConvergenceRow& Convergence::worst() const {
  return *std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
}

std::string Convergence::conclusion(const HydroSet& set) const {
  const ConvergenceRow& row = worst();
  return fmt::format(
      "The panels of {} are {} {:.0f} % of converged coefficients: the largest estimated error is {:.1f} % of "
      "the largest {} in {}.",
      set.title(), within_limit() ? "within" : "NOT within", 100.0 * kLimit, 100.0 * row.error, row.quantity,
      set.mode_name(row.mode));
}

std::array<HydroSet, 2> convergence_sets(const HydroSet& set) {
  std::array<HydroSet, 2> others{set, set};
  others[0].options.refinement = set.options.refinement / kRatio;
  others[1].options.refinement = set.options.refinement * kRatio;
  for (HydroSet& other : others) other.bands = planned_bands(other.hulls, other.options);
  return others;
}

Convergence converge(const Case& c, const HydroSet& set, const HydroProgress& progress) {
  std::array<HydroSet, 2> others = convergence_sets(set);
  double done = 0.0, all = 0.0;
  for (const HydroSet& other : others) all += estimated_seconds(other);
  for (HydroSet& other : others) {
    const double own = estimated_seconds(other);
    const std::string grid = fmt::format("panels divided by {:.2f}: ", other.options.refinement);
    compute_set(c, other, [&](double share, const std::string& text) {
      return !progress || progress((done + share * own) / all, grid + text);
    });
    done += own;
  }
  Convergence result;
  const std::array<const HydroSet*, 3> grids{&others[0], &set, &others[1]};
  for (int k = 0; k < 3; ++k) {
    result.refinement[k] = grids[k]->options.refinement;
    count_panels(grids[k]->bands, result.hull_panels[k], result.surface_panels[k]);
  }
  const std::array<const HydrodynamicCoefficients*, 3> values{grids[0]->set.get(), grids[1]->set.get(),
                                                              grids[2]->set.get()};
  for (const char* quantity : {"A", "B", "X"})
    for (int mode = 0; mode < set.set->modes(); ++mode) result.rows.push_back(convergence_row(values, quantity, mode));
  return result;
}

}  // namespace stillhook
