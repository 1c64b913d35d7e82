// Reading NetCDF files of which nobody vouches that they are whole.
//
// The HDF5 library beneath NetCDF trusts what a file says about itself: in a damaged one it may follow a wrong address
// and end the process, or go round in circles. So a file is read in a child process first, and in this one only when
// the child came through.
#pragma once

#include <functional>
#include <string>

namespace stillhook {

/// Calls `read` in a child process. Throws FileError when that ends it, or wants more time or memory than a file of
/// this size can need. What `read` throws itself is left to the call that follows.
void try_reading(const std::string& path, const std::function<void()>& read);

template <class Read>
auto read_safely(const std::string& path, Read read) {
  try_reading(path, [&read] { read(); });
  return read();
}

}  // namespace stillhook
