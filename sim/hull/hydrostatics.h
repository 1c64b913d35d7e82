// Hydrostatic and Froude-Krylov force: the pressure of the undisturbed wave on the instantaneous wetted hull.
//
//   F = -rho g int_S h n dS,   M = -rho g int_S h (r x n) dS          over the hull surface S below z = zeta(x, y, t)
//
// pressure  h is the head of the incident wave with Wheeler stretching (wave_field.h), n the full outward normal: gives
//           surge, sway and yaw too.
// volume    h = zeta - z, the weight of the column below the wave profile, and only the vertical part of n: the
//           displaced volume and its first moments, Eq. 5 of Cha, Nam & Ha (2018).
//
// n outward normal, r arm from the centre of gravity, m; h pressure head, m; zeta wave elevation, m. Depth and head are
// sampled at the vertices and vary linearly on each triangle, which is cut at the surface (clipped_panel.h). In calm
// water this is exact for the polyhedron. In waves a panel of edge L sees head waves of number k weaker by (k L)^2/12.
#pragma once

#include <array>
#include <memory>

#include "sim/body_spec.h"
#include "sim/channel_kind.h"
#include "sim/hull/mesh/mesh.h"
#include "sim/multibody/force_element.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// What is recorded of every hull, in the order in which measure() writes it.
namespace hull_channels {
inline constexpr ChannelKind<BodySpec> buoyancy{
    "buoyancy", "N", "vertical force of the water on the hull (hydrostatic and Froude-Krylov)"};
inline constexpr ChannelKind<BodySpec> submerged_volume{"submerged_volume", "m3",
                                                        "volume of the hull below the wave profile"};
inline constexpr std::array all = {buoyancy, submerged_volume};
}  // namespace hull_channels

/// The mesh of a hull in B: a box divided into panels, or the mesh file with edges longer than a panel's diagonal
/// halved. panel_length = 0 takes automatic_panel_length. Throws MeshError; a hull without shape gives an empty mesh.
Mesh build_hull_mesh(const HullSpec& hull, std::string* mended = nullptr);

/// The element "<body>.hydrostatics" with channels <body>.buoyancy (N, vertical force) and <body>.submerged_volume (m3,
/// below the wave profile). Its potential energy is rho g times the first moment of the submerged volume about the
/// surface, int (zeta - z) dV: in calm water the forces are its derivatives and energy is conserved; in waves it is the
/// work of pushing the hull down through the wave profile frozen at that instant, and the waves do work on the hull.
/// Throws SpecificationError for a body without hull, a mesh that is none, and a sea whose dominant wave is shorter
/// than five panels.
std::unique_ptr<ForceElement> build_hydrostatics(const BodySpec& body, int index,
                                                 std::shared_ptr<const WaveField> waves, const SeaSpec& sea);

}  // namespace stillhook
