// Quantities that entries of one kind record as channels: the only place where the name of a channel is spelled is the
// element that writes it. Who reads a run asks `wire_channels::tension.of(wire)`.
#pragma once

#include <string>
#include <vector>

#include "sim/multibody/force_element.h"

namespace stillhook {

/// One quantity that every entry of a kind records. `Spec` is the kind's entry of the specification; the channels of
/// bodies cannot be asked of a wire.
template <class Spec>
struct ChannelKind {
  const char* quantity;     // "tension"
  const char* unit;         // SI, as Channel::unit
  const char* description;  // for the archive and its exports

  /// The channel of one entry, by the entry or by its name.
  std::string of(const Spec& entry) const { return of(entry.name); }
  std::string of(const std::string& name) const { return name + "." + quantity; }
  Channel channel(const std::string& name) const { return {of(name), unit, description}; }
};

/// The channels that an entry records, from the list of its kind.
template <class Kinds>
std::vector<Channel> channels_of(const std::string& name, const Kinds& kinds) {
  std::vector<Channel> all;
  for (const auto& kind : kinds) all.push_back(kind.channel(name));
  return all;
}

}  // namespace stillhook
