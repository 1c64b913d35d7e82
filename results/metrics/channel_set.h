// The channels that rows of metrics read, collected by name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sim/run_channels.h"
#include "sim/specification.h"

namespace stillhook {

class ChannelSet {
 public:
  explicit ChannelSet(const Specification& s);

  const Specification& specification() const { return specification_; }
  void add(const std::string& channel) { all_.insert(channel); }
  template <class Spec>
  void add(const std::string& entry, std::initializer_list<ChannelKind<Spec>> kinds) {
    for (const auto& kind : kinds) all_.insert(kind.of(entry));
  }
  /// Position and attitude of a body; of "world" and of no body nothing.
  void add_pose(const std::string& body);
  /// Of the hoist wires, or of all.
  void add_hoist_wires(std::initializer_list<ChannelKind<WireSpec>> kinds);
  void add_wires(std::initializer_list<ChannelKind<WireSpec>> kinds);

  std::vector<std::string> all() const { return {all_.begin(), all_.end()}; }

 private:
  const Specification& specification_;
  std::set<std::string> all_;
};

}  // namespace stillhook
