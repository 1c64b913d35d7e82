// What the formats of mesh files hold: STL, OBJ and GDF (mesh_file.h), chosen by the end of the name.
#pragma once

#include <string>

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// The triangles of a file in its own coordinates, corners not merged. `scale` (m per unit) is only looked at to tell
/// feet from metres. Throws MeshError with the file's name and, where there is one, the line.
Mesh mesh_in_file(const std::string& path, double scale);

}  // namespace stillhook
