#include "problems/not_modelled.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace stillhook {
namespace {

struct Missing {
  std::vector<std::string_view> words;  // of a key, parted by "_"; a word with "_" in it is looked for in the whole key
  std::string_view sentence;
};

const std::vector<Missing>& missing_things() {
  static const std::vector<Missing> all = {
      {{"gust", "gusts", "gustiness"},
       "gusts are those of a spectrum or of a record, [wind] with spectrum = \"npd\", not a factor on the mean"},
      {{"windage"}, "wind on bodies is that of [[wind_areas]] and [[wind_hulls]]"},
      {{"currents", "current_speed", "current_direction", "current_velocity"},
       "the current has a table of its own, [sea.current], and acts on [[current_areas]] and [[current_hulls]]"},
      {{"ahc", "phc", "heave_compensation", "heave_compensator", "heave_compensated", "compensator", "compensation"},
       "stillhook does not model heave compensation yet"},
      {{"constant_tension", "tension_control"},
       "stillhook does not model winches at constant tension yet, but for taglines with gains of 0"},
      {{"dp", "dynamic_positioning", "thruster", "thrusters"},
       "stillhook does not model dynamic positioning yet: soft moorings hold a vessel instead"},
      {{"cranes"},
       "stillhook does not model a crane as one thing yet: a crane is a body with joints, drives and wires, and its "
       "capacity over the radius is an entry of [[crane_curves]]"},
      {{"capacity_curve", "load_chart", "derating"},
       "a crane's capacity over its radius is an entry of [[crane_curves]], one for each height of sea"},
      {{"slam", "slamming", "slamming_coefficient"}, "stillhook does not model slamming yet"},
      {{"drag", "morison", "cd"},
       "stillhook does not model drag on the velocity of the water in waves yet: [[current_areas]] have that on the "
       "current and the body's own velocity"},
      {{"surface_normal", "guide", "guides", "bumper", "bumpers", "stabbing"},
       "stillhook does not model guides, bumpers or inclined contact surfaces yet: a contact is a horizontal "
       "rectangle"},
      {{"weight_n_per_m", "weight_kn_per_m", "mass_kg_per_m", "mass_t_per_m", "weight_t_per_m"},
       "stillhook does not model the weight of wires yet"},
      {{"mudmat", "suction"}, "stillhook does not model suction of the seabed yet"},
      {{"raos", "displacement_rao"},
       "a vessel that moves by displacement RAOs has hydrodynamics.kind = \"rao\" and the table [bodies.hydrodynamics.rao]"},
      {{"qtf", "qtfs"}, "stillhook does not model mean and slow drift forces yet"}};
  return all;
}

bool names(const std::string& key, std::string_view word) {
  const std::string parted = "_" + key + "_", wanted = "_" + std::string(word) + "_";
  return parted.find(wanted) != std::string::npos;
}

}  // namespace

std::string not_modelled(const std::string& word) {
  std::string key = word;
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return c == '-' || c == '.' ? '_' : std::tolower(c); });
  for (const Missing& thing : missing_things())
    if (std::any_of(thing.words.begin(), thing.words.end(), [&](std::string_view w) { return names(key, w); }))
      return std::string(thing.sentence);
  return {};
}

}  // namespace stillhook
