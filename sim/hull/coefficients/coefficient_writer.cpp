#include <cmath>
#include <iomanip>
#include <sstream>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/whole_file.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {


class CoefficientWriter {
 public:
  CoefficientWriter(const std::string& path, const HydrodynamicCoefficients& c) : path_(path), c_(c) {
    out_ << std::setprecision(9);
  }

  std::string text() {
    if (c_.retardation.empty()) fail("there are no retardation functions to write");
    header();
    matrix("Ainf", "", c_.A_inf);
    kernels();
    tables();
    excitation();
    out_ << "end," << rows_ << '\n';
    return out_.str();
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const { throw SpecificationError(path_, "", sentence); }

  double finite(double value, const char* what) const {
    if (!std::isfinite(value)) fail(std::string(what) + " holds a number that is not finite");
    return value;
  }

  void header() {
    std::string description = c_.description;
    for (char& letter : description)
      if (letter == '\n' || letter == '\r') letter = ' ';
    out_ << "stillhook_coefficients,1\ndescription," << description << "\nhulls," << c_.hulls()
         << "\nreference_point,body_origin\naxes,x_forward_y_port_z_up\nwaterline_m," << c_.waterline << "\nvolume_m3";
    for (double volume : c_.volume) out_ << ',' << volume;
    if (!c_.waterplane.empty()) {
      out_ << "\nwaterplane_m2";
      for (double area : c_.waterplane) out_ << ',' << area;
    }
    if (c_.gap_rise > 0.0) out_ << "\ngap_rise," << c_.gap_rise << "\ngap_frequency_rad_s," << c_.gap_frequency;
    if (std::isfinite(c_.depth)) out_ << "\ndepth_m," << c_.depth;
    out_ << "\ndensity_kg_m3," << c_.density << "\ngravity_m_s2," << c_.gravity << "\nlength_m," << c_.length
         << "\ntime_factor,exp(-i omega t)\nwave_heading,towards\nsymmetry,none\n"
            "quantity,i,j_or_heading_deg,omega_rad_s_or_t_s,value,phase_deg\n";
  }

  /// Pairs that are zero both ways are left out; the diagonal never is, so that every table has rows.
  void matrix(const char* quantity, const std::string& argument, const MatrixX& X) {
    for (int i = 0; i < X.rows(); ++i)
      for (int j = 0; j < X.cols(); ++j) {
        const bool zero = X(i, j) == 0.0 && X(j, i) == 0.0;
        if ((zero && i != j) || (i > j && X(i, j) == X(j, i))) continue;
        out_ << quantity << ',' << i + 1 << ',' << j + 1 << ',' << argument << ',' << finite(X(i, j), quantity)
             << ",\n";
        ++rows_;
      }
  }

  void kernels() {
    for (const RetardationKernel& kernel : c_.retardation.kernels)
      for (std::size_t m = 0; m < kernel.value.size(); ++m) {
        out_ << "K," << kernel.i + 1 << ',' << kernel.j + 1 << ',' << c_.retardation.interval * static_cast<double>(m)
             << ',' << finite(kernel.value[m], "K") << ",\n";
        ++rows_;
      }
  }

  void tables() {
    VectorX largest = VectorX::Zero(c_.modes());
    for (const FrequencyCoefficients& f : c_.frequency) largest = largest.cwiseMax(f.B.diagonal().cwiseAbs());
    for (const FrequencyCoefficients& f : c_.frequency) {
      const std::string omega = number(f.frequency);
      matrix("A", omega, f.A);
      if (f.frequency == 0.0 && f.B.isZero(0.0)) continue;
      for (int i = 0; i < f.B.rows(); ++i)
        if (f.B(i, i) < -kNegativeDamping * largest(i))
          fail("B" + std::to_string(i + 1) + std::to_string(i + 1) + " at " + omega + " rad/s is negative");
      matrix("B", omega, f.B);
      if (f.gap.size() > 0) matrix("Bgap", omega, f.gap);
    }
  }

  void excitation() {
    const ExcitationTable& X = c_.excitation;
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      for (std::size_t h = 0; h < X.headings.size(); ++h)
        for (int i = 0; i < X.modes; ++i) {
          const Complex x = X.at(static_cast<int>(f), static_cast<int>(h), i);
          out_ << "X," << i + 1 << ',' << number(X.headings[h] / kDegree) << ',' << number(X.frequencies[f]) << ','
               << finite(std::abs(x), "X") << ',' << std::arg(x) / kDegree << '\n';
          ++rows_;
        }
  }

  std::string number(double value) const {
    std::ostringstream out;
    out << std::setprecision(9) << finite(value, "a frequency or heading");
    return out.str();
  }

  const std::string& path_;
  const HydrodynamicCoefficients& c_;
  std::ostringstream out_;
  int rows_ = 0;
};

}  // namespace

void write_coefficient_file(const std::string& path, const HydrodynamicCoefficients& coefficients) {
  WholeFile file(path);
  file.write(CoefficientWriter(path, coefficients).text());
  file.commit();
}

}  // namespace stillhook
