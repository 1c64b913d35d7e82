#include "problems/case_key.h"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "problems/case_format.h"

namespace stillhook {
namespace {

std::string joined(const std::vector<std::string>& steps, std::size_t from, std::size_t to) {
  return fmt::format("{}", fmt::join(steps.begin() + static_cast<std::ptrdiff_t>(from),
                                     steps.begin() + static_cast<std::ptrdiff_t>(to), "."));
}

[[noreturn]] void fail(const std::string& section, const std::string& step, const std::string& sentence) {
  throw KeyError((section.empty() ? "" : "[" + section + "] ") + step + ": " + sentence);
}

const std::string* name_of(const Node& entry, const std::string& name_key) {
  const Node* name = entry.find(name_key);
  return name && name->kind == Node::Kind::text ? &name->text : nullptr;
}

/// Follows a key through the format and the document together.
class Walk {
 public:
  Walk(const std::vector<std::string>& steps, std::vector<KeyTarget>& targets) : steps_(steps), targets_(targets) {}

  void table(std::size_t i, const Table& format, Node& node, const std::string& section) {
    const Field* field = format.find(steps_[i]);
    if (!field) fail(section, steps_[i], unknown_key_sentence(format, steps_[i]));
    const std::string here = (section.empty() ? "" : section + ".") + field->key;
    const bool last = i + 1 == steps_.size();
    if (last) {
      targets_.push_back({&node, &format, field, std::nullopt});
    } else if (field->type == Field::Type::table) {
      table(i + 1, field->table(), node.at(field->key), here);
    } else if (field->type == Field::Type::tables) {
      entries(i + 1, *field, node.find(field->key), here);
    } else if (field->type == Field::Type::map) {
      map(i + 1, *field, node.at(field->key), here);
    } else {
      item(i + 1, format, *field, node, section);
    }
  }

 private:
  void entries(std::size_t i, const Field& field, Node* array, const std::string& section) {
    std::vector<std::string> names;
    const std::size_t before = targets_.size();
    const bool any = steps_[i] == "*";
    if (array && array->kind == Node::Kind::array) {
      for (Node& entry : array->items) {
        const std::string* name = name_of(entry, field.entry_name);
        if (!name) continue;
        names.push_back(*name);
        if (!any && *name != steps_[i]) continue;
        const std::string here = section + "." + *name;
        if (i + 1 == steps_.size()) fail(section, steps_[i], "is a table, name one of its keys");
        table(i + 1, field.table(), entry, here);
      }
    }
    if (targets_.size() > before) return;
    if (names.empty()) fail(section, steps_[i], "the case has no entries here");
    const auto near = nearest(steps_[i], names);
    fail(section, steps_[i],
         near ? fmt::format("there is no entry of this name, did you mean \"{}\"?", *near)
              : fmt::format("there is no entry of this name, there are {}", fmt::join(names, ", ")));
  }

  /// Names of a map may contain dots, its keys do not: the longest name that exists wins.
  void map(std::size_t i, const Field& field, Node& node, const std::string& section) {
    if (i + 1 >= steps_.size()) fail(section, steps_[i], "is a table, name one of its keys");
    for (std::size_t end = steps_.size() - 1; end > i; --end) {
      const std::string name = joined(steps_, i, end);
      if (Node* entry = node.find(name)) return table(end, field.table(), *entry, section + "." + name);
    }
    const std::size_t end = steps_.size() - 1;
    const std::string name = joined(steps_, i, end);
    table(end, field.table(), node.at(name), section + "." + name);
  }

  void item(std::size_t i, const Table& format, const Field& field, Node& node, const std::string& section) {
    const std::string& step = steps_[i];
    const bool is_index = !step.empty() && step.size() < 6 &&
                          std::all_of(step.begin(), step.end(), [](unsigned char c) { return std::isdigit(c); });
    if (field.type != Field::Type::numbers || !is_index || i + 1 != steps_.size())
      fail(section, field.key, fmt::format("is a value, it has no \"{}\"", step));
    const std::size_t index = std::stoul(step);
    const Node* list = node.find(field.key);
    if (!list) list = default_list(format, field, node);
    if (!list || list->kind != Node::Kind::array || index >= list->items.size())
      fail(section, field.key, fmt::format("has no item {} in this case (the first is 0)", index));
    targets_.push_back({&node, &format, &field, index});
  }

  /// A list that the document lacks is added with its default numbers, so that one of them can be changed.
  static const Node* default_list(const Table& format, const Field& field, Node& node) {
    const std::optional<Value> value = format.default_of(field);
    if (!value || !std::holds_alternative<std::vector<double>>(*value)) return nullptr;
    Node& list = node.at(field.key);
    list.kind = Node::Kind::array;
    list.position = node.position;
    for (const double number : std::get<std::vector<double>>(*value)) {
      Node& item = list.items.emplace_back();
      item.kind = Node::Kind::number;
      item.number = number;
    }
    return &list;
  }

  const std::vector<std::string>& steps_;
  std::vector<KeyTarget>& targets_;
};

}  // namespace

std::vector<std::string> steps_of(const std::string& key) {
  std::vector<std::string> steps(1);
  bool quoted = false;
  for (const char c : key) {
    if (c == '"')
      quoted = !quoted;
    else if (c == '.' && !quoted)
      steps.emplace_back();
    else
      steps.back() += c;
  }
  return steps;
}

std::vector<KeyTarget> find_targets(Node& root, const std::string& key) {
  std::vector<KeyTarget> targets;
  const std::vector<std::string> steps = steps_of(key);
  Walk(steps, targets).table(0, case_table(), root, {});
  return targets;
}

void set_key(Node& root, const std::string& key, const Node& value) {
  for (const KeyTarget& target : find_targets(root, key)) {
    if (target.index) {
      target.parent->find(target.field->key)->items[*target.index] = value;
      continue;
    }
    if (!target.field->group.empty())
      for (const Field& other : target.table->fields)
        if (other.group == target.field->group && other.key != target.field->key) target.parent->remove(other.key);
    if (target.parent->position.line == 0) target.parent->position = value.position;  // a table added on the way
    target.parent->at(target.field->key) = value;
  }
}

std::optional<double> number_at(const KeyTarget& target) {
  const Node* node = target.parent->find(target.field->key);
  if (target.index) {
    if (!node || node->kind != Node::Kind::array || *target.index >= node->items.size()) return std::nullopt;
    node = &node->items[*target.index];
  }
  if (node) return node->is_number() ? std::optional<double>(node->number) : std::nullopt;
  const auto by_default = target.table->default_of(*target.field);
  if (!by_default || !std::holds_alternative<double>(*by_default)) return std::nullopt;
  return std::get<double>(*by_default);
}

namespace {

const Node* entry_called(const Node& array, const std::string& step) {
  for (const Node& entry : array.items)
    for (const char* name_key : {"name", "drive", "joint"}) {
      const std::string* name = name_of(entry, name_key);
      if (name && *name == step) return &entry;
    }
  return nullptr;
}

/// The child that a step means: a key, a key without its unit, or an entry of an array.
const Node* child_called(const Node& node, const std::string& step) {
  if (node.kind == Node::Kind::array) return entry_called(node, step);
  if (const Node* exact = node.find(step)) return exact;
  for (const auto& [key, child] : node.entries)
    if (key.compare(0, step.size() + 1, step + "_") == 0) return &child;
  return nullptr;
}

/// Follows the steps as far as the document goes, the longest match first (names of metrics have dots); returns the
/// last node reached, and in `i` how many steps that took.
const Node* follow(const Node& root, const std::vector<std::string>& steps, std::size_t& i) {
  const Node* node = &root;
  for (i = 0; i < steps.size();) {
    const Node* child = nullptr;
    std::size_t end = steps.size();
    for (; end > i; --end)
      if ((child = child_called(*node, joined(steps, i, end)))) break;
    if (!child) break;
    i = end;
    node = child;
  }
  return node;
}

}  // namespace

const Node* find_key(const Node& root, const std::string& entry, const std::string& key) {
  const std::vector<std::string> steps = steps_of(entry);
  std::size_t reached = 0;
  const Node* node = follow(root, steps, reached);
  return reached == steps.size() ? node->find(key) : nullptr;
}

Position position_of_key(const Node& root, const std::string& entry, const std::string& key) {
  std::vector<std::string> steps = steps_of(entry);
  if (!key.empty())
    for (const std::string& step : steps_of(key)) steps.push_back(step);
  std::size_t reached = 0;
  return follow(root, steps, reached)->position;
}

}  // namespace stillhook
