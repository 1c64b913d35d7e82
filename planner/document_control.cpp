#include "planner/document_control.h"

#include <ctime>
#include <fstream>
#include <iterator>

#include "results/sha256.h"

namespace stillhook {

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

DocumentControl document_control(const Case& c, const std::string& date, const std::string& case_file) {
  DocumentControl control{c.project, c.revision, c.author, c.checked_by, date, ""};
  if (std::ifstream in(case_file, std::ios::binary); in)
    control.case_hash = sha256(std::string(std::istreambuf_iterator<char>(in), {}));
  return control;
}

}  // namespace stillhook
