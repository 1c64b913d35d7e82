// Statistics of a certification against values from tables.
#include "planner/verbs/plan/certify.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace stillhook {
namespace {

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
