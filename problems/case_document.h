// A case file as a tree that remembers where everything stands. It is the only form the reader works on; the TOML
// library is seen by case_document.cpp alone.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace stillhook {

/// Where something was written: a place in the file, or on the command line.
struct Position {
  std::string origin;  // empty: the file; otherwise "--set KEY=VALUE"
  int line = 0, column = 0;
};

struct Node {
  enum class Kind { table, array, text, integer, number, boolean, date };
  Kind kind = Kind::table;
  Position position;                                  // of the key, of an array's item: of the value
  std::vector<std::pair<std::string, Node>> entries;  // table, in the order of the file
  std::vector<Node> items;                            // array
  std::string text;                                   // text; a date as written
  double number = 0.0;                                // number, integer
  std::int64_t integer = 0;
  bool boolean = false;

  Node* find(const std::string& key);
  const Node* find(const std::string& key) const;
  /// The entry of this name, added at the end if there is none.
  Node& at(const std::string& key);
  void remove(const std::string& key);
  bool is_number() const { return kind == Kind::number || kind == Kind::integer; }
  /// Array whose items are all tables, at least one.
  bool is_array_of_tables() const;
};

/// "a string", "an array of tables", ... for messages.
std::string kind_name(const Node& node);
/// The value as it would be written in TOML on one line, shortened to about 40 characters.
std::string short_value(const Node& node);

/// Reads TOML. Throws CaseError "name:line:col: ..." for text that is empty, binary, too large, too deep or not TOML.
Node parse_document(const std::string& text, const std::string& name);

/// Reads the VALUE of --set KEY=VALUE as a TOML value; a bare word counts as a string. Throws CaseError.
Node parse_value(const std::string& key, const std::string& value);

/// TOML text that parse_document reads back to the same tree: same values to the last bit, same order of entries.
std::string write_document(const Node& root);

}  // namespace stillhook
