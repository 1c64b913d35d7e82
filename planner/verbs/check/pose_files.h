// The static poses of a lift as drawings in files.
#pragma once

#include <string>
#include <vector>

#include "sim/operation.h"

namespace stillhook {

/// Draws into `path`: a name that ends in ".svg" gets the start pose, any other is a folder (made if there is none)
/// that gets every pose that differs from the one before, numbered in their order: "1_start.svg". Returns the files.
/// Throws FileError for one that exists already, unless `replace`, and for one that cannot be written.
std::vector<std::string> write_pose_drawings(const Model& model, const Operation& operation, const std::string& path,
                                             bool replace);

}  // namespace stillhook
