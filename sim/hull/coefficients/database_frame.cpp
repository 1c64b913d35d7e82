#include "sim/hull/coefficients/database_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "sim/sea/dispersion.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

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

}  // namespace

void require_frame(const DatabaseFrame& frame, const std::string& source) {
  if (frame.bodies.empty()) fail(source, "a database needs at least one hull to be read for");
  if (!(frame.length > 0.0)) fail(source, "the length scale of the hull must be > 0 m");
  if ((frame.port_starboard || frame.axisymmetric) && frame.bodies.size() > 1)
    fail(source, "several hulls together have no symmetry");
  if (frame.port_starboard && frame.axisymmetric)
    fail(source, "port_starboard and axisymmetric cannot stand together: one heading of a body of revolution is all");
  if (!(frame.lowest < frame.highest)) {
    std::ostringstream sentence;
    sentence << "the lowest frequency to use (" << frame.lowest << " rad/s) must be below the highest ("
             << frame.highest << " rad/s)";
    fail(source, sentence.str());
  }
  for (const DatabaseBody& body : frame.bodies) {
    if (!body.origin.allFinite() || !std::isfinite(body.volume) || body.volume < 0.0)
      fail(source, "the origin of a hull must be finite and its volume >= 0");
    if (std::abs(body.origin.z() - frame.bodies[0].origin.z()) > 1e-9)
      fail(source, "the body origins of hulls in one database must lie at the same height");
  }
}

double water_of(const ExcitationTable& X, double gravity, double depth, const DatabaseFrame& frame,
                const std::string& source) {
  if (!(depth > 0.0)) fail(source, "the water depth must be > 0 m");
  if (X.frequencies.empty() || std::isinf(depth)) return std::numeric_limits<double>::infinity();
  const double k = wave_number(X.frequencies[0], gravity, depth);
  if (k * depth >= std::numbers::pi) return std::numeric_limits<double>::infinity();
  if (frame.accept_finite_depth || std::abs(frame.depth / depth - 1.0) <= kSameDepth) return depth;
  const double deep = std::sqrt(gravity * std::numbers::pi / depth * std::tanh(std::numbers::pi));
  std::ostringstream sentence;
  sentence.precision(4);
  sentence << "holds for a depth of " << depth << " m, which waves of " << X.frequencies[0]
           << " rad/s feel, and the waves of the case are those of ";
  if (std::isinf(frame.depth))
    sentence << "deep water";
  else
    sentence << "sea.depth_m = " << frame.depth << " m, more than " << 100.0 * kSameDepth << " % off";
  sentence << ": run the panel code for the depth of the case, or leave out what feels the bed, with "
              "database_lowest_rad_per_s = "
           << std::ceil(1000.0 * deep) / 1000.0;
  fail(source, sentence.str());
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
  change_excitation(c.excitation, c.gravity, c.depth, [&](Eigen::Map<Eigen::VectorXcd>& x, double k, double heading) {
    for (std::size_t n = 0; n < frame.bodies.size(); ++n)
      x.segment<6>(static_cast<Eigen::Index>(6 * n)) *= phase_at(frame.bodies[n].origin, k, heading);
    x = (T.transpose() * x.conjugate()).eval();
  });
  return c;
}

void complete_retardation(HydrodynamicCoefficients& c, const DatabaseFrame& frame) {
  if (!c.retardation.empty() || frame.without_retardation) return;
  try {
    c.retardation = retardation_from_damping(c.frequency, frame.retardation);
  } catch (const std::invalid_argument& error) {
    fail(c.source, error.what());
  }
}

}  // namespace stillhook
