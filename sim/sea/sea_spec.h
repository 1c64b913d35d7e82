// What a case says about the sea. SI and radians.
#pragma once

#include <string>
#include <vector>

namespace stillhook {

struct SeaStateSpec {
  enum class Type { calm, regular, jonswap, pierson_moskowitz };
  std::string name;
  Type type = Type::calm;
  double amplitude = 0.0;       // m, regular
  double frequency = 0.0;       // rad/s, regular
  double phase = 0.0;           // rad, lag of the crest at the world origin at t = 0, regular
  double significant_height = 0.0;  // m, irregular
  double peak_period = 0.0;     // s, irregular
  double gamma = 0.0;           // 1, JONSWAP peakedness; 0 = by the DNV rule from Hs and Tp
  double heading = 0.0;         // rad, direction the waves travel towards, from +x counter-clockwise
  double spreading = 0.0;       // exponent n of cos^n; 0 = long-crested
  int components = 60;          // irregular: number of frequencies
  int directions = 1;           // irregular: number of directions, > 1 only with spreading
  int seed = 1;                 // irregular: phases come from this index
};

struct SeaSpec {
  std::string active;           // name of the state used
  double ramp = 30.0;           // s, the waves grow smoothly from nothing over this time
  double density = 1025.0;      // kg/m3
  double gravity = 9.80665;     // m/s2
  double depth = 0.0;           // m, 0 = deep; used by moorings, waves are deep-water
  std::vector<SeaStateSpec> states;
};

}  // namespace stillhook
