// The mesh on which the pressure of a sea acts.
#pragma once

#include "sim/body_spec.h"
#include "sim/error.h"
#include "sim/hull/mesh/mesh.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// build_hull_mesh(), with panels small enough for the waves that carry the sea's energy: a fifth of their length; the
/// tail of a spectrum is never seen by the panels. Automatic panels are made smaller where the sea asks for it. Throws
/// SpecificationError("bodies.<name>") for a mesh that is none, for a hull.panel_length_m that the case sets too long,
/// and where the waves ask for more than kMostHullPanels panels.
Mesh hull_mesh_in(const BodySpec& body, const WaveField& waves);

inline constexpr double kMostHullPanels = 20000.0;

}  // namespace stillhook
