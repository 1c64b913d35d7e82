#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/fit_report.h"
#include "planner/version.h"
#include "results/summary.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json line_json(const DecayLine& line) {
  return {{"period_s", number(line.period)}, {"p", number(line.p)}, {"q", number(line.q)}, {"message", line.message}};
}

Json record_json(const RecordFit& record) {
  Json channels = Json::array(), own = Json::array(), decays = Json::array();
  for (const ChannelFit& c : record.channels)
    channels.push_back({{"channel", c.channel},
                        {"unit", c.unit},
                        {"samples", c.samples},
                        {"missing", c.missing},
                        {"outliers", c.outliers},
                        {"rms_start", number(c.rms_before)},
                        {"rms_fit", number(c.rms_after)},
                        {"explained", number(c.explained)},
                        {"samples_per_independent", number(c.correlation_time)}});
  for (const OwnEstimate& o : record.own)
    own.push_back({{"name", o.name}, {"unit", o.unit}, {"value", number(o.value)}, {"sd", number(o.sd)}});
  for (const DecayComparison& d : record.decays)
    decays.push_back({{"channel", d.channel}, {"measured", line_json(d.measured)}, {"simulated", line_json(d.simulated)}});
  return {{"name", record.name},         {"file", record.file}, {"rows", record.rows},
          {"interval_s", record.interval}, {"channels", channels}, {"own", own}, {"decays", decays}};
}

}  // namespace

std::string fit_summary(const Case& c, const Identification& result, const std::vector<std::string>& files) {
  Json document;
  document["schema_version"] = Summary::kSchemaVersion;
  document["program"] = std::string("stillhook ") + kVersion;
  document["case"] = c.name;
  document["verb"] = "fit";
  document["status"] = result.interrupted ? "interrupted" : result.usable ? "completed" : "diverged";
  document["message"] = result.message;
  document["trusted"] = result.trusted;
  document["warnings"] = result.warnings;
  document["notes"] = result.notes;
  document["wall_s"] = number(result.wall);
  document["iterations"] = result.iterations;
  document["simulations"] = result.simulations;
  document["files"] = files;
  Json& estimates = document["estimates"] = Json::array();
  for (const FitEstimate& e : result.estimates)
    estimates.push_back({{"name", e.spec.key},
                         {"unit", e.unit},
                         {"value", number(e.value)},
                         {"low", number(e.low)},
                         {"high", number(e.high)},
                         {"sd", number(e.sd)},
                         {"sd_white", number(e.white_sd)},
                         {"start", number(e.start)},
                         {"started_from", e.started_from},
                         {"lower", number(e.spec.lower)},
                         {"upper", number(e.spec.upper)},
                         {"at_bound", e.at_bound},
                         {"determined", !e.no_influence}});
  Json& correlation = document["correlation"] = Json::array();
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < result.correlation.cols(); ++j) row.push_back(number(result.correlation(i, j)));
    correlation.push_back(row);
  }
  Json& pairs = document["inseparable"] = Json::array();
  for (const Inseparable& pair : result.inseparable)
    pairs.push_back({{"a", result.estimates[static_cast<std::size_t>(pair.a)].spec.key},
                     {"b", result.estimates[static_cast<std::size_t>(pair.b)].spec.key},
                     {"correlation", number(pair.correlation)},
                     {"test", pair.test}});
  Json& records = document["records"] = Json::array();
  for (const RecordFit& record : result.records) records.push_back(record_json(record));
  Json& cross = document["cross_validation"] = Json::array();
  for (const LeftOut& left : result.cross)
    cross.push_back({{"record", left.record}, {"rms_ratio", number(left.ratio)}, {"values", left.values}});
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace stillhook
