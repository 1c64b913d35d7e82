#include "problems/case_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "problems/not_modelled.h"

namespace stillhook {
namespace {

bool is_plain_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '_' || c == '-';
  });
}

std::string wanted_kind(const Field& field) {
  switch (field.type) {
    case Field::Type::number:
      return "a number";
    case Field::Type::integer:
      return "a whole number";
    case Field::Type::boolean:
      return "true or false";
    case Field::Type::text:
    case Field::Type::name:
    case Field::Type::choice:
    case Field::Type::file:
      return "a string";
    case Field::Type::numbers:
      return field.sizes.empty() ? "a list of numbers"
                                 : fmt::format("a list of {} numbers", fmt::join(field.sizes, " or "));
    case Field::Type::points:
      return fmt::format("a list of rows of {} numbers", field.sizes.front());
    case Field::Type::table:
      return fmt::format("a table [{}]", field.key);
    case Field::Type::tables:
      return fmt::format("an array of tables [[{}]]", field.key);
    case Field::Type::map:
      return fmt::format("a table [{}]", field.key);
  }
  return {};
}

std::string got(const Node& value) {
  return ", got " + kind_name(value) + (value.kind == Node::Kind::table ? "" : " " + short_value(value));
}

}  // namespace

void TableReader::read(const Table& table, Node& node, void* object, const std::string& section) {
  std::vector<std::string> meant;  // by a key that is not known; told once, not also as missing
  for (const auto& [key, value] : node.entries) {
    if (table.find(key)) continue;
    findings_.add(value.position, section, key, unknown_key_sentence(table, key));
    for (const std::string& other : meant_keys(table, key)) meant.push_back(other);
  }
  const auto is_meant = [&meant](const Field& f) {
    return std::find(meant.begin(), meant.end(), f.key) != meant.end();
  };
  check_groups(table, node, section, meant);
  for (const Field& field : table.fields) {
    Node* value = node.find(field.key);
    if (!value) {
      if (!is_meant(field)) check_absent(table, field, node, section);
    } else if (!applies(table, field, node)) {
      findings_.add(
          value->position, section, field.key,
          fmt::format("has a meaning only with {} = \"{}\"", field.when_key, fmt::join(field.when, "\" or \"")));
    } else {
      read_field(field, *value, object, section);
    }
  }
}

bool TableReader::applies(const Table& table, const Field& field, const Node& node) const {
  if (field.when_key.empty()) return true;
  std::string choice;
  if (const Node* value = node.find(field.when_key)) {
    choice = value->text;
    const Field* key = table.find(field.when_key);
    // A choice that does not exist is an error of its own; what it would have allowed is not told twice.
    if (key && std::find(key->choices.begin(), key->choices.end(), choice) == key->choices.end()) return true;
  } else if (const Field* key = table.find(field.when_key)) {
    if (key->required) return true;  // its absence is told
    const auto by_default = table.default_of(*key);
    if (by_default) choice = std::get<std::string>(*by_default);
  }
  return std::find(field.when.begin(), field.when.end(), choice) != field.when.end();
}

void TableReader::check_groups(const Table& table, const Node& node, const std::string& section,
                               const std::vector<std::string>& meant) {
  std::map<std::string, std::vector<const Field*>> groups;
  std::map<std::string, const Field*> given;
  for (const Field& field : table.fields) {
    if (field.group.empty()) continue;
    groups[field.group].push_back(&field);
    const Node* value = node.find(field.key);
    if (!value) continue;
    const auto [first, is_first] = given.emplace(field.group, &field);
    if (!is_first)
      findings_.add(value->position, section, field.key,
                    fmt::format("cannot stand beside \"{}\", give one of them", first->second->key));
  }
  for (const auto& [group, fields] : groups) {
    if (given.count(group) || !fields.front()->group_required) continue;
    std::vector<std::string> keys;
    bool is_meant = false;
    for (const Field* field : fields) {
      keys.push_back("\"" + field->key + "\"");
      is_meant = is_meant || std::find(meant.begin(), meant.end(), field->key) != meant.end();
    }
    if (is_meant) continue;
    findings_.add(node.position, section, "",
                  fmt::format("needs its {}: give one of {}", group, fmt::join(keys, ", ")));
  }
}

void TableReader::check_absent(const Table& table, const Field& field, const Node& node, const std::string& section) {
  if (!field.required || !applies(table, field, node)) return;
  const Field* choice = field.when_key.empty() ? nullptr : table.find(field.when_key);
  if (choice && choice->required && !node.find(field.when_key)) return;  // first the choice
  if (choice) {
    const Node* value = node.find(field.when_key);
    if (value && std::find(field.when.begin(), field.when.end(), value->text) == field.when.end()) return;
    findings_.add(
        node.position, section, field.key,
        fmt::format("is required with {} = \"{}\"", field.when_key, value ? value->text : field.when.front()));
  } else {
    findings_.add(node.position, section, field.key, "is required");
  }
}

void TableReader::read_field(const Field& field, Node& value, void* object, const std::string& section) {
  const std::string here = (section.empty() ? "" : section + ".") + field.key;
  const auto refuse = [&] {
    findings_.add(value.position, section, field.key, "must be " + wanted_kind(field) + got(value));
  };
  switch (field.type) {
    case Field::Type::number:
    case Field::Type::integer:
      return read_number(field, value, object, section);
    case Field::Type::boolean:
      if (value.kind != Node::Kind::boolean) return refuse();
      return field.set(object, value.boolean);
    case Field::Type::text:
    case Field::Type::name:
    case Field::Type::choice:
    case Field::Type::file:
      return read_text(field, value, object, section);
    case Field::Type::numbers:
      return read_numbers(field, value, object, section);
    case Field::Type::points:
      return read_rows(field, value, object, section);
    case Field::Type::table:
      if (value.kind != Node::Kind::table) return refuse();
      return read(field.table(), value, field.open(object, {}), here);
    case Field::Type::tables:
      return read_entries(field, value, object, section);
    case Field::Type::map:
      if (value.kind != Node::Kind::table) return refuse();
      return read_map(field, value, object, here);
  }
}

bool TableReader::good_number(const Field& field, const Node& value, const std::string& section,
                              const std::string& which) {
  const auto refuse = [&](const std::string& sentence) {
    findings_.add(value.position, section, field.key, which + sentence);
    return false;
  };
  if (!value.is_number()) return refuse("must be a number" + got(value));
  if (!std::isfinite(value.number)) return refuse("must be a finite number, got " + short_value(value));
  if (!field.range.contains(value.number))
    return refuse(fmt::format("must be {}, got {}", field.range.text(field.unit), short_value(value)));
  return true;
}

void TableReader::read_number(const Field& field, const Node& value, void* object, const std::string& section) {
  if (field.type == Field::Type::integer && value.kind != Node::Kind::integer) {
    findings_.add(value.position, section, field.key, "must be a whole number" + got(value));
    return;
  }
  if (good_number(field, value, section, "")) field.set(object, value.number * field.unit.factor);
}

void TableReader::read_numbers(const Field& field, const Node& value, void* object, const std::string& section) {
  const bool right_size =
      field.sizes.empty() ? !value.items.empty()
                          : std::find(field.sizes.begin(), field.sizes.end(), value.items.size()) != field.sizes.end();
  if (value.kind != Node::Kind::array || !right_size) {
    findings_.add(value.position, section, field.key, "must be " + wanted_kind(field) + got(value));
    return;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < value.items.size(); ++i)
    if (good_number(field, value.items[i], section, fmt::format("item {} ", i + 1)))
      numbers.push_back(value.items[i].number * field.unit.factor);
  if (numbers.size() == value.items.size()) field.set(object, numbers);
}

void TableReader::read_rows(const Field& field, const Node& value, void* object, const std::string& section) {
  if (value.kind != Node::Kind::array || value.items.empty()) {
    findings_.add(value.position, section, field.key, "must be " + wanted_kind(field) + got(value));
    return;
  }
  const std::size_t width = field.sizes.front();
  if (width == 6 && value.items.size() != width) {
    findings_.add(value.position, section, field.key,
                  fmt::format("must have {} rows, got {}", width, value.items.size()));
    return;
  }
  std::vector<std::vector<double>> rows;
  bool good = true;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const Node& row = value.items[i];
    if (row.kind != Node::Kind::array || row.items.size() != width) {
      findings_.add(row.position, section, field.key,
                    fmt::format("row {} must be {} numbers{}", i + 1, width, got(row)));
      good = false;
      continue;
    }
    std::vector<double>& numbers = rows.emplace_back();
    for (const Node& item : row.items) {
      good = good_number(field, item, section, fmt::format("row {} ", i + 1)) && good;
      numbers.push_back(item.number * field.unit.factor);
    }
  }
  if (good) field.set(object, rows);
}

std::string TableReader::absolute_file(const std::string& name) const {
  const std::filesystem::path given(name);
  std::error_code error;
  const auto path =
      std::filesystem::absolute(given.is_absolute() ? given : directory_ / given, error).lexically_normal();
  return error ? name : path.string();
}

std::string TableReader::existing_file(const std::string& name) const {
  const std::string path = absolute_file(name);
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? path : std::string();
}

void TableReader::read_text(const Field& field, Node& value, void* object, const std::string& section) {
  const auto refuse = [&](const std::string& sentence) { findings_.add(value.position, section, field.key, sentence); };
  if (value.kind != Node::Kind::text) return refuse("must be " + wanted_kind(field) + got(value));
  if (value.text.empty() && field.type != Field::Type::text) return refuse("must not be empty");
  if (field.type == Field::Type::name && !is_plain_name(value.text))
    return refuse("may have letters, digits, _ and - only, got " + short_value(value));
  if (field.type == Field::Type::choice &&
      std::find(field.choices.begin(), field.choices.end(), value.text) == field.choices.end()) {
    const std::string missing = not_modelled(value.text);
    return refuse(fmt::format("{} \"{}\", got {}{}", field.choices.size() == 1 ? "can only be" : "must be one of",
                              fmt::join(field.choices, "\", \""), short_value(value),
                              missing.empty() ? did_you_mean(value.text, field.choices) : "; " + missing));
  }
  if (field.type == Field::Type::file) {
    const std::string path = field.may_be_missing ? absolute_file(value.text) : existing_file(value.text);
    if (path.empty()) return refuse("there is no file " + short_value(value) + " in the folder of the case");
    value.text = path;
  }
  if (field.reference != Reference::none) {
    if (value.text.empty()) return refuse("must not be empty");
    references_.push_back({field.reference, value.text, value.position, section, field.key});
  }
  field.set(object, value.text);
}

void TableReader::read_entries(const Field& field, Node& array, void* object, const std::string& section) {
  if (array.kind != Node::Kind::array || (!array.items.empty() && !array.is_array_of_tables())) {
    findings_.add(array.position, section, field.key, "must be " + wanted_kind(field) + got(array));
    return;
  }
  const std::string here = (section.empty() ? "" : section + ".") + field.key;
  if (array.items.empty() && field.required)
    findings_.add(array.position, section, field.key, "must have at least one entry");
  std::map<std::string, Position> seen;
  for (std::size_t i = 0; i < array.items.size(); ++i) {
    Node& entry = array.items[i];
    const Node* name = entry.find(field.entry_name);
    std::string label = fmt::format("{}[{}]", here, i + 1);
    if (name && name->kind == Node::Kind::text && !name->text.empty()) {
      label = here + "." + name->text;
      const auto [first, is_new] = seen.emplace(name->text, name->position);
      if (!is_new)
        findings_.add(name->position, here, field.entry_name,
                      fmt::format("\"{}\" is used twice, first in line {}", name->text, first->second.line));
    }
    read(field.table(), entry, field.open(object, {}), label);
  }
}

void TableReader::read_map(const Field& field, Node& map, void* object, const std::string& section) {
  for (auto& [name, entry] : map.entries) {
    if (entry.kind != Node::Kind::table) {
      findings_.add(entry.position, section, name,
                    "must be a table like { " + field.table().fields.front().key + " = ... }" + got(entry));
      continue;
    }
    read(field.table(), entry, field.open(object, name), section + "." + as_step(name));
  }
}

}  // namespace stillhook
