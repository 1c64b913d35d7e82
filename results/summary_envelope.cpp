#include "results/summary_envelope.h"

#include "results/summary.h"

namespace stillhook {

nlohmann::ordered_json summary_envelope(const std::string& program_version, const std::string& date,
                                        const std::string& case_name, const std::string& verb) {
  nlohmann::ordered_json document;
  document["schema_version"] = Summary::kSchemaVersion;
  document["program"] = "stillhook " + program_version;
  document["date"] = date;
  document["case"] = case_name;
  document["verb"] = verb;
  return document;
}

std::string summary_text(const nlohmann::ordered_json& document) {
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace stillhook
