#include "problems/case_sources.h"

#include <map>
#include <sstream>

#include "problems/case_document.h"

namespace stillhook {
namespace {

/// A value with its line in the text that it was parsed from.
struct Leaf {
  std::string key, value;
  int line = 0;
};

/// What --set calls an entry of an array of tables.
std::string step_name(const Node& item, std::size_t index) {
  for (const char* key : {"name", "drive"})
    if (const Node* name = item.find(key); name && name->kind == Node::Kind::text) return name->text;
  return std::to_string(index);
}

void collect(const Node& node, const std::string& path, std::vector<Leaf>& leaves) {
  const auto below = [&](const std::string& step) { return path.empty() ? step : path + "." + step; };
  if (node.kind == Node::Kind::table) {
    for (const auto& [key, child] : node.entries) collect(child, below(key), leaves);
  } else if (node.is_array_of_tables()) {
    for (std::size_t i = 0; i < node.items.size(); ++i)
      collect(node.items[i], below(step_name(node.items[i], i)), leaves);
  } else {
    leaves.push_back({path, short_value(node), node.position.line});
  }
}

std::vector<Leaf> leaves_of(const std::string& text, const std::string& name) {
  std::vector<Leaf> leaves;
  collect(parse_document(text, name), "", leaves);
  return leaves;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What follows the first # that is not inside a string.
std::string remark_in(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote == 0 && line[i] == '#') {
      const std::size_t from = line.find_first_not_of(" \t", i + 1);
      return from == std::string::npos ? "" : line.substr(from, line.find_last_not_of(" \t\r") + 1 - from);
    }
    if (quote == '"' && line[i] == '\\')
      ++i;
    else if (quote != 0 && line[i] == quote)
      quote = 0;
    else if (quote == 0 && (line[i] == '"' || line[i] == '\''))
      quote = line[i];
  }
  return {};
}

/// Whether a key that may hold "*" means this one.
bool means(const std::string& pattern, const std::string& key) {
  std::istringstream a(pattern), b(key);
  std::string step, other;
  while (std::getline(a, step, '.')) {
    if (!std::getline(b, other, '.')) return false;
    if (step != "*" && step != other) return false;
  }
  return true;  // the key itself, or one inside the table that was set
}

}  // namespace

std::vector<CaseSource> case_sources(const Case& c) {
  std::map<std::string, std::string> remarks;
  const std::vector<std::string> lines = lines_of(c.text);
  for (const Leaf& leaf : leaves_of(c.text, c.file))
    if (leaf.line > 0 && static_cast<std::size_t>(leaf.line) <= lines.size())
      remarks[leaf.key] = remark_in(lines[static_cast<std::size_t>(leaf.line) - 1]);
  std::vector<CaseSource> sources;
  for (const Leaf& leaf : leaves_of(resolved_text(c), c.file)) {
    std::string remark = remarks[leaf.key];
    for (const Override& o : c.overrides)
      if (means(o.key, leaf.key)) remark = "set on top of the case file";
    sources.push_back({leaf.key, leaf.value, remark});
  }
  return sources;
}

std::string text_with_remarks(const Case& c) {
  std::vector<std::string> lines = lines_of(resolved_text(c));
  const std::vector<CaseSource> sources = case_sources(c);
  const std::vector<Leaf> leaves = leaves_of(resolved_text(c), c.file);  // the same values in the same order
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const std::size_t line = static_cast<std::size_t>(leaves[i].line);
    if (sources[i].remark.empty() || line == 0 || line > lines.size()) continue;
    if (!remark_in(lines[line - 1]).empty()) continue;  // several values on one line: the first has it
    lines[line - 1] += "  # " + sources[i].remark;
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace stillhook
