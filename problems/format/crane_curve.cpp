// Capacity curves of cranes in a case.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "problems/case_checks.h"
#include "problems/case_format.h"
#include "problems/entry_check.h"
#include "sim/crane_parts.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return list;
}

}  // namespace

const Table& crane_curve_table() {
  static const Table table = [] {
    using S = CraneCurveSpec;
    TableOf<S> t("crane_curves",
                 "What a crane may lift over its radius, in seas up to a height. Its largest use is the metric "
                 "`crane_utilisation_max.<crane>`.");
    t.name("name", &S::name, "Name.");
    t.text("crane", &S::crane, "Body that holds hoist wires, or the vessel under such bodies: their loads count together.")
        .names(Reference::body)
        .require();
    t.numbers(
         "radius_m", {}, [](S& s, const std::vector<double>& v) { s.radius = v; }, unit::m, not_negative(),
         "Radii of the curve, ascending: horizontally from the slewing axis, or else the boom's hinge, to the hook.")
        .require();
    t.numbers(
         "capacity_t", {},
         [](S& s, const std::vector<double>& v) {
           s.capacity.clear();
           for (const double mass : v) s.capacity.push_back(mass * kStandardGravity);
         },
         unit::t, positive(),
         "What may hang there: load, rigging and hook block together, as the mass that standard gravity pulls with.")
        .require();
    t.number("up_to_significant_height_m", &S::significant_height, unit::m, not_negative(),
             "Height of the sea up to which it holds: the significant one, of a regular wave its height.")
        .absent("every sea");
    t.choice<decltype(&S::basis), S::Basis>(
        "basis", &S::basis, {{"dynamic", S::Basis::dynamic}, {"static", S::Basis::static_load}},
        "What it bounds: the hook load in waves, or that at rest where the maker has taken their amplification off.");
    return t.build();
  }();
  return table;
}

void check_crane_curve(const CraneCurveSpec& curve, EntryCheck& check) {
  const Specification& s = check.specification();
  if (curve.radius.size() < 2) check.report("radius_m", "must have two radii at least");
  if (!std::is_sorted(curve.radius.begin(), curve.radius.end(), std::less_equal<>()))
    check.report("radius_m", "must ascend");
  if (curve.capacity.size() != curve.radius.size())
    check.report("capacity_t", fmt::format("has {} numbers, radius_m {}: each radius has one capacity",
                                           curve.capacity.size(), curve.radius.size()));
  const std::vector<std::string> cranes = crane_bodies(s);
  if (std::find(cranes.begin(), cranes.end(), curve.crane) == cranes.end()) {
    if (entry_named(s.bodies, curve.crane))
      check.report("crane", fmt::format("\"{}\" holds no hoist wire, nor does a body that stands on it: {}", curve.crane,
                                        cranes.empty() ? "the case has no crane"
                                                       : "a curve can be of " + quoted_list(cranes)));
    return;
  }
  if (crane_reach(s, curve.crane).axes.empty())
    check.report("crane", fmt::format("\"{}\" has no joint to measure a radius from: a boom stands on a hinge or a "
                                      "slewing ring",
                                      curve.crane));
  for (const CraneCurveSpec& other : s.crane_curves)
    if (&other < &curve && other.crane == curve.crane && other.significant_height == curve.significant_height)
      check.report("up_to_significant_height_m",
                   fmt::format("is that of \"{}\" as well: one curve for one height of sea", other.name));
}

void check_crane_seas(const Case& c, const Node& root, Findings& findings) {
  const Specification& s = c.specification;
  for (const std::string& crane : cranes_with_curves(s)) {
    if (curve_of(s, crane)) continue;
    const CraneCurveSpec* highest = nullptr;  // where it is told
    for (const CraneCurveSpec& curve : s.crane_curves)
      if (curve.crane == crane && (!highest || curve.significant_height > highest->significant_height)) highest = &curve;
    EntryCheck(s, root, findings, "crane_curves." + highest->name)
        .report("up_to_significant_height_m",
                fmt::format("is {:.4g}, but the active sea \"{}\" has a height of {:.4g} m: \"{}\" has no curve for it",
                            highest->significant_height, s.sea.active, curve_sea_height(s), crane));
  }
}

}  // namespace stillhook
