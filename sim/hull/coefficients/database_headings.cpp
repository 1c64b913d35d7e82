// The headings of a database (database_frame.h): brought into order, mirrored, turned.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "sim/hull/coefficients/database_frame.h"
#include "sim/sea/dispersion.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kCircle = 2.0 * std::numbers::pi;
constexpr double kSameHeading = 1e-5;                               // rad: printed with 6 digits
constexpr double kSameExcitation = 1e-3;                            // of the largest of the mode
constexpr double kMirror = 1e-2;                                    // sway in a following sea, of the largest sway
constexpr double kWidestSpacing = 90.5 / 180.0 * std::numbers::pi;  // rad
constexpr double kRound = 0.03;                                     // of a body of revolution made of flat panels

[[noreturn]] void fail_heading(const std::string& source, const std::string& sentence) {
  throw SpecificationError(source, "", sentence);
}

/// The table with the headings `order` of the old one, at `headings`; sway, roll, yaw of `mirrored` change sign.
ExcitationTable rearranged(const ExcitationTable& X, const std::vector<double>& headings, const std::vector<int>& order,
                           std::size_t mirrored_from) {
  ExcitationTable result{X.frequencies, headings, X.modes, {}};
  for (std::size_t f = 0; f < X.frequencies.size(); ++f)
    for (std::size_t h = 0; h < order.size(); ++h)
      for (int i = 0; i < X.modes; ++i)
        result.value.push_back((h >= mirrored_from && i % 2 == 1 ? -1.0 : 1.0) *
                               X.at(static_cast<int>(f), order[h], i));
  return result;
}

VectorX largest_of_mode(const ExcitationTable& X) {
  VectorX largest = VectorX::Zero(X.modes);
  for (std::size_t n = 0; n < X.value.size(); ++n) {
    const auto mode = static_cast<Eigen::Index>(n % static_cast<std::size_t>(X.modes));
    largest(mode) = std::max(largest(mode), std::abs(X.value[n]));
  }
  return largest;
}

std::string in_degrees(double heading) {
  std::ostringstream out;
  out << heading * 180.0 / std::numbers::pi << " deg";
  return out.str();
}

/// Ascending in [0, 2 pi), each heading once.
ExcitationTable sorted_once(const ExcitationTable& X, const std::string& source) {
  std::vector<double> heading;
  for (double b : X.headings) {
    b = std::fmod(b, kCircle);
    if (b < -kSameHeading) b += kCircle;
    heading.push_back(std::abs(b) <= kSameHeading || b > kCircle - kSameHeading ? 0.0 : b);
  }
  std::vector<int> order(heading.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return heading[a] < heading[b]; });
  const VectorX largest = largest_of_mode(X);
  std::vector<int> once;
  std::vector<double> headings;
  for (int n : order) {
    if (headings.empty() || heading[n] - headings.back() > kSameHeading) {
      once.push_back(n);
      headings.push_back(heading[n]);
      continue;
    }
    for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f)
      for (int i = 0; i < X.modes; ++i)
        if (std::abs(X.at(f, n, i) - X.at(f, once.back(), i)) > kSameExcitation * largest(i))
          fail_heading(source, "the heading " + in_degrees(heading[n]) + " is given twice, with different excitation");
  }
  return rearranged(X, headings, once, once.size());
}

ExcitationTable mirrored(const ExcitationTable& X, const std::string& source) {
  const std::size_t given = X.headings.size();
  if (X.headings.back() > std::numbers::pi + kSameHeading)
    fail_heading(source, "with port_starboard symmetry the headings must lie between 0 and 180 deg, got " +
                             in_degrees(X.headings[0]) + " to " + in_degrees(X.headings.back()) +
                             ": leave port_starboard out where the file has both sides");
  const auto on_axis = [&](std::size_t h) {
    return X.headings[h] == 0.0 || std::abs(X.headings[h] - std::numbers::pi) <= kSameHeading;
  };
  // With seas along the hull alone there is no other sway, roll and yaw to compare with: surge and pitch stand for
  // them.
  VectorX scale = largest_of_mode(X);
  bool beside = false;
  for (std::size_t h = 0; h < given; ++h) beside = beside || !on_axis(h);
  for (int i = 1; !beside && i < X.modes; i += 2) scale(i) = scale(i < 3 ? 0 : 4);
  for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f)
    for (int h = 0; h < static_cast<int>(given); ++h)
      for (int i = 1; on_axis(static_cast<std::size_t>(h)) && i < X.modes; i += 2)
        if (std::abs(X.at(f, h, i)) > kMirror * scale(i))
          fail_heading(source,
                       "sway, roll and yaw must vanish in following and head seas with port_starboard symmetry");
  std::vector<int> order(given);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> headings = X.headings;
  for (std::size_t h = given; h-- > 0;) {
    if (on_axis(h)) continue;
    order.push_back(static_cast<int>(h));
    headings.push_back(kCircle - X.headings[h]);
  }
  return rearranged(X, headings, order, given);
}

using Vector6c = Eigen::Matrix<Complex, 6, 1>;

/// The largest difference of A, or of B, from that of a body of revolution about the vertical, of its largest entry.
double unevenness(const std::vector<MatrixX>& matrices) {
  double translation = 0.0, rotation = 0.0, coupling = 0.0, worst = 0.0;
  for (const MatrixX& M : matrices) {
    translation = std::max({translation, std::abs(M(0, 0)), std::abs(M(1, 1))});
    rotation = std::max({rotation, std::abs(M(3, 3)), std::abs(M(4, 4))});
  }
  coupling = std::sqrt(translation * rotation);
  const auto compare = [&](double difference, double scale) {
    if (scale > 0.0) worst = std::max(worst, std::abs(difference) / scale);
  };
  for (const MatrixX& M : matrices) {
    compare(M(0, 0) - M(1, 1), translation);
    compare(M(3, 3) - M(4, 4), rotation);
    compare(M(0, 4) + M(1, 3), coupling);
    compare(M(0, 1), translation);
    compare(M(3, 4), rotation);
  }
  return worst;
}

void require_round(const HydrodynamicCoefficients& c, const std::string& source) {
  std::vector<MatrixX> A{c.A_inf}, B;
  for (const FrequencyCoefficients& f : c.frequency) {
    A.push_back(f.A);
    B.push_back(f.B);
  }
  const double worst = std::max(unevenness(A), unevenness(B));
  if (worst <= kRound) return;
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << "is not that of a body of revolution about the vertical through the point that its moments are about: "
              "surge and sway, or roll and pitch, differ by "
           << 100.0 * worst << " %, at most " << 100.0 * kRound
           << " may; leave axisymmetric out, or give that point where the axis is";
  fail_heading(source, sentence.str());
}

/// Modes turned about the vertical.
Vector6c turned_about_z(const Vector6c& x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Vector6c y = x;
  for (const int at : {0, 3}) {
    y(at) = c * x(at) - s * x(at + 1);
    y(at + 1) = s * x(at) + c * x(at + 1);
  }
  return y;
}

}  // namespace

void turn_heading(HydrodynamicCoefficients& c, const Vector3& reference, const DatabaseFrame& frame, double depth,
                  const std::string& source) {
  ExcitationTable& X = c.excitation;
  if (!frame.axisymmetric || X.empty()) return;
  require_round(c, source);
  const double heading = X.headings[0];
  const double shortest = wave_number(X.frequencies.back(), c.gravity, depth);
  // What the table's interpolation (diffraction.h) and Haskind's relation (coefficients.h) need.
  const int headings = 4 * static_cast<int>(std::ceil(std::clamp((shortest * frame.length + 2.0) / 4.0, 3.0, 90.0)));
  ExcitationTable all{X.frequencies, {}, 6, {}};
  for (int h = 0; h < headings; ++h) all.headings.push_back(kCircle * h / headings);
  all.value.resize(all.frequencies.size() * all.headings.size() * 6);
  const VectorX largest = largest_of_mode(X);
  for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f) {
    const double k = wave_number(X.frequencies[static_cast<std::size_t>(f)], c.gravity, depth);
    const auto phase = [&](double b) {
      return std::polar(1.0, k * (reference.x() * std::cos(b) + reference.y() * std::sin(b)));
    };
    Vector6c along;
    for (int i = 0; i < 6; ++i) along(i) = X.at(f, 0, i) * phase(heading);
    along = turned_about_z(along, -heading);
    for (const int i : {1, 3, 5}) {
      const double scale = i == 1 ? std::max(largest(0), largest(1)) : std::max(largest(3), largest(4));
      if (std::abs(along(i)) > kRound * scale)
        fail_heading(source, "is not that of a body of revolution: waves push it across their own direction, mode " +
                                 std::to_string(i + 1) + "; leave axisymmetric out");
      along(i) = 0.0;
    }
    for (int h = 0; h < headings; ++h) {
      const double b = all.headings[static_cast<std::size_t>(h)];
      const Vector6c x = turned_about_z(along, b) / phase(b);
      for (int i = 0; i < 6; ++i) all.at(f, h, i) = x(i);
    }
  }
  X = all;
}

void complete_headings(ExcitationTable& X, const DatabaseFrame& frame, const std::string& source) {
  if (X.empty()) return;
  X = sorted_once(X, source);
  if (frame.port_starboard) X = mirrored(X, source);
  const std::size_t count = X.headings.size();
  const double step = kCircle / static_cast<double>(count);
  if (step > kWidestSpacing) return;
  std::vector<double> even;
  for (std::size_t h = 0; h < count; ++h) {
    even.push_back(X.headings[0] + step * static_cast<double>(h));
    if (std::abs(X.headings[h] - even[h]) > 2.0 * kSameHeading) return;
  }
  X.headings = even;
}

}  // namespace stillhook
