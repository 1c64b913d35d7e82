// Dotted keys into a case: "taglines.*.kp_kN_per_deg", "operation.phases.hoist_up.moves.hoist.speed_m_per_min". Entries
// of arrays go by their name (a move by its drive), `*` means every entry, a number picks from a list of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problems/case_document.h"
#include "problems/field_table.h"
#include "sim/error.h"

namespace stillhook {

/// A key that leads nowhere; what() is "[section] step: sentence".
class KeyError : public Error {
 public:
  using Error::Error;
};

/// A place that a key leads to. The value itself may be absent.
struct KeyTarget {
  Node* parent = nullptr;        // the table that holds it
  const Table* table = nullptr;  // its format
  const Field* field = nullptr;
  std::optional<std::size_t> index;  // of a list of numbers
};

/// Where `key` leads in `root`. Tables on the way that the document lacks are added (their values are defaults);
/// entries of arrays are not. Throws KeyError.
std::vector<KeyTarget> find_targets(Node& root, const std::string& key);

/// Puts `value` where `key` leads, and takes away the keys that exclude it. Throws KeyError.
void set_key(Node& root, const std::string& key, const Node& value);

/// Number at a target in its own unit, as written or by default; nothing if it has neither or is not a number.
std::optional<double> number_at(const KeyTarget& target);

/// The value of a key of an entry ("wires.hoist_port", "slack_m"), or null if it is not written.
const Node* find_key(const Node& root, const std::string& entry, const std::string& key);

/// Position of the entry and key, or of the nearest thing around it that exists. `key` may lack its unit.
Position position_of_key(const Node& root, const std::string& entry, const std::string& key);

/// Steps of a dotted key; a step in double quotes may contain dots.
std::vector<std::string> steps_of(const std::string& key);

}  // namespace stillhook
