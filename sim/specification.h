// Plain structs that describe a lift: what a case file fills in and build_model() reads. SI and radians throughout; the
// case reader alone converts units. Names refer to other entries; "world" is the fixed body. The structs of a subject stand
// with it (sea_spec.h, hull_spec.h, gear_spec.h, ...); here they come together.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "sim/body_spec.h"
#include "sim/element_kind.h"
#include "sim/environment/flow_spec.h"
#include "sim/environment/wind_spec.h"
#include "sim/error.h"
#include "sim/lifting/crane_curve.h"
#include "sim/lifting/gear_spec.h"
#include "sim/multibody/joint_spec.h"
#include "sim/operation_spec.h"
#include "sim/own_element.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

struct SolverSpec {
  double time_step = 0.05;                 // s
  double hht_alpha = -0.1;                 // in [-1/3, 0]
  double newton_tolerance = 1e-7;          // share of g, see hht.h
  double output_interval = 0.2;            // s
  double max_duration = 0.0;               // s; 0 = until the operation ends
  bool static_start = true;                // start from static equilibrium instead of the given poses
};

struct Specification {
  std::string name;
  SeaSpec sea;
  std::vector<BodySpec> bodies;
  PanelMethodSpec panel_method;
  std::vector<JointSpec> joints;
  std::vector<DriveSpec> drives;
  std::vector<WireSpec> wires;
  std::vector<TaglineSpec> taglines;
  std::vector<MooringSpec> moorings;
  std::vector<RestoringSpec> restoring;
  std::vector<ContactSpec> contacts;
  std::vector<BallastSpec> ballast;
  WindSpec wind;
  std::vector<WindAreaSpec> wind_areas;
  std::vector<WindHullSpec> wind_hulls;
  std::vector<CurrentAreaSpec> current_areas;
  std::vector<CurrentHullSpec> current_hulls;
  OperationSpec operation;
  std::vector<PoseSpec> poses;
  std::vector<ClearanceSpec> clearances;
  std::vector<CraneCurveSpec> crane_curves;
  SolverSpec solver;
  std::vector<OwnElement> own_elements;  // of a program that embeds the library; never of a case file

  /// Index that the phases of the gusts come from: the wind's own, else that of the active sea, else 1.
  int gust_seed() const {
    if (wind.seed) return *wind.seed;
    const SeaStateSpec* state = sea.active_state();
    return state && state->seeded() ? state->seed : 1;
  }
};

// ---- kinds of force elements ----------------------------------------------------------------------------------

/// Every kind that a case can hold, in the order in which they join a model (element_kind.h says what each brings).
inline constexpr std::tuple kElementKinds = {
    ElementKind<WireSpec>{"wires", "wire", "Wires", &Specification::wires, &WireSpec::winch},
    ElementKind<TaglineSpec>{"taglines", "tagline", "Taglines", &Specification::taglines},
    ElementKind<MooringSpec>{"moorings", "mooring", "Mooring lines", &Specification::moorings, &MooringSpec::tow},
    ElementKind<RestoringSpec>{"restoring", "spring", "Linear springs to the world", &Specification::restoring},
    ElementKind<ContactSpec>{"contacts", "contact", "Contacts", &Specification::contacts},
    ElementKind<BallastSpec>{"ballast", "ballast", "Ballast transfers", &Specification::ballast, &BallastSpec::drive},
    ElementKind<WindAreaSpec>{"wind_areas", "wind area", "Areas in the wind", &Specification::wind_areas},
    ElementKind<WindHullSpec>{"wind_hulls", "hull in the wind", "Hulls in the wind", &Specification::wind_hulls},
    ElementKind<CurrentAreaSpec>{"current_areas", "area in the current", "Areas in the current",
                                 &Specification::current_areas},
    ElementKind<CurrentHullSpec>{"current_hulls", "hull in the current", "Hulls in the current",
                                 &Specification::current_hulls},
};

/// Calls visit(kind) for each of them.
template <class Visit>
void for_each_element_kind(Visit visit) {
  std::apply([&](const auto&... kind) { (visit(kind), ...); }, kElementKinds);
}

}  // namespace stillhook
