// A checksum at the end of a finished file, over all that stands before it. HDF5 and NetCDF do not look behind the end
// that a file gives itself, so that any program reads a sealed file as before.
#pragma once

#include <string>

namespace stillhook {

/// Appends the seal. Throws FileError; `shown` is the name that it gives.
void seal_file(const std::string& path, const std::string& shown);

/// False if the file has no seal: it is not finished, or another program wrote it. Throws FileError if it has one that
/// does not fit what stands before it.
bool has_good_seal(const std::string& path);

}  // namespace stillhook
