// The part of JSON Schema (draft 2020-12) that the case schema uses, so that a test can hold it against the reader.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace stillhook {

/// What a schema objects to, each "path: keyword"; a required key that is missing as "path/key: required".
class SchemaCheck {
 public:
  using Json = nlohmann::json;

  std::vector<std::string> objections(const Json& schema, const Json& value, const std::string& path = "") const {
    std::vector<std::string> all;
    collect(schema, value, path, all);
    return all;
  }
  bool accepts(const Json& schema, const Json& value) const { return objections(schema, value).empty(); }

 private:
  using Objections = std::vector<std::string>;

  static bool is_of_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    throw std::invalid_argument("type " + type);
  }

  void collect(const Json& schema, const Json& value, const std::string& path, Objections& out) const {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) out.push_back(path + ": not allowed");
      return;
    }
    for (const auto& [keyword, rule] : schema.items()) {
      const auto object = [&](bool holds) {
        if (!holds) out.push_back(path + ": " + keyword);
      };
      if (keyword == "type")
        object(is_of_type(value, rule));
      else if (keyword == "enum")
        object(std::find(rule.begin(), rule.end(), value) != rule.end());
      else if (keyword == "minimum")
        object(!value.is_number() || value.get<double>() >= rule.get<double>());
      else if (keyword == "exclusiveMinimum")
        object(!value.is_number() || value.get<double>() > rule.get<double>());
      else if (keyword == "maximum")
        object(!value.is_number() || value.get<double>() <= rule.get<double>());
      else if (keyword == "minLength")
        object(!value.is_string() || value.get<std::string>().size() >= rule.get<std::size_t>());
      else if (keyword == "pattern")
        object(!value.is_string() || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
      else if (keyword == "minItems")
        object(!value.is_array() || value.size() >= rule.get<std::size_t>());
      else if (keyword == "maxItems")
        object(!value.is_array() || value.size() <= rule.get<std::size_t>());
      else
        collect_nested(keyword, rule, schema, value, path, out);
    }
  }

  void collect_nested(const std::string& keyword, const Json& rule, const Json& schema, const Json& value,
                      const std::string& path, Objections& out) const {
    if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
        collect(rule, value[i], path + "/" + std::to_string(i), out);
    } else if (keyword == "properties") {
      for (const auto& [key, sub] : rule.items())
        if (value.is_object() && value.contains(key)) collect(sub, value[key], path + "/" + key, out);
    } else if (keyword == "additionalProperties") {
      if (!value.is_object()) return;
      for (const auto& [key, entry] : value.items())
        if (!schema.contains("properties") || !schema["properties"].contains(key))
          collect(rule, entry, path + "/" + key, out);
    } else if (keyword == "required") {
      for (const Json& key : rule)
        if (value.is_object() && !value.contains(key.get<std::string>()))
          out.push_back(path + "/" + key.get<std::string>() + ": required");
    } else if (keyword == "allOf") {
      for (const Json& sub : rule) collect(sub, value, path, out);
    } else if (keyword == "anyOf" || keyword == "oneOf") {
      std::size_t accepting = 0;
      for (const Json& sub : rule) accepting += accepts(sub, value);
      if (keyword == "anyOf" ? accepting == 0 : accepting != 1) out.push_back(path + ": " + keyword);
    } else if (keyword == "not") {
      if (accepts(rule, value)) out.push_back(path + ": not");
    } else if (keyword == "if") {
      const char* branch = accepts(rule, value) ? "then" : "else";
      if (schema.contains(branch)) collect(schema[branch], value, path, out);
    } else if (keyword != "then" && keyword != "else" && keyword != "description" && keyword != "default" &&
               keyword != "title" && keyword != "$schema") {
      throw std::invalid_argument("the schema uses a keyword that this check does not know: " + keyword);
    }
  }
};

}  // namespace stillhook
