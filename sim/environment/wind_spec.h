// What a case says about the wind. SI and radians.
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "sim/element_kind.h"
#include "sim/spatial/pose.h"

namespace stillhook {

/// Steady wind over the sea.
struct WindSpec {
  enum class Profile { iso, power, constant };
  double speed = 0.0;             // m/s, hourly mean at 10 m above still water; 0 = no wind
  std::optional<double> from, to;  // rad, where it comes from or goes to, from +x counter-clockwise; one of them
  Profile profile = Profile::iso;
  double exponent = 0.12;         // of Profile::power
  double density = 1.226;         // kg/m3, of the air

  bool blows() const { return speed > 0.0; }
  double towards() const { return to ? *to : from ? *from + std::numbers::pi : 0.0; }
  bool operator==(const WindSpec&) const = default;
};

/// An area of a body that the wind blows on.
struct WindAreaSpec : ElementEntry<WindAreaSpec> {
  std::string body;
  Vector3 centre = Vector3::Zero();            // m, in B
  Vector3 areas = Vector3::Zero();             // m2, that wind along x, y, z of B meets
  Vector3 drag = Vector3::Constant(1.2);       // 1, along x, y, z of B
  std::optional<double> height;                // m; absent: root of the larger of the areas across x and y
};

}  // namespace stillhook
