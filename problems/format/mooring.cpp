// Mooring lines in a case: keys and rules.
#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {
namespace {

void check_tow(const MooringSpec& m, EntryCheck& check) {
  if (m.tow.empty()) {
    if (m.tow_direction.norm() > 0.0) check.report("tow_direction", "needs tow, the drive that moves the far end");
    return;
  }
  check.wants_drive("tow", m.tow, DriveSpec::Kind::tow);
  if (!check.written("tow_direction"))
    check.report("tow", "needs tow_direction");
  else
    check.wants_direction("tow_direction", m.tow_direction);
}

}  // namespace

const Table& case_table(const MooringSpec*) {
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
        "Where the far end is instead, in the world: x, y and z above the still water. On the sea bed (z = -depth_m) "
        "the "
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

void check_entry(const MooringSpec& m, EntryCheck& check) {
  check_tow(m, check);
  const bool catenary = m.type == MooringSpec::Type::catenary, follows = catenary && m.anchor;
  if (catenary && !(check.specification().sea.depth > 0.0)) check.report("type", "\"catenary\" needs sea.depth_m");
  if (catenary && m.weight == 0.0)
    check.report("weight_N_per_m",
                 "must not be 0: a line as heavy as water is straight; give it as a wire from \"world\", or as type = "
                 "\"linear\"");
  if (!follows && !check.written("pretension_kN"))
    check.report("pretension_kN", m.anchor ? "is required with type = \"linear\"" : "is required with azimuth_deg");
  else if (catenary && !m.anchor && !(m.pretension > 0.0))
    check.report("pretension_kN", "must be > 0 kN, got 0");
  if (follows && check.written("pretension_kN"))
    check.report(
        "pretension_kN",
        "cannot stand beside anchor_m: with its two ends the tension of a catenary follows from length_m; leave "
        "one of them out");
  if (catenary) return;
  if (m.anchor && check.written("anchor_distance_m"))
    check.report("anchor_distance_m", "cannot stand beside anchor_m, leave one of them out");
  if (!m.anchor && !check.written("anchor_distance_m"))
    check.report("anchor_distance_m", "is required with azimuth_deg");
}

}  // namespace stillhook
