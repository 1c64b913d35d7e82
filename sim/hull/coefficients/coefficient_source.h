// Where a hull's coefficient set comes from: a file, or the panel method on the hull as it floats.
//
// A set that was computed is kept, in memory for this process and on disk for the next, under a name that is a hash of
// everything it depends on: the hulls' shapes and drafts, where they lie when they are coupled, water and its depth,
// band, panels, and
// the version of the method. On disk it is a coefficient file (coefficient_file.h) in $STILLHOOK_CACHE, else
// $XDG_CACHE_HOME/stillhook, else ~/.cache/stillhook; where nothing can be written it is computed each time. A set is
// always used as it reads back from that form, so that a first run and a later one agree to the last bit.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/body_spec.h"
#include "sim/error.h"
#include "sim/hull/rankine/panel_method.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

/// Share done in [0, 1] and what is being done; false ends the computation.
using HydroProgress = std::function<bool(double, const std::string&)>;

/// The section of the case that an error of this body's coefficients names.
inline std::string entry_of(const BodySpec& body) { return "bodies." + body.name + ".hydrodynamics"; }

/// A body's hull in its initial equilibrium. The panel method takes it upright: heel and trim are left out.
struct HullAfloat {
  const BodySpec* body = nullptr;
  const Mesh* mesh = nullptr;          // B
  double waterline = 0.0;              // m, height of the still water plane above Bo at the middle of the hull
  double x = 0.0, y = 0.0, yaw = 0.0;  // m, m, rad: Bo and heading in W
};

/// What the panel method is asked for these hulls. Drafts are rounded to kDraftStep, so that a change of ballast by a
/// few tonnes does not ask for a new set.
inline constexpr double kDraftStep = 0.01;  // m
std::vector<PanelHull> panel_hulls(std::span<const HullAfloat> hulls);
/// A set of several hulls has one height of its reference points above the water, that of the first hull's Bo. Height of
/// the reference point above Bo of another one, m.
double reference_height(std::span<const HullAfloat> hulls, const HullAfloat& hull);
PanelMethodOptions panel_options(const SeaSpec& sea, const PanelMethodSpec& method, double panel_length);
/// m, of the water that panels are computed in: that of the waves, infinite from the length of the longest wave of the
/// band of deep water on, of which the bed then returns exp(-4 pi) = 3e-6.
double panel_depth(const SeaSpec& sea, const PanelMethodSpec& method);

/// The set of one hull (kinds table, database, panels) or of several coupled ones (panels); null for other kinds. Checked
/// by require_self_checks with method.accepted_checks; the sentences of those that failed go to `warnings`. Throws
/// SpecificationError("bodies.<name>.hydrodynamics").
std::shared_ptr<const HydrodynamicCoefficients> coefficient_set(std::span<const HullAfloat> hulls, const SeaSpec& sea,
                                                                const PanelMethodSpec& method,
                                                                std::vector<std::string>& warnings,
                                                                const HydroProgress& progress = {});

/// The same for a panel computation alone, with its report; cached like it. `report` is filled only when the set was
/// really computed. `from_cache` tells.
std::shared_ptr<const HydrodynamicCoefficients> cached_panel_method(const std::vector<PanelHull>& hulls,
                                                                    const PanelMethodOptions& options,
                                                                    const HydroProgress& progress, bool* from_cache,
                                                                    PanelMethodReport* report = nullptr);

/// Where cached sets lie; empty where there is no such place.
std::string cache_folder();

}  // namespace stillhook
