#include "sim/lifting/tagline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/lifting/line.h"
#include "sim/specification.h"

namespace stillhook {

namespace {
constexpr double kSteepest = 0.1;  // least horizontal share of the line at the initial pose
}

TaglineCase tagline_case(double theta_rate, double error) {
  if (theta_rate < 0.0) return TaglineCase::C;
  return error >= 0.0 ? TaglineCase::A : TaglineCase::B;
}

double tagline_law(double theta, double theta_rate, double set_point, double kp, double kd) {
  const double e = theta - set_point;
  switch (tagline_case(theta_rate, e)) {
    case TaglineCase::A:
      return kp * e + kd * theta_rate;
    case TaglineCase::B:
      return kd * theta_rate;
    case TaglineCase::C:
      break;
  }
  return 0.0;
}

Tagline::Tagline(TaglineOptions options, const Instant& initial)
    : ForceElement(options.name), options_(std::move(options)) {
  const TaglineOptions& o = options_;
  const auto require = [&](bool holds, const char* field, const char* rule) {
    if (!holds) throw SpecificationError("taglines." + name(), field, rule);
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  const auto not_negative = [](double v) { return std::isfinite(v) && v >= 0.0; };
  require(not_negative(o.kp), "kp", "must be >= 0 N/rad");
  require(not_negative(o.kd), "kd", "must be >= 0 N s/rad");
  require(std::isfinite(o.set_point), "set_point", "must be finite");
  require(not_negative(o.pretension), "pretension", "must be >= 0 N");
  require(positive(o.tension_max), "tension_max", "must be > 0 N");
  require(o.pretension <= o.tension_max, "pretension", "must not be above tension_max");
  require(not_negative(o.speed_max), "speed_max", "must be >= 0 m/s");
  require(positive(o.time_constant), "time_constant", "must be > 0 s");
  require(positive(o.axial_stiffness), "axial_stiffness", "must be > 0 N");

  const Vector3 r = motion_of(o.to, initial).p - motion_of(o.from, initial).p;
  const double level = std::hypot(r.x(), r.y());
  require(r.norm() > 0.0, "point_to", "the line has no length at the initial pose");
  require(level >= kSteepest * r.norm(), "point_to", "the line is so steep at the initial pose that it has no plane");
  k_ = o.axial_stiffness / r.norm();
  const double psi = heading_angle(o.from.body, initial), c = std::cos(psi), s = std::sin(psi);
  angle_.upper = o.hoist_upper;
  angle_.lower = o.hoist_lower;
  angle_.heading_body = o.from.body;
  angle_.n_H = Vector3(c * r.x() + s * r.y(), -s * r.x() + c * r.y(), 0.0) / level;
}

bool Tagline::same_as(const ForceElement& other) const {
  const auto* line = dynamic_cast<const Tagline*>(&other);
  return line && line->options_ == options_ && line->k_ == k_ && line->angle_.n_H == angle_.n_H;
}

Tagline::Command Tagline::command(const PlaneAngle::Value& angle, bool pulling) const {
  const TaglineOptions& o = options_;
  Command c{.value = o.pretension};
  if (pulling) {
    const double e = angle.angle - o.set_point;
    const double law = o.kp * std::max(0.0, e) + o.kd * angle.rate;
    if (law > 0.0) {
      c.value += law;
      c.by_angle = e >= 0.0 ? o.kp : 0.0;
      c.by_rate = o.kd;
    }
  }
  if (c.value > o.tension_max) return {.value = o.tension_max, .limited = true};
  return c;
}

Tagline::Command Tagline::steady_command(const PlaneAngle::Value& angle) const {
  Command c = command({angle.angle, 0.0}, true);
  c.by_rate = 0.0;
  return c;
}

Tagline::Pull Tagline::pull(double length, double command, double h, Memory m) const {
  const double paid_out = m.state[kPaidOut];
  const double before = k_ * (m.scratch[kLength] - paid_out);
  const double a = 0.5 * h / options_.time_constant;
  const double wanted = ((1.0 - a) * before + a * (m.scratch[kCommand] + command)) / (1.0 + a);
  double out = length - m.scratch[kLength] - (wanted - before) / k_;  // line paid out in this step

  Pull p{.tension = wanted, .by_length = 0.0, .by_command = a / (1.0 + a)};
  const double most = options_.speed_max > 0.0 ? options_.speed_max * h : std::numeric_limits<double>::infinity();
  if (std::abs(out) > most) {
    out = std::copysign(most, out);
    p = {.tension = k_ * (length - paid_out - out), .by_length = k_, .by_command = 0.0, .limited = true};
  }
  if (p.tension > options_.tension_max) {
    const double slip = (p.tension - options_.tension_max) / k_;
    out += slip;
    p = {.tension = options_.tension_max, .slip_speed = slip / h, .limited = true};
  }
  p.paid_out = paid_out + out;
  p.line_speed = out / h;
  if (p.tension < 0.0) p.tension = p.by_length = p.by_command = 0.0;
  return p;
}

double Tagline::held_tension(const Instant& now, Memory m) const {
  if (!active(now)) return 0.0;
  return std::max(0.0, k_ * (line_motion(options_.to, options_.from, now).length - m.state[kPaidOut]));
}

void Tagline::start(const Instant& now, Memory m) const {
  const double length = line_motion(options_.to, options_.from, now).length;
  const Command c = active(now) ? steady_command(angle_.value(now)) : Command{};
  m.state[kPaidOut] = length - c.value / k_;
  m.state[kLineSpeed] = 0.0;
  m.state[kSlipSpeed] = 0.0;
  m.state[kSaturated] = c.limited ? 1.0 : 0.0;
}

void Tagline::begin_step(const Instant& before, double, Memory m) const {
  if (!active(before)) return;
  const PlaneAngle::Value angle = angle_.value(before);
  const bool pulling = tagline_case(angle.rate, angle.angle - options_.set_point) != TaglineCase::C;
  m.scratch[kLength] = line_motion(options_.to, options_.from, before).length;
  m.scratch[kCommand] = command(angle, pulling).value;
  m.scratch[kPulling] = pulling ? 1.0 : 0.0;
}

void Tagline::add_forces(const Instant& now, double h, Memory m, ForceSum& out) const {
  if (!active(now)) return;
  const LineMotion line = line_motion(options_.to, options_.from, now);
  const PlaneAngle::Value angle = angle_.value(now);
  const double tension = h > 0.0 ? pull(line.length, command(angle, m.scratch[kPulling] != 0.0).value, h, m).tension
                                 : steady_command(angle).value;
  add_line_forces(options_.to, options_.from, now, line, tension, out);
}

void Tagline::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  if (!active(now)) return;
  const LineMotion line = line_motion(options_.to, options_.from, now);
  const PlaneAngle::Value angle = angle_.value(now);
  Command c = steady_command(angle);
  Pull p{.tension = c.value, .by_command = 1.0};
  if (h > 0.0) {
    c = command(angle, m.scratch[kPulling] != 0.0);
    p = pull(line.length, c.value, h, m);
  }
  add_line_jacobian(options_.to, options_.from, now, line, p.tension, p.by_length, 0.0, out);
  const double by_angle = p.by_command * c.by_angle, by_rate = p.by_command * c.by_rate;
  if (by_angle == 0.0 && by_rate == 0.0) return;
  for (const PlaneAngle::Gradient& g : angle_.gradient(now)) {
    const Eigen::Matrix<double, 3, 6> A = -line.e * (by_angle * g.angle_xi + by_rate * g.rate_xi);
    const Eigen::Matrix<double, 3, 6> B = -line.e * (by_rate * g.rate_u);
    add_force_jacobian(options_.to, now, Vector3::Zero(), g.body, A, B, false, out);
    add_force_jacobian(options_.from, now, Vector3::Zero(), g.body, -A, -B, false, out);
  }
}

void Tagline::end_step(const Instant& now, double h, Memory m) const {
  if (!active(now)) {
    // Not connected yet: it follows without a pull.
    m.state[kPaidOut] = line_motion(options_.to, options_.from, now).length;
    m.state[kLineSpeed] = m.state[kSlipSpeed] = m.state[kSaturated] = 0.0;
    return;
  }
  if (h <= 0.0) return;
  const double length = line_motion(options_.to, options_.from, now).length;
  const Command c = command(angle_.value(now), m.scratch[kPulling] != 0.0);
  const Pull p = pull(length, c.value, h, m);
  m.state[kPaidOut] = p.paid_out;
  m.state[kLineSpeed] = p.line_speed;
  m.state[kSlipSpeed] = p.slip_speed;
  m.state[kSaturated] = c.limited || p.limited ? 1.0 : 0.0;
}

double Tagline::potential_energy(const Instant& now, Memory m) const {
  const double tension = held_tension(now, m);
  return 0.5 * tension * tension / k_;
}

double Tagline::dissipated_power(const Instant& now, Memory m) const {
  return held_tension(now, m) * m.state[kSlipSpeed];
}

std::vector<Channel> Tagline::channels() const {
  return {{name() + ".tension", "N", "tension"},
          {name() + ".command", "N", "commanded tension"},
          {name() + ".line_speed", "m/s", "speed of the line at the winch, positive paying out"},
          {name() + ".saturated", "1", "1 while the speed or the tension limit acts"},
          {name() + ".angle", "rad", "controlled angle of the hoist wire, positive away from the winch"},
          {name() + ".angle_rate", "rad/s", "its rate"}};
}

void Tagline::measure(const Instant& now, Memory m, std::span<double> out) const {
  const PlaneAngle::Value angle = angle_.value(now);
  const bool pulling = tagline_case(angle.rate, angle.angle - options_.set_point) != TaglineCase::C;
  out[0] = held_tension(now, m);
  out[1] = active(now) ? command(angle, pulling).value : 0.0;
  out[2] = active(now) ? m.state[kLineSpeed] : 0.0;
  out[3] = m.state[kSaturated];
  out[4] = angle.angle;
  out[5] = angle.rate;
}

}  // namespace stillhook
