// Current in a case: the current itself, the areas and the hulls in it.
#include "problems/case_format.h"
#include "problems/format/flow_keys.h"

namespace stillhook {

const Table& current_table() {
  static const Table table = [] {
    using S = CurrentSpec;
    using P = CurrentSpec::Profile;
    TableOf<S> t("sea.current",
                 "Steady current. It acts on the bodies that have [[current_areas]] or [[current_hulls]].");
    t.choice<decltype(&S::profile), P>(
         "profile", &S::profile, {{"uniform", P::uniform}, {"power", P::power}, {"table", P::table}},
         "How it changes with the depth: not at all, by a power of the height above the bed, or by a table.")
        .absent("power with sea.depth_m, else uniform");
    t.number("speed_m_per_s", &S::speed, unit::m_per_s, not_negative(), "At the surface.").absent("by the table");
    t.number("towards_deg", &S::towards, unit::deg, Range{-360.0, 360.0, false},
             "Direction it flows to, from +x, counter-clockwise.")
        .absent("by the table");
    t.number("exponent", &S::exponent, unit::one, between(0.0, 1.0), "Of the power; 1/7 of tidal streams.")
        .only_when("profile", {"power"});
    t.rows(
         "table", 3,
         [](S& s, const std::vector<std::vector<double>>& rows) {
           s.table.clear();
           for (const std::vector<double>& row : rows) s.table.push_back({row[0], row[1], row[2] * unit::deg.factor});
         },
         unit::one,
         "Layers by rising depth: [depth below the surface in m, speed in m/s, direction it flows to in deg], linear "
         "between, constant above the first and below the last.")
        .only_when("profile", {"table"})
        .require();
    return t.build();
  }();
  return table;
}

const Table& case_table(const CurrentAreaSpec*) {
  static const Table table = [] {
    TableOf<CurrentAreaSpec> t(
        "current_areas", "An area of a body in the current: drag along each axis of the body, as far as it is wet.");
    t.name("name", &CurrentAreaSpec::name, "Name.");
    add_area_keys(t, "current", "Coefficients along x, y and z.",
                  "Height of the area: how the current takes hold of it as it goes under water.");
    return t.build();
  }();
  return table;
}

const Table& case_table(const CurrentHullSpec*) {
  static const Table table = [] {
    using S = CurrentHullSpec;
    TableOf<S> t(
        "current_hulls",
        "A hull in the current: forces and yaw moment by coefficients over the direction, with the hull's slow "
        "velocity. It acts at half the draft.");
    t.name("name", &S::name, "Name.");
    add_hull_keys(t, "F = q length draft C, yaw moment q length^2 draft Cn.").one_of("coefficients", true);
    t.numbers(
         "drag", {2},
         [](S& s, const std::vector<double>& v) {
           s.drag = {v[0], v[1]};
         },
         unit::one, not_negative(),
         "In place of a file: coefficients along and across the hull, each on its own part of the velocity; of a "
         "barge about 0.05 to 0.1 and 0.6 to 1.0.")
        .one_of("coefficients", true);
    t.number("draft_m", &S::draft, unit::m, positive(), "Draft.").require();
    return t.build();
  }();
  return table;
}

namespace {

void wants_current(EntryCheck& check) {
  if (!check.specification().sea.current.flows())
    check.report("", "meets no current: the case has no [sea.current], or its speed is 0");
}

}  // namespace

void check_entry(const CurrentAreaSpec& area, EntryCheck& check) {
  check_area(area, "current", check);
  wants_current(check);
}

void check_entry(const CurrentHullSpec& hull, EntryCheck& check) {
  check_hull(hull, "current", check);
  const Specification& s = check.specification();
  const BodySpec* body = entry_named(s.bodies, hull.body);
  if (body && body->hull.shape == HullSpec::Shape::box && hull.draft > body->hull.size.z())
    check.report("draft_m", fmt::format("is {:.4g} m, more than the depth of the hull of \"{}\", {:.4g} m", hull.draft,
                                        hull.body, body->hull.size.z()));
  if (s.sea.depth > 0.0 && hull.draft >= s.sea.depth)
    check.report("draft_m", fmt::format("is {:.4g} m in water of sea.depth_m = {:.4g} m", hull.draft, s.sea.depth));
  wants_current(check);
}

}  // namespace stillhook
