#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/hull/coefficients/bemio_file.h"
#include "sim/hull/coefficients/hdf5_file.h"
#include "sim/hull/coefficients/whole_file.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

Hdf5Array number(double value) { return {{1, 1}, {value}}; }
Hdf5Array list(const std::vector<double>& value) { return {{value.size(), 1}, value}; }
Hdf5Array point(const Vector3& p) { return {{3, 1}, {p.x(), p.y(), p.z()}}; }

/// The table's rows at the frequencies of X, or what the retardation functions have there.
std::vector<FrequencyCoefficients> radiation_at(const HydrodynamicCoefficients& c, const std::string& path) {
  std::vector<FrequencyCoefficients> rows;
  for (double w : c.excitation.frequencies) {
    const auto same = [w](const FrequencyCoefficients& f) { return std::abs(f.frequency - w) <= 1e-6 * w; };
    const auto found = std::find_if(c.frequency.begin(), c.frequency.end(), same);
    if (found != c.frequency.end())
      rows.push_back(*found);
    else if (!c.retardation.empty())
      rows.push_back(sampled(c, {w})[0]);
    else
      throw SpecificationError(path, "", "A and B are not known at all frequencies of the excitation");
  }
  return rows;
}

void write_radiation(Hdf5File& file, const std::string& name, Eigen::Index first, const HydrodynamicCoefficients& c,
                     const std::vector<FrequencyCoefficients>& rows) {
  const auto modes = static_cast<std::size_t>(c.modes());
  Hdf5Array A_inf{{6, modes}, {}}, A{{6, modes, rows.size()}, {}}, B = A;
  for (Eigen::Index i = first; i < first + 6; ++i)
    for (Eigen::Index j = 0; j < c.modes(); ++j) {
      A_inf.value.push_back(c.A_inf(i, j) / c.density);
      for (const FrequencyCoefficients& row : rows) {
        A.value.push_back(row.A(i, j) / c.density);
        B.value.push_back(row.B(i, j) / (c.density * row.frequency));
      }
    }
  file.write(name + "/added_mass/inf_freq", A_inf, "m^3, m^4, m^5");
  file.write(name + "/added_mass/all", A, "m^3, m^4, m^5");
  file.write(name + "/radiation_damping/all", B, "m^3, m^4, m^5");
}

void write_retardation(Hdf5File& file, const std::string& name, int first, const HydrodynamicCoefficients& c) {
  if (c.retardation.empty()) return;
  const auto modes = static_cast<std::size_t>(c.modes());
  std::size_t samples = 0;
  for (const RetardationKernel& kernel : c.retardation.kernels) samples = std::max(samples, kernel.value.size());
  Hdf5Array K{{6, modes, samples}, std::vector<double>(6 * modes * samples, 0.0)};
  for (const RetardationKernel& kernel : c.retardation.kernels) {
    if (kernel.i < first || kernel.i >= first + 6) continue;
    const std::size_t at =
        (static_cast<std::size_t>(kernel.i - first) * modes + static_cast<std::size_t>(kernel.j)) * samples;
    for (std::size_t m = 0; m < kernel.value.size(); ++m) K.value[at + m] = kernel.value[m] / c.density;
  }
  std::vector<double> t;
  for (std::size_t m = 0; m < samples; ++m) t.push_back(c.retardation.interval * static_cast<double>(m));
  file.write(name + "/radiation_damping/impulse_response_fun/K", K, "m^3/s^2, m^4/s^2, m^5/s^2");
  file.write(name + "/radiation_damping/impulse_response_fun/t", list(t), "s");
  file.write(name + "/radiation_damping/impulse_response_fun/w", list(c.excitation.frequencies), "rad/s");
}

void write_excitation(Hdf5File& file, const std::string& name, int first, const HydrodynamicCoefficients& c) {
  const ExcitationTable& X = c.excitation;
  Hdf5Array re{{6, X.headings.size(), X.frequencies.size()}, {}}, im = re, magnitude = re, phase = re;
  for (int i = first; i < first + 6; ++i)
    for (int h = 0; h < static_cast<int>(X.headings.size()); ++h)
      for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f) {
        const Complex x = X.at(f, h, i) / (c.density * c.gravity);
        re.value.push_back(x.real());
        im.value.push_back(x.imag());
        magnitude.value.push_back(std::abs(x));
        phase.value.push_back(std::arg(x));
      }
  file.write(name + "/excitation/re", re, "m^2, m^3");
  file.write(name + "/excitation/im", im, "m^2, m^3");
  file.write(name + "/excitation/mag", magnitude, "m^2, m^3");
  file.write(name + "/excitation/phase", phase, "rad");
}

void write_parameters(Hdf5File& file, const HydrodynamicCoefficients& c) {
  const std::string name = "/simulation_parameters/";
  std::vector<double> T, headings;
  for (double w : c.excitation.frequencies) T.push_back(2.0 * std::numbers::pi / w);
  for (double b : c.excitation.headings) headings.push_back(b * 180.0 / std::numbers::pi);
  file.write("/bem_data/code", std::string("stillhook"));
  file.write(name + "scaled", number(0.0), "");
  file.write(name + "g", number(c.gravity), "m/s^2");
  file.write(name + "rho", number(c.density), "kg/m^3");
  file.write(name + "T", list(T), "s");
  file.write(name + "w", list(c.excitation.frequencies), "rad/s");
  if (std::isinf(c.depth))
    file.write(name + "water_depth", std::string("infinite"));
  else
    file.write(name + "water_depth", number(c.depth), "m");
  file.write(name + "wave_dir", list(headings), "deg");
}

void write_properties(Hdf5File& file, const std::string& name, std::size_t n, const BemioBody& body, double volume) {
  file.write(name + "/properties/name", body.name);
  file.write(name + "/properties/body_number", number(static_cast<double>(n + 1)), "");
  file.write(name + "/properties/cb", point(body.cb), "m");
  file.write(name + "/properties/cg", point(body.cg), "m");
  file.write(name + "/properties/disp_vol", number(volume), "m^3");
  file.write(name + "/properties/dof", number(6.0), "");
  file.write(name + "/properties/dof_start", number(static_cast<double>(6 * n + 1)), "");
  file.write(name + "/properties/dof_end", number(static_cast<double>(6 * n + 6)), "");
}

void write_all(Hdf5File& file, const HydrodynamicCoefficients& c, const std::vector<BemioBody>& bodies,
               const std::vector<FrequencyCoefficients>& rows) {
  write_parameters(file, c);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const std::string name = "/body" + std::to_string(n + 1), coefficients = name + "/hydro_coeffs";
    const int first = static_cast<int>(6 * n);
    write_properties(file, name, n, bodies[n], c.volume[n]);
    Hdf5Array stiffness{{6, 6}, {}};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) stiffness.value.push_back(bodies[n].stiffness(i, j) / (c.density * c.gravity));
    file.write(coefficients + "/linear_restoring_stiffness", stiffness, "m^2, m^3, m^4");
    write_radiation(file, coefficients, first, c, rows);
    write_retardation(file, coefficients, first, c);
    write_excitation(file, coefficients, first, c);
  }
}

}  // namespace

void write_bemio(const std::string& path, const HydrodynamicCoefficients& coefficients, const DatabaseFrame& frame,
                 const std::vector<BemioBody>& bodies) {
  const auto require = [&](bool holds, const char* rule) {
    if (!holds) throw SpecificationError(path, "", rule);
  };
  require_frame(frame, path);
  require(static_cast<int>(frame.bodies.size()) == coefficients.hulls() && bodies.size() == frame.bodies.size(),
          "the frame must name every hull of the set");
  require(std::abs(coefficients.waterline + frame.bodies[0].origin.z()) < 1e-6,
          "the origins of the frame do not lie where the set has its water plane, at z = 0");
  require(!coefficients.excitation.empty(), "there is no excitation to write, which this format needs");
  std::vector<Vector3> cg;
  for (const BemioBody& body : bodies) cg.push_back(body.cg);
  HydrodynamicCoefficients known = coefficients;
  known.frequency = radiation_at(coefficients, path);
  const HydrodynamicCoefficients moved = from_body_origins(known, cg, frame);
  WholeFile whole(path);
  Hdf5File file(whole.temporary(), Hdf5File::Mode::create, path);
  write_all(file, moved, bodies, moved.frequency);
  file.close();
  whole.commit();
}

}  // namespace stillhook
