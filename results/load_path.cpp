#include "results/load_path.h"

#include <algorithm>
#include <cmath>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// Of the static load: a wire that is to hold less than this beside a load at rest may as well hang loose.
constexpr double kMeantToHold = 0.05;

double static_sum(const RunView& view, std::size_t pose, const std::vector<std::string>& channels) {
  double sum = 0.0;
  for (const std::string& name : channels) sum += view.static_value(pose, name);
  return sum;
}

double larger(double a, double b) { return std::isnan(a) || b > a ? b : a; }

/// The static sum in the pose nearest to a phase in which the load hangs; NaN if it hangs in none.
double nearest_hanging(const RunView& view, std::size_t phase, const std::vector<std::string>& channels) {
  const std::size_t poses = view.run().static_poses.size();
  for (std::size_t away = 1; away <= poses; ++away) {
    double found = kNaN;
    if (phase >= away && view.hangs(phase - away)) found = static_sum(view, phase - away, channels);
    if (phase + 1 + away < poses && view.hangs(phase + 1 + away))
      found = larger(found, static_sum(view, phase + 1 + away, channels));
    if (!std::isnan(found)) return found;
  }
  return kNaN;
}

/// Smallest ratio in a phase in which the load hangs free throughout.
void take_hanging(const RunView& view, std::size_t p, const std::string& channel, Peak& smallest) {
  const StaticLoad static_load(view, p, {channel});
  const auto take = [&](double tension, double t) {
    const double at_rest = static_load.at(t);
    if (at_rest > 0.0) smallest.take_smaller(tension / at_rest, t);
  };
  if (const Peak low = view.minimum(channel, {p}); low.valid()) take(low.value, low.time);
  const auto tension = view.series(channel);
  const RunView::Range range = view.samples(p);
  for (std::size_t i = range.first; i < range.last && i < tension.size(); ++i) take(tension[i], view.run().time[i]);
}

/// The same in a phase that begins or ends with the load at rest.
void take_resting(const RunView& view, std::size_t p, const std::string& channel, double free_from, double free_until,
                  Peak& smallest) {
  const auto tension = view.series(channel);
  const double low = std::min(view.static_value(p, channel), view.static_value(p + 1, channel));
  const bool landed = view.run().phases[p].stage != Stage::transfer;
  const StaticLoad static_load(view, p, {channel});
  const auto take = [&](double tension_then, double t) {
    const double whole = static_load.at(t);
    if (!(whole > 0.0)) return;
    const bool free = t >= free_from && t < free_until && view.run().phases[p].stage != Stage::landed;
    if (free) smallest.take_smaller(tension_then / whole, t);
    if (!free && landed && t >= free_until && low > kMeantToHold * whole) smallest.take_smaller(tension_then / low, t);
  };
  // The smallest of every step, should it fall into the time that counts, and else what the samples know.
  if (const Peak least = view.minimum(channel, {p}); least.valid()) take(least.value, least.time);
  const RunView::Range range = view.samples(p);
  for (std::size_t i = range.first; i < range.last && i < tension.size(); ++i) take(tension[i], view.run().time[i]);
}

}  // namespace

double lift_off_time(const RunView& view) {
  const std::vector<std::size_t> transfer = view.phases_of({Stage::transfer});
  const std::vector<std::size_t> hanging = view.phases_of({Stage::hanging});
  const std::vector<std::size_t>& lifting = transfer.empty() ? hanging : transfer;
  const std::vector<ContactSpec>& contacts = view.specification().contacts;
  if (lifting.empty() || std::none_of(contacts.begin(), contacts.end(),
                                      [](const ContactSpec& c) { return c.role == ContactSpec::Role::pickup; }))
    return kNaN;
  double t = view.run().phases[lifting.front()].start;
  for (bool moved = true; moved;) {
    moved = false;
    for (const ContactEvent& event : view.run().contacts) {
      if (event.role != ContactSpec::Role::pickup || event.start > t || event.end <= t) continue;
      t = event.end;
      moved = true;
    }
  }
  return t < view.end() ? t : kNaN;
}

double landing_time(const RunView& view) {
  double first = std::numeric_limits<double>::infinity();
  for (const ContactEvent& event : view.run().contacts)
    if (event.role == ContactSpec::Role::target && event.start > view.start()) first = std::min(first, event.start);
  return first;
}

StaticLoad::StaticLoad(const RunView& view, std::size_t phase, const std::vector<std::string>& channels)
    : view_(view), phase_(phase) {
  const bool from = view.hangs(phase), to = view.hangs(phase + 1);
  if (from && to) {
    for (const std::string& name : channels) paths_.push_back(view.static_path(phase, name));
    return;
  }
  constant_ = larger(static_sum(view, phase, channels), static_sum(view, phase + 1, channels));
  if (from || to) return;
  const double hanging = nearest_hanging(view, phase, channels);
  constant_ = std::isnan(hanging) ? kNaN : larger(constant_, hanging);
}

double StaticLoad::at(double t) const {
  if (paths_.empty()) return constant_;
  const double progress = view_.progress(phase_, t);
  double sum = 0.0;
  for (const StaticPath& path : paths_) sum += path.at(progress);
  return sum;
}

Peak largest_amplification(const RunView& view, const std::vector<std::string>& channels,
                           const std::vector<std::size_t>& phases) {
  Peak largest;
  std::vector<std::span<const double>> series;
  for (const std::string& name : channels) series.push_back(view.series(name));
  const bool sampled = std::none_of(series.begin(), series.end(), [](const auto& s) { return s.empty(); });
  for (const std::size_t p : phases) {
    const StaticLoad static_load(view, p, channels);
    const auto take = [&](double tension, double t) {
      const double at_rest = static_load.at(t);
      if (at_rest > 0.0) largest.take_larger(tension / at_rest, t);
    };
    if (channels.size() == 1)
      if (const Peak high = view.maximum(channels[0], {p}); high.valid()) take(high.value, high.time);
    if (!sampled) continue;
    const RunView::Range range = view.samples(p);
    for (std::size_t i = range.first; i < range.last; ++i) {
      double sum = 0.0;
      for (const auto& values : series) sum += values[i];
      take(sum, view.run().time[i]);
    }
  }
  return largest;
}

Peak smallest_share(const RunView& view, const std::string& channel, std::size_t phase) {
  Peak smallest;
  const Stage stage = view.run().phases[phase].stage;
  if (stage == Stage::on_barge) return smallest;
  if (stage == Stage::hanging) {
    take_hanging(view, phase, channel, smallest);
    return smallest;
  }
  const std::vector<ContactSpec>& contacts = view.specification().contacts;
  const bool has_support = std::any_of(contacts.begin(), contacts.end(),
                                       [](const ContactSpec& c) { return c.role == ContactSpec::Role::pickup; });
  const double free_from = has_support ? lift_off_time(view) : view.start(), free_until = landing_time(view);
  take_resting(view, phase, channel, free_from, free_until, smallest);
  return smallest;
}

}  // namespace stillhook
