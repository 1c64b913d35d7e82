// Reading HDF5 and NetCDF files of which nobody vouches that they are whole.
//
// The HDF5 library trusts what a file says about itself: in a damaged one it may follow a wrong address and end the
// process, free what it does not own, or go round in circles. So a file is read in a child process first, and in this
// one only when the child came through and could close the library behind it.
#pragma once

#include <functional>
#include <string>

#include "sim/error.h"

namespace stillhook {

/// Calls `read` in a child process and returns what it returned there. Throws FileError when `read` throws (with the
/// sentence of that exception), when it ends the child, or when it wants more time or memory than a file of this size
/// can need.
std::string read_in_child(const std::string& path, const std::function<std::string()>& read);

/// The same for a read that is repeated in this process afterwards.
void try_reading(const std::string& path, const std::function<void()>& read);

}  // namespace stillhook
