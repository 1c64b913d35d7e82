#include "sim/hull/diffraction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <sstream>

#include "sim/sea/dispersion.h"
#include "sim/sea/wave_sums.h"

namespace stillhook {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Weight of an entry at distance x (rad) in the trigonometric interpolation through n entries evenly around a circle.
double circle_weight(double x, int n) {
  const double s = std::sin(0.5 * x);
  if (std::abs(s) < 1e-9) return 1.0;
  const double numerator = std::sin(0.5 * n * x) / n;
  return n % 2 == 0 ? numerator * std::cos(0.5 * x) / s : numerator / s;
}

std::string listed_in_degrees(const std::vector<double>& headings) {
  std::ostringstream text;
  text.precision(4);
  for (std::size_t h = 0; h < headings.size(); ++h)
    text << (h == 0 ? "" : h + 1 == headings.size() ? " and " : ", ") << headings[h] * 360.0 / kTurn;
  return text.str();
}

}  // namespace

struct DiffractionTable::Known {
  std::mutex mutex;
  std::map<std::pair<double, double>, Eigen::VectorXcd> values;
};

DiffractionTable::DiffractionTable(const ExcitationTable& total, std::span<const LinearFroudeKrylov> froude_krylov,
                                   std::span<const double> headings, double length)
    : headings_(total.headings),
      hulls_(froude_krylov.begin(), froude_krylov.end()),
      length_(length),
      gravity_(froude_krylov[0].gravity()),
      depth_(froude_krylov[0].depth()),
      known_(std::make_shared<Known>()) {
  for (const double heading : headings) turned_.push_back(heading - headings[0]);
  const int directions = static_cast<int>(headings_.size());
  all_around_ = directions >= 4;
  for (int h = 0; h < directions; ++h)
    all_around_ = all_around_ && std::abs(headings_[h] - headings_[0] - h * kTurn / directions) <= 1e-6;
  frequencies_.push_back(0.0);
  value_.push_back(Eigen::MatrixXcd::Zero(directions, total.modes));
  frequencies_.insert(frequencies_.end(), total.frequencies.begin(), total.frequencies.end());
  value_.resize(frequencies_.size(), Eigen::MatrixXcd(directions, total.modes));
#pragma omp parallel for schedule(dynamic, 1)
  for (int f = 0; f < static_cast<int>(total.frequencies.size()); ++f)
    for (int hull = 0; hull < static_cast<int>(froude_krylov.size()); ++hull) {
      std::vector<double> own(headings_);
      for (double& heading : own) heading += headings[0] - headings[hull];
      const auto incident = froude_krylov[hull].excitations(total.frequencies[f], own);
      for (int h = 0; h < directions; ++h)
        for (int i = 0; i < 6; ++i)
          value_[f + 1](h, 6 * hull + i) = total.at(f, h, 6 * hull + i) - incident(i, h);
    }
}

int DiffractionTable::closest(double heading) const {
  const auto distance = [&](int h) { return std::abs(std::remainder(heading - headings_[h], kTurn)); };
  int best = 0;
  for (int h = 1; h < static_cast<int>(headings_.size()); ++h)
    if (distance(h) < distance(best)) best = h;
  return best;
}

double DiffractionTable::frequency_of(double frequency, double depth) const {
  return std::isinf(depth) || std::isfinite(depth_) ? frequency
                                                    : std::sqrt(gravity_ * wave_number(frequency, gravity_, depth));
}

bool DiffractionTable::resolves(double frequency, double heading) const {
  // A frequency or heading given exactly on an entry may miss it by a rounding error.
  return frequency <= highest_frequency() * (1.0 + 1e-9) && resolves_heading(frequency, heading);
}

bool DiffractionTable::resolves_heading(double frequency, double heading) const {
  if (!all_around_) return std::abs(std::remainder(heading - headings_[closest(heading)], kTurn)) <= kSameDirection;
  const int n = static_cast<int>(headings_.size());
  const double u = (heading - headings_[0]) * n / kTurn;
  if (std::abs(u - std::round(u)) < 1e-6) return true;
  // Above the table it is what is read at its end that must be resolved; the limit of short waves is known everywhere.
  const double read = std::min(frequency, highest_frequency());
  return wave_number(read, gravity_, depth_) * 0.5 * length_ <= 0.5 * n;
}

Eigen::VectorXcd DiffractionTable::short_waves(double frequency, double heading) const {
  Eigen::VectorXcd X(value_.front().cols());
  for (std::size_t hull = 0; hull < hulls_.size(); ++hull)
    X.segment<6>(6 * static_cast<Eigen::Index>(hull)) =
        hulls_[hull].short_wave_diffraction(frequency, heading - turned_[hull]);
  return X;
}

Eigen::VectorXcd DiffractionTable::at(double frequency, double heading) const {
  const double end = highest_frequency();
  if (frequency <= end * (1.0 + 1e-9)) return within(std::min(frequency, end), heading);
  const std::lock_guard lock(known_->mutex);
  const auto [entry, fresh] = known_->values.try_emplace({frequency, heading});
  if (fresh)
    entry->second = short_waves(frequency, heading) +
                    std::pow(end / frequency, 4) * (within(end, heading) - short_waves(end, heading));
  return entry->second;
}

Eigen::VectorXcd DiffractionTable::at_heading(int f, double heading) const {
  if (!all_around_) return value_[f].row(closest(heading)).transpose();
  const int n = static_cast<int>(headings_.size());
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(value_[f].cols());
  for (int h = 0; h < n; ++h) sum += circle_weight(heading - headings_[h], n) * value_[f].row(h).transpose();
  return sum;
}

Eigen::VectorXcd DiffractionTable::within(double frequency, double heading) const {
  const int last = static_cast<int>(frequencies_.size()) - 1;
  const auto above = std::upper_bound(frequencies_.begin(), frequencies_.end(), frequency);
  const int i = std::clamp(static_cast<int>(above - frequencies_.begin()) - 1, 0, last - 1);
  const Eigen::VectorXcd y0 = at_heading(i, heading), y1 = at_heading(i + 1, heading);
  const double h = frequencies_[i + 1] - frequencies_[i];
  const Eigen::VectorXcd rise = (y1 - y0) / h;
  // Slopes of the parabola through three neighbours; in deep water X_D ~ w^2 makes the one at w = 0 zero.
  Eigen::VectorXcd slope0 = rise, slope1 = rise;
  if (i == 0) {
    if (std::isinf(depth_)) slope0.setZero();
  } else {
    const double before = frequencies_[i] - frequencies_[i - 1];
    slope0 = ((y0 - at_heading(i - 1, heading)) / before * h + rise * before) / (h + before);
  }
  if (i + 1 < last) {
    const double after = frequencies_[i + 2] - frequencies_[i + 1];
    slope1 = ((at_heading(i + 2, heading) - y1) / after * h + rise * after) / (h + after);
  } else {
    slope1 = 2.0 * rise - slope0;
  }
  const double t = (frequency - frequencies_[i]) / h, s = 1.0 - t;
  return (1.0 + 2.0 * t) * s * s * y0 + t * s * s * h * slope0 + t * t * (3.0 - 2.0 * t) * y1 - t * t * s * h * slope1;
}

std::string unresolved_sea(double share, bool above, double highest_frequency, double negligible_energy) {
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << 100.0 * share << " % of the sea's energy lies ";
  if (above)
    sentence << "above " << highest_frequency << " rad/s, where the excitation of the coefficients ends; at most "
             << 100.0 * negligible_energy << " % may with panel_method.beyond = \"refuse\". \"limit\" takes the limit of "
             << "short waves there, \"cut\" no diffraction, and a higher panel_method.highest_rad_per_s computes it";
  else
    sentence << "in short waves between the headings of the coefficients, which are too far apart for them; at most "
             << 100.0 * negligible_energy << " % may. Panels compute as many headings as the waves need with "
             << "panel_method.headings = 0; panel_method.beyond = \"cut\" leaves out the diffraction of these waves";
  return sentence.str();
}

namespace {

/// Why a sea is refused that comes from elsewhere than the few headings of a file.
std::string other_directions(double share, const DiffractionTable& table, double negligible_energy) {
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << 100.0 * share
           << " % of the sea's energy lies in other directions than those of the coefficients, which hold for waves towards "
           << listed_in_degrees(table.headings())
           << " deg of the hull alone: run the panel code with headings evenly around the circle, or over 0..180 deg for a "
              "hull with port_starboard = true; a body of revolution needs one heading and axisymmetric = true; at most "
           << 100.0 * negligible_energy << " % may";
  return sentence.str();
}

}  // namespace

Diffraction::Diffraction(std::shared_ptr<const WaveField> waves, const DiffractionTable& table,
                         std::span<const double> headings, double negligible_energy, const std::string& entry,
                         ShortWaves above)
    : waves_(std::move(waves)), hulls_(headings.size()) {
  double energy = 0.0, beyond = 0.0, in_limit = 0.0;
  bool too_short = false;
  for (const WaveComponent& wave : waves_->components()) {
    const double a2 = wave.amplitude * wave.amplitude;
    energy += a2;
    const double heading = std::atan2(wave.sin_heading, wave.cos_heading) - headings[0];
    const double read = table.frequency_of(wave.frequency, waves_->depth());
    const bool known = above == ShortWaves::limit ? table.resolves_heading(read, heading) : table.resolves(read, heading);
    const bool short_wave = read > table.highest_frequency() * (1.0 + 1e-9);
    if (!known) {
      beyond += a2;
      too_short |= short_wave && above == ShortWaves::left_out;
      continue;
    }
    if (short_wave) in_limit += a2;
    const Eigen::VectorXcd X = wave.amplitude * table.at(read, heading);
    for (std::size_t hull = 0; hull < hulls_.size(); ++hull) hulls_[hull].add(wave, X.segment<6>(6 * hull));
  }
  left_out_ = energy > 0.0 ? beyond / energy : 0.0;
  in_limit_ = energy > 0.0 ? in_limit / energy : 0.0;
  if (left_out_ > negligible_energy)
    throw SpecificationError(entry, "",
                             !too_short && !table.all_around()
                                 ? other_directions(left_out_, table, negligible_energy)
                                 : unresolved_sea(left_out_, too_short, table.highest_frequency(), negligible_energy));
}

void Diffraction::Hull::add(const WaveComponent& c, const Eigen::VectorXcd& X) {
  constexpr std::size_t B = kPhaseBlock;
  const std::size_t block = waves / B, lane = waves % B;
  wave.resize((block + 1) * 4 * B, 0.0);
  force.resize((block + 1) * 12 * B, 0.0);
  const double of_wave[4] = {c.wavenumber * c.cos_heading, c.wavenumber * c.sin_heading, c.frequency, c.phase};
  for (std::size_t i = 0; i < 4; ++i) wave[(4 * block + i) * B + lane] = of_wave[i];
  for (std::size_t m = 0; m < 6; ++m) {
    const std::complex<double> x = X[static_cast<Eigen::Index>(m)];
    force[(12 * block + 2 * m) * B + lane] = x.real();
    force[(12 * block + 2 * m + 1) * B + lane] = x.imag();
  }
  ++waves;
}

void Diffraction::scale(std::span<const double> factors) {
  for (std::size_t hull = 0; hull < hulls_.size(); ++hull)
    for (double& force : hulls_[hull].force) force *= factors[hull];
}

void Diffraction::evaluate(int hull, double t, double x, double y, Vector6& F, Eigen::Matrix<double, 6, 2>& dF) const {
  F.setZero();
  dF.setZero();
  const double ramp = waves_->ramp(t);
  if (ramp == 0.0) return;
  const Hull& of = hulls_[static_cast<std::size_t>(hull)];
  Eigen::Matrix<double, 6, 3> sums;
  sum_force(of.wave.data(), of.force.data(), static_cast<int>(of.wave.size() / (4 * kPhaseBlock)), x, y, t, sums.data());
  F = ramp * sums.col(0);
  dF = ramp * sums.rightCols<2>();
}

}  // namespace stillhook
