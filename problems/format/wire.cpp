// Wires in a case: keys and rules.
#include <fmt/core.h>

#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {

const Table& case_table(const WireSpec*) {
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

void check_entry(const WireSpec& w, EntryCheck& check) {
  if (w.from == w.to) check.report("to", fmt::format("must be another body than from, both are \"{}\"", w.from));
  if (w.damping_ratio > 0.0 && !(w.damping_mass > 0.0)) check.report("damping_ratio", "needs damping_mass_t");
  check.wants_drive("winch", w.winch, DriveSpec::Kind::winch);
  if (w.breaking_load > 0.0 && w.tension_max > w.breaking_load)
    check.report("tension_max_kN", fmt::format("must be at most the breaking load {:.6g} kN, got {:.6g}",
                                               w.breaking_load / 1e3, w.tension_max / 1e3));
  const JointSpec* held = entry_named(check.specification().joints, w.hold_joint);
  if (held && held->type != JointSpec::Type::revolute && held->type != JointSpec::Type::prismatic)
    check.report("hold_joint",
                 fmt::format("must be a revolute or prismatic joint, \"{}\" has no coordinate", held->name));
}

}  // namespace stillhook
