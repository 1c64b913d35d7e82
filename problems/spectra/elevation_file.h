// A measured elevation of the surface in a table: the first column the time in s in even steps, the names of the
// columns in the first row.
#pragma once

#include "sim/sea/sea_spec.h"

namespace stillhook {

/// The column spec.column, in m. Throws FileError "<file>:<line>: ...".
ElevationRecord read_elevation_file(const RecordFileSpec& spec);

}  // namespace stillhook
