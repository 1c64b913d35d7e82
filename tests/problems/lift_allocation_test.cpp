// The whole reference lift must not ask for memory in its steps.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "problems/case.h"
#include "sim/simulate.h"
#include "tests/bench/memory_requests.h"

using namespace stillhook;

#ifdef STILLHOOK_COUNTS_MEMORY
TEST_CASE("simulate: the steps of the reference lift ask for no memory") {
  const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/problems/box_installation.toml");
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  struct Interval {
    double start, end;  // s
    long requests;
  };
  std::vector<Interval> intervals;
  intervals.reserve(10000);
  double last = 0.0;
  long mark = memory_requests;
  RunOptions options;
  options.record = false;
  options.progress = [&](double t, double) {
    if (intervals.size() < intervals.capacity()) intervals.push_back({last, t, memory_requests - mark});
    last = t;
    mark = memory_requests;
    return true;
  };
  const Trajectory run = simulate(model, operation, options);
  REQUIRE(run.status == RunStatus::completed);
  REQUIRE(intervals.size() > 100);
  REQUIRE(intervals.size() < intervals.capacity());

  // What may ask: the start of the run, a phase that opens, a contact that begins or ends. With room for the step at
  // which an interval ends.
  const double h = model.specification().solver.time_step;
  long quiet = 0;
  for (const Interval& i : intervals) {
    const auto within = [&](double t) { return t >= i.start - h && t <= i.end + h; };
    const bool phase = std::ranges::any_of(run.phases, [&](const PhaseRecord& p) { return within(p.start); });
    const bool contact =
        std::ranges::any_of(run.contacts, [&](const ContactEvent& e) { return within(e.start) || within(e.end); });
    if (i.start == 0.0 || phase || contact) continue;
    ++quiet;
    INFO("from " << i.start << " to " << i.end << " s");
    CHECK(i.requests == 0);
  }
  CHECK(quiet > static_cast<long>(intervals.size()) / 2);
  CHECK(intervals.front().requests > 0);  // the counter counts
}
#endif
