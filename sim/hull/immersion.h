// A hull at rest in calm water: the polyhedron below z = 0, exactly.
//
// By the divergence theorem all integrals run over the wet part S of the hull's surface alone, since the integrands
// vanish on the waterplane or are chosen not to depend on z:
//
//   V = int z n_z dS        V x = int x z n_z dS        V z = int z^2/2 n_z dS
//   A = -int n_z dS         int_A x^2 dA = -int x^2 n_z dS        and so on
//
//   GM = I/V + z_B - z_G    (I second moment of the waterplane about the axis through its centroid)
#pragma once

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// What a pose means for a hull in calm water. Positions in W.
struct HydrostaticSummary {
  double volume = 0.0;                                            // m3, below z = 0
  Vector3 centre_of_buoyancy = Vector3::Zero();                   // m
  double waterplane_area = 0.0;                                   // m2
  Eigen::Vector2d centre_of_flotation = Eigen::Vector2d::Zero();  // m
  // Second moments of the waterplane about the centre of flotation, axes along and across the hull's heading, m4.
  double transverse_inertia = 0.0;    // int y^2 dA, about the longitudinal axis
  double longitudinal_inertia = 0.0;  // int x^2 dA, about the transverse axis
  double lowest = 0.0;                // m, z of the lowest vertex; minus the draft
  double freeboard = 0.0;             // m, z of the highest vertex
};

/// Clips the mesh (in B) at z = 0. A hull that is dry has volume 0 and its centres at the origin of B.
HydrostaticSummary immersion_of(const Mesh& mesh, const Pose& X_WB);

/// Height above Bo (m) of the still water in which the upright mesh displaces `volume` (m3): its lowest or highest point
/// where it cannot.
double floating_height(const Mesh& mesh, double volume);

struct MetacentricHeights {
  double transverse = 0.0, longitudinal = 0.0;  // m
};

/// GM of a vessel that carries `mass` (kg, hanging loads included at their points of suspension) with its common centre
/// of gravity p_WG. Written as (rho I + rho V z_B) / mass - z_G, which is I/V + KB - KG when the vessel floats freely
/// and stays right when moorings or a barge take part of the weight. density in kg/m3.
MetacentricHeights metacentric_heights(const HydrostaticSummary& hull, double mass, const Vector3& p_WG,
                                       double density);

}  // namespace stillhook
