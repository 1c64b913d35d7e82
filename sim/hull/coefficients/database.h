// Hydrodynamic coefficients from any file the project reads, chosen by the end of its name.
#pragma once

#include <string>
#include <vector>

#include "sim/hull/coefficients/bemio_file.h"
#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/wamit_file.h"

namespace stillhook {

struct DatabaseOptions {
  DatabaseFrame frame;  // not needed for the project's own format, which says all of it
  WamitUnits wamit;     // for WAMIT files only
};

/// What a file is by the end of its name, in small letters or capitals.
bool is_bemio(const std::string& path);
bool is_wamit(const std::string& path);

/// The files that are read for one that is named: of WAMIT, those of the same base name. They need not exist.
std::vector<std::string> database_files(const std::string& path);

/// .csv: the project's own; .1, .2, .3, .hst: the WAMIT files of that base name; .h5: BEMIO. Throws SpecificationError
/// as the readers do, and for any other ending one that names these. Does not run the self-checks.
HydrodynamicCoefficients read_database(const std::string& path, const DatabaseOptions& options = {});

}  // namespace stillhook
