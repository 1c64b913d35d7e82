#include "sim/recorder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "sim/drive_unit.h"
#include "sim/run_channels.h"

namespace stillhook {

namespace {
// Channels of each.
constexpr int kOfBody = static_cast<int>(body_channels::all.size());
constexpr int kOfDrive = 2;
constexpr int kOfJoint = 1 + static_cast<int>(joint_channels::loads.size());
}  // namespace

ChannelBoard::ChannelBoard(const Model& model) : model_(model) {
  const MultibodySystem& system = model.system();
  const auto add = [&](const Channel& channel) { channels_.push_back(channel); };
  for (const RigidBody& b : system.bodies)
    for (const auto& kind : body_channels::all) {
      add(kind.channel(b.name));
      channels_.back().description += " of " + b.name;
    }
  for (const auto& element : system.elements) {
    element_offset_.push_back(static_cast<int>(channels_.size()));
    std::vector<Channel> own = element->channels();
    samples_only_.push_back(!own.empty() && std::ranges::all_of(own, &Channel::samples_only));
    std::ranges::move(own, std::back_inserter(channels_));
  }
  element_offset_.push_back(static_cast<int>(channels_.size()));
  drive_offset_ = static_cast<int>(channels_.size());
  for (const DriveSpec& d : model.specification().drives) {
    const DriveMotion motion = drive_motion(model.specification(), d);
    add({drive_channels::position.of(d), position_unit(motion),
         d.kind == DriveSpec::Kind::winch ? "length hauled in" : drive_channels::position.description});
    add({drive_channels::rate.of(d), rate_unit(motion), drive_channels::rate.description});
  }
  joint_offset_ = static_cast<int>(channels_.size());
  for (const Joint& j : system.joints) {
    const bool slides = j.type == JointSpec::Type::prismatic;
    add((slides ? joint_channels::slide : joint_channels::angle).channel(j.name));
    for (const auto& kind : joint_channels::loads) add(kind.channel(j.name));
  }
  rest_offset_ = static_cast<int>(channels_.size());
  add(sea_channels::elevation_kind.channel("sea"));
  add({sea_channels::phase, "1", "index of the phase of the operation"});
  values_.assign(channels_.size(), 0.0);
}

int ChannelBoard::find(const std::string& name) const {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].name == name) return static_cast<int>(i);
  return -1;
}

std::pair<ChannelBoard::Source, int> ChannelBoard::source_of(int channel) const {
  if (channel >= rest_offset_) return {Source::rest, 0};
  if (channel >= joint_offset_) return {Source::joint, (channel - joint_offset_) / kOfJoint};
  if (channel >= drive_offset_) return {Source::drive, (channel - drive_offset_) / kOfDrive};
  if (channel < element_offset_.front()) return {Source::body, channel / kOfBody};
  const auto after = std::upper_bound(element_offset_.begin(), element_offset_.end(), channel);
  return {Source::element, static_cast<int>(after - element_offset_.begin()) - 1};
}

void ChannelBoard::measure_body(std::size_t i, const SystemState& state) {
  double* out = values_.data() + kOfBody * i;
  const auto put = [&out](const Vector3& v) {
    for (int k = 0; k < 3; ++k) *out++ = v[k];
  };
  const BodyKinematics& k = state.body[i];
  const Vector3 arm = -model_.system().bodies[i].cog;
  const RollPitchYaw angles = roll_pitch_yaw(k.R_WB);
  put(k.p_WC + k.R_WB * arm);
  put({angles.roll, angles.pitch, angles.yaw});
  put(k.v_WC + k.R_WB * k.w_B.cross(arm));
  put(k.w_B);
}

void ChannelBoard::measure_joint(std::size_t j, const SystemState& state) {
  double* out = values_.data() + joint_offset_ + kOfJoint * j;
  Vector3 force, moment;
  model_.system().joint_reaction(state, static_cast<int>(j), force, moment);
  *out++ = model_.system().joints[j].coordinate(state.instant());
  for (int k = 0; k < 3; ++k) *out++ = force[k];
  for (int k = 0; k < 3; ++k) *out++ = moment[k];
}

void ChannelBoard::measure(Source source, int index, SystemState& state, SystemWorkspace& work, Branches* branches) {
  switch (source) {
    case Source::body:
      measure_body(static_cast<std::size_t>(index), state);
      break;
    case Source::element: {
      const std::size_t first = element_offset_[index], count = element_offset_[index + 1] - first;
      Instant now = state.instant();
      now.branches = branches;
      model_.system().elements[index]->measure(now, model_.system().memory(index, state, work),
                                               std::span(values_).subspan(first, count));
      break;
    }
    case Source::drive:
      values_[drive_offset_ + kOfDrive * index] = state.drive[index].position;
      values_[drive_offset_ + kOfDrive * index + 1] = state.drive[index].rate;
      break;
    case Source::joint:
      measure_joint(static_cast<std::size_t>(index), state);
      break;
    case Source::rest:
      values_[rest_offset_] = model_.waves().elevation(0.0, 0.0, state.t);
      values_[rest_offset_ + 1] = state.phase;
      break;
  }
}

void ChannelBoard::measure(SystemState& state, SystemWorkspace& work, int phase, bool sample) {
  const MultibodySystem& system = model_.system();
  const auto all = [&](Source source, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) measure(source, static_cast<int>(i), state, work);
  };
  all(Source::body, system.bodies.size());
  for (std::size_t i = 0; i < system.elements.size(); ++i)
    if (sample || !samples_only_[i]) measure(Source::element, static_cast<int>(i), state, work);
  all(Source::drive, state.drive.size());
  all(Source::joint, system.joints.size());
  if (sample) measure(Source::rest, 0, state, work);
  values_[rest_offset_ + 1] = phase;
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
    w.gap = at("gap");
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
  if (sample) keep(t);
}

void Recorder::keep(double t) {
  if (!samples_) return;
  const std::span<const double> values = board_.values();
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
    const double gap = v[w.gap];
    w.parted = w.parting && force <= 0.0 && gap > 0.0;
    if (w.parted) {
      w.last_touch = t - h * (w.last_gap < 0.0 ? gap / (gap - w.last_gap) : 1.0);
      w.parting = false;
    }
    w.last_gap = gap;
    if (force > 0.0) {
      w.last_touch = t;
      w.parting = true;
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
    w.event.end = std::max(w.event.start, t);
    out_.contacts.push_back(w.event);
  }
  std::stable_sort(out_.contacts.begin(), out_.contacts.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
}

double Recorder::parted_at(int contact_element) const {
  for (const Watch& w : watches_)
    if (w.element == contact_element) return w.last_touch;
  return -std::numeric_limits<double>::infinity();
}

bool Recorder::just_parted(int contact_element) const {
  for (const Watch& w : watches_)
    if (w.element == contact_element) return w.parted;
  return false;
}

}  // namespace stillhook
