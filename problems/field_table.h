// One table per struct: every key of a case with its unit, range, default and meaning. The same table parses, checks,
// suggests ("did you mean"), writes the JSON Schema and the key reference, and tells where a plan variable leads.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "problems/unit.h"

namespace stillhook {

/// Allowed values of a number, in the unit of its key.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  // low itself is not allowed

  bool contains(double value) const { return (low_open ? value > low : value >= low) && value <= high; }
  /// "> 0 s", ">= 0 s", "in [-0.333, 0]"; empty when every number is allowed.
  std::string text(const Unit& unit) const;
};
inline Range any_value() { return {}; }
inline Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
inline Range not_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
inline Range between(double low, double high) { return {low, high, false}; }

/// What a text names.
enum class Reference { none, body, body_or_world, joint, drive, wire, contact, sea_state, phase };

/// A value as it stands in the case: numbers in SI once they reach a field's `set`.
using Value = std::variant<double, bool, std::string, std::vector<double>, std::vector<std::vector<double>>>;

struct Table;

struct Field {
  enum class Type { number, integer, boolean, text, name, choice, file, numbers, points, table, tables, map };

  std::string key;
  Type type = Type::number;
  Unit unit;
  Range range;
  std::string doc;
  std::vector<std::size_t> sizes;    // numbers: allowed counts, empty = any but none
  std::vector<std::string> choices;  // choice
  Reference reference = Reference::none;
  std::string entry_name;  // tables: the key that names an entry
  bool required = false;
  std::string group;  // fields of one group exclude each other
  bool group_required = false;
  bool may_be_missing = false;  // file: what needs it says so then
  std::string when_key;           // the field has a meaning only while this choice ...
  std::vector<std::string> when;  // ... is one of these
  std::string without;            // what holds when the key is absent and no value stands for it

  std::function<void(void*, const Value&)> set;               // value in SI
  std::function<std::optional<Value>(const void*)> get;       // value in SI
  std::function<void*(void*, const std::string& name)> open;  // sub-table, new entry of tables or map
  std::function<const Table&()> table;                        // its fields

  Field& needed_later() { return may_be_missing = true, *this; }
  Field& require() { return required = true, *this; }
  Field& names(Reference what) { return reference = what, *this; }
  /// One of the fields of `name` at most; exactly one if `needed`.
  Field& one_of(std::string name, bool needed = false) {
    return group = std::move(name), group_required = needed, *this;
  }
  Field& only_when(std::string choice_key, std::vector<std::string> values) {
    return when_key = std::move(choice_key), when = std::move(values), *this;
  }
  Field& absent(std::string meaning) { return without = std::move(meaning), *this; }
};

struct Table {
  std::string name;  // for the reference and the schema, e.g. "bodies.hull"
  std::string doc;
  std::vector<Field> fields;
  std::function<std::shared_ptr<void>()> make;  // a struct with its defaults

  const Field* find(const std::string& key) const;
  /// Default in the unit of the key, if the struct has one.
  std::optional<Value> default_of(const Field& field) const;
};

/// Collects the fields of struct S. `access` is a member pointer or any callable S& -> member&.
template <class S>
class TableOf {
 public:
  TableOf(std::string name, std::string doc) {
    table_.name = std::move(name);
    table_.doc = std::move(doc);
    table_.make = [] { return std::static_pointer_cast<void>(std::make_shared<S>()); };
  }

  template <class A>
  Field& number(std::string key, A access, const Unit& unit, const Range& range, std::string doc) {
    Field& f = add(Field::Type::number, std::move(key), std::move(doc), unit, range);
    scalar(f, access);
    return f;
  }
  template <class A>
  Field& integer(std::string key, A access, const Range& range, std::string doc) {
    Field& f = add(Field::Type::integer, std::move(key), std::move(doc), unit::one, range);
    scalar(f, access);
    return f;
  }
  template <class A>
  Field& boolean(std::string key, A access, std::string doc) {
    Field& f = add(Field::Type::boolean, std::move(key), std::move(doc));
    f.set = [access](void* s, const Value& v) { of(access, s) = std::get<bool>(v); };
    f.get = [access](const void* s) -> std::optional<Value> { return Value(of(access, s)); };
    return f;
  }
  template <class A>
  Field& text(std::string key, A access, std::string doc) {
    return string_field(Field::Type::text, std::move(key), access, std::move(doc));
  }
  template <class A>
  Field& name(std::string key, A access, std::string doc) {
    return string_field(Field::Type::name, std::move(key), access, std::move(doc)).require();
  }
  template <class A>
  Field& file(std::string key, A access, std::string doc) {
    return string_field(Field::Type::file, std::move(key), access, std::move(doc));
  }
  template <class A, class E>
  Field& choice(std::string key, A access, std::vector<std::pair<std::string, E>> values, std::string doc) {
    Field& f = add(Field::Type::choice, std::move(key), std::move(doc));
    for (const auto& value : values) f.choices.push_back(value.first);
    f.set = [access, values](void* s, const Value& v) {
      for (const auto& value : values)
        if (value.first == std::get<std::string>(v)) of(access, s) = value.second;
    };
    f.get = [access, values](const void* s) -> std::optional<Value> {
      for (const auto& value : values)
        if (value.second == of(access, s)) return Value(value.first);
      return std::nullopt;
    };
    return f;
  }
  /// A list of numbers with a setter of its own.
  template <class Set>
  Field& numbers(std::string key, std::vector<std::size_t> sizes, Set set, const Unit& unit, const Range& range,
                 std::string doc) {
    Field& f = add(Field::Type::numbers, std::move(key), std::move(doc), unit, range);
    f.sizes = std::move(sizes);
    f.set = [set](void* s, const Value& v) { set(*static_cast<S*>(s), std::get<std::vector<double>>(v)); };
    return f;
  }
  /// Three numbers of a vector-like member.
  template <class A>
  Field& vector(std::string key, A access, const Unit& unit, const Range& range, std::string doc) {
    Field& f = numbers(
        std::move(key), {3},
        [access](S& s, const std::vector<double>& v) {
          for (int i = 0; i < 3; ++i) std::invoke(access, s)[i] = v[static_cast<std::size_t>(i)];
        },
        unit, range, std::move(doc));
    f.get = [access](const void* s) -> std::optional<Value> {
      const auto& v = of(access, s);
      return Value(std::vector<double>{v[0], v[1], v[2]});
    };
    return f;
  }
  /// A list of rows of `width` numbers.
  template <class Set>
  Field& rows(std::string key, std::size_t width, Set set, const Unit& unit, std::string doc) {
    Field& f = add(Field::Type::points, std::move(key), std::move(doc), unit);
    f.sizes = {width};
    f.set = [set](void* s, const Value& v) { set(*static_cast<S*>(s), std::get<std::vector<std::vector<double>>>(v)); };
    return f;
  }
  template <class A>
  Field& table(std::string key, A access, const Table& (*fields)(), std::string doc) {
    Field& f = add(Field::Type::table, std::move(key), std::move(doc));
    f.open = [access](void* s, const std::string&) -> void* { return &of(access, s); };
    f.table = fields;
    return f;
  }
  template <class A>
  Field& tables(std::string key, A access, std::string entry_name, const Table& (*fields)(), std::string doc) {
    Field& f = add(Field::Type::tables, std::move(key), std::move(doc));
    f.entry_name = std::move(entry_name);
    f.open = [access](void* s, const std::string&) -> void* { return &of(access, s).emplace_back(); };
    f.table = fields;
    return f;
  }
  /// A table whose keys are names: each entry becomes one struct, its name in the member `key_member`.
  template <class A, class K>
  Field& map(std::string key, A access, K key_member, const Table& (*fields)(), std::string doc) {
    Field& f = add(Field::Type::map, std::move(key), std::move(doc));
    f.open = [access, key_member](void* s, const std::string& entry) -> void* {
      auto& item = of(access, s).emplace_back();
      item.*key_member = entry;
      return &item;
    };
    f.table = fields;
    return f;
  }

  Table build() { return std::move(table_); }

 private:
  template <class A>
  static auto& of(const A& access, void* s) {
    return std::invoke(access, *static_cast<S*>(s));
  }
  // Reading through the same access; the object is never changed.
  template <class A>
  static const auto& of(const A& access, const void* s) {
    return std::invoke(access, *static_cast<S*>(const_cast<void*>(s)));
  }
  Field& add(Field::Type type, std::string key, std::string doc, Unit unit = {}, Range range = {}) {
    Field f;
    f.type = type;
    f.key = std::move(key);
    f.doc = std::move(doc);
    f.unit = std::move(unit);
    f.range = range;
    return table_.fields.emplace_back(std::move(f));
  }
  template <class A>
  static void scalar(Field& f, A access) {
    f.set = [access](void* s, const Value& v) {
      auto& member = of(access, s);
      using M = std::remove_reference_t<decltype(member)>;
      if constexpr (std::is_same_v<M, std::optional<int>>)
        member = static_cast<int>(std::get<double>(v));
      else if constexpr (std::is_same_v<M, std::optional<double>>)
        member = std::get<double>(v);
      else
        member = static_cast<M>(std::get<double>(v));
    };
    f.get = [access](const void* s) -> std::optional<Value> {
      const auto& member = of(access, s);
      using M = std::remove_cvref_t<decltype(member)>;
      if constexpr (std::is_arithmetic_v<M>)
        return Value(static_cast<double>(member));
      else
        return member ? std::optional<Value>(static_cast<double>(*member)) : std::nullopt;
    };
  }
  template <class A>
  Field& string_field(Field::Type type, std::string key, A access, std::string doc) {
    Field& f = add(type, std::move(key), std::move(doc));
    f.set = [access](void* s, const Value& v) { of(access, s) = std::get<std::string>(v); };
    f.get = [access](const void* s) -> std::optional<Value> {
      const std::string& text = of(access, s);
      return text.empty() ? std::nullopt : std::optional<Value>(text);
    };
    return f;
  }

  Table table_;
};

/// The candidate nearest to `word` by edit distance (with swaps), if near enough to be meant.
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& candidates);

/// `, did you mean "x"?` or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// The keys that an unknown one may stand for: the same quantity in another unit or without one, or the nearest by
/// spelling.
std::vector<std::string> meant_keys(const Table& table, const std::string& key);

/// What to say about a key that the table does not know: a wrong or missing unit, a slip, or what there is.
std::string unknown_key_sentence(const Table& table, const std::string& key);

/// A name as a step of a dotted key: in double quotes if it has dots.
std::string as_step(const std::string& name);

/// Key without its unit suffix.
std::string base_of(const Field& field);

}  // namespace stillhook
