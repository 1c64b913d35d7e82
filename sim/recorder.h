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
  /// Fills values() from a state whose elements' memories belong to it.
  void measure(SystemState& state, SystemWorkspace& work, int phase);
  std::span<const double> values() const { return values_; }
  /// Index of the first channel of an element.
  int element_offset(int element) const { return element_offset_[element]; }

 private:
  const Model& model_;
  std::vector<Channel> channels_;
  std::vector<double> values_;
  std::vector<int> element_offset_;
};

/// Turns the board's values into a trajectory.
class Recorder {
 public:
  /// `samples`: keep them; they go to `sink` if there is one, else into the trajectory.
  Recorder(const Model& model, const ChannelBoard& board, bool samples, Trajectory& out, SampleSink* sink = nullptr);
  /// Once per step, after board.measure(). `sample`: keep the values.
  void add(double t, double h, int phase, bool sample);
  /// Phase bookkeeping.
  void open_phase(const std::string& name, PhaseSpec::Stage stage, double t, bool timed_out);
  void close(double t);
  /// Seconds since the contact element last carried force (0 while it does).
  double clear_for(int contact_element, double t) const;

 private:
  struct Watch {  // one contact element
    int element, force, approach, place;
    ContactSpec::Role role;
    std::string name;
    bool touching = false;
    double last_touch, last_approach = 0.0;
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
