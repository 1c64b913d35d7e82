#include "problems/case_document.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "problems/case.h"

namespace stillhook {
namespace {

constexpr std::size_t kLargestFile = 4u << 20;  // bytes; a case of a thousand bodies has a tenth of it
constexpr int kDeepestNesting = 32;             // the format itself needs 6

Position position_of(const toml::source_region& region, const std::string& origin) {
  return {origin, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

bool before(const Position& a, const Position& b) { return a.line != b.line ? a.line < b.line : a.column < b.column; }

/// Where a table first shows: implicit tables and arrays of tables have no key of their own in every case.
Position first_position(const Node& node) {
  Position best = node.position;
  const auto consider = [&best](const Position& p) {
    if (p.line > 0 && (best.line == 0 || before(p, best))) best = p;
  };
  for (const auto& [key, child] : node.entries) consider(first_position(child));
  for (const Node& item : node.items) consider(first_position(item));
  return best;
}

Node convert(const toml::node& from, const std::string& origin) {
  Node to;
  to.position = position_of(from.source(), origin);
  if (const toml::table* table = from.as_table()) {
    to.kind = Node::Kind::table;
    for (const auto& [key, value] : *table) {
      Node child = convert(value, origin);
      if (key.source().begin.line > 0) child.position = position_of(key.source(), origin);
      to.entries.emplace_back(std::string(key.str()), std::move(child));
    }
    // The library sorts by name; the order of the file is what a user expects to meet again.
    std::stable_sort(to.entries.begin(), to.entries.end(), [](const auto& a, const auto& b) {
      return before(first_position(a.second), first_position(b.second));
    });
  } else if (const toml::array* array = from.as_array()) {
    to.kind = Node::Kind::array;
    for (const toml::node& item : *array) to.items.push_back(convert(item, origin));
  } else if (from.is_string()) {
    to.kind = Node::Kind::text;
    to.text = from.as_string()->get();
  } else if (from.is_integer()) {
    to.kind = Node::Kind::integer;
    to.integer = from.as_integer()->get();
    to.number = static_cast<double>(to.integer);
  } else if (from.is_floating_point()) {
    to.kind = Node::Kind::number;
    to.number = from.as_floating_point()->get();
  } else if (from.is_boolean()) {
    to.kind = Node::Kind::boolean;
    to.boolean = from.as_boolean()->get();
  } else {
    to.kind = Node::Kind::date;
    std::ostringstream out;
    if (from.is_date()) out << from.as_date()->get();
    if (from.is_time()) out << from.as_time()->get();
    if (from.is_date_time()) out << from.as_date_time()->get();
    to.text = out.str();
  }
  return to;
}

/// Deepest nesting of brackets outside strings and comments, and where it goes too deep.
void refuse_deep_nesting(const std::string& text, const std::string& name) {
  int depth = 0, line = 1, column = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    ++column;
    if (c == '\n') {
      ++line;
      column = 0;
      quote = 0;
    } else if (quote) {
      if (c == '\\' && quote == '"') ++i, ++column;
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestNesting)
        throw CaseError(
            fmt::format("{}:{}:{}: brackets are nested deeper than {}", name, line, column, kDeepestNesting));
    } else if (c == ']' || c == '}') {
      depth = std::max(0, depth - 1);
    }
  }
}

void refuse_unreadable(const std::string& text, const std::string& name) {
  if (text.size() > kLargestFile)
    throw CaseError(
        fmt::format("{}:1:1: the file has {} bytes, a case may have at most {}", name, text.size(), kLargestFile));
  if (text.find('\0') != std::string::npos) throw CaseError(name + ":1:1: is a binary file, not a case in TOML text");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw CaseError(name + ":1:1: is empty");
  refuse_deep_nesting(text, name);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  return out + "\"";
}

std::string written_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string written_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);  // the shortest form that reads back to the same bits
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string written_value(const Node& node) {
  switch (node.kind) {
    case Node::Kind::text:
      return quoted(node.text);
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::number:
      return written_number(node.number);
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::date:
      return node.text;
    case Node::Kind::array: {
      std::string out = "[";
      for (std::size_t i = 0; i < node.items.size(); ++i) out += (i ? ", " : "") + written_value(node.items[i]);
      return out + "]";
    }
    case Node::Kind::table: {
      std::string out = "{ ";
      for (std::size_t i = 0; i < node.entries.size(); ++i)
        out += (i ? ", " : "") + written_key(node.entries[i].first) + " = " + written_value(node.entries[i].second);
      return out + " }";
    }
  }
  return {};
}

void write_table(const Node& table, const std::string& path, std::string& out) {
  for (const auto& [key, value] : table.entries)
    if (value.kind != Node::Kind::table && !value.is_array_of_tables())
      out += written_key(key) + " = " + written_value(value) + "\n";
  for (const auto& [key, value] : table.entries) {
    const std::string child = (path.empty() ? "" : path + ".") + written_key(key);
    if (value.kind == Node::Kind::table) {
      out += "\n[" + child + "]\n";
      write_table(value, child, out);
    } else if (value.is_array_of_tables()) {
      for (const Node& item : value.items) {
        out += "\n[[" + child + "]]\n";
        write_table(item, child, out);
      }
    }
  }
}

/// Last line before `before` with the header "[name]" or "[[name]]", or with a key "name =": of all the tables that may have
/// such a key the one above is meant. 0 if there is none.
int earlier_line_of(const std::string& text, const std::string& name, int before) {
  std::istringstream lines(text);
  int number = 0, found = 0;
  for (std::string line; std::getline(lines, line) && ++number < before;) {
    std::string bare;
    for (const char c : line.substr(0, line.find('#')))
      if (c != ' ' && c != '\t' && c != '[' && c != ']' && c != '"' && c != '\r') bare += c;
    const bool header = line.find_first_not_of(" \t") != std::string::npos && line[line.find_first_not_of(" \t")] == '[';
    const bool same_header = header && (bare == name || bare.ends_with("." + name));
    if (same_header || (!header && bare.starts_with(name + "="))) found = number;
  }
  return found;
}

/// What the parser objects to, as a user would say it.
std::string parse_fault(const std::string& text, const std::string& description, int line) {
  // "... cannot redefine existing table 'operation'": TOML allows a table or a key once.
  const std::size_t again = description.find("cannot redefine existing "), quote = description.find('\'');
  if (again == std::string::npos || quote == std::string::npos) return "is not TOML: " + description;
  const std::string name = description.substr(quote + 1, description.rfind('\'') - quote - 1);
  const bool table = description.find(" table header") != std::string::npos;
  const int first = earlier_line_of(text, name, line);
  return fmt::format("{} stands twice{}: {}", table ? "the table [" + name + "]" : "the key \"" + name + "\"",
                     first > 0 ? fmt::format(", first in line {}", first) : std::string(),
                     table ? "put its keys together under one" : "remove one of them");
}

}  // namespace

Node* Node::find(const std::string& key) {
  for (auto& [name, child] : entries)
    if (name == key) return &child;
  return nullptr;
}

const Node* Node::find(const std::string& key) const { return const_cast<Node*>(this)->find(key); }

Node& Node::at(const std::string& key) {
  if (Node* found = find(key)) return *found;
  return entries.emplace_back(key, Node{}).second;
}

void Node::remove(const std::string& key) {
  entries.erase(std::remove_if(entries.begin(), entries.end(), [&key](const auto& e) { return e.first == key; }),
                entries.end());
}

bool Node::is_array_of_tables() const {
  return kind == Kind::array && !items.empty() &&
         std::all_of(items.begin(), items.end(), [](const Node& n) { return n.kind == Kind::table; });
}

std::string kind_name(const Node& node) {
  switch (node.kind) {
    case Node::Kind::table:
      return "a table";
    case Node::Kind::array:
      return node.is_array_of_tables() ? "an array of tables" : "an array";
    case Node::Kind::text:
      return "a string";
    case Node::Kind::integer:
      return "an integer";
    case Node::Kind::number:
      return "a number";
    case Node::Kind::boolean:
      return "a boolean";
    case Node::Kind::date:
      return "a date";
  }
  return {};
}

std::string short_value(const Node& node) {
  std::string text = node.kind == Node::Kind::number ? fmt::format("{}", node.number) : written_value(node);
  if (text.size() <= 40) return text;
  std::size_t cut = 37;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) --cut;  // not inside a UTF-8 sequence
  return text.substr(0, cut) + "...";
}

Node parse_document(const std::string& text, const std::string& name) {
  refuse_unreadable(text, name);
  try {
    return convert(toml::parse(text, name), {});
  } catch (const toml::parse_error& error) {
    const auto line = static_cast<int>(error.source().begin.line);
    throw CaseError(fmt::format("{}:{}:{}: {}", name, line, error.source().begin.column,
                                parse_fault(text, std::string(error.description()), line)));
  }
}

Node parse_value(const std::string& key, const std::string& value) {
  const std::string origin = "--set " + key + "=" + value;
  const auto is_word_character = [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '_' || c == '-' || c == '.' || c == '/';
  };
  refuse_unreadable(value, origin);
  try {
    const toml::table parsed = toml::parse("v = " + value);
    if (parsed.size() == 1 && parsed.get("v")) return convert(*parsed.get("v"), origin);
  } catch (const toml::parse_error&) {
    if (std::all_of(value.begin(), value.end(), is_word_character)) {
      Node word;
      word.kind = Node::Kind::text;
      word.text = value;
      word.position = {origin, 1, 1};
      return word;
    }
  }
  throw CaseError(origin + ": the value is not TOML; write a number, true, false, \"text\" or [1, 2, 3]");
}

std::string write_document(const Node& root) {
  std::string out;
  write_table(root, {}, out);
  return out;
}

}  // namespace stillhook
