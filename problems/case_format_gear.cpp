// Field tables of the lifting gear: drives, wires, taglines, moorings, contacts, ballast.
#include "problems/case_format.h"

namespace stillhook {

const Table& drive_table() {
  static const Table table = [] {
    using S = DriveSpec;
    TableOf<S> t("drives", "Anything that moves by command; its position is 0 at the start.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::kind), S::Kind>(
         "kind", &S::kind,
         {{"winch", S::Kind::winch}, {"ballast", S::Kind::ballast}, {"tow", S::Kind::tow}, {"joint", S::Kind::joint}},
         "winch: metres hauled in (+ shortens); ballast: share moved, 0 to 1; tow: metres; "
         "joint: angle or metres.")
        .require();
    const std::vector<std::string> metres = {"winch", "tow", "joint"};
    t.number("speed_max_m_per_min", &S::speed_max, unit::m_per_min, positive(), "Largest speed.")
        .only_when("kind", metres)
        .one_of("speed limit")
        .absent("unlimited");
    t.number("speed_max_m_per_s", &S::speed_max, unit::m_per_s, positive(), "The same in m/s.")
        .only_when("kind", metres)
        .one_of("speed limit")
        .absent("unlimited");
    t.number("speed_max_deg_per_s", &S::speed_max, unit::deg_per_s, positive(), "The same of a turning joint.")
        .only_when("kind", {"joint"})
        .one_of("speed limit")
        .absent("unlimited");
    t.number("speed_max_share_per_min", &S::speed_max, unit::share_per_min, positive(), "The same of ballast.")
        .only_when("kind", {"ballast"})
        .one_of("speed limit")
        .absent("unlimited");
    t.number("acceleration_max_m_per_s2", &S::acceleration_max, unit::m_per_s2, positive(), "Largest acceleration.")
        .only_when("kind", metres)
        .one_of("acceleration limit")
        .absent("unlimited");
    t.number("acceleration_max_deg_per_s2", &S::acceleration_max, unit::deg_per_s2, positive(),
             "The same of a turning joint.")
        .only_when("kind", {"joint"})
        .one_of("acceleration limit")
        .absent("unlimited");
    t.number("acceleration_max_share_per_s2", &S::acceleration_max, unit::share_per_s2, positive(),
             "The same of ballast.")
        .only_when("kind", {"ballast"})
        .one_of("acceleration limit")
        .absent("unlimited");
    return t.build();
  }();
  return table;
}

const Table& wire_table() {
  static const Table table = [] {
    using S = WireSpec;
    TableOf<S> t("wires", "A wire between two bodies: pulls, never pushes.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::role), S::Role>("role", &S::role,
                                          {{"other", S::Role::other},
                                           {"hoist", S::Role::hoist},
                                           {"luffing", S::Role::luffing},
                                           {"stay", S::Role::stay},
                                           {"sling", S::Role::sling}},
                                          "What it is for; hook load, DAF and off-lead are those of the hoist wires.");
    t.text("from", &S::from, "Body of the upper end or the sheave, or `world`.")
        .names(Reference::body_or_world)
        .require();
    t.text("to", &S::to, "Body of the other end, or `world`.").names(Reference::body_or_world).require();
    t.vector("point_from_m", &S::point_from, unit::m, any_value(), "Upper end in the frame of `from`.");
    t.vector("point_to_m", &S::point_to, unit::m, any_value(), "Other end in the frame of `to`.");
    t.number("axial_stiffness_kN", &S::axial_stiffness, unit::kN, positive(), "EA, all falls together.").require();
    t.number("damping_ratio", &S::damping_ratio, unit::one, between(0.0, 1.0),
             "Damping as a share of critical, of damping_mass_t on the initial stiffness EA/L.")
        .one_of("damping");
    t.number("damping_mass_t", &S::damping_mass, unit::t, positive(), "The mass that damping_ratio means.")
        .absent("none; needed with damping_ratio");
    t.number("damping_kN_s_per_m", &S::damping, unit::kN_s_per_m, not_negative(), "Damping, instead of damping_ratio.")
        .one_of("damping");
    t.number("unstretched_length_m", &S::unstretched_length, unit::m, positive(), "Length without load at the start.")
        .one_of("length", true);
    t.number("slack_m", &S::slack, unit::m, any_value(),
             "Unstretched length less the distance of the ends at the start; negative: pre-tensioned. Where something "
             "would fall without the wire, the distance is that of the given pose; else that of the pose in which "
             "everything else is in balance.")
        .one_of("length", true);
    t.text("hold_joint", &S::hold_joint,
           "Length such that this joint keeps its initial coordinate in the initial static equilibrium.")
        .names(Reference::joint)
        .one_of("length", true);
    t.text("winch", &S::winch, "Drive that hauls it in.").names(Reference::drive).absent("fixed length");
    t.number("tension_max_kN", &S::tension_max, unit::kN, positive(), "Limit of the winch; checked, not enforced.")
        .absent("none");
    t.number("breaking_load_kN", &S::breaking_load, unit::kN, positive(), "Minimum breaking load.").absent("not given");
    return t.build();
  }();
  return table;
}

const Table& gain_point_table() {
  static const Table table = [] {
    using S = GainPointSpec;
    TableOf<S> t("taglines.gain_schedule", "Factors on the gains at one length of the hoist wire.");
    t.name("name", &S::name, "Name.");
    t.number("fall_m", &S::fall, unit::m, positive(),
             "Length of the hoist wire. Linear between the entries, constant outside; in rising order.")
        .require();
    t.number("kp_factor", &S::kp_factor, unit::one, not_negative(), "Factor on kp.");
    t.number("kd_factor", &S::kd_factor, unit::one, not_negative(), "Factor on kd.");
    return t.build();
  }();
  return table;
}

const Table& tagline_table() {
  static const Table table = [] {
    using S = TaglineSpec;
    TableOf<S> t("taglines",
                 "A line on a winch that pulls, by a PD law on the angle of a hoist wire, to keep the load still.");
    t.name("name", &S::name, "Name.");
    t.text("from", &S::from, "Body that carries the winch, or `world`.").names(Reference::body_or_world).require();
    t.text("to", &S::to, "Body that it controls.").names(Reference::body).require();
    t.vector("point_from_m", &S::point_from, unit::m, any_value(), "Winch in the frame of `from`.");
    t.vector("point_to_m", &S::point_to, unit::m, any_value(), "Eye in the frame of `to`.");
    t.text("wire", &S::wire, "Hoist wire whose angle is controlled.").names(Reference::wire).require();
    t.number("kp_kN_per_deg", &S::kp, unit::kN_per_deg, not_negative(), "Proportional gain.").require();
    t.number("kd_kN_s_per_deg", &S::kd, unit::kN_s_per_deg, not_negative(), "Derivative gain.").require();
    t.tables("gain_schedule", &S::gain_schedule, "name", &gain_point_table,
             "Factors on both gains over the length of the hoist wire.")
        .absent("the same gains throughout");
    t.number("set_point_deg", &S::set_point, unit::deg, Range{-90.0, 90.0, false},
             "Wanted angle of the hoist wire, positive away from the winch.");
    t.number("pretension_kN", &S::pretension, unit::kN, not_negative(), "Pull when there is nothing to correct.");
    t.number("tension_max_kN", &S::tension_max, unit::kN, positive(), "Largest pull of the winch.").require();
    t.number("speed_max_m_per_min", &S::speed_max, unit::m_per_min, positive(), "Largest line speed of the winch.")
        .absent("unlimited");
    t.number("time_constant_s", &S::time_constant, unit::s, not_negative(), "First-order lag of the winch.");
    t.number("axial_stiffness_kN", &S::axial_stiffness, unit::kN, positive(), "EA of the line.");
    t.boolean("active", &S::active, "Whether it is rigged.");
    t.text("active_from", &S::active_from, "Phase with which it is connected.")
        .names(Reference::phase)
        .absent("always");
    return t.build();
  }();
  return table;
}

const Table& mooring_table() {
  static const Table table = [] {
    using S = MooringSpec;
    TableOf<S> t("moorings", "A line that keeps a body in place: a catenary to the sea bed, or a linear spring.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::type), S::Type>(
         "type", &S::type, {{"catenary", S::Type::catenary}, {"linear", S::Type::linear}}, "Kind of line.")
        .require();
    t.text("body", &S::body, "Body that it holds.").names(Reference::body).require();
    t.vector("fairlead_m", &S::fairlead, unit::m, any_value(), "Fairlead in the body frame.").require();
    t.number("azimuth_deg", &S::azimuth, unit::deg, Range{-360.0, 360.0, false},
             "Direction from the fairlead to the anchor at the start, from +x, counter-clockwise; the anchor then lies "
             "where the line has its pretension.")
        .one_of("anchor", true);
    Field& anchor = t.numbers(
        "anchor_m", {3}, [](S& s, const std::vector<double>& v) { s.anchor = Vector3(v[0], v[1], v[2]); }, unit::m,
        any_value(),
        "Where the far end is instead, in the world: x, y and z above the still water. On the sea bed (z = -depth_m) the "
        "line may lie beside it, from any other height it hangs free.");
    anchor.one_of("anchor", true);
    t.number("pretension_kN", &S::pretension, unit::kN, not_negative(),
             "Horizontal tension at the start. Of a catenary with anchor_m it follows from length_m and is left out.")
        .absent("needed but for a catenary with anchor_m");
    t.number("stiffness_kN_per_m", &S::stiffness, unit::kN_per_m, positive(), "Stiffness.")
        .only_when("type", {"linear"})
        .require();
    t.number("anchor_distance_m", &S::anchor_distance, unit::m, positive(),
             "Horizontal distance to the far end; with anchor_m it is left out.")
        .only_when("type", {"linear"})
        .absent("needed with azimuth_deg");
    t.number("length_m", &S::length, unit::m, positive(), "Unstretched length.")
        .only_when("type", {"catenary"})
        .require();
    t.number("weight_N_per_m", &S::weight, unit::N_per_m, any_value(),
             "Weight in water; below 0 the line is buoyant and rises from its anchor.")
        .only_when("type", {"catenary"})
        .require();
    t.number("axial_stiffness_kN", &S::axial_stiffness, unit::kN, positive(), "EA.")
        .only_when("type", {"catenary"})
        .require();
    t.number("seabed_friction", &S::seabed_friction, unit::one, not_negative(), "Friction coefficient on the sea bed.")
        .only_when("type", {"catenary"});
    t.text("tow", &S::tow, "Drive that moves the far end.").names(Reference::drive).absent("fixed");
    t.vector("tow_direction", &S::tow_direction, unit::one, any_value(),
             "Direction of that motion in the world; any length but 0.");
    return t.build();
  }();
  return table;
}

const Table& contact_table() {
  static const Table table = [] {
    using S = ContactSpec;
    TableOf<S> t("contacts", "Points of one body against a horizontal rectangle on another.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::role), S::Role>(
        "role", &S::role, {{"other", S::Role::other}, {"pickup", S::Role::pickup}, {"target", S::Role::target}},
        "pickup: the load leaves it and re-hits are counted; target: set-down is measured on it.");
    t.text("body", &S::body, "Body that carries the points.").names(Reference::body).require();
    t.rows(
         "points_m", 3,
         [](S& s, const std::vector<std::vector<double>>& rows) {
           s.points.clear();
           for (const auto& p : rows) s.points.emplace_back(p[0], p[1], p[2]);
         },
         unit::m, "Points in the body frame.")
        .require();
    t.text("surface_body", &S::surface_body, "Body that carries the rectangle, or `world`.")
        .names(Reference::body_or_world)
        .require();
    t.vector("surface_centre_m", &S::surface_centre, unit::m, any_value(),
             "Centre of the rectangle in that body's frame.")
        .require();
    t.number("surface_length_m", &S::surface_length, unit::m, positive(), "Extent along x.").require();
    t.number("surface_breadth_m", &S::surface_breadth, unit::m, positive(), "Extent along y.").require();
    t.number("stiffness_kN_per_m", &S::stiffness, unit::kN_per_m, positive(), "Stiffness, all points together.")
        .require();
    t.number("damping_kN_s_per_m", &S::damping, unit::kN_s_per_m, not_negative(), "Damping, all points together.");
    t.number("damping_depth_m", &S::damping_depth, unit::m, positive(),
             "Penetration over which the damping grows to its full value.");
    t.number("friction", &S::friction, unit::one, between(0.0, 2.0), "Coefficient of friction.");
    t.text("active_from", &S::active_from, "Phase with which it begins to act.")
        .names(Reference::phase)
        .absent("always");
    return t.build();
  }();
  return table;
}

const Table& ballast_table() {
  static const Table table = [] {
    using S = BallastSpec;
    TableOf<S> t("ballast", "Water moved from one tank to another. Its weight counts, its inertia does not.");
    t.name("name", &S::name, "Name.");
    t.text("body", &S::body, "Body with the tanks.").names(Reference::body).require();
    t.number("mass_t", &S::mass, unit::t, not_negative(), "Mass moved when the drive stands at 1.").require();
    t.vector("from_m", &S::from, unit::m, any_value(), "Centre of the tank it leaves.").require();
    t.vector("to_m", &S::to, unit::m, any_value(), "Centre of the tank it goes to.").require();
    t.text("drive", &S::drive, "Drive that moves it.").names(Reference::drive).require();
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
