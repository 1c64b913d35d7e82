// The head that every summary.json has, whichever verb wrote it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace stillhook {

/// schema_version, program, date, case, verb: the first keys of a summary, to which the verb adds its own.
nlohmann::ordered_json summary_envelope(const std::string& program_version, const std::string& date,
                                        const std::string& case_name, const std::string& verb);

/// The document as text, a line break at its end. Names come from case files: bytes that are not UTF-8 are replaced.
std::string summary_text(const nlohmann::ordered_json& document);

}  // namespace stillhook
