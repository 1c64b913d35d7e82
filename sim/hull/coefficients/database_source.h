// The coefficient set of a body's file (kinds table and database), read once for all models of a search.
#pragma once

#include <memory>
#include <string>

#include "sim/hull/coefficients/coefficient_source.h"

namespace stillhook {

/// The set of the file that `hull.body` names, without the noise of its silent modes; the same object for every model
/// that asks alike, until one of the files has another size or time. Its displaced volume is the file's own, or, where
/// the format has none, that of the hull below the still water of the database. For several threads at once. Throws
/// SpecificationError of the readers.
std::shared_ptr<const HydrodynamicCoefficients> file_set(const HullAfloat& hull, const SeaSpec& sea);

/// A sentence when the body floats at another draft than the coefficients of its file hold for, by more than 2 % of the
/// volume; empty otherwise.
std::string draft_difference(const HydrodynamicCoefficients& set, const HullAfloat& hull);

/// How the set of a database could pass the checks it fails: the band of frequencies that does, the depth that its
/// waves feel, the other reading of its first column. Sentences to follow "...", each begun with "; "; empty when
/// nothing known helps.
std::string database_remedy(const HydrodynamicCoefficients& set, const HullAfloat& hull, const SeaSpec& sea,
                            const PanelMethodSpec& method);

}  // namespace stillhook
