// What the rules of one entry of a case may ask and say: its own keys as they are written, what else the lift has.
#pragma once

#include <string>

#include "problems/case_findings.h"
#include "problems/case_reader.h"
#include "sim/specification.h"

namespace stillhook {

class EntryCheck {
 public:
  /// `entry` is where the entry stands, "wires.hoist_port". Keeps references.
  EntryCheck(const Specification& specification, const Node& root, Findings& findings, std::string entry);

  const Specification& specification() const { return specification_; }
  /// A finding at a key; at the entry itself if the key is empty or not written.
  void report(const std::string& key, const std::string& sentence);
  /// True if the case has the key.
  bool written(const std::string& key) const;

  /// Rules that several kinds have.
  void wants_drive(const std::string& key, const std::string& drive, DriveSpec::Kind kind);
  void wants_direction(const std::string& key, const Vector3& direction);
  void wants_another_body(const std::string& key, const std::string& body, const std::string& than);
  void one_of(const std::string& key, const std::string& other);

 private:
  const Specification& specification_;
  const Node& root_;
  Findings& findings_;
  std::string entry_;
};

/// The rules of one capacity curve of a crane.
void check_crane_curve(const CraneCurveSpec& curve, EntryCheck& check);

/// The entry of that name, nullptr if there is none.
template <class Entries>
auto entry_named(const Entries& entries, const std::string& name) -> decltype(&entries.front()) {
  for (const auto& entry : entries)
    if (entry.name == name) return &entry;
  return nullptr;
}

}  // namespace stillhook
