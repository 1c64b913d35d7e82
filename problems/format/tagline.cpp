// Taglines in a case: keys and rules.
#include <fmt/core.h>

#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {
namespace {

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

}  // namespace

const Table& case_table(const TaglineSpec*) {
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

void check_entry(const TaglineSpec& t, EntryCheck& check) {
  if (t.from == t.to) check.report("to", fmt::format("must be another body than from, both are \"{}\"", t.from));
  if (t.pretension > t.tension_max)
    check.report("pretension_kN", fmt::format("must be at most tension_max_kN {:.6g}, got {:.6g}", t.tension_max / 1e3,
                                              t.pretension / 1e3));
  const WireSpec* wire = entry_named(check.specification().wires, t.wire);
  if (wire && wire->role != WireSpec::Role::hoist)
    check.report("wire", fmt::format("must be a wire with role = \"hoist\", \"{}\" is not", t.wire));
}

}  // namespace stillhook
