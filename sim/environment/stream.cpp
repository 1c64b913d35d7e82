#include "sim/environment/stream.h"

#include <algorithm>
#include <cmath>

#include "sim/error.h"

namespace stillhook {
namespace {

constexpr double kNearBed = 0.01;  // of the depth, where the power law would become infinitely steep

Vector3 horizontal(double speed, double towards) { return {speed * std::cos(towards), speed * std::sin(towards), 0.0}; }

bool same_current(const CurrentSpec& a, const CurrentSpec& b) {
  return a.speed == b.speed && a.towards == b.towards && a.profile == b.profile && a.exponent == b.exponent &&
         std::equal(a.table.begin(), a.table.end(), b.table.begin(), b.table.end(), [](const auto& p, const auto& q) {
           return p.depth == q.depth && p.speed == q.speed && p.towards == q.towards;
         });
}

}  // namespace

WindStream::WindStream(const WindSpec& wind, int seed, double ramp)
    : wind_(wind), gusts_(wind, seed, ramp), direction_(horizontal(1.0, wind.towards())) {
  if (!(wind.speed >= 0.0 && wind.density > 0.0))
    throw SpecificationError("wind", "", "needs a speed >= 0 in air of density > 0");
}

StreamPoint WindStream::at(const Vector3& p_W, const Instant& now, std::span<double> memory) const {
  const WindSpeed mean = wind_speed(wind_, p_W.z(), now), gust = gusts_.at(p_W.z(), now, memory);
  StreamPoint s;
  s.velocity = (mean.value + gust.value) * direction_;
  s.by_place.col(2) = (mean.slope + gust.slope) * direction_;
  s.inside = p_W.z();
  s.inside_by_place = Vector3::UnitZ();
  return s;
}

Vector3 WindStream::at_hull(double distance, const Instant& now, std::span<double> memory) const {
  return (wind_speed(wind_, distance, now).value + gusts_.at(distance, now, memory).value) * direction_;
}

bool WindStream::same_as(const Stream& other) const {
  const auto* o = dynamic_cast<const WindStream*>(&other);
  return o && o->wind_.speed == wind_.speed && o->direction_ == direction_ && o->wind_.profile == wind_.profile &&
         o->wind_.exponent == wind_.exponent && o->wind_.density == wind_.density && o->gusts_ == gusts_;
}

CurrentStream::CurrentStream(const CurrentSpec& current, std::shared_ptr<const WaveField> waves, double depth,
                             double density)
    : current_(current), waves_(std::move(waves)), depth_(depth), density_(density) {
  using Profile = CurrentSpec::Profile;
  if (current_.profile == Profile::automatic) current_.profile = depth > 0.0 ? Profile::power : Profile::uniform;
  if (current_.profile == Profile::power && !(depth > 0.0))
    throw SpecificationError("sea.current", "profile", "\"power\" falls towards a bed: give sea.depth_m");
  if (current_.profile == Profile::table) {
    if (current_.table.empty()) throw SpecificationError("sea.current", "table", "needs one layer at least");
    for (std::size_t i = 0; i + 1 < current_.table.size(); ++i)
      if (!(current_.table[i].depth < current_.table[i + 1].depth))
        throw SpecificationError("sea.current", "table", "its depths must rise");
  }
  surface_ = horizontal(current_.speed, current_.towards.value_or(0.0));
}

CurrentStream::Velocity CurrentStream::in_table(double d, const Instant& now) const {
  const std::vector<CurrentSpec::Layer>& t = current_.table;
  const auto velocity = [&](std::size_t i) { return horizontal(t[i].speed, t[i].towards); };
  if (!now.on(d > t.front().depth)) return {velocity(0), Vector3::Zero()};
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    if (now.on(d <= t[i + 1].depth)) {
      const Vector3 slope = (velocity(i + 1) - velocity(i)) / (t[i + 1].depth - t[i].depth);
      return {velocity(i) + (d - t[i].depth) * slope, slope};
    }
  return {velocity(t.size() - 1), Vector3::Zero()};
}

CurrentStream::Velocity CurrentStream::at_depth(double d, const Instant& now) const {
  if (current_.profile == CurrentSpec::Profile::table) return in_table(d, now);
  // Above the surface, where areas that stand half out of the water have their centre, it is that at the surface.
  if (current_.profile == CurrentSpec::Profile::uniform || !now.on(d > 0.0)) return {surface_, Vector3::Zero()};
  const double left = 1.0 - d / depth_;
  if (!now.on(left > kNearBed)) return {std::pow(kNearBed, current_.exponent) * surface_, Vector3::Zero()};
  const double share = std::pow(left, current_.exponent);
  return {share * surface_, -current_.exponent * share / (left * depth_) * surface_};
}

StreamPoint CurrentStream::at(const Vector3& p_W, const Instant& now, std::span<double>) const {
  double zeta = 0.0, slope_x = 0.0, slope_y = 0.0;
  if (!waves_->calm())
    waves_->sample(now.t, {&p_W.x(), 1}, {&p_W.y(), 1}, {&p_W.z(), 1}, true,
                   {{&zeta, 1}, {&slope_x, 1}, {&slope_y, 1}, {}, {}, {}, {}});
  StreamPoint s;
  s.inside = zeta - p_W.z();
  s.inside_by_place = {slope_x, slope_y, -1.0};
  const Velocity v = at_depth(s.inside, now);
  s.velocity = v.value;
  s.by_place = v.by_depth * s.inside_by_place.transpose();
  return s;
}

Vector3 CurrentStream::at_hull(double distance, const Instant&, std::span<double>) const {
  return at_depth(distance, Instant()).value;
}

bool CurrentStream::same_as(const Stream& other) const {
  const auto* o = dynamic_cast<const CurrentStream*>(&other);
  return o && same_current(o->current_, current_) && *o->waves_ == *waves_ && o->depth_ == depth_ &&
         o->density_ == density_;
}

}  // namespace stillhook
