// Statistics of a certification against values from tables.
#include "planner/verbs/plan/certify.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace stillhook {
namespace {

TEST_CASE("The bound of a broken share is Clopper and Pearson's", "[certify]") {
  // None of n broken: 1 - 0.05^(1/n), in closed form.
  CHECK(broken_share_bound(0, 20) == Approx(1.0 - std::pow(0.05, 1.0 / 20.0)).epsilon(1e-9));
  CHECK(broken_share_bound(0, 59) < 0.05);  // the well-known 59 runs for 95 % / 95 % (Wilks 1941)
  CHECK(broken_share_bound(0, 58) > 0.05);
  // One of 20: the 95 % quantile of Beta(2, 19), where P(X <= 1) = (1 - p)^20 + 20 p (1 - p)^19 is 0.05.
  const double p = broken_share_bound(1, 20);
  CHECK(std::pow(1.0 - p, 20) + 20.0 * p * std::pow(1.0 - p, 19) == Approx(0.05).epsilon(1e-9));
  CHECK(broken_share_bound(20, 20) == 1.0);
}

TEST_CASE("A summary knows quantile, worst and the spread of its mean", "[certify]") {
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) values.push_back(i);
  values.push_back(std::nan(""));
  const SampleSummary s = summarised(values);
  CHECK(s.mean == Approx(50.0));
  CHECK(s.quantile == Approx(90.0));
  CHECK(s.worst == 100.0);
  CHECK(s.worst_index == 100);
  // The mean of 101 uniform numbers has a standard deviation of 29.15/sqrt(101) = 2.90; 90 % is +-1.645 of it. The
  // bootstrap's own scatter with 2000 samples is some per cent of that.
  CHECK(s.mean_high - s.mean_low == Approx(2.0 * 1.645 * 2.90).epsilon(0.1));
  const SampleSummary low = summarised(values, false);
  CHECK(low.worst == 0.0);
  CHECK(low.quantile == Approx(10.0));
}

}  // namespace
}  // namespace stillhook
