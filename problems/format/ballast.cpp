// Ballast transfers in a case: keys and rules.
#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {

const Table& case_table(const BallastSpec*) {
  static const Table table = [] {
    using S = BallastSpec;
    TableOf<S> t("ballast", "Water moved from one tank to another. Its weight counts, its inertia does not.");
    t.name("name", &S::name, "Name.");
    t.text("body", &S::body, "Body with the tanks.").names(Reference::body).require();
    t.number("mass_t", &S::mass, unit::t, not_negative(), "Mass moved when the drive stands at 1.").require();
    t.vector("from_m", &S::from, unit::m, any_value(), "Centre of the tank it leaves.").require();
    t.vector("to_m", &S::to, unit::m, any_value(), "Centre of the tank it goes to.").require();
    t.text("drive", &S::drive, "Drive that moves it.").names(Reference::drive).require();
    return t.build();
  }();
  return table;
}

void check_entry(const BallastSpec& ballast, EntryCheck& check) {
  check.wants_drive("drive", ballast.drive, DriveSpec::Kind::ballast);
}

}  // namespace stillhook
