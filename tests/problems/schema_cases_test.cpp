// The JSON Schema takes every case that is shipped or used here, and refuses what the reader refuses.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "problems/case_document.h"
#include "problems/schema.h"
#include "tests/problems/json_schema_check.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

SchemaCheck::Json json_of(const Node& node) {
  SchemaCheck::Json json;
  switch (node.kind) {
    case Node::Kind::table:
      json = SchemaCheck::Json::object();
      for (const auto& [key, value] : node.entries) json[key] = json_of(value);
      return json;
    case Node::Kind::array:
      json = SchemaCheck::Json::array();
      for (const Node& item : node.items) json.push_back(json_of(item));
      return json;
    case Node::Kind::text:
    case Node::Kind::date:
      return node.text;
    case Node::Kind::integer:
      return node.integer;
    case Node::Kind::number:
      return node.number;
    case Node::Kind::boolean:
      return node.boolean;
  }
  return json;
}

SchemaCheck::Json document_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return json_of(parse_document(text.str(), file.filename().string()));
}

std::vector<std::string> objections(const SchemaCheck::Json& document) {
  static const SchemaCheck::Json schema = SchemaCheck::Json::parse(json_schema());
  return SchemaCheck().objections(schema, document);
}

const fs::path kSource = STILLHOOK_SOURCE_DIR;

}  // namespace

TEST_CASE("every shipped case and every case of the tests is valid by the JSON Schema", "[case]") {
  int cases = 0;
  for (const char* folder : {"problems", "tests/problems/cases", "tests/planner/cases", "tests/validation/cases"})
    for (const fs::directory_entry& entry : fs::directory_iterator(kSource / folder)) {
      if (entry.path().extension() != ".toml") continue;
      CAPTURE(entry.path().string());
      CHECK(objections(document_of(entry.path())) == std::vector<std::string>{});
      ++cases;
    }
  CHECK(cases >= 10);
}

TEST_CASE("the JSON Schema refuses what is wrong with a case, where it is wrong", "[case]") {
  const SchemaCheck::Json good = document_of(kSource / "tests/planner/cases/small_lift.toml");
  const auto with = [&](const char* pointer, SchemaCheck::Json value) {
    SchemaCheck::Json changed = good;
    changed[SchemaCheck::Json::json_pointer(pointer)] = std::move(value);
    return objections(changed);
  };
  using Found = std::vector<std::string>;
  CHECK(with("/bodies/0/mass_t", -1.0) == Found{"/bodies/0/mass_t: exclusiveMinimum"});
  CHECK(with("/bodies/0/mass_kg", 1.0) == Found{"/bodies/0/mass_kg: not allowed"});
  CHECK_THAT(with("/sea/states/0/type", "rough"), Catch::VectorContains(std::string("/sea/states/0/type: enum")));
  CHECK(with("/sea/states/0/peak_period_s", 8.0) == Found{"/sea/states/0/peak_period_s: not allowed"});
  CHECK(with("/wires/0/slack_m", 0.1) == Found{"/wires/0: oneOf"});
  CHECK(with("/wires/0/from", "") == Found{"/wires/0/from: minLength"});
  CHECK(with("/bodies", SchemaCheck::Json::array()) == Found{"/bodies: minItems"});
  SchemaCheck::Json nameless = good;
  nameless["bodies"][1].erase("name");
  CHECK(objections(nameless) == Found{"/bodies/1/name: required"});
}
