// What a case says about the current. SI and radians.
#pragma once

#include <optional>
#include <vector>

namespace stillhook {

/// Steady motion of the water, which depends on the depth below the surface alone.
struct CurrentSpec {
  enum class Profile { automatic, uniform, power, table };  // automatic: power over a bed, else uniform
  /// The current at one depth.
  struct Layer {
    double depth = 0.0;    // m below the surface
    double speed = 0.0;    // m/s
    double towards = 0.0;  // rad, from +x counter-clockwise
  };
  double speed = 0.0;            // m/s, at the surface
  std::optional<double> towards;  // rad, from +x counter-clockwise
  Profile profile = Profile::automatic;
  double exponent = 1.0 / 7.0;   // of Profile::power
  std::vector<Layer> table;      // by rising depth; linear between, constant outside (table)

  bool flows() const {
    if (profile != Profile::table) return speed > 0.0;
    for (const Layer& layer : table)
      if (layer.speed > 0.0) return true;
    return false;
  }
};

}  // namespace stillhook
