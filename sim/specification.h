// Plain structs that describe a lift: what a case file fills in and build_model() reads. SI and radians throughout;
// the case reader alone converts units. Names refer to other entries; "world" is the fixed body.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "sim/element_kind.h"
#include "sim/error.h"
#include "sim/hull/self_check_tolerances.h"
#include "sim/own_element.h"
#include "sim/rao_spec.h"
#include "sim/spatial/pose.h"

namespace stillhook {

// ---- sea ------------------------------------------------------------------------------------------------------

struct SeaStateSpec {
  enum class Type { calm, regular, jonswap, pierson_moskowitz };
  std::string name;
  Type type = Type::calm;
  double amplitude = 0.0;       // m, regular
  double frequency = 0.0;       // rad/s, regular
  double phase = 0.0;           // rad, lag of the crest at the world origin at t = 0, regular
  double significant_height = 0.0;  // m, irregular
  double peak_period = 0.0;     // s, irregular
  double gamma = 0.0;           // 1, JONSWAP peakedness; 0 = by the DNV rule from Hs and Tp
  double heading = 0.0;         // rad, direction the waves travel towards, from +x counter-clockwise
  double spreading = 0.0;       // exponent n of cos^n; 0 = long-crested
  int components = 60;          // irregular: number of frequencies
  int directions = 1;           // irregular: number of directions, > 1 only with spreading
  int seed = 1;                 // irregular: phases come from this index
};

struct SeaSpec {
  std::string active;           // name of the state used
  double ramp = 30.0;           // s, the waves grow smoothly from nothing over this time
  double density = 1025.0;      // kg/m3
  double gravity = 9.80665;     // m/s2
  double depth = 0.0;           // m, 0 = deep; used by moorings, waves are deep-water
  std::vector<SeaStateSpec> states;
};

// ---- bodies ---------------------------------------------------------------------------------------------------

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

struct BodySpec {
  std::string name;
  double mass = 0.0;                       // kg
  Vector3 cog = Vector3::Zero();           // m, p_BC
  Matrix3 inertia = Matrix3::Zero();       // kg m2, about C, axes of B
  Vector3 position = Vector3::Zero();      // m, p_WB at the start (first guess of the static equilibrium)
  RollPitchYaw attitude;                   // rad, at the start
  Vector3 velocity = Vector3::Zero();      // m/s, of Bo in W at the start (only with start = "as_given")
  Vector3 angular_velocity = Vector3::Zero();  // rad/s, in B at the start
  HullSpec hull;
  HydrodynamicsSpec hydrodynamics;

  /// The sea alone moves it, no force does.
  bool moved_by_sea() const { return hydrodynamics.kind == HydrodynamicsSpec::Kind::rao; }
  /// It has a hull whose pressure carries it.
  bool floats() const { return hull.shape != HullSpec::Shape::none && !moved_by_sea(); }
};

/// How coefficients are computed and what is accepted of them, for all hulls.
struct PanelMethodSpec {
  enum class Beyond { limit, cut, refuse };
  double lowest = 0.2;                 // rad/s
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

// ---- joints ---------------------------------------------------------------------------------------------------

struct JointSpec {
  enum class Type { revolute, fixed, spherical, prismatic };
  std::string name;
  Type type = Type::revolute;
  std::string parent, child;               // bodies; parent may be "world"
  Vector3 point_on_parent = Vector3::Zero();  // m, in the parent's B
  Vector3 point_on_child = Vector3::Zero();   // m, in the child's B
  Vector3 axis = Vector3::UnitY();         // in the parent's B; revolute: of rotation, prismatic: of sliding
  // A driven or sprung joint (revolute: N m/rad, prismatic: N/m); the drive moves the rest position.
  double stiffness = 0.0;
  double damping = 0.0;
  double rest = 0.0;                       // rad or m, coordinate at zero load, relative to the initial pose
  std::string drive;                       // name of a drive, empty = none
};

// ---- lifting gear ---------------------------------------------------------------------------------------------

/// Anything that moves by command. Position 0 at the start of the run.
struct DriveSpec {
  enum class Kind { winch, ballast, tow, joint };
  std::string name;
  Kind kind = Kind::winch;      // winch: m hauled in (+ shortens); ballast: share 0..1; tow: m; joint: rad or m
  double speed_max = 0.0;       // per s; 0 = unlimited
  double acceleration_max = 0.0;  // per s2; 0 = unlimited
};

struct WireSpec : ElementEntry<WireSpec> {
  enum class Role { other, hoist, luffing, stay, sling };
  Role role = Role::other;
  std::string from, to;                    // bodies; "from" carries the upper end or the sheave
  Vector3 point_from = Vector3::Zero(), point_to = Vector3::Zero();  // m, in B of each
  double axial_stiffness = 0.0;            // EA, N
  double damping_ratio = 0.0;              // share of critical of the mass below at the initial stiffness EA/L
  double damping_mass = 0.0;               // kg, the mass meant by damping_ratio
  double damping = 0.0;                    // N s/m, instead of damping_ratio
  double unstretched_length = 0.0;         // m; 0 = from `slack` or `hold_*` below
  double slack = 0.0;                      // m, unstretched length minus distance of the ends at the start
  std::string hold_joint;                  // unstretched length such that this joint keeps its initial coordinate in
                                           // the initial static equilibrium (luffing and stay wires)
  std::string winch;                       // name of a drive, empty = fixed length
  double tension_max = 0.0;                // N, limit of the winch (checked, not enforced); 0 = none
  double breaking_load = 0.0;              // N; 0 = not given
};

/// Factors on a tagline's gains while its hoist wire has this length.
struct GainPointSpec {
  std::string name;
  double fall = 0.0;                       // m
  double kp_factor = 1.0, kd_factor = 1.0;

  bool operator==(const GainPointSpec&) const = default;
};

struct TaglineSpec : ElementEntry<TaglineSpec> {
  std::string from, to;                    // winch body, controlled body
  Vector3 point_from = Vector3::Zero(), point_to = Vector3::Zero();  // m, in B of each
  std::string wire;                        // the hoist wire whose angle is controlled
  double kp = 0.0;                         // N/rad
  double kd = 0.0;                         // N s/rad
  std::vector<GainPointSpec> gain_schedule;  // by rising fall; empty = the gains as they are throughout
  double set_point = 0.0;                  // rad, wanted angle of the hoist wire towards the winch's far side
  double pretension = 0.0;                 // N
  double tension_max = 0.0;                // N
  double speed_max = 0.0;                  // m/s; 0 = unlimited
  double time_constant = 0.5;              // s
  double axial_stiffness = 2.0e7;          // EA, N
  bool active = true;
  std::string active_from;                 // phase with which the line is connected; empty = always
};

struct MooringSpec : ElementEntry<MooringSpec> {
  enum class Type { catenary, linear };
  Type type = Type::catenary;
  std::string body;
  Vector3 fairlead = Vector3::Zero();      // m, in B
  std::optional<Vector3> anchor;           // m, in W; absent: found from azimuth, pretension and length or distance
  double azimuth = 0.0;                    // rad, direction from the fairlead to the anchor at the initial pose, in W
  double pretension = 0.0;                 // N, horizontal tension at the initial pose; not of a catenary with an anchor
  double stiffness = 0.0;                  // N/m, linear only
  double anchor_distance = 0.0;            // m, horizontal, linear only
  double length = 0.0;                     // m, unstretched, catenary
  double weight = 0.0;                     // N/m, in water, catenary; < 0: the line is buoyant
  double axial_stiffness = 0.0;            // N, catenary
  double seabed_friction = 0.0;            // 1, catenary
  std::string tow;                         // drive that moves the anchor, empty = fixed
  Vector3 tow_direction = Vector3::Zero(); // unit vector in W
};

/// A linear spring and damper in all six motions between a body and the world, about one point of the body.
struct RestoringSpec : ElementEntry<RestoringSpec> {
  std::string body;
  Vector3 point = Vector3::Zero();          // m, in B
  std::optional<Vector3> rest_point;        // m, in W: where the point is at rest; absent: at the initial pose
  std::optional<RollPitchYaw> rest_attitude;  // rad, of the body at rest; absent: that of the initial pose
  std::optional<double> axes_heading;       // rad, of the axes of the matrices in W; absent: that of the rest attitude
  Matrix6 stiffness = Matrix6::Zero();      // N/m, N, N m/rad; symmetric
  Matrix6 damping = Matrix6::Zero();        // N s/m, N s, N m s/rad; symmetric, positive semidefinite
  Vector3 force_at_rest = Vector3::Zero();  // N, in W, on the body
};

/// Corner points of one body against a horizontal rectangle fixed to another.
struct ContactSpec : ElementEntry<ContactSpec> {
  std::string body;                        // carries the points
  std::vector<Vector3> points;             // m, in B
  std::string surface_body;                // carries the rectangle, may be "world"
  Vector3 surface_centre = Vector3::Zero();   // m, in its B
  double surface_length = 0.0, surface_breadth = 0.0;  // m, along x and y of its B
  double stiffness = 0.0;                  // N/m, all points together
  double damping = 0.0;                    // N s/m, all points together
  double damping_depth = 0.005;            // m, penetration over which the damping grows to its full value
  double friction = 0.0;                   // 1
  enum class Role { other, pickup, target };
  Role role = Role::other;                 // pickup: re-hits are counted; target: set-down is measured
  std::string active_from;                 // phase with which it begins to act; empty = always. No force before.
};

/// A mass of water moved from one tank to another; its weight counts, its inertia does not.
struct BallastSpec : ElementEntry<BallastSpec> {
  std::string body;
  double mass = 0.0;                       // kg, moved when the drive stands at 1
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m, in B
  std::string drive;
};

/// Steady wind over the sea.
struct WindSpec {
  enum class Profile { iso, power, constant };
  double speed = 0.0;             // m/s, hourly mean at 10 m above still water; 0 = no wind
  std::optional<double> from, to;  // rad, where it comes from or goes to, from +x counter-clockwise; one of them
  Profile profile = Profile::iso;
  double exponent = 0.12;         // of Profile::power
  double density = 1.226;         // kg/m3, of the air

  bool blows() const { return speed > 0.0; }
  double towards() const { return to ? *to : from ? *from + std::numbers::pi : 0.0; }
  bool operator==(const WindSpec&) const = default;
};

/// An area of a body that the wind blows on.
struct WindAreaSpec : ElementEntry<WindAreaSpec> {
  std::string body;
  Vector3 centre = Vector3::Zero();            // m, in B
  Vector3 areas = Vector3::Zero();             // m2, that wind along x, y, z of B meets
  Vector3 drag = Vector3::Constant(1.2);       // 1, along x, y, z of B
  std::optional<double> height;                // m; absent: root of the larger of the areas across x and y
};

// ---- operation ------------------------------------------------------------------------------------------------

/// A scalar measured in the model that a goal can ask for.
struct CoordinateSpec {
  std::string body;                        // point of a body ...
  Vector3 point = Vector3::Zero();         // m, in B
  int axis = 2;                            // 0 x, 1 y, 2 z in W
  std::string relative_to;                 // body whose axes and origin are used instead of W; empty = world
  std::string joint;                       // ... or the coordinate of a joint relative to its initial pose
  std::string wire;                        // ... or the tension of a wire, N
};

struct ProfileSpec {
  enum class Shape { trapezoid, s_curve, knots };
  // Input shaping (Singer & Seering 1990): the profile convolved with impulses that leave no residual swing of a
  // pendulum; zvd bears twice the error of its period.
  enum class Shaper { none, zv, zvd };
  Shape shape = Shape::s_curve;
  double ramp = 10.0;                      // s, from rest to full speed and back
  std::vector<double> knots;               // relative speeds at equal times, between the two zeros (knots only)
  Shaper shaper = Shaper::none;
  double shaper_period = 0.0;              // s; 0 = of the pendulum on the hoist falls as long as they are at the middle
                                           // of the move, 2 pi sqrt(l/g)
  double shaper_damping = 0.0;             // 1, damping ratio of that swing
};

struct MoveSpec {
  std::string drive;
  double speed = 0.0;                      // per s, magnitude of the peak speed
  std::optional<double> travel;            // given travel, with sign ...
  std::optional<CoordinateSpec> goal;      // ... or such that this coordinate
  double goal_value = 0.0;                 // reaches this value in static equilibrium at the end of the phase
  ProfileSpec profile;
  double delay = 0.0;                      // s after the start of the phase
  bool background = false;                 // the phase may end before this move
};

struct EventSpec {
  enum class Type { none, clear_of_contact };
  Type type = Type::none;
  std::string contact;                     // clear_of_contact: no force in it ...
  double hold = 0.0;                       // s, ... for this long
  double timeout = 600.0;                  // s, go on after this, with a note in the result
};

struct PhaseSpec {
  enum class Stage { on_barge, transfer, hanging, set_down, landed };
  std::string name;
  Stage stage = Stage::hanging;
  double duration = 0.0;                   // s, at least; the moves may need more
  EventSpec wait_for;                      // before the phase starts
  std::vector<MoveSpec> moves;
};

struct OperationSpec {
  std::string load;                        // the lifted body
  std::string crane;                       // the vessel whose heading defines off-lead and side-lead
  Vector3 target = Vector3::Zero();        // m, in W: where the load's target point should stand
  Vector3 load_reference = Vector3::Zero();  // m, in the load's B: the point that should stand there
  std::vector<PhaseSpec> phases;
};

/// A pose to report: joints held at given coordinates by adjusting wires, drives at given positions.
struct PoseSpec {
  struct DriveSetting { std::string drive; double position = 0.0; };
  struct Hold { std::string joint; double coordinate = 0.0; std::string drive; };  // rad relative to the initial pose
  struct Goal { CoordinateSpec coordinate; double value = 0.0; std::string drive; };
  std::string name;
  std::vector<DriveSetting> drives;
  std::vector<Hold> holds;
  std::vector<Goal> goals;
};

/// Two bodies, as boxes or capsules, whose distance is reported.
struct ClearanceSpec {
  struct Shape {
    std::string body;
    Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m, in B: axis of a capsule, or opposite corners of a box
    double radius = 0.0;                                   // m, > 0: capsule; 0: box
  };
  std::string name;
  Shape a, b;
};

struct SolverSpec {
  double time_step = 0.05;                 // s
  double hht_alpha = -0.1;                 // in [-1/3, 0]
  double newton_tolerance = 1e-7;          // share of g, see hht.h
  double output_interval = 0.2;            // s
  double max_duration = 0.0;               // s; 0 = until the operation ends
  bool static_start = true;                // start from static equilibrium instead of the given poses
};

struct Specification {
  std::string name;
  SeaSpec sea;
  std::vector<BodySpec> bodies;
  PanelMethodSpec panel_method;
  std::vector<JointSpec> joints;
  std::vector<DriveSpec> drives;
  std::vector<WireSpec> wires;
  std::vector<TaglineSpec> taglines;
  std::vector<MooringSpec> moorings;
  std::vector<RestoringSpec> restoring;
  std::vector<ContactSpec> contacts;
  std::vector<BallastSpec> ballast;
  WindSpec wind;
  std::vector<WindAreaSpec> wind_areas;
  OperationSpec operation;
  std::vector<PoseSpec> poses;
  std::vector<ClearanceSpec> clearances;
  SolverSpec solver;
  std::vector<OwnElement> own_elements;  // of a program that embeds the library; never of a case file
};

// ---- kinds of force elements ----------------------------------------------------------------------------------

/// Every kind that a case can hold, in the order in which they join a model (element_kind.h says what each brings).
inline constexpr std::tuple kElementKinds = {
    ElementKind<WireSpec>{"wires", "wire", "Wires", &Specification::wires, &WireSpec::winch},
    ElementKind<TaglineSpec>{"taglines", "tagline", "Taglines", &Specification::taglines},
    ElementKind<MooringSpec>{"moorings", "mooring", "Mooring lines", &Specification::moorings, &MooringSpec::tow},
    ElementKind<RestoringSpec>{"restoring", "spring", "Linear springs to the world", &Specification::restoring},
    ElementKind<ContactSpec>{"contacts", "contact", "Contacts", &Specification::contacts},
    ElementKind<BallastSpec>{"ballast", "ballast", "Ballast transfers", &Specification::ballast, &BallastSpec::drive},
    ElementKind<WindAreaSpec>{"wind_areas", "wind area", "Areas in the wind", &Specification::wind_areas},
};

/// Calls visit(kind) for each of them.
template <class Visit>
void for_each_element_kind(Visit visit) {
  std::apply([&](const auto&... kind) { (visit(kind), ...); }, kElementKinds);
}

}  // namespace stillhook
