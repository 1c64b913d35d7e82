#include "sim/hull/rao_motion.h"

#include <algorithm>
#include <cmath>

#include "sim/number_text.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kAtTheEdge = 1e-6;         // relative: a wave at the first or last period of the table
constexpr double kNegligibleEnergy = 0.01;  // of the sea
constexpr double kWidestRaoGap = 45.5;      // deg: the middle of a cosine over 45 deg is 8 % low
constexpr double kNotedRaoGap = 30.5;       // deg: over 30 deg it is 3 % low

bool longer_than(const RaoTable& table, double w) { return w < table.frequencies.front() * (1.0 - kAtTheEdge); }
bool shorter_than(const RaoTable& table, double w) { return w > table.frequencies.back() * (1.0 + kAtTheEdge); }

std::string in_percent(double share) { return number_text(std::round(share * 1000.0) / 10.0) + " %"; }
std::string seconds(double w) { return number_text(std::round(kTwoPi / w * 100.0) / 100.0) + " s"; }
std::string in_degrees_from_bow(double b) {
  return number_text(std::round(std::remainder(b, kTwoPi) / kDegree * 10.0) / 10.0) + " deg";
}

}  // namespace

RaoMotion::RaoMotion(const BodySpec& body, const RaoTable& table, std::shared_ptr<const WaveField> waves,
                     std::vector<std::string>& notes)
    : waves_(std::move(waves)), reference_(body.hydrodynamics.rao.reference) {
  const RaoFrame frame(body);
  R_WH_ = rotation_from({0.0, 0.0, frame.heading});
  R_HB_ = frame.R_HB;
  const Matrix3 R_WB = rotation_from(body.attitude);
  mean_ = body.position + R_WB * reference_;
  const Vector3 Q = body.position + R_WB * frame.q;
  cover(body, table, notes);
  for (const WaveComponent& wave : waves_->components()) {
    if (longer_than(table, wave.frequency) || shorter_than(table, wave.frequency)) continue;
    const double towards = std::atan2(wave.sin_heading, wave.cos_heading) - frame.heading;
    Component c;
    c.frequency = wave.frequency;
    c.phase = wave.phase + wave.wavenumber * (Q.x() * wave.cos_heading + Q.y() * wave.sin_heading);
    c.motion = moved_by(table.between(wave.frequency, towards), frame.arm);
    for (auto& x : c.motion) x *= wave.amplitude;
    components_.push_back(c);
  }
}

void RaoMotion::cover(const BodySpec& body, const RaoTable& table, std::vector<std::string>& notes) const {
  const std::string entry = "bodies." + body.name + ".hydrodynamics.rao";
  const double heading = RaoFrame(body).heading;
  double energy = 0.0, longer = 0.0, shorter = 0.0, longest = 1e9, shortest = 0.0, widest = 0.0;
  for (const WaveComponent& wave : waves_->components()) {
    const double a2 = wave.amplitude * wave.amplitude;
    energy += a2;
    longest = std::min(longest, wave.frequency);
    shortest = std::max(shortest, wave.frequency);
    if (longer_than(table, wave.frequency)) longer += a2;
    if (shorter_than(table, wave.frequency)) shorter += a2;
    const double towards = std::atan2(wave.sin_heading, wave.cos_heading) - heading;
    const double gap = table.gap_at(towards) / kDegree;
    widest = std::max(widest, gap);
    if (gap > kWidestRaoGap)
      throw SpecificationError(
          entry, "file",
          "has no headings near waves that travel towards " + in_degrees_from_bow(towards) +
              " from the bow: the nearest to both sides must be at most 45 deg apart. Add rows for "
              "that heading, or port_starboard = true if the file is of one side only");
  }
  const std::string periods = seconds(table.frequencies.back()) + " to " + seconds(table.frequencies.front());
  if (longer > kNegligibleEnergy * energy)
    throw SpecificationError(entry, "file",
                             "covers periods of " + periods + ", but " + in_percent(longer / energy) +
                                 " of the sea's energy is in longer waves, up to " + seconds(longest) +
                                 ": add rows for longer periods");
  if (shorter > kNegligibleEnergy * energy && body.hydrodynamics.rao.beyond == RaoSpec::Beyond::refuse)
    throw SpecificationError(entry, "beyond",
                             "the file covers periods of " + periods + ", but " + in_percent(shorter / energy) +
                                 " of the sea's energy is in shorter waves, down to " + seconds(shortest) +
                                 ": add rows for shorter periods, or set beyond = \"cut\" if waves so short do not "
                                 "move this vessel");
  if (longer + shorter > 0.0)
    notes.push_back("bodies." + body.name + ": " + in_percent((longer + shorter) / energy) +
                    " of the sea's energy is in waves outside the periods of its RAOs (" + periods +
                    ") and does not move it");
  if (widest > kNotedRaoGap)
    notes.push_back("bodies." + body.name + ": waves come between headings of its RAOs that are " +
                    number_text(std::round(widest)) +
                    " deg apart; what is interpolated between them may be several per cent low");
}

FrameMotion RaoMotion::at(double t) const {
  const auto [r, r_t, r_tt] = waves_->ramp_derivatives(t);
  Vector6 s = Vector6::Zero(), s_t = Vector6::Zero(), s_tt = Vector6::Zero();
  if (r > 0.0)
    for (const Component& c : components_) {
      const double th = std::remainder(c.phase - c.frequency * t, kTwoPi), cosine = std::cos(th), sine = std::sin(th);
      for (Eigen::Index i = 0; i < 6; ++i) {
        const std::complex<double>& X = c.motion[static_cast<std::size_t>(i)];
        const double x = X.real() * cosine - X.imag() * sine;
        s[i] += x;
        s_t[i] += c.frequency * (X.real() * sine + X.imag() * cosine);
        s_tt[i] -= c.frequency * c.frequency * x;
      }
    }
  const Vector6 q = r * s, q_t = r_t * s + r * s_t, q_tt = r_tt * s + 2.0 * r_t * s_t + r * s_tt;

  // Rates of the turns Rz(q6) Ry(q5) Rx(q4): each about its axis as the turns before it leave it.
  const Matrix3 Rz = rotation_from({0.0, 0.0, q[5]}), Rzy = rotation_from({0.0, q[4], q[5]});
  const Vector3 z = Vector3::UnitZ(), y = Rz.col(1), x = Rzy.col(0);
  const Vector3 w_z = q_t[5] * z, w_zy = w_z + q_t[4] * y;
  const Vector3 w = w_zy + q_t[3] * x;
  const Vector3 w_dot = q_tt[5] * z + q_tt[4] * y + q_tt[3] * x + q_t[4] * w_z.cross(y) + q_t[3] * w_zy.cross(x);

  FrameMotion F;
  F.R = R_WH_ * rotation_from({q[3], q[4], q[5]}) * R_HB_;
  F.w = R_WH_ * w;
  F.w_dot = R_WH_ * w_dot;
  const Vector3 arm = -(F.R * reference_);  // from the reference point to Bo
  F.p = mean_ + R_WH_ * q.head<3>() + arm;
  F.v = R_WH_ * q_t.head<3>() + F.w.cross(arm);
  F.a = R_WH_ * q_tt.head<3>() + F.w_dot.cross(arm) + F.w.cross(F.w.cross(arm));
  return F;
}

bool RaoMotion::same_as(const PrescribedMotion& other) const {
  const auto* motion = dynamic_cast<const RaoMotion*>(&other);
  return motion && motion->components_ == components_ && motion->R_WH_ == R_WH_ && motion->R_HB_ == R_HB_ &&
         motion->mean_ == mean_ && motion->reference_ == reference_ && *motion->waves_ == *waves_;
}

}  // namespace stillhook
