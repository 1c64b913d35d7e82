#include "results/failures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/crane_use.h"
#include "results/deck_corners.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kCarries = 0.1;  // of the largest static tension: a wire below it has no direction to judge

/// The first sample at which f is true, or `otherwise`: the time of an extreme that lies between samples.
template <class F>
double first_time(const RunView& view, double otherwise, F f) {
  const std::vector<double>& time = view.run().time;
  for (std::size_t i = 0; i < time.size() && time[i] < otherwise; ++i)
    if (f(i)) return time[i];
  return otherwise;
}

std::string at(const RunView& view, double t) { return fmt::format("at {:.1f} s in {}", t, view.phase_at(t)); }

void find_parted_wires(const RunView& view, std::vector<Failure>& failures) {
  for (const WireSpec& wire : view.specification().wires) {
    if (!(wire.breaking_load > 0.0)) continue;
    const Peak largest = view.maximum(wire_channels::tension.of(wire), view.all_phases());
    if (!(largest.value > wire.breaking_load)) continue;
    const auto tension = view.series(wire_channels::tension.of(wire));
    const double t = first_time(view, largest.time,
                                [&](std::size_t i) { return i < tension.size() && tension[i] > wire.breaking_load; });
    failures.push_back({t, fmt::format("wire {} parts {}: it is asked to hold {:.0f} kN, {:.3g} times its breaking "
                                       "load of {:.0f} kN",
                                       wire.name, at(view, t), largest.value / 1e3, largest.value / wire.breaking_load,
                                       wire.breaking_load / 1e3)});
  }
}

void find_capsized(const RunView& view, std::vector<Failure>& failures) {
  for (const std::string& body : operation_vessels(view.specification()))
    for (const auto& [quantity, what] :
         {std::pair{body_channels::roll, "heels"}, std::pair{body_channels::pitch, "trims"}}) {
      const Peak largest = view.largest_magnitude(quantity.of(body), view.all_phases());
      if (!(largest.value > kCapsized)) continue;
      const auto angle = view.series(quantity.of(body));
      const double t = first_time(view, largest.time,
                                  [&](std::size_t i) { return i < angle.size() && std::abs(angle[i]) > kCapsized; });
      failures.push_back({t, fmt::format("{} capsizes {}: it {} by up to {:.1f} deg, more than {:.0f} deg", body,
                                         at(view, t), what, largest.value / kDegree, kCapsized / kDegree)});
    }
}

/// A deck that is under water at rest, at the end of a phase. Of a mesh hull only what was dry at the start is deck:
/// its upper half may hold more that faces up (braces of a jacket that a module is set down on).
void find_flooded(const RunView& view, std::vector<Failure>& failures) {
  const Specification& s = view.specification();
  const std::vector<std::string> vessels = operation_vessels(s);
  const std::vector<PhaseRecord>& phases = view.run().phases;
  const std::vector<StaticPose>& poses = view.run().static_poses;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    if (std::find(vessels.begin(), vessels.end(), s.bodies[b].name) == vessels.end()) continue;
    if (!s.bodies[b].floats()) continue;
    std::vector<Vector3> deck = deck_corners(s.bodies[b].hull);
    if (s.bodies[b].hull.shape == HullSpec::Shape::mesh && !poses.empty() && b < poses.front().bodies.size())
      std::erase_if(deck, [&](const Vector3& corner) { return (poses.front().bodies[b] * corner).z() < 0.0; });
    for (std::size_t p = 0; p < poses.size() && p <= phases.size(); ++p) {
      if (b >= poses[p].bodies.size()) break;
      double lowest = std::numeric_limits<double>::infinity();
      for (const Vector3& corner : deck) lowest = std::min(lowest, (poses[p].bodies[b] * corner).z());
      if (!(lowest < 0.0)) continue;
      const double t = p == 0 ? view.start() : phases[p - 1].end;
      failures.push_back({t, fmt::format("{} has no freeboard {}: at rest an edge of its deck is {:.2f} m under water",
                                         s.bodies[b].name, at(view, t), -lowest)});
      break;
    }
  }
}

void find_lost_load(const RunView& view, std::vector<Failure>& failures) {
  for (const WireSpec& wire : view.specification().wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    const auto x = view.series(wire_channels::offset_x.of(wire)), y = view.series(wire_channels::offset_y.of(wire)),
               length = view.series(wire_channels::length.of(wire)),
               tension = view.series(wire_channels::tension.of(wire));
    if (x.empty() || y.empty() || length.empty() || tension.empty()) continue;
    double carried = 0.0;
    for (std::size_t i = 0; i < view.run().static_poses.size(); ++i)
      carried = std::max(carried, view.static_value(i, wire_channels::tension.of(wire)));
    Peak first;
    for (std::size_t i = 0; i < view.run().time.size() && !first.valid(); ++i) {
      const double angle = std::asin(std::min(1.0, std::hypot(x[i], y[i]) / length[i]));
      if (tension[i] > kCarries * carried && tension[i] > 0.0 && angle > kSwungOut) first = {angle, view.run().time[i]};
    }
    if (first.valid())
      failures.push_back(
          {first.time, fmt::format("the load is out of the crane's reach {}: wire {} stands {:.0f} deg from the "
                                   "vertical and still carries",
                                   at(view, first.time), wire.name, first.value / kDegree)});
  }
}

/// A crane that carries where its curve says nothing, or in a sea that none of its curves holds in.
void find_outside_curve(const RunView& view, std::vector<Failure>& failures) {
  const Specification& s = view.specification();
  for (const std::string& crane : cranes_with_curves(s)) {
    const CraneUse use = crane_use(view, crane);
    if (!use.curve) {
      failures.push_back({view.start(), fmt::format("{} has no capacity curve for a sea of {:.2f} m: the crane may not "
                                                    "work in it",
                                                    crane, curve_sea_height(s))});
      continue;
    }
    double most = 0.0;
    for (const double load : use.load) most = std::max(most, load);  // passes over moments without a load at rest
    for (std::size_t i = 0; i < use.radius.size(); ++i) {
      if (!(use.load[i] > kCarries * most) || std::isfinite(capacity_at(*use.curve, use.radius[i]))) continue;
      const double t = view.run().time[i];
      failures.push_back({t, fmt::format("{} carries {:.0f} t at a radius of {:.1f} m {}, outside its capacity curve {} "
                                         "of {:.1f} to {:.1f} m",
                                         crane, use.load[i] / (1e3 * kStandardGravity), use.radius[i], at(view, t),
                                         use.curve->name, use.curve->radius.front(), use.curve->radius.back())});
      break;
    }
  }
}

}  // namespace

std::vector<Failure> failures_of(const RunView& view) {
  std::vector<Failure> failures;
  find_parted_wires(view, failures);
  find_capsized(view, failures);
  find_flooded(view, failures);
  find_lost_load(view, failures);
  find_outside_curve(view, failures);
  std::stable_sort(failures.begin(), failures.end(),
                   [](const Failure& a, const Failure& b) { return a.time < b.time; });
  return failures;
}

std::string failure_text(const std::vector<Failure>& failures) {
  if (failures.empty()) return {};
  const std::size_t more = failures.size() - 1;
  return failures.front().sentence +
         (more > 0 ? fmt::format("; {} more follow{}", more, more == 1 ? "s" : "") : std::string()) +
         "; what comes after it is no lift";
}

}  // namespace stillhook
