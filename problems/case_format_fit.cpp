// Field tables of the fit to measured runs.
#include "problems/case_format.h"

namespace stillhook {
namespace {

const Table& parameter_table() {
  static const Table table = [] {
    using S = FitParameterSpec;
    TableOf<S> t("fit.parameters",
                 "A numeric key of the case to be estimated, as in plan.variables; numbers in the key's own unit.");
    t.number("min", &S::lower, unit::one, any_value(), "Lower bound.").require();
    t.number("max", &S::upper, unit::one, any_value(), "Upper bound.").require();
    t.number("start", &S::start, unit::one, any_value(), "Value to start from.")
        .absent("from the p-q line of a decay where that gives it, else the case's own value");
    t.number("prior_mean", &S::prior_mean, unit::one, any_value(), "What is known beforehand: the mean ...")
        .absent("nothing is known");
    t.number("prior_sd", &S::prior_sd, unit::one, positive(), "... and the standard deviation of a normal.")
        .absent("nothing is known");
    return t.build();
  }();
  return table;
}

const Table& column_table() {
  static const Table table = [] {
    using S = FitColumnSpec;
    TableOf<S> t("fit.records.columns", "A column of the measured file and the channel of the simulation it shows.");
    t.text("channel", &S::channel, "Channel, as in history.nc: `vessel.roll`, `hoist.tension`, `sea.elevation`.")
        .require();
    t.text("column", &S::column, "Name of the column, or of the NetCDF variable.").absent("the channel's name");
    t.text("unit", &S::unit,
           "Unit in the file: m, mm, cm, ft; deg, rad, mrad; m/s, mm/s, m/min; deg/s, rad/s; N, kN, MN, t; N m, kN m; 1.")
        .require();
    t.boolean("reversed", &S::reversed, "What is positive in the file is negative here.");
    t.number("offset", &S::offset, unit::one, any_value(), "Zero of the sensor in the file's unit, taken off first.");
    t.boolean("estimate_offset", &S::estimate_offset, "Estimate what is left of the sensor's zero.");
    t.number("noise", &S::noise, unit::one, positive(), "Standard deviation of the sensor's noise, in the file's unit.")
        .absent("from the residuals");
    t.boolean("trust_unit", &S::trust_unit, "Do not refuse a column whose size looks like another unit's.");
    return t.build();
  }();
  return table;
}

const Table& setting_table() {
  static const Table table = [] {
    using S = FitSettingSpec;
    TableOf<S> t("fit.records.settings", "A key of the case that was different in this run, as with --set.");
    t.text("key", &S::key, "Key.").require();
    t.text("value", &S::value, "Value as TOML text, e.g. \"2.5\" or \"[1, 0, 0]\".").require();
    return t.build();
  }();
  return table;
}

void add_initial_state(TableOf<FitRecordSpec>& t) {
  using S = FitRecordSpec;
  t.text("free_body", &S::free_body,
         "Body whose position, attitude and velocity at the start of the run are estimated, with everything jointed to "
         "it; the run starts from the lift's equilibrium (or given poses) so displaced.")
      .names(Reference::body)
      .absent("none: the run starts as the case does");
  t.text("free", &S::free,
         "Which of them, with commas in between: x, y, z, roll, pitch, yaw, vx, vy, vz, wx, wy, wz (displacements and "
         "velocities of the body's origin in the world, turns and rates about the body's axes).")
      .absent("those that a measured channel shows, and their rates");
}

const Table& record_table() {
  static const Table table = [] {
    using S = FitRecordSpec;
    TableOf<S> t("fit.records", "A measured run.");
    t.name("name", &S::name, "Name.");
    t.file("file", &S::file, "CSV or NetCDF file.").absent("given by --measured");
    t.choice<decltype(&S::kind), S::Kind>("kind", &S::kind,
                                          {{"decay", S::Kind::decay},
                                           {"regular", S::Kind::regular},
                                           {"irregular", S::Kind::irregular},
                                           {"static", S::Kind::constant}},
                                          "Free decay; regular or irregular waves; a pull at rest, of which the mean "
                                          "counts.")
        .require();
    t.text("sea", &S::sea, "Sea state of the run.")
        .names(Reference::sea_state)
        .absent("calm water for decay and static, else sea.active");
    t.text("time_column", &S::time_column, "Name of the time column.");
    t.choice<decltype(&S::time_unit), double>("time_unit", &S::time_unit,
                                              {{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}, {"h", 3600.0}},
                                              "Unit of the time column.");
    t.number("time_shift_s", &S::time_shift, unit::s, any_value(),
             "Added to the record's time, at full scale, to give simulated time.")
        .absent("a decay and a static run begin with the window, others have the simulation's clock");
    t.number("start_s", &S::start, unit::s, any_value(), "Start of the window that counts, on the record's own clock.")
        .absent("the first row");
    t.number("end_s", &S::end, unit::s, any_value(), "End of that window.").absent("the last row");
    t.number("settle_s", &S::settle, unit::s, not_negative(),
             "The first part of the simulation that does not count, while it forgets how it began.");
    t.number("model_scale", &S::model_scale, unit::one, Range{0.01, 1000.0, false},
             "Full scale over model scale when the file is at model scale; by Froude.");
    t.number("interval_s", &S::interval, unit::s, positive(), "Interval of the samples that are compared.")
        .absent("solver.output_interval_s, or the record's own if that is longer");
    add_initial_state(t);
    t.tables("columns", &S::columns, "channel", &column_table, "What was measured.").require();
    t.tables("settings", &S::settings, "key", &setting_table, "What was different in this run.").absent("nothing");
    return t.build();
  }();
  return table;
}

}  // namespace

const Table& fit_table() {
  static const Table table = [] {
    using S = FitSpec;
    TableOf<S> t("fit", "Estimation of case keys from measured runs: `stillhook fit`. See docs/fitting.md.");
    t.map("parameters", &S::parameters, &FitParameterSpec::key, &parameter_table, "What is unknown, by key.");
    t.tables("records", &S::records, "name", &record_table, "Measured runs.").absent("none");
    t.choice<decltype(&S::shooting), S::Shooting>(
        "shooting", &S::shooting, {{"single", S::Shooting::single}, {"multiple", S::Shooting::multiple}},
        "Single: a record is one simulation. Multiple: first in segments whose beginnings are unknowns too, which finds "
        "its way from bad start values, then single.");
    t.integer("segments", &S::segments, between(2.0, 200.0), "Segments of a record in multiple shooting.");
    t.number("robust", &S::robust, unit::one, positive(),
             "Standard deviations beyond which a residual counts linearly instead of squared (Huber).");
    t.integer("iterations", &S::iterations, between(1.0, 1000.0), "Most iterations of a solve.");
    t.boolean("cross_validate", &S::cross_validate,
              "With several records, fit without each and predict it with what the others gave.");
    t.number("explained", &S::explained, unit::one, between(0.0, 1.0),
             "Share of each channel's variance that the fit must explain to be trusted.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
