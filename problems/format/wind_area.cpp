// Wind in a case: the wind itself and the areas that it blows on.
#include <fmt/core.h>

#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {

const Table& wind_table() {
  static const Table table = [] {
    using S = WindSpec;
    TableOf<S> t("wind", "Steady wind. It acts on the bodies that have [[wind_areas]].");
    t.number("speed_m_per_s", &S::speed, unit::m_per_s, not_negative(), "Hourly mean at 10 m above still water.")
        .require();
    t.number("from_deg", &S::from, unit::deg, Range{-360.0, 360.0, false},
             "Direction it blows from, from +x, counter-clockwise.")
        .one_of("direction", true);
    t.number("towards_deg", &S::to, unit::deg, Range{-360.0, 360.0, false}, "Direction it blows to instead.")
        .one_of("direction", true);
    t.choice<decltype(&S::profile), S::Profile>(
        "profile", &S::profile,
        {{"iso", S::Profile::iso}, {"power", S::Profile::power}, {"constant", S::Profile::constant}},
        "How it grows with height: iso (ISO 19901-1), a power of the height, or not at all.");
    t.number("exponent", &S::exponent, unit::one, between(0.0, 1.0), "Of the power of the height.")
        .only_when("profile", {"power"});
    t.number("air_density_kg_per_m3", &S::density, unit::kg_per_m3, positive(), "Density of the air.");
    return t.build();
  }();
  return table;
}

const Table& case_table(const WindAreaSpec*) {
  static const Table table = [] {
    using S = WindAreaSpec;
    TableOf<S> t("wind_areas", "An area of a body that the wind blows on: drag along each axis of the body.");
    t.name("name", &S::name, "Name.");
    t.text("body", &S::body, "Body that it belongs to.").names(Reference::body).require();
    t.vector("centre_m", &S::centre, unit::m, any_value(), "Centre of the area, in the body frame.");
    t.vector("areas_m2", &S::areas, unit::m2, not_negative(),
             "Area that wind along x, along y and along z of the body meets.")
        .require();
    t.vector("drag", &S::drag, unit::one, not_negative(),
             "Coefficients along x, y and z: 1.2 of flat sides, 1.6 of the solid area of a lattice.");
    t.number("height_m", &S::height, unit::m, positive(),
             "Height of the area: how it leaves the wind as it goes under water.")
        .absent("the root of the larger of the areas across x and y");
    return t.build();
  }();
  return table;
}

void check_entry(const WindAreaSpec& area, EntryCheck& check) {
  if (!(area.areas.maxCoeff() > 0.0)) check.report("areas_m2", "must have one number > 0 at least");
  if (!(area.height || area.areas.head<2>().maxCoeff() > 0.0))
    check.report("height_m", "is needed with an area across z alone");
  if (!check.specification().wind.blows()) check.report("", "meets no wind: the case has no [wind], or its speed is 0");
  const BodySpec* body = entry_named(check.specification().bodies, area.body);
  if (body && body->moved_by_sea())
    check.report("body", fmt::format("\"{}\" moves by displacement RAOs, which no wind changes: leave the entry out",
                                     area.body));
}

}  // namespace stillhook
