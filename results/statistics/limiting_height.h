// The limiting significant wave height of a condition from the heights at which single seeds break.
//
// For each seed, h is the lowest Hs at which its run breaks a limit: a property of the seed. With level p of runs that
// shall keep the limits, the limiting Hs is the (1 - p) quantile of h. Its interval is that of order statistics and
// assumes no distribution; it holds for any response.
#pragma once

#include <string>
#include <vector>

#include "sim/spatial/constants.h"

namespace stillhook {

/// Where one seed breaks.
struct Crossing {
  double height = 0.0;    // m, Hs
  std::string criterion;  // what breaks there
  bool found = true;      // false: it did not break up to this height
  bool smooth = true;     // the criterion changes smoothly with Hs; false for counts
};

struct LimitingHeight {
  double height = kNaN;  // m; NaN: so many seeds do not break that only "more than tried" is known
  double low = kNaN;     // m, lower bound at 95 %; NaN: not certified, too few seeds
  double high = kNaN;    // m, upper bound at 95 %; NaN: too few seeds, or they do not break
  double gumbel = kNaN;  // m, smooth estimate beside it: Gumbel on 1/h by L-moments. NaN: does not apply
  int seeds = 0;
  std::string governing;          // criterion of most seeds that break at or below the limit
  double governing_share = kNaN;  // of them
};

/// `level`: share of runs that shall keep the limits, 0.90, or 1/e for the most probable maximum.
LimitingHeight limiting_height(const std::vector<Crossing>& crossings, double level = 0.90);

}  // namespace stillhook
