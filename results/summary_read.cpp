#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "results/files.h"
#include "results/json_number.h"
#include "results/summary.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

RunStatus status_of(const std::string& name) {
  for (const RunStatus status : {RunStatus::completed, RunStatus::interrupted, RunStatus::diverged, RunStatus::failed})
    if (status_name(status) == name) return status;
  return RunStatus::not_run;
}

Metrics metrics_of(const Json& document) {
  Metrics metrics;
  for (const auto& [name, m] : document.at("metrics").items()) {
    Metric metric{name,
                  m.at("unit").get<std::string>(),
                  number_of(m.at("value")),
                  number_of(m.at("time")),
                  m.at("phase").get<std::string>(),
                  m.value("scenario", std::string()),
                  {}};
    if (m.contains("by_phase"))  // older runs have none
      for (const auto& [phase, value] : m.at("by_phase").items()) metric.by_phase.push_back({phase, number_of(value)});
    metrics.items.push_back(std::move(metric));
  }
  return metrics;
}

std::vector<LimitCheck> limits_of(const Json& document) {
  std::vector<LimitCheck> limits;
  for (const Json& l : document.at("limits")) {
    LimitCheck check;
    check.metric = l.at("name").get<std::string>();
    check.unit = l.at("unit").get<std::string>();
    check.source = l.at("source").get<std::string>();
    check.phase = l.at("phase").get<std::string>();
    check.is_max = l.at("sense") == "max";
    check.value = number_of(l.at("value"));
    check.limit = number_of(l.at("limit"));
    check.margin = number_of(l.at("margin"));
    check.time = number_of(l.at("time"));
    check.hard = l.at("hard").get<bool>();
    check.pass = l.at("pass").get<bool>();
    check.scenario = l.value("scenario", std::string());
    limits.push_back(check);
  }
  return limits;
}

Summary summary_of(const Json& document) {
  Summary summary;
  const std::string program = document.at("program").get<std::string>();
  summary.program_version = program.substr(program.find(' ') + 1);
  summary.date = document.value("date", std::string());  // older runs have none
  summary.case_name = document.at("case").get<std::string>();
  summary.verb = document.at("verb").get<std::string>();
  summary.sea = document.at("sea").get<std::string>();
  summary.status = status_of(document.at("status").get<std::string>());
  summary.message = document.at("message").get<std::string>();
  summary.warnings = document.at("warnings").get<std::vector<std::string>>();
  summary.simulated = number_of(document.at("simulated_s"));
  summary.wall = number_of(document.at("wall_s"));
  summary.metrics = metrics_of(document);
  summary.metrics.status = summary.status;
  summary.metrics.message = summary.message;
  summary.limits = limits_of(document);
  return summary;
}

}  // namespace

Summary read_summary(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw FileError(path + ": cannot be read");
  try {
    return summary_of(Json::parse(in));
  } catch (const Json::exception& error) {
    throw FileError(path + ": is not the summary of a run: " + error.what());
  }
}

}  // namespace stillhook
