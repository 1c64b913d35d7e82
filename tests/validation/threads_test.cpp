// The same bits with one thread, two and four: a set of coefficients without the cache, the reference lift in waves
// with its joints, contacts and state spaces, and a search over a part of it.
#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "problems/evaluator.h"
#include "problems/search/solve.h"
#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/rankine/panel_method.h"
#include "sim/simulate.h"
#include "tests/sim/temporary_folder.h"
#include "tests/validation/reference_lift.h"

using namespace stillhook;

namespace {

/// Runs something with a number of OpenMP threads and puts that back.
template <class F>
auto with_threads(int threads, F run) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  auto result = run();
  omp_set_num_threads(before);
  return result;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) return false;
  return true;
}

/// Every bit of added mass, damping and excitation.
std::string coefficients_of_the_crane() {
  const Case c = reference_case();
  const BodySpec& crane = c.specification.bodies.front();
  REQUIRE(crane.name == "crane");
  PanelHull hull;
  hull.name = crane.name;
  hull.mesh = build_hull_mesh(crane.hull);
  hull.box_size = crane.hull.size;
  hull.box_centre = crane.hull.centre;
  PanelMethodOptions options;
  options.frequencies =
      8;  // every loop over frequencies, headings and panels is gone through, in a quarter of the time
  const HydrodynamicCoefficients set = panel_method({hull}, options);
  std::string bits;
  const auto add = [&](const void* from, std::size_t bytes) { bits.append(static_cast<const char*>(from), bytes); };
  add(set.A_inf.data(), sizeof(double) * static_cast<std::size_t>(set.A_inf.size()));
  for (const FrequencyCoefficients& at : set.frequency) {
    add(at.A.data(), sizeof(double) * static_cast<std::size_t>(at.A.size()));
    add(at.B.data(), sizeof(double) * static_cast<std::size_t>(at.B.size()));
  }
  add(set.excitation.value.data(), sizeof(set.excitation.value.front()) * set.excitation.value.size());
  return bits;
}

}  // namespace

TEST_CASE("the crane's coefficients have the same bits with one, two and four threads", "[slow]") {
  const std::string one = with_threads(1, coefficients_of_the_crane);
  CHECK(one.size() > 10000);
  CHECK(with_threads(2, coefficients_of_the_crane) == one);
  CHECK(with_threads(4, coefficients_of_the_crane) == one);
}

TEST_CASE("the reference lift has the same bits with one, two and four threads", "[slow]") {
  const Case c = reference_case({{"sea.active", "wind_sea"}, {"solver.max_duration_s", "260"}});
  const auto run = [&] {
    const Model model = build_model(c.specification);
    return simulate(model, build_operation(model));
  };
  const Trajectory one = with_threads(1, run);
  REQUIRE(one.status == RunStatus::completed);
  CHECK_FALSE(one.contacts.empty());  // the load has left the barge
  for (const int threads : {2, 4}) {
    CAPTURE(threads);
    const Trajectory many = with_threads(threads, run);
    REQUIRE(many.values.size() == one.values.size());
    bool same = same_bits(many.time, one.time);
    for (std::size_t i = 0; i < one.values.size(); ++i) same = same && same_bits(many.values[i], one.values[i]);
    CHECK(same);
  }
}

TEST_CASE("a search over the reference lift's lift-off has the same bits with one, two and four threads", "[slow]") {
  Case c = reference_case();
  c.plan.part = {1, 0.0};  // load_transfer: contacts, joints, state spaces, two scenarios
  std::erase_if(c.plan.variables,
                [](const VariableSpec& v) { return !v.key.starts_with("operation.phases.load_transfer"); });
  std::erase_if(c.plan.objective,
                [](const ObjectiveTerm& t) { return t.metric != "rehits" && t.metric != "duration"; });
  c.limits.clear();
  const Evaluator evaluator(c);
  const auto search = [&] {
    SolveOptions options;
    options.solver = "cobyla";
    options.evaluations = 4;
    return solve(evaluator.problem(), options);
  };
  const SearchReport one = with_threads(1, search);
  CHECK(one.best.usable);
  for (const int threads : {2, 4}) {
    CAPTURE(threads);
    const SearchReport many = with_threads(threads, search);
    CHECK(many.best_x == one.best_x);
    CHECK(many.best.objective == one.best.objective);
    CHECK(same_bits(many.best.details, one.best.details));
  }
}
