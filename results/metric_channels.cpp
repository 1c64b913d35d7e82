// What each metric of the catalogue is computed from.
#include <map>
#include <set>
#include <stdexcept>

#include "results/smooth_metrics.h"
#include "sim/crane_parts.h"

namespace stillhook {
namespace {

/// Groups of channels that metrics need; contacts, phases and static poses belong to every run.
enum class Needs {
  nothing,
  load_pose,
  vessel_attitude,
  hoist_offsets,
  hoist_leads,
  hoist_tensions,
  hoist_lengths,
  hoist_unstretched,
  wire_tensions,
  taglines,
  moorings,
  pickup_gaps,
  clearance_bodies
};

using NeedsOf = std::map<std::string, std::set<Needs>>;

void add_needs(NeedsOf& all, std::initializer_list<const char*> names, std::set<Needs> needs) {
  for (const char* name : names) all[name] = needs;
}

NeedsOf build_needs() {
  NeedsOf all;
  add_needs(all,
            {"duration", "event_timeouts", "lift_off_time", "rehit_speed_max", "rehit_impulse_max", "contact_speed_max",
             "contact_impulse_max", "contact_force_max", "setdown_speed", "winch_speed_max.%"},
            {Needs::nothing});
  add_needs(all,
            {"range_x.%", "range_y.%", "range_z.%", "range_roll.%", "range_pitch.%", "range_yaw.%", "mean_x.%",
             "mean_y.%", "mean_z.%", "setdown_offset", "setdown_movement_x", "setdown_movement_y", "load_tilt_max",
             "load_yaw_max"},
            {Needs::load_pose});
  add_needs(all, {"setdown_movement_z"}, {Needs::load_pose, Needs::hoist_unstretched});
  add_needs(all, {"sway_rms", "sway_x_rms", "sway_y_rms", "sway_peak", "sway_rms.%", "sway_peak.%"},
            {Needs::hoist_offsets});
  add_needs(all, {"offlead_max", "sidelead_max", "offlead_max.%", "sidelead_max.%"},
            {Needs::hoist_leads, Needs::hoist_tensions});
  add_needs(all,
            {"daf_total", "daf_max", "daf_excess", "slack_ratio_min", "slack_ratio_min.%", "hook_load_max",
             "hook_load_max.%"},
            {Needs::hoist_tensions});
  add_needs(all,
            {"daf.%", "tension_max.%", "wire_utilisation_max", "winch_pull_max.%", "winch_pull_max",
             "winch_utilisation_max"},
            {Needs::wire_tensions});
  add_needs(all,
            {"tagline_tension_max", "tagline_speed_max", "tagline_saturated", "tagline_tension_max.%",
             "tagline_speed_max.%", "tagline_saturated.%"},
            {Needs::taglines});
  add_needs(all, {"mooring_tension_max", "mooring_tension_max.%"}, {Needs::moorings});
  add_needs(all, {"rehits"}, {Needs::pickup_gaps});
  add_needs(all, {"lift_off_relative_speed", "lift_off_relative_speed_extreme", "cycles_to_clear"},
            {Needs::hoist_lengths});
  add_needs(all,
            {"heel_max", "trim_max", "heel_static_max", "trim_static_max", "heel_max.%", "trim_max.%",
             "heel_static_max.%", "trim_static_max.%"},
            {Needs::vessel_attitude});
  add_needs(all, {"clearance_min.%"}, {Needs::clearance_bodies});
  return all;
}

class ChannelSet {
 public:
  explicit ChannelSet(const Specification& s) : s_(s) {
    for (const DriveSpec& d : s.drives) of(d.name, {".position", ".rate"});  // how far a phase has come
  }

  void add(Needs needs, const std::string& element) {
    switch (needs) {
      case Needs::nothing:
        break;
      case Needs::load_pose:
        if (!s_.operation.load.empty()) pose(s_.operation.load);
        break;
      case Needs::vessel_attitude:
        for (const std::string& vessel : crane_vessels(s_)) pose(vessel);
        break;
      case Needs::hoist_offsets:
        wires(true, {".offset_x", ".offset_y"});
        break;
      case Needs::hoist_leads:
        wires(true, {".off_lead", ".side_lead"});
        break;
      case Needs::hoist_tensions:
        wires(true, {".tension"});
        break;
      case Needs::hoist_lengths:
        wires(true, {".length"});
        break;
      case Needs::hoist_unstretched:
        wires(true, {".unstretched"});
        break;
      case Needs::wire_tensions:
        wires(false, {".tension"});
        break;
      case Needs::taglines:
        for (const TaglineSpec& t : s_.taglines) of(t.name, {".tension", ".command", ".line_speed", ".saturated"});
        break;
      case Needs::moorings:
        for (const MooringSpec& m : s_.moorings) of(m.name, {".tension"});
        break;
      case Needs::pickup_gaps:
        for (const ContactSpec& c : s_.contacts)
          if (c.role == ContactSpec::Role::pickup) of(c.name, {".gap"});
        break;
      case Needs::clearance_bodies:
        for (const ClearanceSpec& c : s_.clearances)
          if (c.name == element)
            for (const std::string& body : {c.a.body, c.b.body})
              if (body != "world") pose(body);
        break;
    }
  }
  std::vector<std::string> all() const { return {all_.begin(), all_.end()}; }

 private:
  void of(const std::string& entry, std::initializer_list<const char*> quantities) {
    for (const char* q : quantities) all_.insert(entry + q);
  }
  void pose(const std::string& body) { of(body, {".x", ".y", ".z", ".roll", ".pitch", ".yaw"}); }
  void wires(bool hoist_alone, std::initializer_list<const char*> quantities) {
    for (const WireSpec& w : s_.wires)
      if (!hoist_alone || w.role == WireSpec::Role::hoist) of(w.name, quantities);
  }

  const Specification& s_;
  std::set<std::string> all_;
};

}  // namespace

std::vector<std::string> channels_of_metric(const Specification& s, const std::string& name) {
  static const NeedsOf needs = build_needs();
  const MetricDefinition* definition = metric_definition(name);
  if (!definition) throw std::logic_error("metric " + name + " is not in the catalogue");
  const auto found = needs.find(definition->name);
  if (found == needs.end()) throw std::logic_error("metric " + name + ": nobody has said which channels it needs");
  const std::string element = definition->element.empty() ? "" : name.substr(definition->name.find('%'));
  ChannelSet channels(s);
  for (const Needs n : found->second) channels.add(n, element);
  return channels.all();
}

}  // namespace stillhook
