#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/verbs/fit/fit_report.h"
#include "planner/version.h"
#include "results/json_number.h"
#include "results/summary.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json line_json(const DecayLine& line) {
  return {{"period_s", json_number(line.period)},
          {"p", json_number(line.p)},
          {"q", json_number(line.q)},
          {"message", line.message}};
}

Json record_json(const RecordFit& record) {
  Json channels = Json::array(), own = Json::array(), decays = Json::array();
  for (const ChannelFit& c : record.channels)
    channels.push_back({{"channel", c.channel},
                        {"unit", c.unit},
                        {"samples", c.samples},
                        {"missing", c.missing},
                        {"outliers", c.outliers},
                        {"rms_start", json_number(c.rms_before)},
                        {"rms_fit", json_number(c.rms_after)},
                        {"explained", json_number(c.explained)},
                        {"samples_per_independent", json_number(c.correlation_time)}});
  for (const OwnEstimate& o : record.own)
    own.push_back({{"name", o.name}, {"unit", o.unit}, {"value", json_number(o.value)}, {"sd", json_number(o.sd)}});
  for (const DecayComparison& d : record.decays)
    decays.push_back(
        {{"channel", d.channel}, {"measured", line_json(d.measured)}, {"simulated", line_json(d.simulated)}});
  return {{"name", record.name},  {"file", record.file}, {"rows", record.rows}, {"interval_s", record.interval},
          {"channels", channels}, {"own", own},          {"decays", decays}};
}

}  // namespace

std::string fit_summary(const Case& c, const Identification& result, const std::vector<std::string>& files,
                        const std::string& date) {
  Json document = summary_envelope(kVersion, date, c.name, "fit");
  document["status"] = result.interrupted ? "interrupted" : result.usable ? "completed" : "diverged";
  document["message"] = result.message;
  document["trusted"] = result.trusted;
  document["warnings"] = result.warnings;
  document["notes"] = result.notes;
  document["wall_s"] = json_number(result.wall);
  document["iterations"] = result.iterations;
  document["simulations"] = result.simulations;
  document["files"] = files;
  Json& estimates = document["estimates"] = Json::array();
  for (const FitEstimate& e : result.estimates)
    estimates.push_back({{"name", e.spec.key},
                         {"unit", e.unit},
                         {"value", json_number(e.value)},
                         {"low", json_number(e.low)},
                         {"high", json_number(e.high)},
                         {"sd", json_number(e.sd)},
                         {"sd_white", json_number(e.white_sd)},
                         {"start", json_number(e.start)},
                         {"started_from", e.started_from},
                         {"lower", json_number(e.spec.lower)},
                         {"upper", json_number(e.spec.upper)},
                         {"at_bound", e.at_bound},
                         {"determined", !e.no_influence}});
  Json& correlation = document["correlation"] = Json::array();
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < result.correlation.cols(); ++j) row.push_back(json_number(result.correlation(i, j)));
    correlation.push_back(row);
  }
  Json& pairs = document["inseparable"] = Json::array();
  for (const Inseparable& pair : result.inseparable)
    pairs.push_back({{"a", result.estimates[static_cast<std::size_t>(pair.a)].spec.key},
                     {"b", result.estimates[static_cast<std::size_t>(pair.b)].spec.key},
                     {"correlation", json_number(pair.correlation)},
                     {"test", pair.test}});
  Json& records = document["records"] = Json::array();
  for (const RecordFit& record : result.records) records.push_back(record_json(record));
  Json& cross = document["cross_validation"] = Json::array();
  for (const LeftOut& left : result.cross)
    cross.push_back({{"record", left.record}, {"rms_ratio", json_number(left.ratio)}, {"values", left.values}});
  return summary_text(document);
}

}  // namespace stillhook
