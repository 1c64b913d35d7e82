// Limiting sea states: which ones, and how surely.
#include "problems/case_format.h"
#include "problems/operability_spec.h"

namespace stillhook {
namespace {

const Table& operability_phase_table() {
  static const Table table = [] {
    using S = OperabilityPhaseSpec;
    TableOf<S> t("operability.phases", "A phase that is simulated alone, begun at rest in the pose before it.");
    t.text("name", &S::name, "Phase of the operation.").names(Reference::phase).require();
    return t.build();
  }();
  return table;
}

void add_seas(TableOf<OperabilitySpec>& t) {
  using S = OperabilitySpec;
  t.text("sea", &S::sea,
         "Sea state that gives the shape of the spectrum, spreading and components: `jonswap` or `pierson_moskowitz`. "
         "Its height, "
         "period and heading are replaced.")
      .names(Reference::sea_state)
      .absent("sea.active");
  t.numbers(
       "peak_periods_s", {}, [](S& s, const std::vector<double>& v) { s.peak_periods = v; }, unit::s,
       Range{0.0, 60.0, true}, "Peak periods, ascending.")
      .require();
  t.numbers(
       "headings_deg", {}, [](S& s, const std::vector<double>& v) { s.headings = v; }, unit::deg,
       between(-360.0, 360.0),
       "Directions that the waves travel towards, from +x counter-clockwise: 180 from ahead, 90 from starboard abeam.")
      .one_of("headings", true);
  t.number("heading_step_deg", &S::heading_step, unit::deg, Range{0.0, 180.0, true},
           "Instead: every so many degrees around the circle, from 0 on.")
      .one_of("headings", true)
      .absent("headings_deg");
  t.boolean("mirror", &S::mirror,
            "Port and starboard are alike: only headings from 0 to 180 deg are simulated, and stand for the others.");
  t.number("height_max_m", &S::height_max, unit::m, positive(), "Largest significant height that is tried.")
      .absent("the steepest sea of the period: 2 pi Hs/(g Tp^2) = 1/15 up to 8 s, 1/25 from 15 s");
}

}  // namespace

const Table& operability_table() {
  static const Table table = [] {
    using S = OperabilitySpec;
    TableOf<S> t("operability",
                 "Limiting sea states of the lift by period and heading: `stillhook operability`. See "
                 "docs/operability.md.");
    add_seas(t);
    t.number("level", &S::level, unit::one, between(0.05, 0.99),
             "Share of the seeds that shall keep the hard limits: 0.90 is the 90 % fractile, 0.367879 the most "
             "probable maximum.");
    t.numbers(
         "seeds", {}, [](S& s, const std::vector<double>& v) { s.seeds = v; }, unit::one, between(1.0, 10000.0),
         "Looks: numbers of seeds, ascending, at which the search may end. Below 29 a limit at 0.90 has no lower "
         "bound.")
        .get = [](const void* s) { return std::optional<Value>(static_cast<const S*>(s)->seeds); };
    t.number("tolerance", &S::tolerance, unit::one, between(0.005, 1.0),
             "Half-width of the limit's 95 % interval, as a share of the limit, at which the search ends.");
    t.number("resolution", &S::resolution, unit::one, between(0.0005, 0.2),
             "Width of the bracket around the height at which a seed breaks, as a share of it.");
    t.number("guess_m", &S::guess, unit::m, positive(),
             "Height at which the search begins. Near the limits it saves runs.");
    t.tables("phases", &S::phases, "name", &operability_phase_table, "Phases that are simulated, each alone.")
        .absent("the whole operation in one run");
    t.choice<decltype(&S::criteria), S::Criteria>(
        "criteria", &S::criteria, {{"governing", S::Criteria::governing}, {"all", S::Criteria::all}},
        "Heights are refined for what governs the lift, and known for other limits and phases as \"at least\"; or for "
        "every limit and phase.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
