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

std::vector<ShaperImpulse> shaper_impulses(ProfileSpec::Shaper shaper, double period, double damping) {
  if (shaper == ProfileSpec::Shaper::none) return {{1.0, 0.0}};
  require(std::isfinite(period) && period > 0.0, "the shaper's period must be > 0 s");
  require(damping >= 0.0 && damping < 1.0, "the shaper's damping must be in [0, 1)");
  const double root = std::sqrt(1.0 - damping * damping), half = 0.5 * period / root;
  const double k = std::exp(-damping * std::numbers::pi / root), sum = 1.0 + k;
  if (shaper == ProfileSpec::Shaper::zv) return {{1.0 / sum, 0.0}, {k / sum, half}};
  return {{1.0 / (sum * sum), 0.0}, {2.0 * k / (sum * sum), half}, {k * k / (sum * sum), 2.0 * half}};
}

RateProfile::RateProfile(const ProfileSpec& spec, double travel, double speed)
    : shape_(spec.shape), travel_(travel), ramp_(spec.ramp) {
  require(std::isfinite(travel), "the travel must be finite");
  require(std::isfinite(speed) && speed > 0.0, "the speed must be > 0");
  require(std::isfinite(spec.ramp) && spec.ramp >= 0.0, "the ramp must be >= 0 s");
  const std::vector<double> knots = relative_knots(spec);
  const std::vector<ShaperImpulse> impulses = shaper_impulses(spec.shaper, spec.shaper_period, spec.shaper_damping);
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
  base_duration_ = unit.time.back();
  impulses_ = impulses;
  knot_position_.assign(unit.time.size(), 0.0);
  for (double r : unit.rate) knot_rate_.push_back(speed_ * r);
  for (std::size_t i = 1; i < knot_time_.size(); ++i)
    knot_position_[i] =
        knot_position_[i - 1] + 0.5 * (knot_rate_[i] + knot_rate_[i - 1]) * (knot_time_[i] - knot_time_[i - 1]);
  find_peaks();
}

double RateProfile::position(double t) const {
  if (t <= 0.0) return 0.0;
  if (t >= duration()) return travel_;
  double sum = 0.0;
  for (const ShaperImpulse& impulse : impulses_) sum += impulse.share * base_position(t - impulse.time);
  return sum;
}

double RateProfile::rate(double t) const {
  if (t <= 0.0 || t >= duration()) return 0.0;
  double sum = 0.0;
  for (const ShaperImpulse& impulse : impulses_) sum += impulse.share * base_rate(t - impulse.time);
  return sum;
}

double RateProfile::base_position(double t) const {
  if (t <= 0.0) return 0.0;
  if (t >= base_duration_) return travel_;
  if (shape_ == ProfileSpec::Shape::s_curve) {
    // integral of sin^2(pi t / (2 ramp)), from either end
    const auto ramp_travel = [&](double s) {
      return speed_ * (0.5 * s - ramp_ / (2.0 * std::numbers::pi) * std::sin(std::numbers::pi * s / ramp_));
    };
    if (t < ramp_) return ramp_travel(t);
    if (t > base_duration_ - ramp_) return travel_ - ramp_travel(base_duration_ - t);
    return 0.5 * speed_ * ramp_ + speed_ * (t - ramp_);
  }
  const auto i = std::upper_bound(knot_time_.begin(), knot_time_.end(), t) - knot_time_.begin();
  const double s = t - knot_time_[i - 1], span = knot_time_[i] - knot_time_[i - 1];
  return knot_position_[i - 1] + s * (knot_rate_[i - 1] + 0.5 * s / span * (knot_rate_[i] - knot_rate_[i - 1]));
}

double RateProfile::base_rate(double t) const {
  if (t <= 0.0 || t >= base_duration_) return 0.0;
  if (shape_ == ProfileSpec::Shape::s_curve) {
    const double s = std::min(t, base_duration_ - t);
    if (s >= ramp_) return speed_;
    const double root = std::sin(0.5 * std::numbers::pi * s / ramp_);
    return speed_ * root * root;
  }
  const auto i = std::upper_bound(knot_time_.begin(), knot_time_.end(), t) - knot_time_.begin();
  const double share = (t - knot_time_[i - 1]) / (knot_time_[i] - knot_time_[i - 1]);
  return knot_rate_[i - 1] + share * (knot_rate_[i] - knot_rate_[i - 1]);
}

/// The rate between two instants where its formula changes: constant + slope t + cosine cos(wt) + sine sin(wt), where
/// either the slope or the wave is zero.
struct RateProfile::Piece {
  double constant = 0.0, slope = 0.0, cosine = 0.0, sine = 0.0;

  double rate(double t, double w) const {
    return constant + slope * t + cosine * std::cos(w * t) + sine * std::sin(w * t);
  }
  double acceleration(double t, double w) const {
    return slope + w * (sine * std::cos(w * t) - cosine * std::sin(w * t));
  }
  /// Instants in [from, to] between which rate and acceleration are monotonic.
  std::vector<double> extremes(double from, double to, double w) const {
    std::vector<double> times = {from, to};
    if (cosine == 0.0 && sine == 0.0) return times;
    // The wave is amplitude cos(wt - phase): every quarter of its period something has an extreme.
    const double quarter = 0.5 * std::numbers::pi / w, first = std::atan2(sine, cosine) / w;
    for (double k = std::ceil((from - first) / quarter); first + k * quarter <= to; ++k)
      times.push_back(first + k * quarter);
    return times;
  }
};

/// The formula of the rate around an instant that is no corner.
RateProfile::Piece RateProfile::piece_around(double t) const {
  Piece piece;
  for (const ShaperImpulse& impulse : impulses_) {
    const double s = t - impulse.time;
    if (s <= 0.0 || s >= base_duration_) continue;
    if (shape_ == ProfileSpec::Shape::s_curve && (s < ramp_ || s > base_duration_ - ramp_)) {
      // speed sin^2(w s / 2) = speed (1 - cos(w s)) / 2, from either end
      const double w = std::numbers::pi / ramp_, zero = impulse.time + (s < ramp_ ? 0.0 : base_duration_);
      const double half = 0.5 * speed_ * impulse.share;
      piece.constant += half;
      piece.cosine -= half * std::cos(w * zero);
      piece.sine -= half * std::sin(w * zero);
    } else {
      const auto k = std::upper_bound(knot_time_.begin(), knot_time_.end(), s) - knot_time_.begin();
      const double slope = (knot_rate_[k] - knot_rate_[k - 1]) / (knot_time_[k] - knot_time_[k - 1]);
      piece.slope += impulse.share * slope;
      piece.constant += impulse.share * (knot_rate_[k - 1] - slope * (impulse.time + knot_time_[k - 1]));
    }
  }
  return piece;
}

void RateProfile::find_peaks() {
  std::vector<double> corners;
  for (const ShaperImpulse& impulse : impulses_)
    for (const double t : knot_time_) corners.push_back(impulse.time + t);
  std::sort(corners.begin(), corners.end());
  const double w = ramp_ > 0.0 ? std::numbers::pi / ramp_ : 1.0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double from = corners[i - 1], to = corners[i];
    if (to - from <= 1e-12 * duration()) continue;  // they differ by rounding alone
    const Piece piece = piece_around(0.5 * (from + to));
    for (const double t : piece.extremes(from, to, w)) {
      peak_rate_ = std::max(peak_rate_, std::abs(piece.rate(t, w)));
      peak_acceleration_ = std::max(peak_acceleration_, std::abs(piece.acceleration(t, w)));
    }
  }
  if (ramp_ == 0.0) peak_acceleration_ = std::numeric_limits<double>::infinity();  // it jumps
}

}  // namespace stillhook
