// Convergence of a panel computation: the same hulls with panels longer and shorter by sqrt(2).
//
//   change of a curve from grid k to k+1:   e_k = max over frequencies (and headings) |f_k+1 - f_k| / max |f|
//   order  p = ln(m_1/m_2) / ln r,  r = sqrt(2),  m_k the root mean square of the same differences
//   error of the middle grid ~ e_2 / (1 - r^-p), p at most 2                   (Richardson 1911; Roache 1997)
//
// The largest changes of two pairs of grids are at different frequencies, so their ratio is no order; the mean over the
// curve is. Flat panels are of second order and not better: a coarse grid that lies far off does not make the fine one
// good. Below first order there is none to be seen, and the largest change counts (Eca & Hoekstra 2014).
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "planner/verbs/hydro/hydro.h"

namespace stillhook {

struct ConvergenceRow {
  std::string quantity;  // "A", "B" or "X"
  int mode = 0;
  double first = 0.0, second = 0.0;  // e_1, e_2
  // p as observed, NaN where it is below 1
  double order = std::numeric_limits<double>::quiet_NaN();
  double error = 0.0;  // estimated, of the case's own panels
};

struct Convergence {
  static constexpr double kLimit = 0.03;
  std::array<double, 3> refinement{};                  // of the three grids, the middle one is the case's
  std::array<int, 3> hull_panels{}, surface_panels{};  // of the band with most panels
  std::vector<ConvergenceRow> rows;                    // A, B of the diagonal and X of every mode

  const ConvergenceRow& worst() const;
  bool within_limit() const { return worst().error <= kLimit; }
  /// "The case's panels are within 3 % ..." with the worst quantity.
  std::string conclusion(const HydroSet& set) const;
};

/// Of the diagonal of "A" or "B", or of "X", in one mode, from sets on longer, the case's own and shorter panels.
ConvergenceRow convergence_row(const std::array<const HydrodynamicCoefficients*, 3>& grids, const std::string& quantity,
                               int mode);

/// What the shorter and longer panels take on top of the case's own.
std::array<HydroSet, 2> convergence_sets(const HydroSet& set);

/// Computes (or takes from the cache) the two other grids of a completed set. Throws like compute_set.
Convergence converge(const Case& c, const HydroSet& set, const HydroProgress& progress);

}  // namespace stillhook
