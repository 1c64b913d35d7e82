#include "sim/hull/coefficients/rao_table.h"

#include <algorithm>
#include <cmath>

#include "sim/hull/coefficients/rao_rows.h"
#include "sim/number_text.h"
#include "sim/sea/dispersion.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kSameRaoHeading = 1e-4;  // rad: headings are printed with a digit or two after the point
constexpr double kSameRaoPeriod = 1e-6;   // relative
constexpr double kMirroredShare = 0.02;   // of the largest sway, roll or yaw: rounding in a following or head sea
constexpr double kLongRaoWave = 0.3;      // rad/s: 690 m long, several times any vessel
constexpr double kSlowRaoWave = 0.2;      // rad/s: 1500 m, slower than a ship rolls
constexpr double kOdd = 0.5;              // of what the surface does

double in_circle(double angle) {
  const double b = std::fmod(angle, kTwoPi);
  const double positive = b < -kSameRaoHeading ? b + kTwoPi : std::max(b, 0.0);
  return positive > kTwoPi - kSameRaoHeading ? 0.0 : positive;
}

std::string degrees(double angle) { return number_text(std::round(angle / kDegree * 1e4) / 1e4) + " deg"; }

/// The heading in our sense of one of the file's.
double file_heading(const RaoSpec& spec, double given) {
  const double turned = spec.turn == RaoSpec::Turn::port ? given : -given;
  return in_circle(spec.direction == RaoSpec::Direction::towards ? turned : turned + std::numbers::pi);
}

/// Rows at the file's reference point and phase origin become those of Q.
Raos at_q(const RaoRow& row, double heading, const RaoSpec& spec, const RaoFrame& frame, double gravity, double depth) {
  Raos X;
  for (std::size_t i = 0; i < 6; ++i)
    X[i] = std::polar(1.0, row.lag[i]) * (spec.reversed[i] ? -row.amplitude[i] : row.amplitude[i]);
  // th at the phase origin is th at Q and k along: what goes with exp(i th_0) goes with exp(i k along) exp(i th_Q).
  const double k = wave_number(row.frequency, gravity, depth);
  const double along = frame.to_phase.x() * std::cos(heading) + frame.to_phase.y() * std::sin(heading);
  for (auto& x : X) x *= std::polar(1.0, k * along);
  return moved_by(X, -frame.arm);
}

class TableBuilder {
 public:
  TableBuilder(const BodySpec& body, double gravity, double depth, RaoRows rows)
      : spec_(body.hydrodynamics.rao), frame_(body), gravity_(gravity), depth_(depth), rows_(std::move(rows)) {}

  RaoTable build() {
    table_.source = spec_.file;
    collect_axes();
    table_.values.resize(table_.frequencies.size() * table_.headings.size());
    std::vector<int> line(table_.values.size(), 0);
    for (const RaoRow& row : rows_.rows) {
      const double heading = file_heading(spec_, row.heading);
      const std::size_t cell = find_frequency(row.frequency) * table_.headings.size() + find_heading(heading);
      const Raos X = at_q(row, heading, spec_, frame_, gravity_, depth_);
      if (line[cell] > 0)
        rows_.fail(row.line, "gives a period and heading once more that line " + std::to_string(line[cell]) + " has");
      table_.values[cell] = X;
      line[cell] = row.line;
    }
    for (std::size_t cell = 0; cell < line.size(); ++cell)
      if (line[cell] == 0) refuse_hole(cell);
    if (spec_.port_starboard) mirror();
    return std::move(table_);
  }

 private:
  void collect_axes() {
    for (const RaoRow& row : rows_.rows) {
      const double heading = file_heading(spec_, row.heading);
      if (find_heading(heading) == table_.headings.size()) table_.headings.push_back(heading);
      if (find_frequency(row.frequency) == table_.frequencies.size()) table_.frequencies.push_back(row.frequency);
    }
    std::sort(table_.frequencies.begin(), table_.frequencies.end());
    std::sort(table_.headings.begin(), table_.headings.end());
  }

  std::size_t find_heading(double heading) const {
    std::size_t n = 0;
    while (n < table_.headings.size() && std::abs(table_.headings[n] - heading) > kSameRaoHeading) ++n;
    return n;
  }
  std::size_t find_frequency(double frequency) const {
    std::size_t n = 0;
    while (n < table_.frequencies.size() && std::abs(table_.frequencies[n] - frequency) > kSameRaoPeriod * frequency)
      ++n;
    return n;
  }

  [[noreturn]] void refuse_hole(std::size_t cell) const {
    const double frequency = table_.frequencies[cell / table_.headings.size()];
    const double heading = table_.headings[cell % table_.headings.size()];
    for (const RaoRow& row : rows_.rows)
      if (std::abs(file_heading(spec_, row.heading) - heading) <= kSameRaoHeading)
        rows_.fail(row.line, "the heading of this row has no row for the period " + number_text(kTwoPi / frequency) +
                                 " s, other headings have it: every heading needs the same periods");
    rows_.fail(0, "a heading lacks a period that others have");
  }

  // The hull is alike on both sides of y = 0, where Q lies: sway, roll and yaw change their sign.
  void mirror() {
    const std::size_t given = table_.headings.size();
    bool port = false, starboard = false;
    for (const double b : table_.headings) {
      const double side = std::sin(b);
      port = port || side > kSameRaoHeading;
      starboard = starboard || side < -kSameRaoHeading;
    }
    if (port && starboard) rows_.fail(0, "has headings to both sides of the vessel: leave port_starboard out");
    std::array<double, 6> largest = {};
    for (const Raos& X : table_.values)
      for (std::size_t i = 0; i < 6; ++i) largest[i] = std::max(largest[i], std::abs(X[i]));
    for (std::size_t f = 0; f < table_.frequencies.size(); ++f)
      for (std::size_t h = 0; h < given; ++h)
        for (std::size_t i = 1; i < 6; i += 2)
          if (std::abs(std::sin(table_.headings[h])) <= kSameRaoHeading &&
              std::abs(table_.at(f, h)[i]) > kMirroredShare * largest[i] + 1e-9)
            rows_.fail(0,
                       "gives sway, roll or yaw in waves from ahead or astern: with port_starboard they must vanish "
                       "there, with reference_m and phase_origin_m where the file has them");
    RaoTable both = table_;
    for (const double b : table_.headings)
      if (std::abs(std::sin(b)) > kSameRaoHeading) both.headings.push_back(kTwoPi - b);
    std::sort(both.headings.begin(), both.headings.end());
    both.values.clear();
    for (std::size_t f = 0; f < table_.frequencies.size(); ++f)
      for (const double b : both.headings) {
        std::size_t own = find_heading(b);
        const bool other_side = own == given;
        if (other_side) own = find_heading(in_circle(-b));
        Raos X = table_.at(f, own);
        for (std::size_t i = 1; other_side && i < 6; i += 2) X[i] = -X[i];
        both.values.push_back(X);
      }
    table_ = std::move(both);
  }

  const RaoSpec& spec_;
  RaoFrame frame_;
  double gravity_, depth_;
  RaoRows rows_;
  RaoTable table_;
};

}  // namespace

RaoFrame::RaoFrame(const BodySpec& body) {
  const RaoSpec& spec = body.hydrodynamics.rao;
  const Matrix3 R_WB = rotation_from(body.attitude);
  heading = roll_pitch_yaw(R_WB).yaw;
  R_HB = rotation_from({0.0, 0.0, heading}).transpose() * R_WB;
  q = Vector3(body.cog.x(), 0.0, body.cog.z());
  arm = R_HB * (spec.reference - q);
  to_phase = R_HB * Vector3(spec.phase_x - q.x(), spec.phase_y, 0.0);
}

Raos moved_by(const Raos& X, const Vector3& r) {
  Raos moved = X;
  moved[0] += X[4] * r.z() - X[5] * r.y();
  moved[1] += X[5] * r.x() - X[3] * r.z();
  moved[2] += X[3] * r.y() - X[4] * r.x();
  return moved;
}

RaoTable read_rao_table(const BodySpec& body, double gravity, double depth) {
  const RaoSpec& spec = body.hydrodynamics.rao;
  return TableBuilder(body, gravity, depth,
                      spec.format == RaoSpec::Format::csv ? read_rao_csv(spec, gravity, depth) : read_rao_wamit(spec))
      .build();
}

double RaoTable::gap_at(double heading) const {
  const double b = in_circle(heading);
  double below = -kTwoPi, above = 2.0 * kTwoPi;
  for (const double h : headings)
    for (const double turn : {-kTwoPi, 0.0, kTwoPi}) {
      if (std::abs(h + turn - b) <= kSameRaoHeading) return 0.0;
      if (h + turn < b) below = std::max(below, h + turn);
      if (h + turn > b) above = std::min(above, h + turn);
    }
  return above - below;
}

Raos RaoTable::between(double frequency, double heading) const {
  const auto above = std::upper_bound(frequencies.begin(), frequencies.end(), frequency);
  std::size_t f1 = static_cast<std::size_t>(above - frequencies.begin());
  f1 = std::min(std::max<std::size_t>(f1, 1), frequencies.size() - 1);
  const std::size_t f0 = frequencies.size() == 1 ? 0 : f1 - 1;
  const double width = frequencies[f1] - frequencies[f0];
  const double s = width > 0.0 ? std::clamp((frequency - frequencies[f0]) / width, 0.0, 1.0) : 0.0;

  const double b = in_circle(heading);
  std::size_t h1 = 0;
  while (h1 < headings.size() && headings[h1] <= b) ++h1;
  const std::size_t h0 = h1 == 0 ? headings.size() - 1 : h1 - 1;
  if (h1 == headings.size()) h1 = 0;
  double gap = headings[h1] - headings[h0], past = b - headings[h0];
  if (gap <= 0.0) gap += kTwoPi;
  if (past < 0.0) past += kTwoPi;
  const double r = past / gap;
  Raos X;
  for (std::size_t i = 0; i < 6; ++i)
    X[i] = (1.0 - s) * ((1.0 - r) * at(f0, h0)[i] + r * at(f0, h1)[i]) +
           s * ((1.0 - r) * at(f1, h0)[i] + r * at(f1, h1)[i]);
  return X;
}

std::vector<std::string> odd_in_long_waves(const RaoTable& table, double gravity, double depth) {
  static constexpr const char* kNames[] = {"surge", "sway", "heave", "roll", "pitch"};
  const double w = table.frequencies.front(), k = wave_number(w, gravity, depth);
  const double along = std::isinf(depth) ? 1.0 : 1.0 / std::tanh(k * depth);  // the water at the surface, per amplitude
  const std::complex<double> i(0.0, 1.0);
  std::vector<std::string> odd;
  if (w > kLongRaoWave) return odd;
  for (std::size_t n = 0; n < 5; ++n) {
    if (n == 3 && w > kSlowRaoWave) continue;
    double worst = 0.0, at = 0.0;
    std::complex<double> found, wanted_there;
    for (std::size_t h = 0; h < table.headings.size(); ++h) {
      const double b = table.headings[h];
      const std::array<std::complex<double>, 5> wanted = {i * along * std::cos(b), i * along * std::sin(b), 1.0, i * k * std::sin(b),
                                                          -i * k * std::cos(b)};
      if (std::abs(wanted[n]) < kOdd * (n > 2 ? k : 1.0)) continue;
      const double miss = std::abs(table.at(0, h)[n] - wanted[n]) / std::abs(wanted[n]);
      if (miss <= worst) continue;
      worst = miss;
      at = b;
      found = table.at(0, h)[n];
      wanted_there = wanted[n];
    }
    if (worst <= kOdd) continue;
    const double unit = n > 2 ? kDegree : 1.0;
    const auto shown = [&](const std::complex<double>& x) {
      return number_text(std::round(1e3 * std::abs(x) / unit) / 1e3) + (n > 2 ? " deg/m" : " m/m") + ", " +
             number_text(std::round(std::arg(x) / kDegree)) + " deg after the crest";
    };
    odd.push_back(std::string(kNames[n]) + " in waves of " + number_text(std::round(kTwoPi / w * 10.0) / 10.0) +
                  " s that travel towards " + degrees(at) + " from the bow is " + shown(found) +
                  " at the centre of gravity; what floats follows so long waves with " + shown(wanted_there));
  }
  return odd;
}

}  // namespace stillhook
