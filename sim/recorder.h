// Channels of a run: what is measured at every step, kept as samples, extremes and contact events.
#pragma once

#include "sim/model.h"
#include "sim/samples.h"
#include "sim/trajectory.h"

namespace stillhook {

/// Measures every channel of a model (trajectory.h lists them) at a state.
class ChannelBoard {
 public:
  explicit ChannelBoard(const Model& model);
  const std::vector<Channel>& channels() const { return channels_; }
  /// Fills values() from a state whose elements' memories belong to it. Between samples the channels that are recorded with
  /// them alone keep their last values.
  void measure(SystemState& state, SystemWorkspace& work, int phase, bool sample);
  /// Fills the channels of one source alone.
  enum class Source { body, element, drive, joint, rest };
  /// Along `branches` of the element's law, if given.
  void measure(Source source, int index, SystemState& state, SystemWorkspace& work, Branches* branches = nullptr);
  /// Which source a channel belongs to, and its index.
  std::pair<Source, int> source_of(int channel) const;
  std::span<const double> values() const { return values_; }
  /// Index of the first channel of an element.
  int element_offset(int element) const { return element_offset_[element]; }
  /// Index of a channel by name, -1 if there is none.
  int find(const std::string& name) const;

 private:
  void measure_body(std::size_t i, const SystemState& state);
  void measure_joint(std::size_t j, const SystemState& state);

  const Model& model_;
  std::vector<Channel> channels_;
  std::vector<double> values_;
  std::vector<int> element_offset_;
  std::vector<bool> samples_only_;  // by element
  int drive_offset_ = 0, joint_offset_ = 0, rest_offset_ = 0;
};

/// Turns the board's values into a trajectory.
class Recorder {
 public:
  /// `samples`: keep them; they go to `sink` if there is one, else into the trajectory.
  Recorder(const Model& model, const ChannelBoard& board, bool samples, Trajectory& out, SampleSink* sink = nullptr);
  /// Once per step, after board.measure(). `sample`: keep the values.
  void add(double t, double h, int phase, bool sample);
  /// Keeps the values as a sample and does nothing else.
  void keep(double t);
  /// Phase bookkeeping.
  void open_phase(const std::string& name, PhaseSpec::Stage stage, double t, bool timed_out);
  void close(double t);  // s, the end of the last phase: at or before the last step
  /// When the contact element parted for the last time, s: between two steps, by the gap on either side. The present
  /// while it touches, minus infinity if it never did.
  double parted_at(int contact_element) const;
  /// True if it parted in the last step.
  bool just_parted(int contact_element) const;

 private:
  struct Watch {  // one contact element
    int element, force, gap, approach, place;
    ContactSpec::Role role;
    std::string name;
    bool touching = false, parting = false, parted = false;  // parting: no force, but not yet apart
    double last_touch, last_approach = 0.0, last_gap = 0.0;
    ContactEvent event;
  };
  void watch_contacts(double t, double h, int phase);

  const ChannelBoard& board_;
  bool samples_;
  Trajectory& out_;
  SampleSink* sink_;
  std::vector<Watch> watches_;
};

}  // namespace stillhook
