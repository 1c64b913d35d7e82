// What the records can tell apart and what they cannot, in sentences.
#pragma once

#include <string>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

inline constexpr double kTooAlike = 0.98;     // |correlation| above which two parameters are not separated
inline constexpr double kTooUncertain = 0.5;  // standard deviation over estimate above which a parameter is not known

/// A pair of parameters that the records hardly tell apart, and the test that would.
struct Inseparable {
  int a = 0, b = 0;  // parameters
  double correlation = 0.0;
  std::string test;
};

/// What kind of thing a key is: decides which test tells it from another.
enum class Influence { inertia, stiffness, linear_damping, quadratic_damping, excitation, phase, other };
Influence influence_of(const std::string& key);

/// The test that separates two keys.
std::string separating_test(const std::string& a, const std::string& b);

/// Pairs above kTooAlike.
std::vector<Inseparable> inseparable_pairs(const std::vector<std::string>& keys, const MatrixX& correlation);

}  // namespace stillhook
