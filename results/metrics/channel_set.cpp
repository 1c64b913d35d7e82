#include "results/metrics/channel_set.h"

#include "results/metrics/metric_row.h"

namespace stillhook {

ChannelSet::ChannelSet(const Specification& s) : specification_(s) {
  for (const DriveSpec& d : s.drives)  // how far a phase has come
    add(d.name, {drive_channels::position, drive_channels::rate});
}

void ChannelSet::add_pose(const std::string& body) {
  if (body.empty() || body == "world") return;
  for (const auto& kind : body_channels::pose) add(kind.of(body));
}

void ChannelSet::add_hoist_wires(std::initializer_list<ChannelKind<WireSpec>> kinds) {
  for (const WireSpec& w : specification_.wires)
    if (w.role == WireSpec::Role::hoist) add(w.name, kinds);
}

void ChannelSet::add_wires(std::initializer_list<ChannelKind<WireSpec>> kinds) {
  for (const WireSpec& w : specification_.wires) add(w.name, kinds);
}

std::vector<std::string> channels_of_metric(const Specification& s, const std::string& name) {
  const MetricDefinition* definition = metric_definition(name);
  if (!definition) throw std::logic_error("metric " + name + " is not in the catalogue");
  ChannelSet channels(s);
  metric_row(definition->name).channels(channels, element_of(*definition, name));
  return channels.all();
}

}  // namespace stillhook
