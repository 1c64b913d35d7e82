#include "problems/tangent_run.h"

#include <omp.h>

#include <cmath>
#include <exception>

#include "sim/number_text.h"

namespace stillhook {

namespace {

// Half the width of a twin, as a share of the key's value or of a hundredth of its range: the second order left out is
// its square, 4e-10; the statics behind a twin are solved to 1e-10. Timing moves the ends of ramps, where a run has
// kinks, across steps, but is free of rounding from statics: there the twins stand closer.
constexpr double kHalfWidth = 2e-5, kHalfWidthOfTiming = 1e-6;
constexpr double kSmallestShare = 0.01;

struct Lift {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Operation> operation;
};

using Condition = std::function<Specification(const Specification&)>;

Specification specification_of(const Case& c, const Condition& condition) {
  return condition ? condition(c.specification) : c.specification;
}

Lift lift_of(const Case& c, const Condition& condition, double until) {
  const auto model = std::make_shared<const Model>(build_model(specification_of(c, condition)));
  return {model, std::make_shared<const Operation>(build_operation(*model, until))};
}

Lift lift_like(const Case& c, const Condition& condition, const Lift& base) {
  const auto model = std::make_shared<const Model>(build_model_like(specification_of(c, condition), *base.model));
  return {model, std::make_shared<const Operation>(build_operation_like(*model, *base.model, *base.operation))};
}

bool of_phase(const std::string& key) { return key.starts_with("operation.phases."); }

// A key of the operation's timing leaves the model and every pose as they are.
bool is_timing(const std::string& key, const Case& base, const Case& changed) {
  return of_phase(key) && same_poses(base.specification.operation, changed.specification.operation);
}

LiftTwin twin_of(const Case& c, const Lift& base, const std::string& key, double range, const Condition& condition) {
  const double x = key_value(c, key), scale = std::max(std::abs(x), kSmallestShare * range);
  const auto at = [&](double value) {
    const Case changed = with_values(c, {{key, value}});
    if (!is_timing(key, c, changed)) return lift_like(changed, condition, base);
    return Lift{base.model, std::make_shared<const Operation>(
                                retimed_operation(*base.model, changed.specification.operation, *base.operation))};
  };
  const auto try_at = [&](double value) -> std::optional<Lift> {
    try {
      return at(value);
    } catch (const CaseError&) {
    } catch (const SpecificationError&) {
    }
    return std::nullopt;
  };
  bool timing = false;
  if (of_phase(key)) {  // reading the case again is most of what a twin costs
    try {
      timing = is_timing(key, c, with_values(c, {{key, x + kHalfWidth * scale}}));
    } catch (const CaseError&) {
      timing = is_timing(key, c, with_values(c, {{key, x - kHalfWidth * scale}}));
    }
  }
  const double half = (timing ? kHalfWidthOfTiming : kHalfWidth) * scale;
  std::optional<Lift> low = try_at(x - half), high = try_at(x + half);
  // At the edge of what the key may be the twin stands on one side.
  double from = x - half, to = x + half;
  if (!low) low = at(from = x);
  if (!high) high = at(to = x);
  LiftTwin twin;
  twin.model = {low->model, high->model};
  twin.operation = {low->operation, high->operation};
  twin.width = to - from;
  twin.range = range;
  if (twin.width == 0.0) throw CaseError(key + ": can be moved neither up nor down from " + number_text(x));
  return twin;
}

}  // namespace

TangentRun run_with_tangents(const Case& c, const TangentRequest& request, const RunOptions& options) {
  double until = request.until > 0.0 ? request.until : c.specification.solver.max_duration;
  if (!request.part.whole()) until = 0.0;  // its time begins with the part
  const Lift base = lift_of(c, request.condition, until);
  const int keys = static_cast<int>(request.keys.size());
  std::vector<LiftTwin> twins(request.keys.size());
  std::vector<std::exception_ptr> errors(request.keys.size());
#pragma omp parallel for schedule(dynamic, 1) if (!omp_in_parallel())
  for (int j = 0; j < keys; ++j) {
    const std::size_t k = static_cast<std::size_t>(j);
    try {
      const double range =
          k < request.ranges.size() ? request.ranges[k] : std::max(1.0, std::abs(key_value(c, request.keys[k])));
      twins[k] = twin_of(c, base, request.keys[k], range, request.condition);
    } catch (...) {
      errors[k] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);

  const Operation* operation = base.operation.get();
  Operation part;
  SystemState start;
  if (!request.part.whole()) {
    part = part_of(*base.operation, request.part);
    start = start_of(*base.operation, request.part);
    operation = &part;
    for (LiftTwin& twin : twins)
      for (std::size_t side = 0; side < 2; ++side) {
        twin.from[side] = std::make_shared<const SystemState>(start_of(*twin.operation[side], request.part));
        twin.operation[side] = std::make_shared<const Operation>(part_of(*twin.operation[side], request.part));
      }
  }
  TangentRun result;
  for (const LiftTwin& twin : twins) {
    result.static_poses.push_back({twin.operation[0]->static_poses, twin.operation[1]->static_poses});
    result.widths.push_back(twin.width);
  }
  RunOptions run_with = options;
  if (!request.part.whole()) run_with.from = &start;
  if (request.from) run_with.from = &*request.from;
  if (request.until > 0.0) run_with.until = request.until;
  TangentOptions wanted;
  wanted.channels = request.channels;
  wanted.by_initial_state = request.by_initial_state;
  if (request.start_change) wanted.start_change = request.start_change(result);
  wanted.growth_limit = request.growth_limit;
  try {
    result.trajectory = simulate_with_tangents(*base.model, *operation, run_with, twins, wanted, result.tangents);
  } catch (const std::invalid_argument& error) {
    throw CaseError(std::string("derivatives: ") + error.what());
  }
  return result;
}

}  // namespace stillhook
