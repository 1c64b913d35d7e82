#include "problems/schema.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "problems/case_format.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const Table& table);

void add_range(Json& schema, const Range& range) {
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) schema["maximum"] = range.high;
}

Json number_schema(const Field& field, const char* type) {
  Json schema = {{"type", type}};
  add_range(schema, field.range);
  return schema;
}

Json list_schema(Json items, const std::vector<std::size_t>& sizes) {
  Json schema = {{"type", "array"}, {"items", std::move(items)}};
  schema["minItems"] = sizes.empty() ? 1 : sizes.front();
  if (!sizes.empty()) schema["maxItems"] = sizes.back();
  if (sizes.size() > 1)  // as many as one of them, not as many as lie in between
    for (const std::size_t size : sizes) schema["anyOf"].push_back({{"minItems", size}, {"maxItems", size}});
  return schema;
}

Json schema_of(const Field& field) {
  switch (field.type) {
    case Field::Type::number:
      return number_schema(field, "number");
    case Field::Type::integer:
      return number_schema(field, "integer");
    case Field::Type::boolean:
      return {{"type", "boolean"}};
    case Field::Type::text:
      if (field.reference != Reference::none) return {{"type", "string"}, {"minLength", 1}};
      return {{"type", "string"}};
    case Field::Type::file:
      return {{"type", "string"}, {"minLength", 1}};
    case Field::Type::name:
      return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]+$"}};
    case Field::Type::choice:
      return {{"enum", field.choices}};
    case Field::Type::numbers:
      return list_schema(number_schema(field, "number"), field.sizes);
    case Field::Type::points:
      // Rows of six are those of a square matrix, others as many as there are points.
      return list_schema(list_schema(number_schema(field, "number"), field.sizes),
                         field.sizes.front() == 6 ? field.sizes : std::vector<std::size_t>{});
    case Field::Type::table:
      return schema_of(field.table());
    case Field::Type::tables: {
      Json schema = {{"type", "array"}, {"items", schema_of(field.table())}};
      if (field.required) schema["minItems"] = 1;
      return schema;
    }
    case Field::Type::map:
      return {{"type", "object"}, {"additionalProperties", schema_of(field.table())}};
  }
  return {};
}

/// "Mass. In t."; what an editor shows beside the key.
std::string description_of(const Field& field) {
  std::string text = field.doc;
  if (!field.unit.text.empty()) text += " In " + field.unit.text + ".";
  if (!field.when_key.empty())
    text += fmt::format(" Only with {} = {}.", field.when_key, fmt::join(field.when, " or "));
  return text;
}

Json json_value(const Value& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

/// Keys that have a meaning only with some choices: refused with the others, some of them required with these.
void add_choices(Json& all, const Table& table) {
  std::vector<std::string> done;
  for (const Field& first : table.fields) {
    const std::string rule = fmt::format("{}={}", first.when_key, fmt::join(first.when, ","));
    if (first.when_key.empty() || std::find(done.begin(), done.end(), rule) != done.end()) continue;
    done.push_back(rule);
    Json only = Json::object(), required = Json::array();
    for (const Field& field : table.fields) {
      if (field.when_key != first.when_key || field.when != first.when) continue;
      only[field.key] = false;
      if (field.required) required.push_back(field.key);
    }
    Json chosen = {{"properties", {{first.when_key, {{"enum", first.when}}}}}};
    const Field* choice = table.find(first.when_key);
    const auto value = choice ? table.default_of(*choice) : std::nullopt;
    const auto* text = value ? std::get_if<std::string>(&*value) : nullptr;
    const bool by_default = text && std::find(first.when.begin(), first.when.end(), *text) != first.when.end();
    if (!by_default) chosen["required"] = Json::array({first.when_key});
    Json entry = {{"if", chosen}};
    if (!required.empty()) entry["then"] = {{"required", required}};
    entry["else"] = {{"properties", only}};
    all.push_back(std::move(entry));
  }
}

/// Exactly one, or at most one, of the keys of each group.
void add_groups(Json& all, const Table& table) {
  std::vector<std::string> done;
  for (const Field& first : table.fields) {
    if (first.group.empty() || std::find(done.begin(), done.end(), first.group) != done.end()) continue;
    done.push_back(first.group);
    Json one = Json::array(), any = Json::array();
    for (const Field& field : table.fields) {
      if (field.group != first.group) continue;
      one.push_back({{"required", Json::array({field.key})}});
      any.push_back({{"required", Json::array({field.key})}});
    }
    if (!first.group_required) one.push_back({{"not", {{"anyOf", any}}}});
    all.push_back({{"oneOf", one}});
  }
}

Json schema_of(const Table& table) {
  Json schema = {{"type", "object"}, {"description", table.doc}, {"additionalProperties", false}};
  Json properties = Json::object(), required = Json::array();
  for (const Field& field : table.fields) {
    Json property = schema_of(field);
    property["description"] = description_of(field);
    if (const auto value = table.default_of(field); value && field.without.empty())
      property["default"] = json_value(*value);
    properties[field.key] = std::move(property);
    if (field.required && field.when_key.empty()) required.push_back(field.key);
  }
  schema["properties"] = std::move(properties);
  if (!required.empty()) schema["required"] = std::move(required);
  Json all = Json::array();
  add_choices(all, table);
  add_groups(all, table);
  if (!all.empty()) schema["allOf"] = std::move(all);
  return schema;
}

// ---- reference
// --------------------------------------------------------------------------------------------------------

std::string number_text(double v) { return fmt::format("{:.6g}", v == 0.0 ? 0.0 : v); }

std::string default_text(const Table& table, const Field& field) {
  if (field.required) return field.when_key.empty() ? "**required**" : "**required** then";
  if (!field.group.empty() && field.group_required) return "**one of** " + field.group;
  if (!field.without.empty()) return field.without;
  const auto value = table.default_of(field);
  if (!value) return "none";
  if (const auto* number = std::get_if<double>(&*value)) return number_text(*number);
  if (const auto* flag = std::get_if<bool>(&*value)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&*value)) return "`" + *text + "`";
  if (const auto* numbers = std::get_if<std::vector<double>>(&*value)) {
    std::vector<std::string> texts;
    for (const double v : *numbers) texts.push_back(number_text(v));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  return {};
}

std::string referred_text(Reference what) {
  switch (what) {
    case Reference::body:
      return "name of a body";
    case Reference::body_or_world:
      return "name of a body, or `world`";
    case Reference::joint:
      return "name of a joint";
    case Reference::drive:
      return "name of a drive";
    case Reference::wire:
      return "name of a wire";
    case Reference::contact:
      return "name of a contact";
    case Reference::sea_state:
      return "name of a sea state";
    case Reference::phase:
      return "name of a phase";
    case Reference::none:
      break;
  }
  return "text";
}

std::string type_text(const Field& field) {
  const std::string range = field.range.text(field.unit);
  const std::string tail = range.empty() ? (field.unit.text.empty() ? "" : ", " + field.unit.text) : " " + range;
  switch (field.type) {
    case Field::Type::number:
      return "number" + tail;
    case Field::Type::integer:
      return "whole number" + tail;
    case Field::Type::boolean:
      return "true, false";
    case Field::Type::text:
      return referred_text(field.reference);
    case Field::Type::name:
      return "name: letters, digits, `_`, `-`";
    case Field::Type::choice:
      return fmt::format("`{}`", fmt::join(field.choices, "`, `"));
    case Field::Type::file:
      return "file, from the case's folder";
    case Field::Type::numbers:
      return (field.sizes.empty() ? "numbers" : fmt::format("{} numbers", fmt::join(field.sizes, " or "))) + tail;
    case Field::Type::points:
      return fmt::format("rows of {} numbers", field.sizes.front()) + tail;
    case Field::Type::table:
      return "table";
    case Field::Type::tables:
      return "array of tables";
    case Field::Type::map:
      return "table by name";
  }
  return {};
}

void write_reference(const Table& table, const std::string& path, const Field* as, std::string& out) {
  if (!path.empty()) {
    const bool entries = as->type == Field::Type::tables;
    const std::string title = as->type == Field::Type::map ? "[" + path + "] NAME = { ... }"
                              : entries                    ? "[[" + path + "]]"
                                                           : "[" + path + "]";
    out += fmt::format("\n## `{}`\n\n{}", title, table.doc);
    if (entries) out += fmt::format(" Addressed by its `{}`.", as->entry_name);
    out += "\n";
  }
  out += "\n| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Field& field : table.fields) {
    std::string meaning = field.doc;
    if (!field.when_key.empty())
      meaning += fmt::format(" Only with `{}` = `{}`.", field.when_key, fmt::join(field.when, "` or `"));
    out += fmt::format("| `{}` | {} | {} | {} |\n", field.key, type_text(field), default_text(table, field), meaning);
  }
  for (const Field& field : table.fields)
    if (field.table) write_reference(field.table(), (path.empty() ? "" : path + ".") + field.key, &field, out);
}

}  // namespace

std::string json_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "stillhook case"}};
  schema.update(schema_of(case_table()));
  return schema.dump(2) + "\n";
}

std::string key_reference_markdown() {
  std::string out =
      "# The case format\n\n"
      "*Written by the program from the tables that its reader uses (`problems/case_format_*.cpp`).*\n\n"
      "A case is a TOML file. Every quantity carries its unit in the key (`mass_t`, `length_m`, `speed_m_per_min`); a "
      "key with "
      "another unit is refused, and so is a key that the format does not know. Frames: the world has z up and its "
      "origin on the "
      "mean free surface; a body's frame has x forward, y port, z up and the origin you choose. Roll + is port side "
      "up, pitch + "
      "bow down, yaw + bow to port. `world` names the fixed body.\n\n"
      "**Keys from outside.** `--set KEY=VALUE` and `[plan.variables]` name a key by its path: tables and entries of "
      "arrays "
      "as steps, an entry by its `name` (a move by its `drive`), `*` for every entry, a number for an item of a list "
      "(the "
      "first is 0). `sea.active`, `wires.hoist_port.slack_m`, `taglines.*.kp_kN_per_deg`, "
      "`operation.phases.hoist_up.moves.hoist.speed_m_per_min`, `bodies.load.position_m.2`. A name with dots may stand "
      "in "
      "double quotes. A key set from outside replaces the keys that exclude it, as `travel_m` does `goal`.\n\n"
      "**Defaults.** *required*: no default. *one of*: exactly one of the keys that share this word.\n\n"
      "## The document\n";
  write_reference(case_table(), {}, nullptr, out);
  return out;
}

}  // namespace stillhook
