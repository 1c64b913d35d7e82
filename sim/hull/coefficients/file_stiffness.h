// The hydrostatic stiffness that comes with a coefficient file against that of the hull it is used for.
//
//   C_33 = rho g A,  C_34 = rho g int y,  C_35 = -rho g int x      over the water plane, from the point of the file
//   C_44 = rho g (int y^2 + V z_B) - m g z_G,  C_55 = rho g (int x^2 + V z_B) - m g z_G,   m = rho V
//
// The program uses its own hydrostatics; that of the file tells whether the file is of this hull at this draft, with
// its origin where the case says. Codes differ in whether the weight, m g z_G, is in; and the centre of gravity of the
// run may be that of another loading condition, which moves C_44 and C_55 alike.
#pragma once

#include <string>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// A sentence that names the entries in which the stiffness of hull `n` of the set is not that of the mesh below
/// z_B = waterline; empty where they agree, or the file has none. `cog`: m, in B. Deviations that count: C_33 by 5 %;
/// the centre of the water plane by 2 % of the hull's length; C_44 and C_55 by 5 % of the water plane's part of C_44
/// and 1 % of that of C_55. Throws MeshError when nothing is below.
std::string stiffness_difference(const HydrodynamicCoefficients& set, std::size_t n, const Mesh& mesh, double waterline,
                                 const Vector3& cog);

}  // namespace stillhook
