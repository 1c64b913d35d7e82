#include "sim/lifting/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace stillhook {

namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("rate profile: ") + rule);
}

// Where the two ramps and the plateau (or the knots) of a rate with its largest value at one lie.
struct UnitPolyline {
  std::vector<double> time, rate;
  double area() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < time.size(); ++i) sum += 0.5 * (rate[i] + rate[i - 1]) * (time[i] - time[i - 1]);
    return sum;
  }
};

UnitPolyline polyline(const std::vector<double>& knots, double ramp, double interval) {
  UnitPolyline line;
  line.time.push_back(0.0);
  line.rate.push_back(0.0);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    line.time.push_back(ramp + static_cast<double>(i) * interval);
    line.rate.push_back(knots[i]);
  }
  line.time.push_back(line.time.back() + ramp);
  line.rate.push_back(0.0);
  return line;
}

// Relative speeds between the two zeros, largest one. A plateau is two equal knots.
std::vector<double> relative_knots(const ProfileSpec& spec) {
  if (spec.shape != ProfileSpec::Shape::knots) return {1.0, 1.0};
  require(!spec.knots.empty(), "the shape `knots` needs at least one knot");
  for (double k : spec.knots) require(std::isfinite(k) && k >= 0.0, "knots must be finite and >= 0");
  const double largest = *std::max_element(spec.knots.begin(), spec.knots.end());
  require(largest > 0.0, "at least one knot must be > 0");
  std::vector<double> knots = spec.knots;
  for (double& k : knots) k /= largest;
  if (knots.size() == 1) knots.push_back(knots.front());
  return knots;
}

}  // namespace

RateProfile::RateProfile(const ProfileSpec& spec, double travel, double speed)
    : shape_(spec.shape), travel_(travel), ramp_(spec.ramp) {
  require(std::isfinite(travel), "the travel must be finite");
  require(std::isfinite(speed) && speed > 0.0, "the speed must be > 0");
  require(std::isfinite(spec.ramp) && spec.ramp >= 0.0, "the ramp must be >= 0 s");
  const std::vector<double> knots = relative_knots(spec);
  if (travel == 0.0) return;

  // Travel = speed (ramps + interval x sum), so the interval between knots follows. It is never so short that the
  // rate changes faster between two knots than in a ramp to full speed; below that the speed is lowered instead.
  double steepest = 0.0;
  const double ramps = 0.5 * ramp_ * (knots.front() + knots.back());
  double sum = 0.0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    sum += 0.5 * (knots[i] + knots[i - 1]);
    steepest = std::max(steepest, std::abs(knots[i] - knots[i - 1]));
  }
  const double shortest = ramp_ * steepest;
  const double interval = std::max((std::abs(travel) / speed - ramps) / sum, shortest);
  const UnitPolyline unit = polyline(knots, ramp_, interval);
  speed_ = travel / unit.area();
  knot_time_ = unit.time;
  duration_ = unit.time.back();
  knot_position_.assign(unit.time.size(), 0.0);
  for (double r : unit.rate) knot_rate_.push_back(speed_ * r);
  for (std::size_t i = 1; i < knot_time_.size(); ++i)
    knot_position_[i] =
        knot_position_[i - 1] + 0.5 * (knot_rate_[i] + knot_rate_[i - 1]) * (knot_time_[i] - knot_time_[i - 1]);
}

double RateProfile::position(double t) const {
  if (t <= 0.0) return 0.0;
  if (t >= duration_) return travel_;
  if (shape_ == ProfileSpec::Shape::s_curve) {
    // integral of sin^2(pi t / (2 ramp)), from either end
    const auto ramp_travel = [&](double s) {
      return speed_ * (0.5 * s - ramp_ / (2.0 * std::numbers::pi) * std::sin(std::numbers::pi * s / ramp_));
    };
    if (t < ramp_) return ramp_travel(t);
    if (t > duration_ - ramp_) return travel_ - ramp_travel(duration_ - t);
    return 0.5 * speed_ * ramp_ + speed_ * (t - ramp_);
  }
  const auto i = std::upper_bound(knot_time_.begin(), knot_time_.end(), t) - knot_time_.begin();
  const double s = t - knot_time_[i - 1], span = knot_time_[i] - knot_time_[i - 1];
  return knot_position_[i - 1] + s * (knot_rate_[i - 1] + 0.5 * s / span * (knot_rate_[i] - knot_rate_[i - 1]));
}

double RateProfile::rate(double t) const {
  if (t <= 0.0 || t >= duration_) return 0.0;
  if (shape_ == ProfileSpec::Shape::s_curve) {
    const double s = std::min(t, duration_ - t);
    if (s >= ramp_) return speed_;
    const double root = std::sin(0.5 * std::numbers::pi * s / ramp_);
    return speed_ * root * root;
  }
  const auto i = std::upper_bound(knot_time_.begin(), knot_time_.end(), t) - knot_time_.begin();
  const double share = (t - knot_time_[i - 1]) / (knot_time_[i] - knot_time_[i - 1]);
  return knot_rate_[i - 1] + share * (knot_rate_[i] - knot_rate_[i - 1]);
}

double RateProfile::peak_rate() const { return std::abs(speed_); }

double RateProfile::peak_acceleration() const {
  if (duration_ == 0.0) return 0.0;
  if (ramp_ == 0.0) return std::numeric_limits<double>::infinity();
  if (shape_ == ProfileSpec::Shape::s_curve) return 0.5 * std::numbers::pi * std::abs(speed_) / ramp_;
  double largest = 0.0;
  for (std::size_t i = 1; i < knot_time_.size(); ++i) {
    const double span = knot_time_[i] - knot_time_[i - 1];
    if (span > 0.0) largest = std::max(largest, std::abs(knot_rate_[i] - knot_rate_[i - 1]) / span);
  }
  return largest;
}

}  // namespace stillhook
