// A plot of the report that shows one channel of every entry of a kind of force element.
#pragma once

#include <functional>
#include <string>

#include "sim/channel_kind.h"

namespace stillhook {

struct ChannelPlot {
  std::string group, title, axis;                          // heading, title, "tension, t"
  std::function<std::string(const std::string&)> channel;  // of an entry, by its name
  double per_si = 1.0;                                     // shown value of one SI unit
};

template <class Spec>
ChannelPlot channel_plot(std::string group, std::string title, std::string axis, const ChannelKind<Spec>& kind,
                         double per_si) {
  return {std::move(group), std::move(title), std::move(axis),
          [kind](const std::string& name) { return kind.of(name); }, per_si};
}

}  // namespace stillhook
