// Workability, windows and the decision by a forecast.
#include "problems/case_format.h"
#include "problems/weather_spec.h"

namespace stillhook {
namespace {

const Table& weather_phase_table() {
  static const Table table = [] {
    using S = WeatherPhaseSpec;
    TableOf<S> t("weather.phases", "A phase of the operation, in order, for the decision by a forecast.");
    t.name("name", &S::name, "Name, as in the limits.");
    t.number("duration_h", &S::duration, unit::h, positive(), "Planned duration.").require();
    return t.build();
  }();
  return table;
}

void add_files(TableOf<WeatherSpec>& t) {
  using S = WeatherSpec;
  t.file("hindcast", &S::hindcast, "Record of years, CSV or NetCDF.").needed_later().absent("given by --hindcast");
  t.file("scatter", &S::scatter, "Table of counts by height and period, CSV.")
      .needed_later()
      .absent("given by --scatter");
  t.file("forecast", &S::forecast, "Forecast, CSV or NetCDF.").needed_later().absent("given by --forecast");
  t.text("time_column", &S::time_column, "Name of the time column.").absent("time, valid_time");
  t.text("height_column", &S::height_column, "Name of the column of significant wave heights.")
      .absent("hs, swh, hm0, VHM0 and the like, with or without a unit in brackets");
  t.text("period_column", &S::period_column, "Name of the column of wave periods.")
      .absent("tp, pp1d, VTPK and the like; tz, t02, te, tm10");
  t.text("direction_column", &S::direction_column, "Name of the column of wave directions.")
      .absent("wave_from, wave_to, mwd, dp, VMDR and the like");
  t.text("wind_column", &S::wind_column, "Name of the column of wind speeds.").absent("wind_speed, ws10, wind");
  t.choice<decltype(&S::period_kind), S::Period>(
       "period_kind", &S::period_kind,
       {{"peak", S::Period::peak}, {"zero_crossing", S::Period::zero_crossing}, {"energy", S::Period::energy}},
       "Which period the file gives; others than the peak's are converted for a JONSWAP spectrum.")
      .absent("by the column's name");
  t.number("gamma", &S::gamma, unit::one, between(1.0, 10.0), "Peak enhancement for that conversion.");
  t.choice<decltype(&S::direction_sense), S::Sense>("direction_sense", &S::direction_sense,
                                                    {{"from", S::Sense::from}, {"towards", S::Sense::towards}},
                                                    "Where the waves of the file come from, or travel towards.")
      .absent("by the column's name or its standard_name");
}

}  // namespace

const Table& weather_table() {
  static const Table table = [] {
    using S = WeatherSpec;
    TableOf<S> t("weather",
                 "Workability, weather windows and the decision by a forecast: `stillhook weather`. See "
                 "docs/operability.md.");
    add_files(t);
    t.number("bow_towards_deg", &S::bow_towards, unit::deg, between(0.0, 360.0),
             "Compass direction of the bow, clockwise from true north.")
        .one_of("heading")
        .absent("the lowest limit over all headings counts");
    t.boolean("free_heading", &S::free_heading, "The vessel turns to the best heading in every sample.")
        .one_of("heading");
    t.number("operation_h", &S::operation, unit::h, positive(), "Planned duration of the operation, T_POP.")
        .absent("the sum of the phases, here or of the case's operation");
    t.number("contingency", &S::contingency, unit::one, between(0.0, 5.0),
             "Share of the planned duration that is added for contingencies, T_C; 6 h at least.");
    t.numbers(
         "windows_h", {}, [](S& s, const std::vector<double>& v) { s.windows = v; }, unit::h, positive(),
         "Durations of the weather windows that are looked for.")
        .absent("T_POP + T_C of the operation, else 6, 12, 24 and 48 h");
    t.tables("phases", &S::phases, "name", &weather_phase_table, "Phases with durations of their own.")
        .absent("those of the case's operation, if the limits name them");
    t.file("alpha", &S::alpha,
           "Factors on the limit by planned duration and height, CSV with the columns `t_pop_at_most [h]`, `hs [m]`, "
           "`alpha`.")
        .absent("a built-in table, to be replaced by that of your licensed copy");
    t.choice<decltype(&S::alpha_by), S::AlphaBy>(
        "alpha_by", &S::alpha_by, {{"operation", S::AlphaBy::operation}, {"lead_time", S::AlphaBy::lead_time}},
        "Alpha by the planned duration, or by how far ahead in the forecast a sample lies, at most that duration.");
    t.number("wind_max_m_per_s", &S::wind_max, unit::m_per_s, positive(), "Largest wind speed.").absent("any");
    t.numbers(
         "daylight_h", {2}, [](S& s, const std::vector<double>& v) { s.daylight = v; }, unit::h, between(0.0, 24.0),
         "Hours of the day, UTC, between which work may go on: [from, to].")
        .absent("day and night");
    t.choice<decltype(&S::record_end), S::End>(
        "record_end", &S::record_end, {{"censor", S::End::censor}, {"wrap", S::End::wrap}},
        "Waits that the end of the record cuts off are left out and counted, or the record is closed to a ring.");
    t.numbers(
         "within_days", {}, [](S& s, const std::vector<double>& v) { s.horizons = v; }, unit::day, positive(),
         "Days within which a window may start: its chance is told.")
        .get = [](const void* s) { return std::optional<Value>(static_cast<const S*>(s)->horizons); };
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
