#include "sim/hull/database_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kCircle = 2.0 * std::numbers::pi;
constexpr double kSameHeading = 1e-5;                                // rad: printed with 6 digits
constexpr double kSameExcitation = 1e-3;                             // of the largest of the mode
constexpr double kMirror = 1e-2;                                     // sway in a following sea, of the largest sway
constexpr double kLargestSpacing = 90.5 / 180.0 * std::numbers::pi;  // rad

[[noreturn]] void fail(const std::string& source, const std::string& sentence) {
  throw SpecificationError(source, "", sentence);
}

/// V_from = T V_to, hull by hull.
MatrixX velocity_map(const std::vector<Vector3>& from, const std::vector<Vector3>& to) {
  const auto modes = static_cast<Eigen::Index>(6 * from.size());
  MatrixX T = MatrixX::Identity(modes, modes);
  for (std::size_t n = 0; n < from.size(); ++n) {
    const auto at = static_cast<Eigen::Index>(6 * n);
    T.block<3, 3>(at, at + 3) = -cross_matrix(from[n] - to[n]);
  }
  return T;
}

void move_kernels(RetardationFunctions& K, const MatrixX& T) {
  const int modes = static_cast<int>(T.rows());
  std::vector<std::vector<double>> moved(static_cast<std::size_t>(modes * modes));
  double largest = 0.0;
  for (const RetardationKernel& kernel : K.kernels)
    for (int i = 0; i < modes; ++i)
      for (int j = 0; j < modes; ++j) {
        const double factor = T(kernel.i, i) * T(kernel.j, j);
        if (factor == 0.0) continue;
        std::vector<double>& sum = moved[static_cast<std::size_t>(i * modes + j)];
        if (sum.size() < kernel.value.size()) sum.resize(kernel.value.size(), 0.0);
        for (std::size_t m = 0; m < kernel.value.size(); ++m) {
          sum[m] += factor * kernel.value[m];
          largest = std::max(largest, std::abs(sum[m]));
        }
      }
  K.kernels.clear();
  for (int i = 0; i < modes; ++i)
    for (int j = 0; j < modes; ++j) {
      std::vector<double>& value = moved[static_cast<std::size_t>(i * modes + j)];
      if (std::any_of(value.begin(), value.end(), [&](double k) { return std::abs(k) > 1e-15 * largest; }))
        K.kernels.push_back({i, j, std::move(value)});
    }
}

void move_matrices(HydrodynamicCoefficients& c, const MatrixX& T) {
  if (T.isIdentity(0.0)) return;
  c.A_inf = (T.transpose() * c.A_inf * T).eval();
  for (FrequencyCoefficients& f : c.frequency) {
    f.A = (T.transpose() * f.A * T).eval();
    f.B = (T.transpose() * f.B * T).eval();
  }
  move_kernels(c.retardation, T);
}

std::vector<Vector3> origins_of(const DatabaseFrame& frame) {
  std::vector<Vector3> result;
  for (const DatabaseBody& body : frame.bodies) result.push_back(body.origin);
  return result;
}

/// Every X at one frequency and heading, by `change(values of all modes, k, heading)`.
template <class Change>
void change_excitation(ExcitationTable& X, double gravity, double depth, Change change) {
  for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
    const double k = wave_number(X.frequencies[f], gravity, depth);
    for (std::size_t h = 0; h < X.headings.size(); ++h) {
      Eigen::Map<Eigen::VectorXcd> x(&X.at(static_cast<int>(f), static_cast<int>(h), 0), X.modes);
      change(x, k, X.headings[h]);
    }
  }
}

Complex phase_at(const Vector3& p, double k, double heading) {
  return std::polar(1.0, k * (p.x() * std::cos(heading) + p.y() * std::sin(heading)));
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

VectorX largest_of_modes(const ExcitationTable& X) {
  VectorX largest = VectorX::Zero(X.modes);
  for (std::size_t n = 0; n < X.value.size(); ++n) {
    const auto mode = static_cast<Eigen::Index>(n % static_cast<std::size_t>(X.modes));
    largest(mode) = std::max(largest(mode), std::abs(X.value[n]));
  }
  return largest;
}

std::string degrees(double heading) {
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
  const VectorX largest = largest_of_modes(X);
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
          fail(source, "the heading " + degrees(heading[n]) + " is given twice, with different excitation");
  }
  return rearranged(X, headings, once, once.size());
}

ExcitationTable mirrored(const ExcitationTable& X, const std::string& source) {
  const std::size_t given = X.headings.size();
  if (given < 2 || X.headings[0] != 0.0 || std::abs(X.headings.back() - std::numbers::pi) > kSameHeading)
    fail(source, "with port_starboard symmetry the headings must run from 0 to 180 deg, got " +
                     (given == 0 ? "none" : degrees(X.headings[0]) + " to " + degrees(X.headings.back())));
  const VectorX largest = largest_of_modes(X);
  for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f)
    for (int h : {0, static_cast<int>(given) - 1})
      for (int i = 1; i < X.modes; i += 2)
        if (std::abs(X.at(f, h, i)) > kMirror * largest(i))
          fail(source, "sway, roll and yaw must vanish in following and head seas with port_starboard symmetry");
  std::vector<int> order(given);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> headings = X.headings;
  for (std::size_t h = given - 1; h-- > 1;) {
    order.push_back(static_cast<int>(h));
    headings.push_back(kCircle - X.headings[h]);
  }
  return rearranged(X, headings, order, given);
}

}  // namespace

void require_frame(const DatabaseFrame& frame, const std::string& source) {
  if (frame.bodies.empty()) fail(source, "a database needs at least one hull to be read for");
  if (!(frame.length > 0.0)) fail(source, "the length scale of the hull must be > 0 m");
  if (frame.port_starboard && frame.bodies.size() > 1) fail(source, "several hulls together have no symmetry");
  for (const DatabaseBody& body : frame.bodies) {
    if (!body.origin.allFinite() || !std::isfinite(body.volume) || body.volume < 0.0)
      fail(source, "the origin of a hull must be finite and its volume >= 0");
    if (std::abs(body.origin.z() - frame.bodies[0].origin.z()) > 1e-9)
      fail(source, "the body origins of hulls in one database must lie at the same height");
  }
}

void require_deep_water(const ExcitationTable& X, double gravity, double depth, const DatabaseFrame& frame,
                        const std::string& source) {
  if (!(depth > 0.0)) fail(source, "the water depth must be > 0 m");
  if (X.frequencies.empty() || frame.accept_finite_depth || std::isinf(depth)) return;
  const double k = wave_number(X.frequencies[0], gravity, depth);
  if (k * depth >= std::numbers::pi) return;
  std::ostringstream sentence;
  sentence << "holds for a depth of " << depth << " m, which waves of " << X.frequencies[0]
           << " rad/s feel; the waves here are those of deep water";
  fail(source, sentence.str());
}

double wave_number(double frequency, double gravity, double depth) {
  const double deep = frequency * frequency / gravity;
  if (std::isinf(depth) || deep * depth > 20.0) return deep;
  // Newton on f(k) = k tanh(k h) - w2/g from above, where f is convex: no step overshoots.
  double k = std::max(deep, std::sqrt(deep / depth)) * 1.2;
  for (int n = 0; n < 60; ++n) {
    const double t = std::tanh(k * depth);
    const double step = (k * t - deep) / (t + k * depth * (1.0 - t * t));
    k -= step;
    if (std::abs(step) < 1e-14 * k) break;
  }
  return k;
}

void to_body_origins(HydrodynamicCoefficients& c, const std::vector<Vector3>& reference, const DatabaseFrame& frame,
                     double depth) {
  const MatrixX T = velocity_map(reference, origins_of(frame));
  move_matrices(c, T);
  change_excitation(c.excitation, c.gravity, depth, [&](Eigen::Map<Eigen::VectorXcd>& x, double k, double heading) {
    x = (T.transpose() * x.conjugate()).eval();
    for (std::size_t n = 0; n < frame.bodies.size(); ++n)
      x.segment<6>(static_cast<Eigen::Index>(6 * n)) *= std::conj(phase_at(frame.bodies[n].origin, k, heading));
  });
  c.length = frame.length;
  c.waterline = -frame.bodies[0].origin.z();
}

HydrodynamicCoefficients from_body_origins(const HydrodynamicCoefficients& coefficients,
                                           const std::vector<Vector3>& reference, const DatabaseFrame& frame) {
  HydrodynamicCoefficients c = coefficients;
  const MatrixX T = velocity_map(origins_of(frame), reference);
  move_matrices(c, T);
  const double deep = std::numeric_limits<double>::infinity();
  change_excitation(c.excitation, c.gravity, deep, [&](Eigen::Map<Eigen::VectorXcd>& x, double k, double heading) {
    for (std::size_t n = 0; n < frame.bodies.size(); ++n)
      x.segment<6>(static_cast<Eigen::Index>(6 * n)) *= phase_at(frame.bodies[n].origin, k, heading);
    x = (T.transpose() * x.conjugate()).eval();
  });
  return c;
}

void complete_headings(ExcitationTable& X, const DatabaseFrame& frame, const std::string& source) {
  if (X.empty()) return;
  X = sorted_once(X, source);
  if (frame.port_starboard) X = mirrored(X, source);
  const double step = kCircle / static_cast<double>(X.headings.size());
  for (std::size_t h = 0; h < X.headings.size(); ++h) {
    const double even = X.headings[0] + step * static_cast<double>(h);
    if (std::abs(X.headings[h] - even) > 2.0 * kSameHeading)
      fail(source, frame.port_starboard
                       ? "the headings must be evenly spaced over 0..180 deg"
                       : "the headings must be evenly spaced around the circle, unless port_starboard symmetry is "
                         "stated for those of 0..180 deg; " +
                             degrees(X.headings[h]) + " stands where " + degrees(even) + " should");
    X.headings[h] = even;
  }
  if (step > kLargestSpacing) fail(source, "the headings are more than 90 deg apart");
}

void complete_retardation(HydrodynamicCoefficients& c, const DatabaseFrame& frame) {
  if (!c.retardation.empty()) return;
  try {
    c.retardation = retardation_from_damping(c.frequency, frame.retardation);
  } catch (const std::invalid_argument& error) {
    fail(c.source, error.what());
  }
}

}  // namespace stillhook
