// What a simulation leaves: a table of named channels over time, the phases as they ran, contacts, extremes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/multibody/force_element.h"
#include "sim/specification.h"

namespace stillhook {

class SampleSource;  // sim/samples.h

/// A phase as it ran.
struct PhaseRecord {
  std::string name;
  PhaseSpec::Stage stage = PhaseSpec::Stage::hanging;
  double start = 0.0, end = 0.0;  // s
  bool event_timed_out = false;   // its wait_for event never came
};

/// One uninterrupted contact of a ContactSpec's point, all points of one contact merged while any of them touches.
struct ContactEvent {
  std::string contact;
  ContactSpec::Role role = ContactSpec::Role::other;
  double start = 0.0, end = 0.0;  // s
  Vector3 place = Vector3::Zero();  // m, in W: mean of the touching points at first touch
  double approach_speed = 0.0;    // m/s, normal, of the fastest point at first touch, >= 0
  double peak_force = 0.0;        // N, normal
  double impulse = 0.0;           // N s, normal
  std::string phase;
};

/// Largest and smallest value of a channel within a phase, over every step (not only the recorded samples), unless the
/// channel is Channel::samples_only.
struct Extreme {
  double min = 0.0, max = 0.0;
  double t_min = 0.0, t_max = 0.0;  // s
};

/// A static pose: the one a phase starts from or ends in, or one of Specification::poses.
struct StaticPose {
  std::string name;
  std::vector<Pose> bodies;                 // X_WB by body index
  std::vector<double> drives;               // positions
  std::map<std::string, double> values;     // every element and joint channel at rest
};

/// failed: it ran to its end, but no lift would have: a wire parted, a vessel capsized (results/failures.h says which).
enum class RunStatus { not_run, completed, interrupted, diverged, failed };

struct Trajectory {
  RunStatus status = RunStatus::not_run;
  std::string message;                      // where, when and which body if it diverged

  std::vector<Channel> channels;            // names like "load.x", "load.roll", "hoist_port.tension", "hoist.rate"
  std::vector<double> time;                 // s
  std::vector<std::vector<double>> values;  // [channel][sample], or empty: then `source` has them
  std::shared_ptr<const SampleSource> source;
  std::vector<std::vector<Extreme>> extremes;  // [phase][channel]

  std::vector<PhaseRecord> phases;
  std::vector<ContactEvent> contacts;
  std::vector<StaticPose> static_poses;     // [0] start, then the end of each phase

  // What it cost.
  long steps = 0, residuals = 0, factorisations = 0;
  double wall = 0.0;                        // s

  /// Index of a channel by name, -1 if there is none.
  int find(const std::string& name) const {
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (channels[i].name == name) return static_cast<int>(i);
    return -1;
  }
  double duration() const { return time.empty() ? 0.0 : time.back() - time.front(); }
};

// Which channels there are: sim/run_channels.h of bodies, drives, joints and the sea; of a force element its own header
// (wire_channels in sim/lifting/wire.h and so on).

}  // namespace stillhook
