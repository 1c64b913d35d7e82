// Wind in a case: the wind itself, the areas and the hulls that it blows on.
#include <fmt/core.h>

#include "problems/case_format.h"
#include "problems/format/flow_keys.h"

namespace stillhook {
namespace {

using GustKind = WindSpec::Gusts;

void add_gust_keys(TableOf<WindSpec>& t) {
  using S = WindSpec;
  const std::vector<std::string> by_spectrum = {"npd", "api", "kaimal"}, by_record = {"record"};
  t.choice<decltype(&S::gusts), GustKind>(
      "spectrum", &S::gusts,
      {{"none", GustKind::none},
       {"npd", GustKind::npd},
       {"api", GustKind::api},
       {"kaimal", GustKind::kaimal},
       {"record", GustKind::record}},
      "Gusts: none, by the spectrum of NPD (ISO 19901-1), of API RP 2A or of Kaimal "
      "(IEC 61400-1) from 1/600 to 0.5 Hz, or as a record has them.");
  t.integer("components", &S::components, Range{10, 2000, false}, "Number of frequencies of the gusts.")
      .only_when("spectrum", by_spectrum);
  t.integer("seed", &S::seed, Range{0, 2147483647, false},
            "Index that the phases of the gusts come from. With it they stay as they are while the seed of the sea "
            "changes.")
      .only_when("spectrum", by_spectrum)
      .absent("the seed of the sea; 1 with a sea that has none");
  t.number("turbulence", &S::turbulence, unit::one, between(0.0, 1.0),
           "Standard deviation of the gusts, all frequencies, over the mean speed.")
      .only_when("spectrum", {"api", "kaimal"})
      .absent("by ISO 19901-1");
  t.number("turbulence_length_m", &S::turbulence_length, unit::m, positive(), "Length L of Kaimal's spectrum.")
      .only_when("spectrum", {"kaimal"})
      .absent("5.67 times the height, 340 m from 60 m on (IEC 61400-1)");
  t.file("record_file", &S::record_file,
         "Table with a measured wind speed in m/s, its first column the time in s, in even steps, from the start of "
         "the run on. Its mean must be that of the wind within a tenth; what it has beside is felt at all heights.")
      .only_when("spectrum", by_record)
      .require();
  t.text("column", &S::column, "Name of the column.").only_when("spectrum", by_record).require();
  t.number("record_height_m", &S::record_height, unit::m, positive(),
           "Height above still water that it was measured at.")
      .only_when("spectrum", by_record);
}

}  // namespace

const Table& wind_table() {
  static const Table table = [] {
    using S = WindSpec;
    TableOf<S> t("wind", "Wind. It acts on the bodies that have [[wind_areas]] or [[wind_hulls]].");
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
    add_gust_keys(t);
    return t.build();
  }();
  return table;
}

const Table& case_table(const WindAreaSpec*) {
  static const Table table = [] {
    TableOf<WindAreaSpec> t("wind_areas",
                            "An area of a body that the wind blows on: drag along each axis of the body.");
    t.name("name", &WindAreaSpec::name, "Name.");
    add_area_keys(t, "wind", "Coefficients along x, y and z: 1.2 of flat sides, 1.6 of the solid area of a lattice.",
                  "Height of the area: how it leaves the wind as it goes under water.");
    return t.build();
  }();
  return table;
}

const Table& case_table(const WindHullSpec*) {
  static const Table table = [] {
    using S = WindHullSpec;
    using Ship = WindHullSpec::Ship;
    TableOf<S> t("wind_hulls",
                 "A hull in the wind: forces and yaw moment by coefficients over the direction, with the hull's slow "
                 "velocity.");
    t.name("name", &S::name, "Name.");
    add_hull_keys(t, "F = q area C, yaw moment q area_side length Cn.").one_of("coefficients", true);
    t.choice<decltype(&S::ship), Ship>("ship", &S::ship,
                                       {{"cargo_loaded", Ship::cargo_loaded},
                                        {"diving_support", Ship::diving_support},
                                        {"drilling", Ship::drilling},
                                        {"offshore_supply", Ship::offshore_supply},
                                        {"research", Ship::research},
                                        {"tanker_ballast", Ship::tanker_ballast},
                                        {"tender", Ship::tender}},
                                       "Kind of ship whose coefficients Blendermann (1994) measured.")
        .one_of("coefficients", true);
    t.number("area_front_m2", &S::area_front, unit::m2, positive(),
             "Area above the water that wind along the hull meets.")
        .require();
    t.number("area_side_m2", &S::area_side, unit::m2, positive(), "Area above the water that wind across it meets.")
        .require();
    t.number("centroid_height_m", &S::centroid_height, unit::m, positive(),
             "Height of the side area's centroid above still water: where the wind is taken, and where it pushes; of a "
             "ship the side force acts higher, as measured.")
        .require();
    t.number("centroid_ahead_m", &S::centroid_ahead, unit::m, any_value(),
             "How far the side area's centroid lies ahead of amidships, with `ship`.");
    return t.build();
  }();
  return table;
}

void check_entry(const WindAreaSpec& area, EntryCheck& check) {
  check_area(area, "wind", check);
  if (!check.specification().wind.blows()) check.report("", "meets no wind: the case has no [wind], or its speed is 0");
}

void check_entry(const WindHullSpec& hull, EntryCheck& check) {
  check_hull(hull, "wind", check);
  if (hull.ship == WindHullSpec::Ship::none && check.written("centroid_ahead_m"))
    check.report("centroid_ahead_m", "has a meaning only with ship: in a file of coefficients Cn has it already");
  if (!check.specification().wind.blows()) check.report("", "meets no wind: the case has no [wind], or its speed is 0");
}

}  // namespace stillhook
