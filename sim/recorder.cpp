#include "sim/recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook {

ChannelBoard::ChannelBoard(const Model& model) : model_(model) {
  const MultibodySystem& system = model.system();
  for (const RigidBody& b : system.bodies) {
    const auto add = [&](const char* quantity, const char* unit, const char* what) {
      channels_.push_back({b.name + "." + quantity, unit, std::string(what) + " of " + b.name});
    };
    for (const char* axis : {"x", "y", "z"}) add(axis, "m", "position of the origin");
    for (const char* angle : {"roll", "pitch", "yaw"}) add(angle, "rad", "ZYX Euler angle");
    for (const char* axis : {"vx", "vy", "vz"}) add(axis, "m/s", "velocity of the origin");
    for (const char* axis : {"wx", "wy", "wz"}) add(axis, "rad/s", "angular velocity in body axes");
  }
  for (const auto& element : system.elements) {
    element_offset_.push_back(static_cast<int>(channels_.size()));
    for (Channel& c : element->channels()) channels_.push_back(std::move(c));
  }
  element_offset_.push_back(static_cast<int>(channels_.size()));
  for (const DriveSpec& d : model.specification().drives) {
    const bool winch = d.kind == DriveSpec::Kind::winch;
    channels_.push_back({d.name + ".position", winch || d.kind == DriveSpec::Kind::tow ? "m" : "1",
                         winch ? "length hauled in" : "position of the drive"});
    channels_.push_back(
        {d.name + ".rate", winch || d.kind == DriveSpec::Kind::tow ? "m/s" : "1/s", "rate of the drive"});
  }
  for (const Joint& j : system.joints) {
    if (j.type == JointSpec::Type::prismatic)
      channels_.push_back({j.name + ".slide", "m", "travel along the axis from the initial pose"});
    else
      channels_.push_back({j.name + ".angle", "rad", "angle about the axis from the initial pose"});
    for (const char* axis : {"x", "y", "z"})
      channels_.push_back({j.name + ".force_" + axis, "N", "force on the child, world axes"});
    for (const char* axis : {"x", "y", "z"})
      channels_.push_back({j.name + ".moment_" + axis, "N m", "moment on the child about the joint, world axes"});
  }
  channels_.push_back({"sea.elevation", "m", "undisturbed wave elevation at the world origin"});
  channels_.push_back({"phase", "1", "index of the phase of the operation"});
  values_.assign(channels_.size(), 0.0);
}

void ChannelBoard::measure(SystemState& state, SystemWorkspace& work, int phase) {
  const MultibodySystem& system = model_.system();
  const Instant now = state.instant();
  double* out = values_.data();
  const auto put = [&out](const Vector3& v) {
    for (int i = 0; i < 3; ++i) *out++ = v[i];
  };
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const BodyKinematics& k = state.body[i];
    const Vector3 arm = -system.bodies[i].cog;
    const RollPitchYaw angles = roll_pitch_yaw(k.R_WB);
    put(k.p_WC + k.R_WB * arm);
    put({angles.roll, angles.pitch, angles.yaw});
    put(k.v_WC + k.R_WB * k.w_B.cross(arm));
    put(k.w_B);
  }
  for (std::size_t e = 0; e < system.elements.size(); ++e) {
    const std::size_t count = element_offset_[e + 1] - element_offset_[e];
    system.elements[e]->measure(now, system.memory(static_cast<int>(e), state, work), {out, count});
    out += count;
  }
  for (const DriveState& d : state.drive) {
    *out++ = d.position;
    *out++ = d.rate;
  }
  for (std::size_t j = 0; j < system.joints.size(); ++j) {
    Vector3 force, moment;
    system.joint_reaction(state, static_cast<int>(j), force, moment);
    *out++ = system.joints[j].coordinate(now);
    put(force);
    put(moment);
  }
  *out++ = model_.waves().elevation(0.0, 0.0, state.t);
  *out++ = phase;
}

Recorder::Recorder(const Model& model, const ChannelBoard& board, bool samples, Trajectory& out, SampleSink* sink)
    : board_(board), samples_(samples), out_(out), sink_(sink) {
  out.channels = board.channels();
  if (!sink) out.values.resize(board.channels().size());
  const auto& elements = model.system().elements;
  for (const ContactSpec& spec : model.specification().contacts) {
    Watch w;
    w.element = model.element_index(spec.name);
    const auto channels = elements[w.element]->channels();
    const auto at = [&](const std::string& quantity) {
      for (std::size_t i = 0; i < channels.size(); ++i)
        if (channels[i].name == spec.name + "." + quantity)
          return board.element_offset(w.element) + static_cast<int>(i);
      return -1;
    };
    w.force = at("force");
    w.approach = at("approach_speed");
    w.place = at("x");
    w.role = spec.role;
    w.name = spec.name;
    w.last_touch = -std::numeric_limits<double>::infinity();
    watches_.push_back(w);
  }
}

void Recorder::open_phase(const std::string& name, PhaseSpec::Stage stage, double t, bool timed_out) {
  if (!out_.phases.empty()) out_.phases.back().end = t;
  out_.phases.push_back({name, stage, t, t, timed_out});
  Extreme nothing;
  nothing.min = std::numeric_limits<double>::infinity();
  nothing.max = -nothing.min;
  out_.extremes.emplace_back(board_.channels().size(), nothing);
}

void Recorder::add(double t, double h, int phase, bool sample) {
  const std::span<const double> values = board_.values();
  std::vector<Extreme>& extremes = out_.extremes[phase];
  for (std::size_t i = 0; i < values.size(); ++i) {
    Extreme& e = extremes[i];
    if (values[i] < e.min) e.min = values[i], e.t_min = t;
    if (values[i] > e.max) e.max = values[i], e.t_max = t;
  }
  watch_contacts(t, h, phase);
  if (!samples_ || !sample) return;
  if (sink_) return sink_->add(out_, t, values);
  out_.time.push_back(t);
  for (std::size_t i = 0; i < values.size(); ++i) out_.values[i].push_back(values[i]);
}

void Recorder::watch_contacts(double t, double h, int phase) {
  const std::span<const double> v = board_.values();
  for (Watch& w : watches_) {
    const double force = v[w.force];
    if (force > 0.0 && !w.touching) {
      w.touching = true;
      w.event = ContactEvent{};
      w.event.contact = w.name;
      w.event.role = w.role;
      w.event.start = t;
      w.event.place = {v[w.place], v[w.place + 1], v[w.place + 2]};
      // The touch lies between two steps: the speed before it has not been braked yet.
      w.event.approach_speed = std::max({0.0, v[w.approach], w.last_approach});
      w.event.phase = out_.phases[phase].name;
    }
    if (force > 0.0) {
      w.last_touch = t;
      w.event.peak_force = std::max(w.event.peak_force, force);
      w.event.impulse += force * h;
    } else if (w.touching) {
      w.touching = false;
      w.event.end = t;
      out_.contacts.push_back(w.event);
    }
    w.last_approach = v[w.approach];
  }
}

void Recorder::close(double t) {
  if (!out_.phases.empty()) out_.phases.back().end = t;
  for (Watch& w : watches_) {
    if (!w.touching) continue;
    w.event.end = t;
    out_.contacts.push_back(w.event);
  }
  std::stable_sort(out_.contacts.begin(), out_.contacts.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
}

double Recorder::clear_for(int contact_element, double t) const {
  for (const Watch& w : watches_)
    if (w.element == contact_element) return t - w.last_touch;
  return std::numeric_limits<double>::infinity();
}

}  // namespace stillhook
