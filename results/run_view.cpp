#include "results/run_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/lifting/contact.h"
#include "sim/run_channels.h"
#include "sim/samples.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// A contact that carries less than this (N) in a static pose is open; the smallest loads of interest weigh tonnes.
constexpr double kOpenContact = 100.0;

}  // namespace

RunView::RunView(const Specification& specification, const Trajectory& trajectory)
    : specification_(specification), run_(trajectory), all_phases_(trajectory.phases.size()) {
  for (std::size_t i = 0; i < run_.channels.size(); ++i) index_.emplace(run_.channels[i].name, static_cast<int>(i));
  std::iota(all_phases_.begin(), all_phases_.end(), std::size_t{0});

  for (const StaticPose& pose : run_.static_poses) {
    bool free = true;
    for (const ContactSpec& contact : specification_.contacts) {
      if (contact.role == ContactSpec::Role::other) continue;
      const auto force = pose.values.find(contact_channels::force.of(contact));
      if (force != pose.values.end() && force->second > kOpenContact) free = false;
    }
    hangs_.push_back(free);
  }

  moving_.resize(run_.phases.size());
  for (std::size_t p = 0; p < run_.phases.size() && p + 1 < run_.static_poses.size(); ++p) {
    const std::vector<double>& from = run_.static_poses[p].drives;
    const std::vector<double>& to = run_.static_poses[p + 1].drives;
    for (std::size_t d = 0; d < specification_.drives.size() && d < from.size() && d < to.size(); ++d) {
      const DriveSpec& drive = specification_.drives[d];
      // A tow moves the barge, not the load's static path.
      if (drive.kind == DriveSpec::Kind::tow || std::abs(to[d] - from[d]) < 1e-9) continue;
      const auto position = series(drive_channels::position.of(drive));
      if (!position.empty()) moving_[p].push_back({position, from[d], to[d]});
    }
  }
  kept_ = std::move(read_);  // the drives' positions; moved as a whole, so that the spans stay
  read_.clear();
}

void RunView::forget() const { read_.clear(); }

int RunView::channel(const std::string& name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? -1 : found->second;
}

std::span<const double> RunView::series(const std::string& name) const {
  const int c = channel(name);
  if (c < 0) return {};
  const std::size_t k = static_cast<std::size_t>(c);
  const bool held = k < run_.values.size() && run_.values[k].size() == run_.time.size();
  if (held) return run_.values[k];
  if (!run_.source) return {};
  if (const auto kept = kept_.find(c); kept != kept_.end()) return kept->second;
  const auto [found, added] = read_.try_emplace(c);
  if (added) found->second = run_.source->series(k);
  return found->second;
}

std::vector<std::size_t> RunView::phases_of(std::initializer_list<Stage> stages) const {
  std::vector<std::size_t> result;
  for (std::size_t p = 0; p < run_.phases.size(); ++p)
    if (std::find(stages.begin(), stages.end(), run_.phases[p].stage) != stages.end()) result.push_back(p);
  return result;
}

RunView::Range RunView::samples(std::size_t phase) const {
  const PhaseRecord& record = run_.phases[phase];
  // Sample times and phase ends come from the same sums of steps; the slack covers their rounding.
  const double slack = 1e-9 * std::max(1.0, std::abs(record.end));
  const auto first = std::lower_bound(run_.time.begin(), run_.time.end(), record.start - slack);
  const auto last = std::upper_bound(run_.time.begin(), run_.time.end(), record.end + slack);
  return {static_cast<std::size_t>(first - run_.time.begin()), static_cast<std::size_t>(last - run_.time.begin())};
}

std::string RunView::phase_at(double t) const {
  for (std::size_t p = run_.phases.size(); p-- > 0;)
    if (t >= run_.phases[p].start && t <= end()) return run_.phases[p].name;
  return {};
}

double RunView::start() const {
  if (!run_.phases.empty()) return run_.phases.front().start;
  return run_.time.empty() ? kNaN : run_.time.front();
}

double RunView::end() const {
  // The last sample may lie a little beyond the end of the last phase.
  if (!run_.phases.empty()) return run_.phases.back().end;
  return run_.time.empty() ? kNaN : run_.time.back();
}

Peak RunView::maximum(const std::string& name, const std::vector<std::size_t>& phases) const {
  Peak peak;
  const int c = channel(name);
  if (c < 0) return peak;
  for (std::size_t p : phases) {
    if (p >= run_.extremes.size() || static_cast<std::size_t>(c) >= run_.extremes[p].size()) continue;
    const Extreme& e = run_.extremes[p][static_cast<std::size_t>(c)];
    if (std::isfinite(e.max)) peak.take_larger(e.max, e.t_max);
  }
  return peak;
}

Peak RunView::minimum(const std::string& name, const std::vector<std::size_t>& phases) const {
  Peak peak;
  const int c = channel(name);
  if (c < 0) return peak;
  for (std::size_t p : phases) {
    if (p >= run_.extremes.size() || static_cast<std::size_t>(c) >= run_.extremes[p].size()) continue;
    const Extreme& e = run_.extremes[p][static_cast<std::size_t>(c)];
    if (std::isfinite(e.min)) peak.take_smaller(e.min, e.t_min);
  }
  return peak;
}

Peak RunView::largest_magnitude(const std::string& name, const std::vector<std::size_t>& phases) const {
  const Peak high = maximum(name, phases), low = minimum(name, phases);
  if (!high.valid()) return {};
  return std::abs(low.value) > std::abs(high.value) ? Peak{std::abs(low.value), low.time}
                                                    : Peak{std::abs(high.value), high.time};
}

double RunView::static_value(std::size_t pose, const std::string& name) const {
  if (pose >= run_.static_poses.size()) return kNaN;
  const auto found = run_.static_poses[pose].values.find(name);
  return found == run_.static_poses[pose].values.end() ? kNaN : found->second;
}

bool RunView::hangs(std::size_t pose) const { return pose < hangs_.size() && hangs_[pose]; }

StaticPath RunView::static_path(std::size_t phase, const std::string& name) const {
  return {hangs(phase) ? static_value(phase, name) : kNaN, hangs(phase + 1) ? static_value(phase + 1, name) : kNaN};
}

double RunView::static_at(std::size_t phase, double t, const std::string& name) const {
  return static_path(phase, name).at(progress(phase, t));
}

double RunView::planned_at(std::size_t phase, double t, const std::string& name) const {
  const double from = static_value(phase, name), to = static_value(phase + 1, name);
  return from + (to - from) * progress(phase, t);
}

double RunView::sample_at(std::span<const double> values, double t) const {
  const auto after = std::lower_bound(run_.time.begin(), run_.time.end(), t);
  if (after == run_.time.begin()) return values.front();
  if (after == run_.time.end()) return values.back();
  const std::size_t i = static_cast<std::size_t>(after - run_.time.begin());
  const double share = (t - run_.time[i - 1]) / (run_.time[i] - run_.time[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

double RunView::progress(std::size_t phase, double t) const {
  const PhaseRecord& record = run_.phases[phase];
  if (moving_[phase].empty()) {
    const double length = record.end - record.start;
    return length > 0.0 ? std::clamp((t - record.start) / length, 0.0, 1.0) : 1.0;
  }
  double sum = 0.0;
  for (const MovingDrive& drive : moving_[phase])
    sum += std::clamp((sample_at(drive.position, t) - drive.from) / (drive.to - drive.from), 0.0, 1.0);
  return sum / static_cast<double>(moving_[phase].size());
}

}  // namespace stillhook
