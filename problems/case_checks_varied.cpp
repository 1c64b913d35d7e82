// Rules of a key that a search or a fit changes.
#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"
#include "problems/case_sections.h"

namespace stillhook {
namespace {

class VariedKeyCheck {
 public:
  VariedKeyCheck(const VariedKey& varied, const Node& root, Findings& findings)
      : varied_(varied), root_(root), findings_(findings) {}

  void run() {
    const bool ordered = varied_.lower < varied_.upper;
    if (!ordered) report("min", fmt::format("must be < max {:.6g}, got {:.6g}", varied_.upper, varied_.lower));
    const std::vector<std::string> steps = steps_of(varied_.key);
    if (!may_be_varied(steps.front()))
      return report("", fmt::format("must be a key of the lift, not of [{}]", steps.front()));
    try {
      Node copy = root_;
      const std::vector<KeyTarget> targets = find_targets(copy, varied_.key);
      const std::optional<double> start = start_value(targets);
      if (start && ordered && !(varied_.lower <= *start && *start <= varied_.upper))
        report("", fmt::format("the start value {:.6g} lies outside [{:.6g}, {:.6g}]", *start, varied_.lower,
                               varied_.upper));
      if (start) check_range(*targets.front().field);
    } catch (const KeyError& error) {
      report("", fmt::format("leads nowhere: {}", error.what()));
    }
  }

 private:
  void report(const std::string& key, const std::string& sentence) {
    findings_.add(position_of_key(root_, varied_.entry, key), varied_.entry, key, sentence);
  }

  /// The value that every target has now; reports if there is none.
  std::optional<double> start_value(const std::vector<KeyTarget>& targets) {
    std::optional<double> start;
    for (const KeyTarget& target : targets) {
      const bool is_number = target.field->type == Field::Type::number || target.index;
      if (!is_number) {
        report("", fmt::format("must lead to a number, {} is not one", target.field->key));
        return std::nullopt;
      }
      const std::optional<double> value = varied_.start ? varied_.start : number_at(target);
      if (!value) {
        report("", fmt::format("the case has no value of {} to start from", target.field->key));
        return std::nullopt;
      }
      if (start && *start != *value) {
        report("", fmt::format("leads to different start values, {:.6g} and {:.6g}", *start, *value));
        return std::nullopt;
      }
      start = value;
    }
    return start;
  }

  void check_range(const Field& field) {
    for (const auto& [key, value] : {std::pair{"min", varied_.lower}, std::pair{"max", varied_.upper}})
      if (!field.range.contains(value))
        report(key, fmt::format("{} must be {}, got {:.6g}", field.key, field.range.text(field.unit), value));
  }

  const VariedKey& varied_;
  const Node& root_;
  Findings& findings_;
};

}  // namespace

void check_varied_key(const VariedKey& varied, const Node& root, Findings& findings) {
  VariedKeyCheck(varied, root, findings).run();
}

}  // namespace stillhook
