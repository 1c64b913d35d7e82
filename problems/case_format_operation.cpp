// Field tables of the operation, poses, clearances and solver; and of the whole document.
#include "problems/case_format.h"

namespace stillhook {
namespace {

/// The keys of a measured coordinate and the value wanted of it, in a struct that holds both.
template <class S, class C, class V>
void add_goal_keys(TableOf<S>& t, C coordinate, V value) {
  const auto member = [coordinate](auto pointer) {
    return [ coordinate, pointer ](S & s) -> auto& { return coordinate(s).*pointer; };
  };
  t.text("body", member(&CoordinateSpec::body), "A point of this body ...")
      .names(Reference::body)
      .one_of("measured thing", true);
  t.text("joint", member(&CoordinateSpec::joint),
         "... or the coordinate of this joint, relative to the initial pose ...")
      .names(Reference::joint)
      .one_of("measured thing", true);
  t.text("wire", member(&CoordinateSpec::wire), "... or the tension of this wire.")
      .names(Reference::wire)
      .one_of("measured thing", true);
  t.vector("point_m", member(&CoordinateSpec::point), unit::m, any_value(), "The point in the body frame.");
  t.template choice<decltype(member(&CoordinateSpec::axis)), int>(
      "axis", member(&CoordinateSpec::axis), {{"x", 0}, {"y", 1}, {"z", 2}}, "The component that counts.");
  t.text("relative_to", member(&CoordinateSpec::relative_to), "Body whose frame is used instead of the world's.")
      .names(Reference::body)
      .absent("the world");
  t.number("value_m", value, unit::m, any_value(), "Wanted position, or slide of a prismatic joint.")
      .one_of("value", true);
  t.number("value_deg", value, unit::deg, any_value(), "Wanted angle of a revolute joint.").one_of("value", true);
  t.number("value_kN", value, unit::kN, not_negative(), "Wanted tension of a wire.").one_of("value", true);
}

const Table& move_goal_table() {
  static const Table table = [] {
    TableOf<MoveSpec> t("operation.phases.moves.goal",
                        "What the move must reach, in static equilibrium at the end of its phase.");
    add_goal_keys(
        t, [](MoveSpec& m) -> CoordinateSpec& { return m.goal ? *m.goal : m.goal.emplace(); }, &MoveSpec::goal_value);
    return t.build();
  }();
  return table;
}

const Table& move_table() {
  static const Table table = [] {
    using S = MoveSpec;
    TableOf<S> t("operation.phases.moves",
                 "One drive moving from rest to rest: a travel, or the travel that reaches a goal.");
    t.text("drive", &S::drive, "Drive.").names(Reference::drive).require();
    t.number("speed_m_per_min", &S::speed, unit::m_per_min, positive(), "Peak speed, without sign.")
        .one_of("speed", true);
    t.number("speed_m_per_s", &S::speed, unit::m_per_s, positive(), "The same in m/s.").one_of("speed", true);
    t.number("speed_deg_per_s", &S::speed, unit::deg_per_s, positive(), "The same of a turning joint.")
        .one_of("speed", true);
    t.number("speed_share_per_min", &S::speed, unit::share_per_min, positive(), "The same of ballast.")
        .one_of("speed", true);
    t.number("travel_m", &S::travel, unit::m, any_value(), "Travel with sign; a winch hauls in with +.")
        .one_of("travel", true);
    t.number("travel_deg", &S::travel, unit::deg, any_value(), "The same of a turning joint.").one_of("travel", true);
    t.number("travel_share", &S::travel, unit::share, between(-1.0, 1.0), "The same of ballast.")
        .one_of("travel", true);
    t.table(
         "goal", [](S& s) -> S& { return s; }, &move_goal_table, "What to reach instead of a travel.")
        .one_of("travel", true);
    t.choice<decltype([](S& s) -> ProfileSpec::Shape& { return s.profile.shape; }), ProfileSpec::Shape>(
        "profile", {},
        {{"trapezoid", ProfileSpec::Shape::trapezoid},
         {"s_curve", ProfileSpec::Shape::s_curve},
         {"knots", ProfileSpec::Shape::knots}},
        "Speed over time: linear ramps, sin^2 ramps, or through knots.");
    t.number(
        "ramp_s", [](S& s) -> double& { return s.profile.ramp; }, unit::s, positive(),
        "From rest to full speed, and back.");
    t.numbers(
         "knots", {}, [](S& s, const std::vector<double>& v) { s.profile.knots = v; }, unit::one, between(0.0, 1e3),
         "Relative speeds at equal times between the two zeros.")
        .only_when("profile", {"knots"})
        .require();
    using Shaper = ProfileSpec::Shaper;
    t.choice<decltype([](S& s) -> Shaper& { return s.profile.shaper; }), Shaper>(
        "shaper", {}, {{"none", Shaper::none}, {"zv", Shaper::zv}, {"zvd", Shaper::zvd}},
        "Shapes the speed so that no swing is left: zv takes half a period more, zvd a whole one and bears a wrong "
        "period better.");
    t.number(
         "shaper_period_s", [](S& s) -> double& { return s.profile.shaper_period; }, unit::s, not_negative(),
         "Natural period of the swing; 0 = of the load as it hangs, along the move, the mean of before and after it.")
        .only_when("shaper", {"zv", "zvd"});
    t.number(
         "shaper_damping", [](S& s) -> double& { return s.profile.shaper_damping; }, unit::one, between(0.0, 0.9),
         "Damping ratio of the swing.")
        .only_when("shaper", {"zv", "zvd"});
    t.number("delay_s", &S::delay, unit::s, not_negative(), "After the start of the phase.");
    t.boolean("background", &S::background, "The phase may end before this move does.");
    return t.build();
  }();
  return table;
}

const Table& event_table() {
  static const Table table = [] {
    using S = EventSpec;
    TableOf<S> t("operation.phases.wait_for", "An event that a phase waits for before it starts.");
    t.choice<decltype(&S::type), EventSpec::Type>("event", &S::type,
                                                  {{"clear_of_contact", EventSpec::Type::clear_of_contact}},
                                                  "clear_of_contact: no force in a contact for a time.")
        .require();
    t.text("contact", &S::contact, "The contact.").names(Reference::contact).require();
    t.number("hold_s", &S::hold, unit::s, not_negative(), "How long it must last.");
    t.number("timeout_s", &S::timeout, unit::s, positive(), "Go on after this, with a note in the result.");
    return t.build();
  }();
  return table;
}

const Table& phase_table() {
  static const Table table = [] {
    using S = PhaseSpec;
    TableOf<S> t("operation.phases",
                 "A named part of the operation. It lasts as long as its moves, and at least `duration_s`.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::stage), S::Stage>("stage", &S::stage,
                                            {{"on_barge", S::Stage::on_barge},
                                             {"transfer", S::Stage::transfer},
                                             {"hanging", S::Stage::hanging},
                                             {"set_down", S::Stage::set_down},
                                             {"landed", S::Stage::landed}},
                                            "Where the load is; decides which metrics look at the phase.");
    t.number("duration_s", &S::duration, unit::s, not_negative(), "At least this long.");
    t.table("wait_for", &S::wait_for, &event_table, "Event before the start.").absent("starts at once");
    t.tables("moves", &S::moves, "drive", &move_table, "Moves, at most one of each drive.").absent("none");
    return t.build();
  }();
  return table;
}

const Table& pose_drive_table() {
  static const Table table = [] {
    using S = PoseSpec::DriveSetting;
    TableOf<S> t("poses.drives", "A drive at a position.");
    t.text("drive", &S::drive, "Drive.").names(Reference::drive).require();
    t.number("position_m", &S::position, unit::m, any_value(), "Position; a winch hauls in with +.")
        .one_of("position", true);
    t.number("position_deg", &S::position, unit::deg, any_value(), "The same of a turning joint.")
        .one_of("position", true);
    t.number("position_share", &S::position, unit::share, between(0.0, 1.0), "The same of ballast.")
        .one_of("position", true);
    return t.build();
  }();
  return table;
}

const Table& pose_hold_table() {
  static const Table table = [] {
    using S = PoseSpec::Hold;
    TableOf<S> t("poses.holds", "A joint held at a coordinate by a drive.");
    t.text("joint", &S::joint, "Joint.").names(Reference::joint).require();
    t.number("angle_deg", &S::coordinate, unit::deg, any_value(), "Angle relative to the initial pose.")
        .one_of("coordinate", true);
    t.number("slide_m", &S::coordinate, unit::m, any_value(), "Slide of a prismatic joint.").one_of("coordinate", true);
    t.text("drive", &S::drive, "Drive that holds it.").names(Reference::drive).require();
    return t.build();
  }();
  return table;
}

const Table& pose_goal_table() {
  static const Table table = [] {
    using S = PoseSpec::Goal;
    TableOf<S> t("poses.goals", "A coordinate brought to a value by a drive.");
    add_goal_keys(
        t, [](S& s) -> CoordinateSpec& { return s.coordinate; }, &S::value);
    t.text("drive", &S::drive, "Drive that reaches it.").names(Reference::drive).require();
    return t.build();
  }();
  return table;
}

const Table& clearance_shape_table() {
  static const Table table = [] {
    using S = ClearanceSpec::Shape;
    TableOf<S> t("clearances.shape", "A box by opposite corners, or a capsule about an axis.");
    t.text("body", &S::body, "Body, or `world`.").names(Reference::body_or_world).require();
    t.vector("from_m", &S::from, unit::m, any_value(), "A corner, or the start of the axis, in the body frame.")
        .require();
    t.vector("to_m", &S::to, unit::m, any_value(), "The opposite corner, or the end of the axis.").require();
    t.number("radius_m", &S::radius, unit::m, positive(), "Radius of a capsule.").absent("a box");
    return t.build();
  }();
  return table;
}

}  // namespace

const Table& operation_table() {
  static const Table table = [] {
    using S = OperationSpec;
    TableOf<S> t("operation", "What is done: phases in sequence.");
    t.text("load", &S::load, "The lifted body.").names(Reference::body).absent("none");
    t.text("crane", &S::crane,
           "The crane vessel, or a body that stands on one: heel and trim are those of the vessel under it. Not needed "
           "where "
           "the joints under the hoist wires lead to the vessel.")
        .names(Reference::body)
        .absent("none");
    t.vector("target_m", &S::target, unit::m, any_value(),
             "Where the load's reference point should end, in the world.");
    t.vector("load_reference_m", &S::load_reference, unit::m, any_value(), "That point in the load's frame.");
    t.tables("phases", &S::phases, "name", &phase_table, "Phases, in order.");
    return t.build();
  }();
  return table;
}

const Table& pose_table() {
  static const Table table = [] {
    using S = PoseSpec;
    TableOf<S> t("poses",
                 "A static pose to report: drives set, joints held, goals reached, all from the initial state.");
    t.name("name", &S::name, "Name.");
    t.tables("drives", &S::drives, "drive", &pose_drive_table, "Drives at positions.").absent("none");
    t.tables("holds", &S::holds, "joint", &pose_hold_table, "Joints held.").absent("none");
    t.tables("goals", &S::goals, "drive", &pose_goal_table, "Coordinates reached.").absent("none");
    return t.build();
  }();
  return table;
}

const Table& clearance_table() {
  static const Table table = [] {
    using S = ClearanceSpec;
    TableOf<S> t("clearances", "Two shapes whose distance is reported as `clearance_min.<name>`.");
    t.name("name", &S::name, "Name.");
    t.table("a", &S::a, &clearance_shape_table, "One shape.").require();
    t.table("b", &S::b, &clearance_shape_table, "The other.").require();
    return t.build();
  }();
  return table;
}

const Table& solver_table() {
  static const Table table = [] {
    using S = SolverSpec;
    TableOf<S> t("solver", "Time stepping: HHT-alpha on the index-3 equations.");
    t.number("time_step_s", &S::time_step, unit::s, positive(), "Time step.");
    t.number("hht_alpha", &S::hht_alpha, unit::one, between(-1.0 / 3.0, 0.0),
             "Numerical damping; below 0 with joints, whose multipliers would ring at 0.");
    t.number("newton_tolerance", &S::newton_tolerance, unit::one, Range{0.0, 1e-2, true},
             "Relative tolerance of Newton's method.");
    t.number("output_interval_s", &S::output_interval, unit::s, positive(), "Interval of the recorded history.");
    t.number("max_duration_s", &S::max_duration, unit::s, positive(), "End of the run.")
        .absent("when the operation ends");
    t.boolean("static_start", &S::static_start,
              "Start from static equilibrium instead of the given poses and velocities.");
    return t.build();
  }();
  return table;
}

const Table& case_table() {
  static const Table table = [] {
    using S = Case;
    TableOf<S> t("", "A case: one lift, its limits, and the plan to search for.");
    const auto spec = [](auto member) {
      return [member](S & s) -> auto& { return s.specification.*member; };
    };
    t.name("name", &S::name, "Name of the case; run folders are named after it.");
    t.text("title", &S::title, "A line for reports.").absent("the name");
    t.text("project", &S::project, "Project, for the head of reports.").absent("not given");
    t.text("revision", &S::revision, "Revision of the document, for the head of reports.").absent("not given");
    t.text("author", &S::author, "Who made it, for the head of reports.").absent("not given");
    t.text("checked_by", &S::checked_by, "Who checked it, for the head of reports.").absent("not given");
    t.number("north_deg", &S::north, unit::deg, Range{-360.0, 360.0, false},
             "Where true north lies, counter-clockwise from +x: an arrow in the replay and compass directions of waves "
             "in reports. It changes no result.")
        .absent("not known");
    t.table("sea", spec(&Specification::sea), &sea_table, "The water and its waves.").absent("calm, deep sea water");
    t.table("wind", spec(&Specification::wind), &wind_table, "The wind.").absent("none");
    t.tables("bodies", spec(&Specification::bodies), "name", &body_table, "Rigid bodies.").require();
    t.table("panel_method", spec(&Specification::panel_method), &panel_method_table, "Coefficients of hulls.")
        .absent("defaults");
    t.tables("joints", spec(&Specification::joints), "name", &joint_table, "Joints.").absent("none");
    t.tables("drives", spec(&Specification::drives), "name", &drive_table, "Drives.").absent("none");
    for_each_element_kind([&](const auto& kind) {
      using Entry = typename std::remove_cvref_t<decltype(kind)>::Spec;
      t.tables(kind.section, spec(kind.entries), "name", &element_table<Entry>, std::string(kind.title) + ".")
          .absent("none");
    });
    t.tables("rigging", &S::rigging, "name", &rigging_table, "Hook blocks with slings.").absent("none");
    t.table("operation", spec(&Specification::operation), &operation_table, "The operation.").require();
    t.tables("poses", spec(&Specification::poses), "name", &pose_table, "Poses to report.").absent("none");
    t.tables("clearances", spec(&Specification::clearances), "name", &clearance_table, "Clearances to report.")
        .absent("none");
    t.tables("crane_curves", spec(&Specification::crane_curves), "name", &crane_curve_table,
             "What the cranes may lift over their radius.")
        .absent("none");
    t.map("limits", &S::limits, &LimitSpec::metric, &limit_table, "Limits, by metric.").absent("none");
    t.table("solver", spec(&Specification::solver), &solver_table, "Time stepping.").absent("defaults");
    t.table("plan", &S::plan, &plan_table, "The search.").absent("no search");
    t.table("tune", &S::tune, &tune_table, "Tuning of tagline gains.").absent("as by default");
    t.table("fit", &S::fit, &fit_table, "What is estimated from measured runs.").absent("nothing");
    t.table("operability", &S::operability, &operability_table, "In which sea the lift may be done.").absent("nothing");
    t.table("weather", &S::weather, &weather_table, "In which weather the lift may be done.").absent("nothing");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
