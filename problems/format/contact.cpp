// Contacts in a case: keys and rules.
#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {

const Table& case_table(const ContactSpec*) {
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

void check_entry(const ContactSpec& contact, EntryCheck& check) {
  check.wants_another_body("surface_body", contact.surface_body, contact.body);
}

}  // namespace stillhook
