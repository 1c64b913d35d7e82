// How much of its limit a metric uses, and which limit governs.
#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "results/limits.h"
#include "results/metrics.h"

using namespace stillhook;

TEST_CASE("how much of a limit is used: of an amplification the dynamic part, of a minimum what could be lost") {
  LimitCheck c;
  const auto use = [&](const char* metric, double value, double limit, bool is_max) {
    c.metric = metric;
    c.value = value;
    c.limit = limit;
    c.is_max = is_max;
    c.margin = is_max ? limit - value : value - limit;
    c.pass = c.margin >= 0.0;
    return limit_use(c);
  };
  CHECK(use("heel_max", 4.0, 5.0, true) == Approx(0.8));
  CHECK(use("daf_total", 1.021, 1.3, true) == Approx(0.07));
  CHECK(limit_use_text(c) == "7 % of what it allows");
  CHECK(use("daf.fall", 1.36, 1.3, true) == Approx(1.2));
  CHECK(use("slack_ratio_min", 0.93, 0.3, false) == Approx(0.1));
  CHECK(use("slack_ratio_min.fall", 0.0, 0.3, false) == Approx(1.0 / 0.7));
  CHECK(use("clearance_min.boom", 8.0, 2.0, false) == Approx(0.25));  // not a margin of 300 %
  CHECK(use("clearance_min.boom", 0.0, 2.0, false) == std::numeric_limits<double>::infinity());
  CHECK(limit_use_text(c).empty());
  CHECK(use("wire_utilisation_max", 17.4, 1.0, true) == Approx(17.4));
  CHECK(limit_use_text(c) == "17.4 times what it allows");  // not a margin of -1638 %
  CHECK(use("rehits", 0.0, 0.0, true) == 0.0);
  CHECK(use("rehits", 1.0, 0.0, true) == std::numeric_limits<double>::infinity());
  // Broken exactly where use is above 1, whatever the metric and the side.
  for (const char* metric : {"daf_max", "slack_ratio_min", "clearance_min.boom", "heel_max", "mean_y.hold"})
    for (const double limit : {-2.0, 0.4, 1.0, 1.3, 5.0})
      for (const double value : {-3.0, 0.2, 0.7, 1.1, 1.5, 9.0})
        for (const bool is_max : {false, true}) {
          CAPTURE(metric, limit, value, is_max);
          CHECK((use(metric, value, limit, is_max) > 1.0) == (is_max ? value > limit : value < limit));
        }
}

TEST_CASE("a lift that hardly moves is not governed by its DAF") {
  std::vector<LimitCheck> checks(2);
  for (auto& [c, metric, value, limit] : std::vector<std::tuple<LimitCheck*, const char*, double, double>>{
           {&checks[0], "daf_total", 1.021, 1.3}, {&checks[1], "heel_max", 2.5, 5.0}}) {
    c->metric = metric;
    c->value = value;
    c->limit = limit;
    c->margin = limit - value;
    c->pass = true;
  }
  CHECK(governing_check(checks)->metric == "heel_max");  // half of its limit against 7 % of the DAF's
}

TEST_CASE("the governing criterion has the smallest relative margin, and a zero limit governs only when broken") {
  std::vector<LimitCheck> checks(3);
  const auto set = [](LimitCheck& c, const char* name, double value, double limit) {
    c.metric = name;
    c.value = value;
    c.limit = limit;
    c.margin = limit - value;
    c.pass = c.margin >= 0.0;
  };
  set(checks[0], "daf_max", 1.05, 1.10);  // 4.5 %
  set(checks[1], "heel_max", 4.9, 5.0);   // 2 %
  set(checks[2], "rehits", 0.0, 0.0);
  CHECK(governing_check(checks)->metric == "heel_max");
  set(checks[2], "rehits", 1.0, 0.0);
  CHECK(governing_check(checks)->metric == "rehits");
  checks[2].hard = false;
  CHECK(governing_check(checks)->metric == "heel_max");
  CHECK(governing_check({}) == nullptr);
}
