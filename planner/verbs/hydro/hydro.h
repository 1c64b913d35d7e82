// The coefficient sets of a case's hulls: what the panel method is asked, what it takes, what came out.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "problems/case.h"
#include "sim/hull/radiation/state_space_fit.h"
#include "sim/model.h"

namespace stillhook {

/// One set: of one hull, or of two that are coupled.
struct HydroSet {
  std::vector<int> bodies;         // in the order of the set's modes
  std::vector<std::string> names;  // of the bodies
  bool panels = false;             // computed by the panel method; else read from a file

  // Of the panel method.
  std::vector<PanelHull> hulls;
  PanelMethodOptions options;
  std::vector<PanelBand> bands;  // as planned, or as they were when it was really computed
  bool from_cache = false;
  double seconds = std::numeric_limits<double>::quiet_NaN();    // s of wall time; NaN when it did not run
  double asymmetry = std::numeric_limits<double>::quiet_NaN();  // PanelMethodReport::asymmetry

  // What came out.
  std::shared_ptr<const HydrodynamicCoefficients> set;
  std::vector<SelfCheck> checks;
  std::optional<StateSpaceModel> fit;
  std::string no_fit;  // why there is no fit, a sentence

  /// "crane", "crane-barge": names files.
  std::string name() const;
  /// "crane", "crane and barge".
  std::string title() const;
  /// Name of a mode: "heave", for coupled hulls "barge heave".
  std::string mode_name(int mode) const;
};

/// Sets of a case whose hulls have some (kinds panels, table, database), the panel method's planned but not computed.
/// The hulls float where the case's static equilibrium has them. Throws CaseError.
std::vector<HydroSet> planned_sets(const Case& c);

/// Computes a planned set, or takes it from the cache. Throws CaseError, and Interrupted when
/// progress ends it.
void compute_set(const Case& c, HydroSet& set, const HydroProgress& progress);

/// Takes the sets that the model uses, checks them and fits the reduced model with the case's tolerance.
void complete_sets(const Model& model, std::vector<HydroSet>& sets);

/// Numbers of panels and bytes of the largest part of a band, which decides on the memory.
double largest_bytes(const HydroSet& set);

/// About how long a computation takes here, s of wall time: counts the work of assembly, factorisation and iterations,
/// and measures the speed of a small matrix product. Good to a factor of two.
double estimated_seconds(const HydroSet& set);

}  // namespace stillhook
