#include "results/judgement.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "results/files.h"
#include "results/json_number.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ReportTable& table) {
  return {{"title", table.title}, {"note", table.note}, {"header", table.header}, {"rows", table.rows}};
}

Json json_of(const SensitivityTable& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const SensitivityTable::Column& c : table.columns) columns.push_back({{"metric", c.metric}, {"unit", c.unit}});
  for (const SensitivityTable::Row& r : table.rows) {
    Json derivative = Json::array();
    for (const double d : r.derivative) derivative.push_back(json_number(d));
    rows.push_back({{"key", r.key}, {"range", json_number(r.range)}, {"derivative", derivative}});
  }
  return {{"note", table.note}, {"columns", columns}, {"rows", rows}};
}

ReportTable table_in(const Json& j) {
  return {j.at("title").get<std::string>(), j.at("note").get<std::string>(),
          j.at("header").get<std::vector<std::string>>(), j.at("rows").get<std::vector<std::vector<std::string>>>()};
}

SensitivityTable sensitivities_in(const Json& j) {
  SensitivityTable table;
  table.note = j.at("note").get<std::string>();
  for (const Json& c : j.at("columns"))
    table.columns.push_back({c.at("metric").get<std::string>(), c.at("unit").get<std::string>()});
  for (const Json& r : j.at("rows")) {
    table.rows.push_back({r.at("key").get<std::string>(), number_of(r.at("range")), {}});
    for (const Json& d : r.at("derivative")) table.rows.back().derivative.push_back(number_of(d));
  }
  return table;
}

}  // namespace

void write_judgement(const Judgement& judgement, const std::string& path) {
  Json document;
  document["tables"] = Json::array();
  for (const ReportTable& table : judgement.tables) document["tables"].push_back(json_of(table));
  document["sensitivities"] = judgement.sensitivities ? json_of(*judgement.sensitivities) : Json(nullptr);
  document["certificate"] = judgement.certificate;
  document["certificate_kept"] = judgement.certificate_kept;
  write_file(path, document.dump(2) + "\n");
}

Judgement read_judgement(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw FileError(path + ": cannot be read");
  try {
    const Json document = Json::parse(in);
    Judgement judgement;
    for (const Json& table : document.at("tables")) judgement.tables.push_back(table_in(table));
    if (const Json& s = document.at("sensitivities"); !s.is_null()) judgement.sensitivities = sensitivities_in(s);
    judgement.certificate = document.value("certificate", std::string());  // older ones have none
    judgement.certificate_kept = document.value("certificate_kept", true);
    return judgement;
  } catch (const Json::exception& error) {
    throw FileError(path + ": is no judgement of a plan: " + error.what());
  }
}

}  // namespace stillhook
