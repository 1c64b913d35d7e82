#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"
#include "problems/entry_check.h"
#include "sim/drive_unit.h"

namespace stillhook {
namespace {

class LiftCheck {
 public:
  LiftCheck(const Case& c, const Node& root, Findings& findings)
      : spec_(c.specification), root_(root), findings_(findings) {}

  void run() {
    for (const BodySpec& body : spec_.bodies) check_body(body);
    for (const JointSpec& joint : spec_.joints) check_joint(joint);
    for_each_element_kind([&](const auto& kind) {
      for (const auto& entry : spec_.*kind.entries) {
        EntryCheck check(spec_, root_, findings_, std::string(kind.section) + "." + entry.name);
        check_entry(entry, check);
      }
    });
    for (const DriveSpec& drive : spec_.drives) check_used(drive);
    for (const SeaStateSpec& state : spec_.sea.states) check_sea(state);
    for (const PhaseSpec& phase : spec_.operation.phases) check_phase(phase);
    for (const PoseSpec& pose : spec_.poses) check_pose(pose);
    for (const ClearanceSpec& clearance : spec_.clearances)
      if (clearance.a.body == clearance.b.body)
        report("clearances." + clearance.name, "b.body", "is the same body as that of a");
    for (const CraneCurveSpec& curve : spec_.crane_curves) {
      EntryCheck check(spec_, root_, findings_, "crane_curves." + curve.name);
      check_crane_curve(curve, check);
    }
    check_wind();
    check_current();
    check_panel_method();
    check_solver();
  }

 private:
  void report(const std::string& entry, const std::string& key, const std::string& sentence) {
    findings_.add(position_of_key(root_, entry, key), entry, key, sentence);
  }
  bool written(const std::string& entry, const std::string& key) const {
    return find_key(root_, entry, key) != nullptr;
  }

  std::string written_of(const std::string& entry, const std::vector<std::string>& keys) const {
    for (const std::string& key : keys)
      if (written(entry, key)) return key;
    return {};
  }

  const DriveSpec* drive(const std::string& name) const { return entry_named(spec_.drives, name); }
  const JointSpec* joint(const std::string& name) const { return entry_named(spec_.joints, name); }

  void check_body(const BodySpec& body) {
    const std::string entry = "bodies." + body.name;
    const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(body.inertia).eigenvalues();  // ascending
    const std::string principal = fmt::format("principal moments {:.6g}, {:.6g}, {:.6g} t m2", moments[0] / 1e3,
                                              moments[1] / 1e3, moments[2] / 1e3);
    const std::string key = written(entry, "inertia_t_m2") ? "inertia_t_m2" : "gyration_m";
    if (!(moments[0] > 0.0))
      report(entry, key, "must be positive definite, got " + principal);
    else if (moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-4))  // input rounded to a few digits
      report(entry, key, "no body has a moment larger than the other two together, got " + principal);
    check_hull(body, entry);
  }

  void check_coupling(const BodySpec& body, const std::string& entry) {
    const HydrodynamicsSpec& h = body.hydrodynamics;
    if (h.radiation == HydrodynamicsSpec::RadiationModel::direct && h.kind != HydrodynamicsSpec::Kind::panels)
      report(entry, "radiation", "\"direct\" marches the panel method: it needs kind = \"panels\"");
    if (!h.coupled_until.empty() && h.coupled_with.empty())
      report(entry, "coupled_until", "has a meaning only with coupled_with");
    if (h.coupled_with.empty()) return;
    if (h.coupled_with == body.name) report(entry, "coupled_with", "must be another body");
    for (const BodySpec& other : spec_.bodies)
      if (other.name == h.coupled_with && other.hydrodynamics.kind != HydrodynamicsSpec::Kind::panels)
        report(entry, "coupled_with", fmt::format("must be a body with kind = \"panels\", \"{}\" is not", other.name));
  }

  /// Wind that leaves out the load would be worse than none: a report would show it.
  void check_wind() {
    const std::string& load = spec_.operation.load;
    if (!spec_.wind.blows() || load.empty()) return;
    const auto of_load = [&](const auto& entry) { return entry.body == load; };
    if (std::ranges::none_of(spec_.wind_areas, of_load) && std::ranges::none_of(spec_.wind_hulls, of_load))
      report("wind", "speed_m_per_s",
             fmt::format("blows on nothing of the load: give [[wind_areas]] with body = \"{}\"", load));
  }

  void check_current() {
    const CurrentSpec& current = spec_.sea.current;
    const std::string entry = "sea.current";
    if (!find_key(root_, "sea", "current")) return;
    const bool table = current.profile == CurrentSpec::Profile::table;
    for (const char* key : {"speed_m_per_s", "towards_deg"}) {
      if (table && written(entry, key)) report(entry, key, "cannot stand beside a table, which has it");
      if (!table && !written(entry, key)) report(entry, key, "is required without a table");
    }
    for (std::size_t i = 0; i < current.table.size(); ++i) {
      const auto& layer = current.table[i];
      if (layer.depth < 0.0 || layer.speed < 0.0 || (i > 0 && !(layer.depth > current.table[i - 1].depth)))
        report(entry, "table",
               fmt::format("depths must be >= 0 m and rise, speeds be >= 0 m/s, but layer {} is at {:.6g} m with "
                           "{:.6g} m/s",
                           i + 1, layer.depth, layer.speed));
    }
    if (current.profile == CurrentSpec::Profile::power && !(spec_.sea.depth > 0.0))
      report(entry, "profile", "\"power\" falls towards a bed: give sea.depth_m, or profile = \"uniform\"");
    if (current.flows() && spec_.current_areas.empty() && spec_.current_hulls.empty())
      report(entry, table ? "table" : "speed_m_per_s",
             "flows past nothing: give [[current_hulls]] or [[current_areas]]");
  }

  void check_panel_method() {
    const PanelMethodSpec& p = spec_.panel_method;
    if (p.highest > 0.0 && p.highest <= p.lowest)
      report("panel_method", "highest_rad_per_s",
             fmt::format("must be above lowest_rad_per_s = {:.6g}, got {:.6g}", p.lowest, p.highest));
    if (p.direct_highest <= p.direct_lowest)
      report(
          "panel_method", "direct_highest_rad_per_s",
          fmt::format("must be above direct_lowest_rad_per_s = {:.6g}, got {:.6g}", p.direct_lowest, p.direct_highest));
  }

  void check_hull(const BodySpec& body, const std::string& entry) {
    using Kind = HydrodynamicsSpec::Kind;
    const HydrodynamicsSpec& h = body.hydrodynamics;
    if (body.hull.shape == HullSpec::Shape::none && h.kind != Kind::none && h.kind != Kind::rao)
      report(entry + ".hydrodynamics", "kind", "needs a [bodies.hull] of the same body");
    check_coupling(body, entry + ".hydrodynamics");
    if (h.kind == Kind::constant) {
      if (h.added_mass.isZero(0.0))
        report(entry + ".hydrodynamics", "kind", "\"constant\" needs added_mass_t or added_mass_matrix_t_m");
      if (!h.added_mass.isApprox(h.added_mass.transpose(), 1e-6))
        report(entry + ".hydrodynamics", "added_mass_matrix_t_m", "must be symmetric");
      for (const auto& [matrix, pieces] : {std::pair{"added_mass_matrix_t_m", "added_inertia_t_m2"},
                                           std::pair{"damping_matrix_kN_s_m", "angular_damping_kN_m_s_per_rad"}})
        if (written(entry + ".hydrodynamics", matrix) && written(entry + ".hydrodynamics", pieces))
          report(entry + ".hydrodynamics", pieces, fmt::format("cannot stand beside \"{}\", give one of them", matrix));
    }
  }

  void check_joint(const JointSpec& j) {
    const std::string entry = "joints." + j.name;
    if (j.parent == j.child)
      report(entry, "child", fmt::format("must be another body than the parent \"{}\"", j.parent));
    EntryCheck check(spec_, root_, findings_, entry);
    if (j.type == JointSpec::Type::revolute || j.type == JointSpec::Type::prismatic)
      check.wants_direction("axis", j.axis);
    if (j.drive.empty()) return;
    check.wants_drive("drive", j.drive, DriveSpec::Kind::joint);
    if (!(j.stiffness > 0.0)) report(entry, "drive", "needs a stiffness of the joint to act through");
  }

  void check_used(const DriveSpec& d) {
    bool used = std::any_of(spec_.joints.begin(), spec_.joints.end(), [&](auto& j) { return j.drive == d.name; });
    std::string nouns = "joint";
    for_each_element_kind([&](const auto& kind) {
      if (!kind.drive) return;
      nouns += std::string(", ") + kind.noun;
      for (const auto& entry : spec_.*kind.entries) used = used || entry.*kind.drive == d.name;
    });
    nouns.replace(nouns.rfind(", "), 2, " or ");
    if (!used) report("drives." + d.name, "", "moves nothing: no " + nouns + " names it");
  }

  void check_sea(const SeaStateSpec& state) {
    check_waves(state, "sea.states." + state.name);
    for (const SeaStateSpec& part : state.parts)
      check_waves(part, "sea.states." + state.name + ".parts." + part.name);
  }

  void check_waves(const SeaStateSpec& waves, const std::string& entry) {
    if (waves.spreading > 0.0 && waves.spreading_2s > 0.0)
      report(entry, "spreading_2s", "cannot stand beside spreading: waves spread in one of the two ways");
    if (waves.directions > 1 && !(waves.spreading > 0.0) && !(waves.spreading_2s > 0.0))
      report(entry, "directions", "more than 1 needs spreading > 0");
    using Type = SeaStateSpec::Type;
    if (waves.type == Type::sum && written(entry, "heading_deg"))
      report(entry, "heading_deg", "has no meaning for a sum: each part has its own");
    if (waves.type == Type::spectrum && written(entry, "heading_deg"))
      report(entry, "heading_deg", "has no meaning for a 2-D spectrum: its directions stand in the file");
    if (waves.type == Type::record && !written(entry, "heading_deg"))
      report(entry, "heading_deg", "is required with type = \"record\": one gauge does not say where waves go");
    if (waves.type == Type::record && !(waves.record_file.lowest < waves.record_file.highest))
      report(entry, "highest_rad_per_s", "must be above lowest_rad_per_s");
  }

  /// The unit that a position, travel or speed of this drive is given in.
  std::string unit_of(const DriveSpec& d) const {
    const DriveMotion motion = drive_motion(spec_, d);
    return motion == DriveMotion::share ? "share" : motion == DriveMotion::angle ? "deg" : "m";
  }

  /// Of the written keys of an entry, those that carry the wrong unit for its drive.
  void check_drive_units(const std::string& entry, const std::string& name,
                         const std::vector<std::string>& quantities) {
    const DriveSpec* d = drive(name);
    if (!d) return;
    const std::string right = unit_of(*d);
    for (const std::string& quantity : quantities)
      for (const char* suffix : {"m", "m_per_min", "m_per_s", "deg", "deg_per_s", "share", "share_per_min"}) {
        const std::string key = quantity + "_" + suffix,
                          unit = std::string(suffix).substr(0, std::string(suffix).find('_'));
        if (unit != right && written(entry, key))
          report(entry, key,
                 fmt::format("does not fit drive \"{}\": it moves in {}", name, right == "share" ? "shares" : right));
      }
  }

  void check_goal(const std::string& entry, const CoordinateSpec& c) {
    std::string right = "value_m";
    if (!c.wire.empty()) right = "value_kN";
    if (const JointSpec* j = c.joint.empty() ? nullptr : joint(c.joint)) {
      if (j->type != JointSpec::Type::revolute && j->type != JointSpec::Type::prismatic)
        report(entry, "joint", fmt::format("must be a revolute or prismatic joint, \"{}\" has no coordinate", j->name));
      if (j->type == JointSpec::Type::revolute) right = "value_deg";
    }
    for (const char* key : {"value_m", "value_deg", "value_kN"})
      if (key != right && written(entry, key))
        report(entry, key, "wrong unit for what is measured: write \"" + right + "\"");
    if (c.body.empty())
      for (const char* key : {"point_m", "axis", "relative_to"})
        if (written(entry, key)) report(entry, key, "has a meaning only with body");
    if (!c.body.empty() && c.body == c.relative_to)
      report(entry, "relative_to", fmt::format("must be another body than \"{}\"", c.body));
  }

  void check_phase(const PhaseSpec& phase) {
    const std::string entry = "operation.phases." + phase.name;
    if (phase.moves.empty() && !(phase.duration > 0.0))
      report(entry, "", "has neither moves nor a duration: give duration_s or [[operation.phases.moves]]");
    for (const MoveSpec& move : phase.moves) {
      const std::string here = entry + ".moves." + move.drive;
      check_drive_units(here, move.drive, {"speed", "travel"});
      if (move.goal) check_goal(here + ".goal", *move.goal);
      if (const DriveSpec* d = drive(move.drive); d && d->speed_max > 0.0 && move.speed > d->speed_max * (1.0 + 1e-9))
        report(here, written_of(here, {"speed_m_per_min", "speed_m_per_s", "speed_deg_per_s", "speed_share_per_min"}),
               fmt::format("is above the limit of drive \"{}\": {:.6g} of {:.6g} {}", d->name, shown(move.speed, *d),
                           shown(d->speed_max, *d), shown_unit(*d)));
      if (move.profile.shape == ProfileSpec::Shape::knots && !has_motion(move.profile.knots))
        report(here, "knots", "must have one number > 0 at least");
    }
  }
  static bool has_motion(const std::vector<double>& knots) {
    return std::any_of(knots.begin(), knots.end(), [](double k) { return k > 0.0; });
  }
  double shown(double speed, const DriveSpec& d) const {
    return unit_of(d) == "deg" ? speed / unit::deg_per_s.factor : speed * 60.0;
  }
  std::string shown_unit(const DriveSpec& d) const {
    return unit_of(d) == "deg" ? "deg/s" : unit_of(d) == "m" ? "m/min" : "shares/min";
  }

  void check_pose(const PoseSpec& pose) {
    const std::string entry = "poses." + pose.name;
    std::set<std::string> used;
    const auto claim = [&](const std::string& here, const std::string& name) {
      if (!used.insert(name).second)
        report(here, "drive", fmt::format("\"{}\" has more than one thing to do in this pose", name));
    };
    for (const PoseSpec::DriveSetting& setting : pose.drives) {
      check_drive_units(entry + ".drives." + setting.drive, setting.drive, {"position"});
      claim(entry + ".drives." + setting.drive, setting.drive);
    }
    for (const PoseSpec::Hold& hold : pose.holds) {
      const std::string here = entry + ".holds." + hold.joint;
      claim(here, hold.drive);
      const JointSpec* held = joint(hold.joint);
      const bool turns = held && held->type == JointSpec::Type::revolute;
      if (held && !turns && held->type != JointSpec::Type::prismatic)
        report(here, "joint",
               fmt::format("must be a revolute or prismatic joint, \"{}\" has no coordinate", held->name));
      const std::string wrong = turns ? "slide_m" : "angle_deg";
      if (held && written(here, wrong))
        report(here, wrong,
               fmt::format("does not fit joint \"{}\": write \"{}\"", hold.joint, turns ? "angle_deg" : "slide_m"));
    }
    for (const PoseSpec::Goal& goal : pose.goals) {
      claim(entry + ".goals." + goal.drive, goal.drive);
      check_goal(entry + ".goals." + goal.drive, goal.coordinate);
    }
  }

  void check_solver() {
    if (spec_.solver.output_interval < spec_.solver.time_step)
      report("solver", "output_interval_s",
             fmt::format("must be at least time_step_s {:.6g}, got {:.6g}", spec_.solver.time_step,
                         spec_.solver.output_interval));
    if (!spec_.joints.empty() && !(spec_.solver.hht_alpha < 0.0))
      report("solver", "hht_alpha",
             fmt::format("must be < 0 with joints, whose multipliers ring without numerical damping, got {:.6g}",
                         spec_.solver.hht_alpha));
    if (spec_.operation.phases.empty() && !(spec_.solver.max_duration > 0.0))
      report("operation", "",
             "has no phases: give [[operation.phases]], or solver.max_duration_s for a run without them");
  }

  const Specification& spec_;
  const Node& root_;
  Findings& findings_;
};

}  // namespace

void check_lift(const Case& c, const Node& root, Findings& findings) { LiftCheck(c, root, findings).run(); }

}  // namespace stillhook
