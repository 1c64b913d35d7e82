// What a case says about the parts of bodies that wind and current push: areas with drag along their body's axes, and
// hulls with coefficients over the direction. SI and radians; B is the frame of the body.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "sim/element_kind.h"
#include "sim/spatial/pose.h"

namespace stillhook {

/// An area of a body that a fluid meets.
struct FlowAreaSpec {
  std::string body;
  Vector3 centre = Vector3::Zero();       // m, in B
  Vector3 areas = Vector3::Zero();        // m2, that a flow along x, y, z of B meets
  Vector3 drag = Vector3::Constant(1.2);  // 1, along x, y, z of B
  std::optional<double> height;           // m; absent: root of the larger of the areas across x and y
};

struct WindAreaSpec : ElementEntry<WindAreaSpec>, FlowAreaSpec {};
struct CurrentAreaSpec : ElementEntry<CurrentAreaSpec>, FlowAreaSpec {};

/// A hull whose forces are known over the direction that the fluid comes from.
struct FlowHullSpec {
  std::string body;
  std::string coefficient_file;           // resolved path: angle, Cx, Cy, Cn; empty: by the rule of the kind
  Vector3 reference = Vector3::Zero();    // m, in B: amidships at the still water
  double length = 0.0;                    // m
  double filter = 20.0;                   // s, of the hull's own velocity
};

struct WindHullSpec : ElementEntry<WindHullSpec>, FlowHullSpec {
  /// Kinds of ships that Blendermann measured.
  enum class Ship { none, cargo_loaded, diving_support, drilling, offshore_supply, research, tanker_ballast, tender };
  Ship ship = Ship::none;
  double area_front = 0.0, area_side = 0.0;  // m2, above the water
  double centroid_ahead = 0.0;               // m, of the side area ahead of the reference point (ship)
  double centroid_height = 0.0;              // m, of the side area above still water
};

struct CurrentHullSpec : ElementEntry<CurrentHullSpec>, FlowHullSpec {
  std::optional<std::array<double, 2>> drag;  // 1, along and across the hull; absent with a file
  double draft = 0.0;           // m
};

}  // namespace stillhook
