#include <filesystem>
#include <fstream>
#include <sstream>

#include "planner/cli/commands.h"
#include "problems/case_sources.h"

namespace stillhook {

namespace {

std::vector<Override> overrides_of(const CommonOptions& options, const std::vector<Override>& more) {
  std::vector<Override> overrides;
  for (const std::string& set : options.sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set " + set + ": must be KEY=VALUE, as in --set sea.ramp_s=20");
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

}  // namespace

Case load_case(const CommonOptions& options, const std::vector<Override>& more) {
  return read_case(options.input, overrides_of(options, more));
}

Case load_case_text(const CommonOptions& options, const std::string& text, const std::vector<Override>& more) {
  const std::string folder = std::filesystem::path(options.input).parent_path().string();
  return read_case_text(text, options.input, folder.empty() ? "." : folder, overrides_of(options, more));
}

std::string statement_of(const std::string& case_file) {
  std::ifstream in(case_file);
  std::string statement, line;
  while (std::getline(in, line) && !line.empty() && line.front() == '#') {
    line.erase(0, line.size() > 1 && line[1] == ' ' ? 2 : 1);
    statement += line + "\n";
  }
  return statement;
}

std::string case_text(const Case& c, const std::string& statement) {
  std::string text;
  std::istringstream lines(statement);
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "#\n" : "# " + line + "\n";
  if (!text.empty()) text += "\n";
  return text + text_with_remarks(c);
}

}  // namespace stillhook
