// Every key of the case format, one by one from the field tables: a good value arrives in SI, and what is of a wrong
// type, not a number, outside the range, in another unit or out of place is refused, by the reader and by the JSON
// Schema alike.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <set>

#include "problems/case_format.h"
#include "problems/case_reader.h"
#include "problems/schema.h"
#include "tests/problems/json_schema_check.h"

using namespace stillhook;
using Json = nlohmann::json;

namespace {

const Json& whole_schema() {
  static const Json schema = Json::parse(json_schema());
  return schema;
}

/// Each table of the format once, with its part of the schema.
void for_each_table(const std::function<void(const Table&, const Json&)>& visit) {
  std::set<const Table*> seen;
  const std::function<void(const Table&, const Json&)> walk = [&](const Table& table, const Json& schema) {
    if (!seen.insert(&table).second) return;
    visit(table, schema);
    for (const Field& field : table.fields) {
      if (!field.table) continue;
      const Json& own = schema.at("properties").at(field.key);
      walk(field.table(), field.type == Field::Type::tables ? own.at("items")
                          : field.type == Field::Type::map  ? own.at("additionalProperties")
                                                            : own);
    }
  };
  walk(case_table(), whole_schema());
}

/// SI for one of what a key's ending says, written here anew. N, m, s, kg, rad.
double si_of(const std::string& suffix) {
  const double deg = std::acos(-1.0) / 180.0;
  static const std::map<std::string, double> factors = {{"", 1},
                                                        {"share", 1},
                                                        {"m", 1},
                                                        {"mm", 1e-3},
                                                        {"m2", 1},
                                                        {"s", 1},
                                                        {"h", 3600},
                                                        {"days", 86400},
                                                        {"deg", deg},
                                                        {"t", 1000},
                                                        {"t_m2", 1000},
                                                        {"t_m", 1000},
                                                        {"kg_per_m3", 1},
                                                        {"m_per_s", 1},
                                                        {"m_per_s2", 1},
                                                        {"m_per_min", 1.0 / 60},
                                                        {"rad_per_s", 1},
                                                        {"deg_per_s", deg},
                                                        {"deg_per_s2", deg},
                                                        {"share_per_min", 1.0 / 60},
                                                        {"share_per_s2", 1},
                                                        {"kN", 1000},
                                                        {"N_per_m", 1},
                                                        {"kN_per_m", 1000},
                                                        {"kN_s_per_m", 1000},
                                                        {"kN_s2_per_m2", 1000},
                                                        {"kN_m_per_rad", 1000},
                                                        {"kN_m_s_per_rad", 1000},
                                                        {"kN_s_m", 1000},
                                                        {"kN_m", 1000},
                                                        {"kN_m_s2_per_rad2", 1000},
                                                        {"kN_per_deg", 1e3 / deg},
                                                        {"kN_s_per_deg", 1e3 / deg}};
  const auto found = factors.find(suffix);
  if (found == factors.end()) FAIL("a unit that this test does not know: " << suffix);
  return found->second;
}

/// The longest ending of a key that is a unit with a factor; a share has none.
std::string unit_in(const std::string& key) {
  for (std::size_t at = key.find('_'); at != std::string::npos; at = key.find('_', at + 1)) {
    const std::string tail = key.substr(at + 1);
    static const std::set<std::string> known = {"m",
                                                "mm",
                                                "m2",
                                                "s",
                                                "h",
                                                "days",
                                                "deg",
                                                "t",
                                                "t_m2",
                                                "t_m",
                                                "kg_per_m3",
                                                "m_per_s",
                                                "m_per_s2",
                                                "m_per_min",
                                                "rad_per_s",
                                                "deg_per_s",
                                                "deg_per_s2",
                                                "share_per_min",
                                                "share_per_s2",
                                                "kN",
                                                "N_per_m",
                                                "kN_per_m",
                                                "kN_s_per_m",
                                                "kN_s2_per_m2",
                                                "kN_m_per_rad",
                                                "kN_m_s_per_rad",
                                                "kN_s_m",
                                                "kN_m",
                                                "kN_m_s2_per_rad2",
                                                "kN_per_deg",
                                                "kN_s_per_deg"};
    if (known.contains(tail)) return tail;
  }
  return {};
}

bool is_numeric(const Field& f) {
  return f.type == Field::Type::number || f.type == Field::Type::integer || f.type == Field::Type::numbers ||
         f.type == Field::Type::points;
}

/// A value inside the range; `which` makes several different ones.
double good_value(const Field& f, int which = 0) {
  const Range& r = f.range;
  const double share = 0.37 + 0.11 * which;
  double v = 1.7 + which;
  if (std::isfinite(r.low) && std::isfinite(r.high))
    v = r.low + std::min(share, 0.99) * (r.high - r.low);
  else if (std::isfinite(r.low))
    v = r.low + 1.7 + which;
  return f.type == Field::Type::integer ? std::ceil(v) : v;
}

/// A value as TOML, which for numbers, strings and lists is JSON too.
std::string list_of(const Field& f, std::size_t count, const std::string& instead_of_last = "") {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i)
    text += (i ? ", " : "") + (i + 1 == count && !instead_of_last.empty()
                                   ? instead_of_last
                                   : fmt::format("{:.15g}", good_value(f, static_cast<int>(i)) + 0.0));
  return text + "]";
}

std::size_t items_of(const Field& f) { return f.sizes.empty() ? 2 : f.sizes.front(); }

/// With a dot, so that TOML takes it for a number and not for a whole one.
std::string as_number(double v) {
  std::string text = fmt::format("{:.15g}", v);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// The field's value with `number` (TOML) in one place of it.
std::string value_with(const Field& f, const std::string& number) {
  if (f.type == Field::Type::numbers) return list_of(f, items_of(f), number);
  if (f.type != Field::Type::points) return number;
  const std::size_t rows = f.sizes.front() == 6 ? 6 : 2;
  std::string text = "[";
  for (std::size_t i = 0; i < rows; ++i)
    text += (i ? ", " : "") + list_of(f, f.sizes.front(), i + 1 == rows ? number : "");
  return text + "]";
}

std::string good_text(const Field& f) {
  switch (f.type) {
    case Field::Type::number:
      return as_number(good_value(f));
    case Field::Type::integer:
      return fmt::format("{:.0f}", good_value(f));
    case Field::Type::numbers:
    case Field::Type::points:
      return value_with(f, as_number(good_value(f, 1)));
    case Field::Type::boolean:
      return "true";
    case Field::Type::choice:
      return "\"" + f.choices.back() + "\"";
    case Field::Type::table:
    case Field::Type::map:
      return "{}";
    case Field::Type::tables:
      return "[{}]";
    default:
      return "\"some_name\"";
  }
}

/// The choice under which a field has a meaning, as a line of TOML.
std::string choice_for(const Field& f) {
  return f.when_key.empty() ? "" : f.when_key + " = \"" + f.when.front() + "\"\n";
}

struct Reading {
  std::shared_ptr<void> object;
  std::string findings;
  /// True if something is said about the key itself (and not about others, which are missing).
  bool objects_to(const std::string& key) const { return findings.find("[here] " + key + ": ") != std::string::npos; }
};

Reading read(const Table& table, const std::string& toml) {
  Reading r;
  r.object = table.make();
  Findings findings("case.toml");
  Node root = parse_document(toml + "\n", "case.toml");
  TableReader(STILLHOOK_SOURCE_DIR "/tests/problems/cases", findings).read(table, root, r.object.get(), "here");
  try {
    findings.throw_if_any();
  } catch (const CaseError& error) {
    r.findings = error.what();
  }
  return r;
}

bool reader_accepts(const Table& table, const Field& f, const std::string& value) {
  return !read(table, choice_for(f) + f.key + " = " + value).objects_to(f.key);
}

/// What cannot stand in JSON is nothing a schema can be asked about.
std::optional<Json> as_json(const std::string& value) {
  if (value.find("nan") != std::string::npos || value.find("inf") != std::string::npos) return std::nullopt;
  if (value == "{}") return Json::object();
  if (value == "[{}]") return Json::array({Json::object()});
  return Json::parse(value);
}

void check_refused(const Table& table, const Json& property, const Field& f, const std::string& value) {
  CAPTURE(table.name, f.key, value);
  CHECK_FALSE(reader_accepts(table, f, value));
  if (const auto json = as_json(value)) CHECK_FALSE(SchemaCheck().accepts(property, *json));
}

std::vector<double> numbers_of(const Value& v) {
  if (const auto* one = std::get_if<double>(&v)) return {*one};
  if (const auto* many = std::get_if<std::vector<double>>(&v)) return *many;
  return {};
}

}  // namespace

TEST_CASE("every key's unit is the one it ends in, with its factor to SI", "[case]") {
  int with_unit = 0;
  for_each_table([&](const Table& table, const Json&) {
    for (const Field& f : table.fields) {
      if (!is_numeric(f)) continue;
      CAPTURE(table.name, f.key, f.unit.suffix);
      CHECK(unit_in(f.key) == (f.unit.suffix == "share" ? "" : f.unit.suffix));
      CHECK(f.unit.factor == Approx(si_of(f.unit.suffix)).epsilon(1e-15));
      with_unit += !f.unit.suffix.empty();
    }
  });
  CHECK(with_unit > 100);
}

TEST_CASE("every key takes a good value, and what can be read back is in SI", "[case]") {
  int fields = 0, read_back = 0;
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      CAPTURE(table.name, f.key);
      ++fields;
      const std::string value = f.type == Field::Type::file ? "\"sphere.obj\"" : good_text(f);
      const Reading r = read(table, choice_for(f) + f.key + " = " + value);
      CAPTURE(r.findings);
      CHECK_FALSE(r.objects_to(f.key));
      if (!f.table) CHECK(SchemaCheck().accepts(schema.at("properties").at(f.key), *as_json(value)));
      if (!f.get || !is_numeric(f)) continue;
      const auto back = f.get(r.object.get());
      REQUIRE(back);
      const Json wanted = Json::parse(value);
      const std::vector<double> numbers = numbers_of(*back);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        CHECK(numbers[i] ==
              Approx((wanted.is_array() ? wanted[i] : wanted).get<double>() * si_of(f.unit.suffix)).epsilon(1e-13));
      ++read_back;
    }
  });
  CHECK(fields > 200);
  CHECK(read_back > 150);
}

TEST_CASE("every key refuses a value of another type, by the reader and by the schema", "[case]") {
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      const Json& property = schema.at("properties").at(f.key);
      const bool wants_text = f.type == Field::Type::text || f.type == Field::Type::name ||
                              f.type == Field::Type::choice || f.type == Field::Type::file;
      check_refused(table, property, f, wants_text ? "3" : "\"three\"");
      if (f.type != Field::Type::boolean) check_refused(table, property, f, "true");
      if (f.type == Field::Type::boolean) check_refused(table, property, f, "1");
      if (f.type == Field::Type::integer) check_refused(table, property, f, fmt::format("{:.1f}", good_value(f) + 0.5));
      if (f.type == Field::Type::choice) check_refused(table, property, f, "\"no_such_choice\"");
      if (f.type == Field::Type::name) check_refused(table, property, f, "\"a name\"");
      if (wants_text && (f.type != Field::Type::text || f.reference != Reference::none))
        check_refused(table, property, f, "\"\"");
      if (f.type == Field::Type::tables && f.required) check_refused(table, property, f, "[]");
    }
  });
}

TEST_CASE("every numeric key refuses nan, infinities and what is outside its range", "[case]") {
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      if (!is_numeric(f)) continue;
      const Json& property = schema.at("properties").at(f.key);
      for (const char* number : {"nan", "inf", "-inf", "\"1\""})
        check_refused(table, property, f, value_with(f, number));
      const auto text = [&](double v) {
        return f.type == Field::Type::integer ? fmt::format("{:.0f}", v) : as_number(v);
      };
      if (std::isfinite(f.range.low)) {
        check_refused(table, property, f, value_with(f, text(f.range.low - 1.0)));
        if (f.range.low_open) check_refused(table, property, f, value_with(f, text(f.range.low)));
        if (!f.range.low_open) CHECK(reader_accepts(table, f, value_with(f, text(f.range.low))));
      }
      if (std::isfinite(f.range.high)) {
        check_refused(table, property, f, value_with(f, text(f.range.high + 1.0)));
        CHECK(reader_accepts(table, f, value_with(f, text(f.range.high))));
      }
    }
  });
}

TEST_CASE("every list of numbers refuses another count", "[case]") {
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      const Json& property = schema.at("properties").at(f.key);
      if (f.type == Field::Type::numbers) {
        check_refused(table, property, f, "[]");
        for (std::size_t count = 1; !f.sizes.empty() && count <= f.sizes.back() + 1; ++count)
          if (std::find(f.sizes.begin(), f.sizes.end(), count) == f.sizes.end())
            check_refused(table, property, f, list_of(f, count));
      }
      if (f.type == Field::Type::points) {
        const std::string row = list_of(f, f.sizes.front()), longer = list_of(f, f.sizes.front() + 1);
        check_refused(table, property, f, "[]");
        check_refused(table, property, f, row);
        check_refused(table, property, f, "[" + row + ", " + longer + "]");
        if (f.sizes.front() == 6) check_refused(table, property, f, "[" + row + "]");
      }
    }
  });
}

TEST_CASE("every key with a unit is refused in another unit and without one, and the right key is named", "[case]") {
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      if (f.unit.suffix.empty()) continue;
      const std::string base = base_of(f);
      for (const std::string& other : {base, base + "_ft", base + "_kg"}) {
        CAPTURE(table.name, f.key, other);
        if (table.find(other)) continue;  // "heading" and "heading_deg" may both exist
        const Reading r = read(table, choice_for(f) + other + " = " + good_text(f));
        CHECK(r.objects_to(other));
        CHECK(r.findings.find("\"" + f.key + "\"") != std::string::npos);
        CHECK_FALSE(schema.at("properties").contains(other));
      }
      CHECK(schema.at("additionalProperties") == false);
    }
  });
}

TEST_CASE("a key that has a meaning with some choices only is refused with the others and required with those",
          "[case]") {
  int pairs = 0;
  for_each_table([&](const Table& table, const Json& schema) {
    for (const Field& f : table.fields) {
      if (f.when_key.empty()) continue;
      for (const std::string& choice : table.find(f.when_key)->choices) {
        CAPTURE(table.name, f.key, choice);
        ++pairs;
        const std::string value = f.type == Field::Type::file ? "\"sphere.obj\"" : good_text(f);
        const bool meant = std::find(f.when.begin(), f.when.end(), choice) != f.when.end();
        const auto schema_objects = [&](const Json& document) {
          for (const std::string& text : SchemaCheck().objections(schema, document))
            // An empty table has faults of its own, the keys that it requires: they say nothing of whether it may stand here.
            if (f.type == Field::Type::table || f.type == Field::Type::tables
                    ? text == "/" + f.key + ": not allowed" || text == "/" + f.key + ": required"
                    : text.starts_with("/" + f.key + ":") || text.starts_with("/" + f.key + "/"))
              return true;
          return false;
        };
        const std::string choose = f.when_key + " = \"" + choice + "\"\n";
        CHECK(read(table, choose + f.key + " = " + value).objects_to(f.key) == !meant);
        CHECK(schema_objects({{f.when_key, choice}, {f.key, *as_json(value)}}) == !meant);
        CHECK(read(table, choose).objects_to(f.key) == (meant && f.required));
        CHECK(schema_objects({{f.when_key, choice}}) == (meant && f.required));
      }
    }
  });
  CHECK(pairs > 100);
}
