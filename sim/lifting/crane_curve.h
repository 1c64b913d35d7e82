// What a crane may lift over its radius, as its maker states it: one entry for one crane and for seas up to one height.
//
// Capacity is linear in the radius between the points of the curve, and there is none outside them. Of a crane with
// several curves the one counts that was made for the lowest seas among those that hold in the sea of the case: never one
// for calmer water.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stillhook {

struct Specification;

struct CraneCurveSpec {
  enum class Basis {
    dynamic,      // the capacity bounds the hook load as it is in waves
    static_load,  // it bounds the load at rest: the maker has taken the waves' amplification off
  };
  std::string name;
  std::string crane;             // body that holds hoist wires, or the vessel under such bodies: they count together
  std::vector<double> radius;    // m, ascending, from the king post or the hinge to the hook
  std::vector<double> capacity;  // N, > 0, of load, rigging and hook block together
  double significant_height = std::numeric_limits<double>::infinity();  // m, of the highest sea that it holds in
  Basis basis = Basis::dynamic;
};

/// N; NaN outside the radii of the curve.
double capacity_at(const CraneCurveSpec& curve, double radius);

/// The same with the capacity of the nearest end outside them, for a number where a verdict fails anyway.
double nearest_capacity(const CraneCurveSpec& curve, double radius);

/// m: significant height of the active sea, the height of a regular wave, 0 in calm water.
double curve_sea_height(const Specification& s);

/// The curve that a crane works by in the active sea; nullptr if it has none that holds there.
const CraneCurveSpec* curve_of(const Specification& s, const std::string& crane);

/// The cranes that have a curve, each once.
std::vector<std::string> cranes_with_curves(const Specification& s);

}  // namespace stillhook
