#include "tuning/identifiability.h"

#include <array>
#include <cmath>
#include <utility>

namespace stillhook {
namespace {

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

struct Rule {
  Influence a, b;
  const char* test;
};

constexpr std::array<Rule, 12> kRules = {{
    {Influence::inertia, Influence::stiffness,
     "a decay sees only their ratio: measure the stiffness by itself in a static pull or an inclining test, or hold it "
     "fixed (hydrostatics follow from the hull)"},
    {Influence::linear_damping, Influence::quadratic_damping,
     "they differ in how the damping depends on amplitude: add decays from at least twice and from half this amplitude"},
    {Influence::excitation, Influence::linear_damping,
     "the response in waves sees their ratio: measure the waves (sea.elevation), or take the damping from a decay"},
    {Influence::excitation, Influence::quadratic_damping,
     "the response in waves sees both: measure the waves (sea.elevation), or take the damping from decays of several "
     "amplitudes"},
    {Influence::excitation, Influence::stiffness,
     "the response in waves sees their ratio: take the stiffness from a static pull, or measure the waves"},
    {Influence::excitation, Influence::inertia,
     "the response in waves sees their ratio: take the inertia from a decay, or measure the waves (sea.elevation)"},
    {Influence::excitation, Influence::excitation,
     "both scale the force of the waves: measure the waves (sea.elevation), or run a second frequency or heading"},
    {Influence::inertia, Influence::inertia,
     "both add to the same inertia: measure another motion in which only one takes part, or hold one fixed"},
    {Influence::stiffness, Influence::stiffness,
     "both add to the same stiffness: add a static pull in another direction or at another offset"},
    {Influence::linear_damping, Influence::linear_damping,
     "both damp the same motion: add a decay of another motion, or in waves of another frequency"},
    {Influence::phase, Influence::phase, "both shift the record in time: measure the waves at a known place"},
    {Influence::inertia, Influence::linear_damping,
     "add a free decay: its period gives the inertia and its decrement the damping"},
}};

}  // namespace

Influence influence_of(const std::string& key) {
  if (contains(key, "quadratic")) return Influence::quadratic_damping;
  if (contains(key, "radiation_factor")) return Influence::linear_damping;
  if (contains(key, "damping") || contains(key, "critical_fraction")) return Influence::linear_damping;
  if (contains(key, "phase_deg") || contains(key, "time_shift")) return Influence::phase;
  if (contains(key, "amplitude_m") || contains(key, "significant_height") || contains(key, "diffraction_factor"))
    return Influence::excitation;
  if (contains(key, "added_") || contains(key, "mass_t") || contains(key, "inertia") || contains(key, "gyration"))
    return Influence::inertia;
  if (contains(key, "stiffness") || contains(key, "pretension") || contains(key, "cog_m")) return Influence::stiffness;
  return Influence::other;
}

std::string separating_test(const std::string& a, const std::string& b) {
  const Influence x = influence_of(a), y = influence_of(b);
  for (const Rule& rule : kRules)
    if ((rule.a == x && rule.b == y) || (rule.a == y && rule.b == x)) return rule.test;
  return "hold one of them fixed or give it a prior, or add a record of another kind (decay, static pull, waves of another "
         "frequency)";
}

std::vector<Inseparable> inseparable_pairs(const std::vector<std::string>& keys, const MatrixX& correlation) {
  std::vector<Inseparable> pairs;
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = i + 1; j < keys.size(); ++j) {
      const double r = correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(r) > kTooAlike)
        pairs.push_back({static_cast<int>(i), static_cast<int>(j), r, separating_test(keys[i], keys[j])});
    }
  return pairs;
}

}  // namespace stillhook
