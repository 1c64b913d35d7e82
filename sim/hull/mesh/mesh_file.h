// Reads hull meshes from files.
//
//   STL  ascii or binary. The normals of the file are not used: the winding of the vertices decides.
//   OBJ  v and f lines (polygons are split into fans; texture, normal, group and material entries are passed over).
//   GDF  WAMIT low-order panels: title; ULEN GRAV; ISX ISY; number of panels; 12 coordinates a panel, vertices
//        counter-clockwise seen from the water (WAMIT manual, "Geometric Data File"). Coordinates are in the length
//        unit of GRAV, not divided by ULEN. The planes x = 0 (ISX) and y = 0 (ISY) of symmetry are applied. Most GDF
//        files describe only the part of a hull below the still water and are open there: such a mesh is refused as
//        open, because the waterline moves, unless deck_height closes it with topsides and deck.
//
// The type is taken from the extension. Vertices closer than a millionth of the mesh's size are merged, and open edges
// divided where the corners of neighbours lie on them (mesh_seams.h).
#pragma once

#include <string>

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

struct MeshFileOptions {
  double scale = 1.0;                // m per unit of the file
  Vector3 origin = Vector3::Zero();  // m, position in B of the file's origin
  RollPitchYaw attitude = {};        // rad, of the file's axes in B
  bool mend = false;                 // mended_mesh of mesh.h before the check
  double deck_height = 0.0;          // m, > 0: decked_mesh of mesh_deck.h before that
  bool mirror = false;               // the file has one side alone: mirrored at its plane y = 0
};

/// The mesh of a file in the body frame B (m), merged and checked by check_mesh. Throws MeshError with the file's name
/// and, where there is one, the line; also when it is longer than any vessel, which a file in millimetres is.
/// `mended` (if given) is what was done with options.mend, and what is doubtful about the file, as a sentence; empty if
/// nothing.
Mesh read_mesh(const std::string& path, const MeshFileOptions& options = {}, std::string* mended = nullptr);

}  // namespace stillhook
