#include "sim/lifting/tagline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/element_site.h"
#include "sim/lifting/line.h"
#include "sim/specification.h"

namespace stillhook {

namespace {
constexpr double kSteepest = 0.1;     // least horizontal share of the line at the initial pose
constexpr double kSwitchRate = 2e-4;  // rad/s, over which the Kp term sets in
}  // namespace

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
  for (std::size_t i = 0; i < o.schedule.size(); ++i) {
    const GainPoint& g = o.schedule[i];
    require(positive(g.fall), "gain_schedule", "every fall must be > 0 m");
    require(i == 0 || g.fall > o.schedule[i - 1].fall, "gain_schedule", "falls must be in rising order");
    require(not_negative(g.kp_factor) && not_negative(g.kd_factor), "gain_schedule", "factors must be >= 0");
  }
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

Tagline::Gains Tagline::gains(const Instant& now) const {
  const TaglineOptions& o = options_;
  if (o.schedule.empty()) return {.kp = o.kp, .kd = o.kd};
  const double fall = line_motion(o.hoist_lower, o.hoist_upper, now).length;
  const auto above =
      std::find_if(o.schedule.begin(), o.schedule.end(), [&](const GainPoint& g) { return now.on(g.fall > fall); });
  if (above == o.schedule.begin() || above == o.schedule.end()) {
    const GainPoint& end = above == o.schedule.end() ? o.schedule.back() : o.schedule.front();
    return {.kp = o.kp * end.kp_factor, .kd = o.kd * end.kd_factor};
  }
  const GainPoint &low = *(above - 1), &high = *above;
  const double width = high.fall - low.fall, x = (fall - low.fall) / width;
  const double kp_rise = o.kp * (high.kp_factor - low.kp_factor), kd_rise = o.kd * (high.kd_factor - low.kd_factor);
  return {o.kp * low.kp_factor + x * kp_rise, o.kd * low.kd_factor + x * kd_rise, kp_rise / width, kd_rise / width};
}

std::array<std::pair<int, Eigen::Matrix<double, 1, 6>>, 2> Tagline::fall_gradient(const Instant& now) const {
  const BodyPoint &lower = options_.hoist_lower, &upper = options_.hoist_upper;
  const LineMotion fall = line_motion(lower, upper, now);
  std::array<std::pair<int, Eigen::Matrix<double, 1, 6>>, 2> g;
  g[0] = {lower.body, Eigen::Matrix<double, 1, 6>::Zero()};
  g[1] = {upper.body, Eigen::Matrix<double, 1, 6>::Zero()};
  if (lower.body != kWorld) g[0].second = fall.e.transpose() * position_jacobian(lower, now);
  if (upper.body != kWorld) g[1].second = -fall.e.transpose() * position_jacobian(upper, now);
  return g;
}

Tagline::Command Tagline::command(const Instant& now) const {
  const TaglineOptions& o = options_;
  const PlaneAngle::Value angle = angle_.value(now);
  Command c{.value = o.pretension};
  if (now.on(angle.rate > 0.0)) {
    const Gains k = gains(now);
    const double over = angle.angle - o.set_point, e = now.on(over > 0.0) ? over : 0.0;
    const double x = now.on(angle.rate < kSwitchRate) ? angle.rate / kSwitchRate : 1.0;
    const double sets_in = x * x * (3.0 - 2.0 * x);
    c.value += sets_in * k.kp * e + k.kd * angle.rate;
    c.by_angle = e > 0.0 ? sets_in * k.kp : 0.0;
    c.by_rate = k.kd + 6.0 * x * (1.0 - x) / kSwitchRate * k.kp * e;
    c.by_fall = sets_in * k.kp_by_fall * e + k.kd_by_fall * angle.rate;
  }
  if (now.on(c.value > o.tension_max)) return {.value = o.tension_max, .limited = true};
  return c;
}

Tagline::Command Tagline::steady_command(const Instant& now) const {
  const TaglineOptions& o = options_;
  const double e = angle_.value(now).angle - o.set_point;
  Command c{.value = o.pretension};
  if (e > 0.0) {
    const Gains k = gains(now);
    c = {.value = o.pretension + k.kp * e, .by_angle = k.kp, .by_fall = k.kp_by_fall * e};
  }
  if (c.value > o.tension_max) return {.value = o.tension_max, .limited = true};
  return c;
}

Tagline::Pull Tagline::pull(double length, double command, double h, Memory m, Branches* branches) const {
  const double paid_out = m.state[kPaidOut];
  const double before = k_ * (m.scratch[kLength] - paid_out);
  const double a = 0.5 * h / options_.time_constant;
  const double wanted = ((1.0 - a) * before + a * (m.scratch[kCommand] + command)) / (1.0 + a);
  double out = length - m.scratch[kLength] - (wanted - before) / k_;  // line paid out in this step

  Pull p{.tension = wanted, .by_length = 0.0, .by_command = a / (1.0 + a)};
  p.by_length_before = k_ * (1.0 - a) / (1.0 + a);
  p.by_paid_before = -p.by_length_before;
  p.by_command_before = p.by_command;
  const double most = options_.speed_max > 0.0 ? options_.speed_max * h : std::numeric_limits<double>::infinity();
  if (on_branch(branches, std::abs(out) > most)) {
    out = std::copysign(most, out);
    p = {.tension = k_ * (length - paid_out - out), .by_length = k_, .by_command = 0.0, .limited = true};
    p.by_paid_before = -k_;
    p.held = true;
  }
  if (on_branch(branches, p.tension > options_.tension_max)) {
    const double slip = (p.tension - options_.tension_max) / k_;
    out += slip;
    p = {.tension = options_.tension_max, .slip_speed = slip / h, .limited = true};
  }
  p.paid_out = paid_out + out;
  p.line_speed = out / h;
  return p;
}

double Tagline::held_tension(const Instant& now, Memory m) const {
  if (!active(now)) return 0.0;
  const double tension = k_ * (line_motion(options_.to, options_.from, now).length - m.state[kPaidOut]);
  return now.on(tension > 0.0) ? tension : 0.0;
}

void Tagline::start(const Instant& now, Memory m) const {
  const double length = line_motion(options_.to, options_.from, now).length;
  const Command c = active(now) ? steady_command(now) : Command{};
  m.state[kPaidOut] = length - c.value / k_;
  m.state[kLineSpeed] = 0.0;
  m.state[kSlipSpeed] = 0.0;
  m.state[kSaturated] = c.limited ? 1.0 : 0.0;
}

void Tagline::begin_step(const Instant& before, double, Memory m) const {
  if (!active(before)) return;
  m.scratch[kLength] = line_motion(options_.to, options_.from, before).length;
  m.scratch[kCommand] = command(before).value;
}

void Tagline::add_forces(const Instant& now, double h, Memory m, ForceSum& out) const {
  if (!active(now)) return;
  const LineMotion line = line_motion(options_.to, options_.from, now);
  double tension =
      h > 0.0 ? pull(line.length, command(now).value, h, m, now.branches).tension : steady_command(now).value;
  if (!now.on(tension > 0.0)) tension = 0.0;
  add_line_forces(options_.to, options_.from, now, line, tension, out);
}

void Tagline::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  if (!active(now)) return;
  const LineMotion line = line_motion(options_.to, options_.from, now);
  Command c = steady_command(now);
  Pull p{.tension = c.value, .by_command = 1.0};
  if (h > 0.0) {
    c = command(now);
    p = pull(line.length, c.value, h, m);
    if (p.tension < 0.0) return;
  }
  add_line_jacobian(options_.to, options_.from, now, line, p.tension, p.by_length, 0.0, out);
  if (const double by_fall = p.by_command * c.by_fall; by_fall != 0.0)
    for (const auto& [body, gradient] : fall_gradient(now)) {
      const Eigen::Matrix<double, 3, 6> A = -line.e * (by_fall * gradient), none = Eigen::Matrix<double, 3, 6>::Zero();
      add_force_jacobian(options_.to, now, Vector3::Zero(), body, A, none, false, out);
      add_force_jacobian(options_.from, now, Vector3::Zero(), body, -A, none, false, out);
    }
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
  const Command c = command(now);
  const Pull p = pull(length, c.value, h, m, now.branches);
  m.state[kPaidOut] = p.paid_out;
  m.state[kLineSpeed] = p.line_speed;
  m.state[kSlipSpeed] = p.slip_speed;
  m.state[kSaturated] = c.limited || p.limited ? 1.0 : 0.0;
}

void Tagline::add_changes(const Instant& at, const Command& c, const BodyChange& bodies, Eigen::RowVectorXd& length,
                          Eigen::RowVectorXd& command_change) const {
  const LineMotion line = line_motion(options_.to, options_.from, at);
  const auto add_length = [&](const BodyPoint& end, double sign) {
    if (end.body == kWorld) return;
    length.noalias() +=
        (sign * line.e.transpose() * position_jacobian(end, at)) * bodies.xi.middleRows<6>(6 * end.body);
  };
  add_length(options_.to, 1.0);
  add_length(options_.from, -1.0);
  if (c.by_fall != 0.0)
    for (const auto& [body, gradient] : fall_gradient(at))
      if (body != kWorld) command_change.noalias() += (c.by_fall * gradient) * bodies.xi.middleRows<6>(6 * body);
  if (c.by_angle == 0.0 && c.by_rate == 0.0) return;
  for (const PlaneAngle::Gradient& g : angle_.gradient(at)) {
    if (g.body == kWorld) continue;
    command_change.noalias() += (c.by_angle * g.angle_xi + c.by_rate * g.rate_xi) * bodies.xi.middleRows<6>(6 * g.body);
    command_change.noalias() += (c.by_rate * g.rate_u) * bodies.u.middleRows<6>(6 * g.body);
  }
}

bool Tagline::add_history_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                                  const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const {
  if (!active(now) || h <= 0.0) return true;
  const LineMotion line = line_motion(options_.to, options_.from, now);
  const Pull p = pull(line.length, command(now).value, h, m);
  if (p.tension < 0.0) return true;
  Eigen::RowVectorXd length = Eigen::RowVectorXd::Zero(dQ.cols()), command_change = length;
  add_changes(before, command(before), from, length, command_change);
  const Eigen::RowVectorXd tension =
      p.by_length_before * length + p.by_paid_before * state.row(kPaidOut) + p.by_command_before * command_change;
  ForceSum unit(static_cast<int>(now.body.size()));
  add_line_forces(options_.to, options_.from, now, line, 1.0, unit);
  dQ.noalias() += unit.value() * tension;
  return true;
}

bool Tagline::advance_state_tangent(const Instant& before, const Instant& now, double h, Memory m,
                                    const BodyChange& from, const BodyChange& to, Eigen::Ref<MatrixX> state) const {
  const LineMotion line = line_motion(options_.to, options_.from, now);
  Eigen::RowVectorXd length = Eigen::RowVectorXd::Zero(state.cols()), command_change = length;
  const Command c = active(now) ? command(now) : Command{};
  add_changes(now, c, to, length, command_change);
  const Eigen::RowVectorXd paid_before = state.row(kPaidOut);
  state.setZero();
  if (!active(now)) {
    state.row(kPaidOut) = length;
    return true;
  }
  const Pull p = pull(line.length, c.value, h, m);
  if (p.held && p.slip_speed == 0.0) {
    state.row(kPaidOut) = paid_before;
    return true;
  }
  // Elsewhere the line paid out is what the tension leaves of its length.
  Eigen::RowVectorXd length_before = Eigen::RowVectorXd::Zero(state.cols()), command_before = length_before;
  add_changes(before, command(before), from, length_before, command_before);
  const Eigen::RowVectorXd tension = p.by_length * length + p.by_command * command_change +
                                     p.by_length_before * length_before + p.by_paid_before * paid_before +
                                     p.by_command_before * command_before;
  state.row(kPaidOut) = length - tension / k_;
  state.row(kLineSpeed) = (state.row(kPaidOut) - paid_before) / h;
  return true;
}

double Tagline::potential_energy(const Instant& now, Memory m) const {
  const double tension = held_tension(now, m);
  return 0.5 * tension * tension / k_;
}

double Tagline::dissipated_power(const Instant& now, Memory m) const {
  return held_tension(now, m) * m.state[kSlipSpeed];
}

std::vector<Channel> Tagline::channels() const { return channels_of(name(), tagline_channels::all); }

void Tagline::measure(const Instant& now, Memory m, std::span<double> out) const {
  const PlaneAngle::Value angle = angle_.value(now);
  out[0] = held_tension(now, m);
  out[1] = active(now) ? command(now).value : 0.0;
  out[2] = active(now) ? m.state[kLineSpeed] : 0.0;
  out[3] = m.state[kSaturated];
  out[4] = angle.angle;
  out[5] = angle.rate;
}

std::unique_ptr<const ForceElement> make_element(const TaglineSpec& t, const ElementSite& site) {
  TaglineOptions o;
  o.name = t.name;
  o.from = site.point(t.from, t.point_from);
  o.to = site.point(t.to, t.point_to);
  for (const WireSpec& w : site.specification().wires)
    if (w.name == t.wire) {
      o.hoist_upper = site.point(w.from, w.point_from);
      o.hoist_lower = site.point(w.to, w.point_to);
    }
  o.kp = t.kp;
  o.kd = t.kd;
  for (const GainPointSpec& g : t.gain_schedule) o.schedule.push_back({g.fall, g.kp_factor, g.kd_factor});
  o.set_point = t.set_point;
  o.pretension = t.pretension;
  o.tension_max = t.tension_max;
  o.speed_max = t.speed_max;
  o.time_constant = t.time_constant;
  o.axial_stiffness = t.axial_stiffness;
  o.active = t.active;
  o.active_from_phase = site.first_phase(t.active_from, "taglines." + t.name);
  return std::make_unique<const Tagline>(o, site.now());
}

}  // namespace stillhook
