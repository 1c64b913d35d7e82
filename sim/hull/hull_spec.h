// What a case says about a hull and its hydrodynamics. SI and radians; B is the frame of the body.
#pragma once

#include <string>

#include "sim/hull/coefficients/self_check_tolerances.h"
#include "sim/hull/rao_spec.h"
#include "sim/spatial/pose.h"

namespace stillhook {

struct HullSpec {
  enum class Shape { none, box, mesh };
  enum class FroudeKrylov { pressure, volume };
  Shape shape = Shape::none;
  Vector3 size = Vector3::Zero();      // m, length (x), breadth (y), depth (z) of a box
  Vector3 centre = Vector3::Zero();    // m, centre of the box in B
  std::string mesh_file;               // resolved path of an STL, OBJ or GDF file
  double mesh_scale = 1.0;             // metres per unit of the file
  Vector3 mesh_origin = Vector3::Zero();  // m, position in B of the file's origin
  RollPitchYaw mesh_attitude;          // rad, of the file's axes in B
  bool mesh_mend = false;              // turn triangles that face inwards, close small holes, leave out inner shells
  bool mesh_mirror = false;            // the file is one side of the hull, mirrored at its plane y = 0
  double mesh_deck_height = 0.0;       // m, > 0: closes a wetted surface, deck this far above its rim; 0 = it has a deck
  double panel_length = 0.0;           // m, target edge of a panel; 0 = automatic
  FroudeKrylov froude_krylov = FroudeKrylov::pressure;
};

struct HydrodynamicsSpec {
  // Where the radiation and diffraction forces come from. `panels` = the panel method on the body's hull; `table` = a
  // file of the project's own format; `database` = WAMIT (.1, .3) or BEMIO (.h5). `rao`: none, the waves alone move the
  // body, by displacement RAOs.
  enum class Kind { none, constant, table, panels, database, rao };
  // How radiation is brought into the time domain: `reduced` = a passive state space fitted to A(omega), B(omega);
  // `retardation` = convolution with K(t); `direct` = the panel method marched along (panels only).
  enum class RadiationModel { automatic, reduced, retardation, direct };  // automatic: retardation for table, else reduced
  Kind kind = Kind::none;
  RadiationModel radiation = RadiationModel::automatic;
  Matrix6 added_mass = Matrix6::Zero();     // about Bo in the heading frame; kg, kg m, kg m2 (constant)
  Matrix6 damping = Matrix6::Zero();        // same, per s (constant)
  std::string coefficient_file;             // resolved path (table, database)
  Vector3 database_origin = Vector3::Zero();  // m, Bo in the frame of the database, whose z = 0 is the water (database)
  double database_length = 1.0;             // m, WAMIT's ULEN (database)
  Vector3 database_xbody = Vector3::Zero();  // m, WAMIT's XBODY: what its moments are about, in the frame of the database
  int database_body = 0;                    // which body of the database, from 1; 0 = the only one (database)
  double database_lowest = 0.0;             // rad/s, what the database has below is left out (database)
  double database_highest = 0.0;            // rad/s, what it has above is left out; 0 = nothing (database)
  double database_depth = 0.0;              // m, of the water it was computed in; 0 = no bottom, or as it says (database)
  bool database_in_frequency = false;       // the first column of WAMIT's files is in rad/s, not a period in s (database)
  bool port_starboard = false;              // headings 0..180 deg of the database are mirrored (database)
  bool axisymmetric = false;                // a body of revolution: one heading of the database stands for all (database)
  double panel_length = 0.0;                // m, longest panel of the hull; 0 = automatic (panels)
  double added_mass_factor = 1.0;           // 1, > 0, on A_inf (panels, table, database)
  double radiation_factor = 1.0;            // 1, >= 0, on the memory of the radiation, K(t) (panels, table, database)
  double diffraction_factor = 1.0;          // 1, on the diffraction force
  RaoSpec rao;                              // (rao)
  std::string coupled_with;                 // body whose hull feels this one; empty = none (panels)
  std::string coupled_until;                // phase with whose start the coupling ends; empty = never (panels)
  Vector6 linear_damping = Vector6::Zero();     // viscous, N s/m and N m s, per degree of freedom about the cog
  Vector6 quadratic_damping = Vector6::Zero();  // viscous, N s2/m2 and N m s2
  Vector6 critical_fraction = Vector6::Zero();  // viscous, share of critical at the initial equilibrium, heave, roll, pitch only
};

/// How coefficients are computed and what is accepted of them, for all hulls.
struct PanelMethodSpec {
  enum class Beyond { limit, cut, refuse };
  double lowest = 0.0;                 // rad/s; 0 = as the depth of the water asks for
  double highest = 0.0;                // rad/s; 0 = as the hull's size and the seas ask for
  int frequencies = 0;                 // 0 = as many as the hull's size asks for
  int headings = 0;                    // around the circle; 0 = as many as the waves need
  double refinement = 1.0;             // every panel is divided by it
  double direct_step = 0.15;           // s, of the `direct` radiation model
  double direct_lowest = 0.4, direct_highest = 1.2;  // rad/s, the band its panels are made for
  std::string accepted_checks;         // self-checks that may fail (coefficients.h), with commas in between
  SelfCheckTolerances tolerances;      // of these checks
  Beyond beyond = Beyond::limit;       // how waves shorter than those of the coefficients act, see diffraction.h
  double memory = 4.0;                 // GB, the most that a panel computation may take
  double fit_tolerance = 0.02;         // 1, of the `reduced` radiation model
};

}  // namespace stillhook
