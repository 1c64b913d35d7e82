// Field table of the drives.
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

}  // namespace stillhook
