#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim/hull/coefficients/wamit_file.h"
#include "sim/hull/coefficients/whole_file.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

int rotations(int i, int j) { return (i % 6 > 2 ? 1 : 0) + (j % 6 > 2 ? 1 : 0); }

std::string field(double value) {
  char text[32];
  std::snprintf(text, sizeof text, " %16.8E", value);
  return text;
}

std::string field(int value) {
  char text[16];
  std::snprintf(text, sizeof text, " %5d", value);
  return text;
}

class WamitWriter {
 public:
  WamitWriter(const HydrodynamicCoefficients& c, const WamitUnits& units) : c_(c), units_(units) {}

  std::string radiation() const {
    std::string text;
    const bool period = units_.column == WamitUnits::Column::period;
    for (const FrequencyCoefficients& f : c_.frequency)
      if (f.frequency == 0.0) matrices(text, period ? -1.0 : 0.0, f.A, nullptr, 0.0);
    matrices(text, period ? 0.0 : -1.0, c_.A_inf, nullptr, 0.0);
    for (const FrequencyCoefficients& f : c_.frequency)
      if (f.frequency > 0.0) matrices(text, column(f.frequency), f.A, &f.B, f.frequency);
    return text;
  }

  std::string excitation() const {
    std::string text;
    const ExcitationTable& X = c_.excitation;
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      for (std::size_t h = 0; h < X.headings.size(); ++h)
        for (int i = 0; i < X.modes; ++i) {
          const Complex x = X.at(static_cast<int>(f), static_cast<int>(h), i) /
                            (units_.density * units_.gravity * std::pow(units_.ulen, 2 + rotations(i, 0)));
          text += field(column(X.frequencies[f])) + field(X.headings[h] * 180.0 / std::numbers::pi) + field(i + 1) +
                  field(std::abs(x)) + field(std::arg(x) * 180.0 / std::numbers::pi) + field(x.real()) +
                  field(x.imag()) + '\n';
        }
    return text;
  }

  std::string restoring(const std::vector<Matrix6>& stiffness) const {
    std::string text;
    const int modes = c_.modes();
    for (int i = 0; i < modes; ++i)
      for (int j = 0; j < modes; ++j) {
        const double C = i / 6 == j / 6 ? stiffness[static_cast<std::size_t>(i / 6)](i % 6, j % 6) : 0.0;
        text += field(i + 1) + field(j + 1) +
                field(C / (units_.density * units_.gravity * std::pow(units_.ulen, 2 + rotations(i, j)))) + '\n';
      }
    return text;
  }

 private:
  double column(double frequency) const {
    return units_.column == WamitUnits::Column::period ? 2.0 * std::numbers::pi / frequency : frequency;
  }

  /// Every pair at every frequency, zeros too: nothing to guess for the reader.
  void matrices(std::string& text, double column, const MatrixX& A, const MatrixX* B, double frequency) const {
    for (int i = 0; i < c_.modes(); ++i)
      for (int j = 0; j < c_.modes(); ++j) {
        const double unit = units_.density * std::pow(units_.ulen, 3 + rotations(i, j));
        text += field(column) + field(i + 1) + field(j + 1) + field(A(i, j) / unit);
        if (B != nullptr) text += field((*B)(i, j) / (unit * frequency));
        text += '\n';
      }
  }

  const HydrodynamicCoefficients& c_;
  const WamitUnits& units_;
};

void put(const std::string& path, const std::string& text) {
  WholeFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

void write_wamit(const std::string& base, const HydrodynamicCoefficients& coefficients, const WamitUnits& units,
                 const DatabaseFrame& frame, const std::vector<Matrix6>& stiffness) {
  const auto require = [&](bool holds, const char* rule) {
    if (!holds) throw SpecificationError(base, "", rule);
  };
  require(units.density > 0.0 && units.gravity > 0.0 && units.ulen > 0.0, "density, gravity and ULEN must be > 0");
  require(static_cast<int>(frame.bodies.size()) == coefficients.hulls(), "the frame must name every hull of the set");
  require_frame(frame, base);
  require(std::abs(coefficients.waterline + frame.bodies[0].origin.z()) < 1e-6,
          "the origins of the frame do not lie where the set has its water plane, at z = 0");
  require(!coefficients.frequency.empty(), "there is no table of A and B to write; WAMIT files have nothing else");
  require(stiffness.empty() || static_cast<int>(stiffness.size()) == coefficients.hulls(),
          "there must be one restoring matrix a hull");
  std::vector<Vector3> reference = units.reference;
  if (reference.empty())
    for (const DatabaseBody& body : frame.bodies) reference.push_back(body.origin);
  require(reference.size() == frame.bodies.size(), "there must be one reference point a hull");
  HydrodynamicCoefficients plain = coefficients;
  plain.retardation = {};
  const HydrodynamicCoefficients moved = from_body_origins(plain, reference, frame);
  require(moved.A_inf.allFinite(), "the added mass holds a number that is not finite");
  const WamitWriter writer(moved, units);
  put(base + ".1", writer.radiation());
  if (!moved.excitation.empty()) put(base + ".3", writer.excitation());
  if (!stiffness.empty()) put(base + ".hst", writer.restoring(stiffness));
}

}  // namespace stillhook
