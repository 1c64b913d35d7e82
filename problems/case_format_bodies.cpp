// Field tables of the sea, the bodies with their hulls, and the joints.
#include "problems/case_format.h"

namespace stillhook {
namespace {

Matrix3 inertia_from(const std::vector<double>& v) {
  Matrix3 inertia = Vector3(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    inertia(0, 1) = inertia(1, 0) = v[3];
    inertia(0, 2) = inertia(2, 0) = v[4];
    inertia(1, 2) = inertia(2, 1) = v[5];
  }
  return inertia;
}

Matrix6 matrix_from(const std::vector<std::vector<double>>& rows) {
  Matrix6 matrix = Matrix6::Zero();
  for (std::size_t i = 0; i < 6 && i < rows.size(); ++i)
    for (std::size_t j = 0; j < 6 && j < rows[i].size(); ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  return matrix;
}

/// Entry i of a vector, or of the diagonal of a matrix.
template <class M>
auto& entry_of(M& member, int i) {
  if constexpr (M::ColsAtCompileTime == 1)
    return member[i];
  else
    return member(i, i);
}

/// Three numbers of a vector, or of the diagonal of a matrix, from `first` on. They have defaults, so a search or a fit
/// may change one of them where the case writes none.
template <class M>
Field& half(TableOf<HydrodynamicsSpec>& t, const char* key, M member, int first, const Unit& unit, const char* doc) {
  Field& field = t.numbers(
      key, {3},
      [member, first](HydrodynamicsSpec& h, const std::vector<double>& v) {
        for (int i = 0; i < 3; ++i) entry_of(h.*member, first + i) = v[static_cast<std::size_t>(i)];
      },
      unit, not_negative(), doc);
  field.get = [member, first](const void* s) -> std::optional<Value> {
    const auto& values = static_cast<const HydrodynamicsSpec*>(s)->*member;
    return Value(std::vector<double>{entry_of(values, first), entry_of(values, first + 1), entry_of(values, first + 2)});
  };
  return field;
}

const Table& sea_state_table() {
  static const Table table = [] {
    using S = SeaStateSpec;
    TableOf<S> t("sea.states", "A sea that the lift can meet; `sea.active` picks one, a scenario of the plan another.");
    const std::vector<std::string> irregular = {"jonswap", "pierson_moskowitz"};
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::type), S::Type>("type", &S::type,
                                          {{"calm", S::Type::calm},
                                           {"regular", S::Type::regular},
                                           {"jonswap", S::Type::jonswap},
                                           {"pierson_moskowitz", S::Type::pierson_moskowitz}},
                                          "Kind of sea.")
        .require();
    t.number("amplitude_m", &S::amplitude, unit::m, not_negative(), "Amplitude, half the wave height.")
        .only_when("type", {"regular"})
        .require();
    t.number("frequency_rad_per_s", &S::frequency, unit::rad_per_s, positive(), "Circular frequency.")
        .only_when("type", {"regular"})
        .require();
    t.number("phase_deg", &S::phase, unit::deg, any_value(), "Lag of the crest at the world's origin at time 0.")
        .only_when("type", {"regular"});
    t.number("significant_height_m", &S::significant_height, unit::m, not_negative(), "Significant wave height Hs.")
        .only_when("type", irregular)
        .require();
    t.number("peak_period_s", &S::peak_period, unit::s, positive(), "Peak period Tp.")
        .only_when("type", irregular)
        .require();
    t.number("gamma", &S::gamma, unit::one, Range{1.0, 10.0, false}, "Peakedness of the JONSWAP spectrum.")
        .only_when("type", {"jonswap"})
        .absent("by the DNV rule from Hs and Tp");
    t.number("heading_deg", &S::heading, unit::deg, Range{-360.0, 360.0, false},
             "Direction the waves travel towards, from +x, counter-clockwise.");
    t.number("spreading", &S::spreading, unit::one, Range{0.0, 100.0, false},
             "Exponent n of the cos^n spreading; 0 is long-crested.")
        .only_when("type", irregular);
    t.integer("components", &S::components, Range{1, 2000, false}, "Number of frequencies.")
        .only_when("type", irregular);
    t.integer("directions", &S::directions, Range{1, 181, false},
              "Number of directions; more than 1 only with spreading.")
        .only_when("type", irregular);
    t.integer("seed", &S::seed, Range{0, 2147483647, false}, "Index that the phases come from.")
        .only_when("type", irregular);
    return t.build();
  }();
  return table;
}

const Table& hull_table() {
  static const Table table = [] {
    using S = HullSpec;
    TableOf<S> t("bodies.hull", "The wetted shape of a body: buoyancy and incident-wave forces.");
    t.choice<decltype(&S::shape), S::Shape>("shape", &S::shape, {{"box", S::Shape::box}, {"mesh", S::Shape::mesh}},
                                            "A box, or a closed mesh from a file.")
        .require();
    t.vector("size_m", &S::size, unit::m, positive(), "Length (x), breadth (y) and depth (z) of the box.")
        .only_when("shape", {"box"})
        .require();
    t.vector("centre_m", &S::centre, unit::m, any_value(), "Centre of the box in the body frame.")
        .only_when("shape", {"box"});
    t.file("mesh_file", &S::mesh_file, "STL, OBJ or GDF file of a closed surface, normals outward.")
        .only_when("shape", {"mesh"})
        .require();
    t.number("mesh_scale", &S::mesh_scale, unit::one, positive(), "Metres per unit of the file.")
        .only_when("shape", {"mesh"});
    t.vector("mesh_origin_m", &S::mesh_origin, unit::m, any_value(), "Position of the file's origin in the body frame.")
        .only_when("shape", {"mesh"});
    Field& attitude = t.numbers(
        "mesh_attitude_deg", {3},
        [](S& s, const std::vector<double>& v) {
          s.mesh_attitude = {v[0], v[1], v[2]};
        },
        unit::deg, Range{-360.0, 360.0, false},
        "Roll, pitch, yaw of the file's axes in the body frame: 180, 0, 0 for a file with z down and y to starboard.");
    attitude.get = [](const void* s) -> std::optional<Value> {
      const RollPitchYaw& a = static_cast<const S*>(s)->mesh_attitude;
      return Value(std::vector<double>{a.roll, a.pitch, a.yaw});
    };
    attitude.only_when("shape", {"mesh"});
    t.boolean("mesh_mend", &S::mesh_mend,
              "Close small holes, turn triangles that face inwards and leave out closed surfaces inside others (tanks, "
              "the inner side of plating), instead of refusing the file; the results say so.")
        .only_when("shape", {"mesh"});
    t.number("mesh_deck_height_m", &S::mesh_deck_height, unit::m, positive(),
             "For a file with the wetted surface alone, open at the still water, as WAMIT's GDF files are: the sides are "
             "drawn straight up from the rim to a deck this far above it.")
        .only_when("shape", {"mesh"})
        .absent("the file has its own deck");
    t.number("panel_length_m", &S::panel_length, unit::m, positive(), "Wanted edge of a panel.").absent("automatic");
    t.choice<decltype(&S::froude_krylov), S::FroudeKrylov>(
        "froude_krylov", &S::froude_krylov,
        {{"pressure", S::FroudeKrylov::pressure}, {"volume", S::FroudeKrylov::volume}},
        "Incident-wave force: pressure integrated over the wetted surface, or weight of the submerged volume.");
    return t.build();
  }();
  return table;
}

void add_viscous_damping(TableOf<HydrodynamicsSpec>& t) {
  using S = HydrodynamicsSpec;
  half(t, "linear_damping_kN_s_per_m", &S::linear_damping, 0, unit::kN_s_per_m,
       "Viscous, linear in velocity: surge, sway, heave.");
  half(t, "linear_angular_damping_kN_m_s_per_rad", &S::linear_damping, 3, unit::kN_m_s_per_rad,
       "Viscous, linear in velocity: roll, pitch, yaw.");
  half(t, "quadratic_damping_kN_s2_per_m2", &S::quadratic_damping, 0, unit::kN_s2_per_m2,
       "Viscous, in velocity times its magnitude: surge, sway, heave.");
  half(t, "quadratic_angular_damping_kN_m_s2_per_rad2", &S::quadratic_damping, 3, unit::kN_m_s2_per_rad2,
       "Viscous, in velocity times its magnitude: roll, pitch, yaw.");
  const std::pair<const char*, int> modes[] = {{"heave", 2}, {"roll", 3}, {"pitch", 4}};
  for (const auto& [mode, index] : modes) {
    const int i = index;
    t.number(
        std::string("critical_fraction_") + mode, [i](S& s) -> double& { return s.critical_fraction[i]; }, unit::one,
        between(0.0, 1.0),
        std::string("Viscous, share of critical damping in ") + mode + " at the initial equilibrium.");
  }
}

const Table& hydrodynamics_table() {
  static const Table table = [] {
    using S = HydrodynamicsSpec;
    TableOf<S> t(
        "bodies.hydrodynamics",
        "Radiation and diffraction of a hull, and viscous damping. About the body's origin, in the heading frame.");
    t.choice<decltype(&S::kind), S::Kind>(
        "kind", &S::kind,
        {{"none", S::Kind::none},
         {"constant", S::Kind::constant},
         {"table", S::Kind::table},
         {"panels", S::Kind::panels},
         {"database", S::Kind::database}},
        "No radiation; constant added mass and damping; a coefficient file of this program; the panel method on the "
        "body's hull; WAMIT (.1 with .3, .hst) or BEMIO (.h5) output.");
    t.choice<decltype(&S::radiation), S::RadiationModel>(
         "radiation", &S::radiation,
         {{"automatic", S::RadiationModel::automatic},
          {"reduced", S::RadiationModel::reduced},
          {"retardation", S::RadiationModel::retardation},
          {"direct", S::RadiationModel::direct}},
         "Radiation in the time domain: a passive state space, convolution with retardation functions, or the panel "
         "method marched along. `automatic` is `retardation` for a table, else `reduced`.")
        .only_when("kind", {"table", "panels", "database"});
    const std::vector<std::string> constant = {"constant"};
    half(t, "added_mass_t", &S::added_mass, 0, unit::t, "Surge, sway, heave.")
        .only_when("kind", constant)
        .one_of("added mass");
    half(t, "added_inertia_t_m2", &S::added_mass, 3, unit::t_m2, "Roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("added inertia");
    t.rows(
         "added_mass_matrix_t_m", 6,
         [](S& s, const std::vector<std::vector<double>>& rows) { s.added_mass = matrix_from(rows); }, unit::t_m,
         "The whole 6 x 6 matrix instead, symmetric, by rows: surge, sway, heave, roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("added mass");
    half(t, "damping_kN_s_per_m", &S::damping, 0, unit::kN_s_per_m, "Surge, sway, heave.")
        .only_when("kind", constant)
        .one_of("damping");
    half(t, "angular_damping_kN_m_s_per_rad", &S::damping, 3, unit::kN_m_s_per_rad, "Roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("angular damping");
    t.rows(
         "damping_matrix_kN_s_m", 6,
         [](S& s, const std::vector<std::vector<double>>& rows) { s.damping = matrix_from(rows); }, unit::kN_s_m,
         "The whole 6 x 6 matrix instead, by rows.")
        .only_when("kind", constant)
        .one_of("damping");
    t.file("coefficient_file", &S::coefficient_file,
           "Added mass at infinite frequency, retardation functions, excitation.")
        .only_when("kind", {"table", "database"})
        .require();
    t.vector("database_origin_m", &S::database_origin, unit::m, any_value(),
             "The body's origin in the frame of the database, whose z = 0 is the still water.")
        .only_when("kind", {"database"});
    t.number("database_length_m", &S::database_length, unit::m, positive(), "WAMIT's ULEN.")
        .only_when("kind", {"database"});
    t.vector("database_xbody_m", &S::database_xbody, unit::m, any_value(),
             "WAMIT's XBODY: the point that the moments of the files are about, in the frame of the database. BEMIO "
             "files name theirs.")
        .only_when("kind", {"database"});
    t.integer("database_body", &S::database_body, Range{1.0, 100.0, false},
              "Which body of a database of several; the waves that the others radiate are left out.")
        .only_when("kind", {"database"})
        .absent("the only one");
    t.number("database_lowest_rad_per_s", &S::database_lowest, unit::rad_per_s, positive(),
             "Lower frequencies of the database are left out: those that feel the bottom, for example.")
        .only_when("kind", {"database"})
        .absent("all are used");
    t.number("database_highest_rad_per_s", &S::database_highest, unit::rad_per_s, positive(),
             "Higher frequencies of the database are left out: those with irregular frequencies, for example.")
        .only_when("kind", {"database"})
        .absent("all are used");
    t.boolean("port_starboard", &S::port_starboard, "The headings 0 to 180 deg of the database are mirrored.")
        .only_when("kind", {"database"});
    t.boolean("axisymmetric", &S::axisymmetric,
              "A body of revolution about the vertical through the point that the moments are about: one heading of the "
              "database stands for all.")
        .only_when("kind", {"database"});
    t.number("panel_length_m", &S::panel_length, unit::m, positive(), "Longest panel of the hull.")
        .only_when("kind", {"panels"})
        .absent("an eighth of the breadth, less in short waves");
    const std::vector<std::string> computed = {"table", "panels", "database"};
    t.number("added_mass_factor", &S::added_mass_factor, unit::one, positive(),
             "On the added mass at infinite frequency: a correction, by a fit or by judgement.")
        .only_when("kind", computed);
    t.number("radiation_factor", &S::radiation_factor, unit::one, not_negative(),
             "On the memory of the radiation, that is on the damping and on what the added mass has above that at "
             "infinite frequency.")
        .only_when("kind", computed);
    t.number("diffraction_factor", &S::diffraction_factor, unit::one, any_value(), "On the diffraction force.")
        .only_when("kind", computed);
    t.text("coupled_with", &S::coupled_with, "Body whose hull and this one feel each other's waves.")
        .only_when("kind", {"panels"})
        .names(Reference::body)
        .absent("none");
    t.text("coupled_until", &S::coupled_until, "Phase with whose start the coupling ends.")
        .only_when("kind", {"panels"})
        .names(Reference::phase)
        .absent("the end");
    add_viscous_damping(t);
    return t.build();
  }();
  return table;
}

}  // namespace

const Table& panel_method_table() {
  static const Table table = [] {
    using S = PanelMethodSpec;
    TableOf<S> t("panel_method", "How coefficients of hulls are computed and what is accepted of them.");
    t.number("lowest_rad_per_s", &S::lowest, unit::rad_per_s, between(0.05, 2.0), "Lowest frequency.");
    t.number("highest_rad_per_s", &S::highest, unit::rad_per_s, between(0.3, 5.0), "Highest frequency.");
    t.integer("frequencies", &S::frequencies, between(20.0, 200.0), "How many are computed, evenly in the logarithm.");
    t.integer("headings", &S::headings, between(4.0, 360.0), "Wave directions around the circle.")
        .absent("as many as the shortest waves need");
    t.number("refinement", &S::refinement, unit::one, between(0.25, 4.0), "Every panel is divided by this.");
    t.number("direct_step_s", &S::direct_step, unit::s, positive(), "Time step of radiation = \"direct\".");
    t.number("direct_lowest_rad_per_s", &S::direct_lowest, unit::rad_per_s, between(0.1, 3.0),
             "Longest wave that the water surface of radiation = \"direct\" is made for.");
    t.number("direct_highest_rad_per_s", &S::direct_highest, unit::rad_per_s, between(0.2, 4.0),
             "Shortest wave that it is made for.");
    t.number("fit_tolerance", &S::fit_tolerance, unit::one, between(0.001, 0.2),
             "Of radiation = \"reduced\": rms error of each entry over the band.");
    t.text("accept_failed_checks", &S::accepted_checks,
           "Self-checks of coefficients that may fail, by name, with commas in between.")
        .absent("none");
    t.choice<decltype(&S::beyond), S::Beyond>(
        "beyond", &S::beyond, {{"limit", S::Beyond::limit}, {"cut", S::Beyond::cut}, {"refuse", S::Beyond::refuse}},
        "Waves shorter than those of the coefficients: diffracted as in the limit of short waves, acting without "
        "diffraction (the report says how much of the sea), or refused when they hold more than 1 % of its energy.");
    t.number("memory_gb", &S::memory, unit::one, positive(),
             "Most memory that a panel computation may take; a hull that needs more is refused before it begins.");
    return t.build();
  }();
  return table;
}

const Table& sea_table() {
  static const Table table = [] {
    using S = SeaSpec;
    TableOf<S> t("sea", "The water, and the seas the lift can meet.");
    t.text("active", &S::active, "The sea state of a single run, or `calm`.").names(Reference::sea_state).absent("calm water");
    t.number("ramp_s", &S::ramp, unit::s, not_negative(), "The waves grow smoothly from nothing over this time.");
    t.number("density_kg_per_m3", &S::density, unit::kg_per_m3, positive(), "Density of the water.");
    t.number("gravity_m_per_s2", &S::gravity, unit::m_per_s2, positive(), "Acceleration of gravity.");
    t.number("depth_m", &S::depth, unit::m, positive(), "Water depth, for moorings; waves are deep-water waves, and a warning says where they would feel the bottom.")
        .absent("deep");
    t.tables("states", &S::states, "name", &sea_state_table, "Sea states.");
    return t.build();
  }();
  return table;
}

const Table& body_table() {
  static const Table table = [] {
    using S = BodySpec;
    TableOf<S> t("bodies", "A rigid body. Body frame: x forward, y port, z up; its origin is yours to choose.");
    t.name("name", &S::name, "Name; `world` is the fixed body.");
    t.number("mass_t", &S::mass, unit::t, positive(), "Mass.").require();
    t.vector("cog_m", &S::cog, unit::m, any_value(), "Centre of gravity in the body frame.");
    t.numbers(
         "gyration_m", {3},
         [](S& s, const std::vector<double>& k) {
           s.inertia = s.mass * Vector3(k[0] * k[0], k[1] * k[1], k[2] * k[2]).asDiagonal().toDenseMatrix();
         },
         unit::m, positive(), "Radii of gyration about the centre of gravity, axes of the body frame.")
        .one_of("inertia", true);
    t.numbers(
         "inertia_t_m2", {3, 6}, [](S& s, const std::vector<double>& v) { s.inertia = inertia_from(v); }, unit::t_m2,
         any_value(), "Ixx, Iyy, Izz, or also Ixy, Ixz, Iyz (tensor entries), about the centre of gravity.")
        .one_of("inertia", true);
    t.vector("position_m", &S::position, unit::m, any_value(), "Position of the body's origin at the start.");
    Field& attitude = t.numbers(
        "attitude_deg", {3},
        [](S& s, const std::vector<double>& v) {
          s.attitude = {v[0], v[1], v[2]};
        },
        unit::deg, Range{-360.0, 360.0, false}, "Roll, pitch, yaw at the start (ZYX; pitch + is bow down).");
    attitude.get = [](const void* s) -> std::optional<Value> {
      const RollPitchYaw& a = static_cast<const S*>(s)->attitude;
      return Value(std::vector<double>{a.roll, a.pitch, a.yaw});
    };
    t.vector(
        "velocity_m_per_s", &S::velocity, unit::m_per_s, any_value(),
        "Velocity of the origin at the start, world axes; of a static start too, whose pose is then the equilibrium.");
    t.vector("angular_velocity_deg_per_s", &S::angular_velocity, unit::deg_per_s, any_value(),
             "Angular velocity at the start, body axes; of a static start too.");
    t.table("hull", &S::hull, &hull_table, "Wetted shape.").absent("dry");
    t.table("hydrodynamics", &S::hydrodynamics, &hydrodynamics_table, "Radiation and damping.").absent("none");
    return t.build();
  }();
  return table;
}

const Table& joint_table() {
  static const Table table = [] {
    using S = JointSpec;
    TableOf<S> t("joints", "A joint between two bodies. Its coordinate is 0 in the initial pose.");
    const std::vector<std::string> turning = {"revolute"}, sliding = {"prismatic"}, moving = {"revolute", "prismatic"};
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::type), S::Type>("type", &S::type,
                                          {{"revolute", S::Type::revolute},
                                           {"fixed", S::Type::fixed},
                                           {"spherical", S::Type::spherical},
                                           {"prismatic", S::Type::prismatic}},
                                          "Kind of joint.")
        .require();
    t.text("parent", &S::parent, "Body, or `world`.").names(Reference::body_or_world).require();
    t.text("child", &S::child, "Body.").names(Reference::body).require();
    t.vector("point_on_parent_m", &S::point_on_parent, unit::m, any_value(), "The joint in the parent's frame.");
    t.vector("point_on_child_m", &S::point_on_child, unit::m, any_value(), "The joint in the child's frame.");
    t.vector("axis", &S::axis, unit::one, any_value(),
             "Axis of turning or sliding in the parent's frame; any length but 0.")
        .only_when("type", moving);
    t.number("angular_stiffness_kN_m_per_rad", &S::stiffness, unit::kN_m_per_rad, not_negative(),
             "Spring about the axis.")
        .only_when("type", turning);
    t.number("angular_damping_kN_m_s_per_rad", &S::damping, unit::kN_m_s_per_rad, not_negative(),
             "Damper about the axis.")
        .only_when("type", turning);
    t.number("rest_deg", &S::rest, unit::deg, any_value(), "Angle at which the spring is at rest.")
        .only_when("type", turning);
    t.number("stiffness_kN_per_m", &S::stiffness, unit::kN_per_m, not_negative(), "Spring along the axis.")
        .only_when("type", sliding);
    t.number("damping_kN_s_per_m", &S::damping, unit::kN_s_per_m, not_negative(), "Damper along the axis.")
        .only_when("type", sliding);
    t.number("rest_m", &S::rest, unit::m, any_value(), "Slide at which the spring is at rest.")
        .only_when("type", sliding);
    t.text("drive", &S::drive, "Drive that moves the spring's rest position.")
        .only_when("type", moving)
        .names(Reference::drive)
        .absent("not driven");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
