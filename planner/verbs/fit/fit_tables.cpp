#include <fmt/format.h>

#include <cmath>

#include "planner/verbs/fit/fit_report.h"
#include "planner/text_number.h"
#include "results/quantity.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

std::string interval_text(const FitEstimate& e) {
  if (e.no_influence) return "not determined";
  if (e.at_bound) return "at its bound";
  return fmt::format("{} to {}", short_number(e.low), short_number(e.high));
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + ", " + unit;
}

}  // namespace

std::string verdict_of(const Identification& result) {
  if (!result.usable) return "No fit: " + result.message;
  if (!result.trusted) return "Not to be trusted: the model does not explain the records";
  return result.warnings.empty() ? "The model explains the records" : "The model explains the records, with reservations";
}

ReportTable estimate_table(const Identification& result) {
  ReportTable t;
  t.title = "Estimates";
  t.note = "Intervals of 95 %; sd in percent of the estimate; widened by: factor on the interval because the residuals are "
           "correlated in time (see docs/fitting.md).";
  t.header = {"parameter", "start", "estimate", "95 % interval", "sd, %", "widened by", "bounds", "started from"};
  for (const FitEstimate& e : result.estimates)
    t.rows.push_back({with_unit(e.spec.key, e.unit), short_number(e.start), short_number(e.value), interval_text(e),
                      std::isnan(e.sd) ? "-" : cell(100.0 * e.sd / std::abs(e.value), 1), cell(e.sd / e.white_sd, 1),
                      fmt::format("{} to {}", short_number(e.spec.lower), short_number(e.spec.upper)), e.started_from});
  return t;
}

ReportTable residual_table(const Identification& result) {
  ReportTable t;
  t.title = "Residuals";
  t.note = "Root mean square of measured less simulated, at the start values and with the fit.";
  t.header = {"record, channel", "unit", "samples", "left out", "rms at start", "rms with fit", "explained, %"};
  for (const RecordFit& record : result.records)
    for (const ChannelFit& c : record.channels) {
      const ShownUnit unit = shown_unit(c.unit);
      t.rows.push_back({record.name + ", " + c.channel, unit.name, std::to_string(c.samples),
                        std::to_string(c.missing + c.outliers), short_number(c.rms_before / unit.factor),
                        short_number(c.rms_after / unit.factor),
                        record.kind == FitRecordSpec::Kind::constant ? "-" : cell(100.0 * c.explained, 2)});
    }
  return t;
}

ReportTable decay_table(const Identification& result) {
  ReportTable t;
  t.title = "Decays";
  t.note = "Relative decrement of a cycle = p + q x mean amplitude; p from linear, q from quadratic damping.";
  t.header = {"record, channel", "", "period, s", "p", "q, per unit", "cycles"};
  for (const RecordFit& record : result.records)
    for (const DecayComparison& d : record.decays) {
      std::string unit;
      for (const ChannelFit& c : record.channels)
        if (c.channel == d.channel) unit = c.unit;
      const ShownUnit shown = shown_unit(unit);
      for (const auto& [what, line] : {std::pair{"measured", &d.measured}, std::pair{"simulated", &d.simulated}})
        t.rows.push_back({record.name + ", " + d.channel, line->usable() ? what : what + (": " + line->message),
                          cell(line->period, 3), cell(line->p, 4),
                          short_number(line->q * shown.factor) + "/" + shown.name, std::to_string(line->cycles.size())});
    }
  return t;
}

ReportTable cross_table(const Identification& result) {
  ReportTable t;
  t.title = "Cross-validation";
  t.note = "Each record predicted with what the others alone give, only its own start fitted: residual rms over that of the "
           "fit to all. Near 1: the records agree.";
  t.header = {"record left out", "rms ratio"};
  for (const FitEstimate& e : result.estimates) t.header.push_back(e.spec.key);
  for (const LeftOut& left : result.cross) {
    t.rows.push_back({left.record, cell(left.ratio, 3)});
    for (const double value : left.values) t.rows.back().push_back(short_number(value));
  }
  return t;
}

}  // namespace stillhook
