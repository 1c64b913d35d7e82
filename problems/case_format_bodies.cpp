// Field tables of the bodies with their hulls, and of the joints.
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
    t.boolean("mesh_mirror", &S::mesh_mirror,
              "The file has one side of the hull alone, as files for panel codes often have: it is mirrored at the plane "
              "y = 0 of the file.")
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

}  // namespace

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
