// A BEMIO file of a made-up hull, small enough to compute every number by hand.
#pragma once

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "sim/hull/coefficients/bemio_file.h"
#include "sim/hull/coefficients/hdf5_file.h"

namespace stillhook {

namespace bemio_sample {

/// The datasets of a small file, as BEMIO would make it: one body, w = 1, 0.5, 2 in this order (others sort periods),
/// four headings. Written without the writer under test.
struct SmallFile {
  std::map<std::string, Hdf5Array> numbers;
  std::map<std::string, std::string> texts;

  static constexpr double rho = 1000.0, g = 10.0;

  SmallFile() {
    texts["/bem_data/code"] = "NEMOH";
    texts["/body1/properties/name"] = "float";
    texts["/simulation_parameters/water_depth"] = "infinite";
    const std::string p = "/simulation_parameters/", b = "/body1/properties/", h = "/body1/hydro_coeffs/";
    numbers[p + "scaled"] = {{1, 1}, {0.0}};
    numbers[p + "rho"] = {{1, 1}, {rho}};
    numbers[p + "g"] = {{}, {g}};  // a scalar, as h5py writes it
    numbers[p + "w"] = {{3, 1}, {1.0, 0.5, 2.0}};
    numbers[p + "T"] = {{3}, {2.0 * std::numbers::pi, 4.0 * std::numbers::pi, std::numbers::pi}};
    numbers[p + "wave_dir"] = {{4, 1}, {0.0, 90.0, 180.0, 270.0}};
    numbers[b + "dof"] = {{1, 1}, {6.0}};
    numbers[b + "disp_vol"] = {{1, 1}, {25.0}};
    numbers[b + "cg"] = {{3, 1}, {2.0, -1.0, -0.5}};
    numbers[h + "linear_restoring_stiffness"] = {{6, 6}, std::vector<double>(36, 0.0)};
    numbers[h + "linear_restoring_stiffness"].value[14] = 13.0;
    numbers[h + "added_mass/inf_freq"] = {{6, 6}, std::vector<double>(36, 0.0)};
    Hdf5Array matrix{{6, 6, 3}, std::vector<double>(108, 0.0)};
    numbers[h + "added_mass/all"] = numbers[h + "radiation_damping/all"] = matrix;
    Hdf5Array force{{6, 4, 3}, std::vector<double>(72, 0.0)};
    numbers[h + "excitation/re"] = numbers[h + "excitation/im"] = force;
    for (int i = 0; i < 6; ++i) {
      numbers[h + "added_mass/inf_freq"].value[static_cast<std::size_t>(7 * i)] = 4.0;
      for (int f = 0; f < 3; ++f) {
        A(i, i, f) = 5.0 + f;
        B(i, i, f) = 0.5 + 0.1 * f;
      }
    }
    A(2, 4, 0) = -0.75;  // not its transpose: an order of dimensions that is reversed would be seen
    re(2, 1, 1) = 3.0;   // heave, 90 deg, 0.5 rad/s
    im(2, 1, 1) = 1.0;
  }

  double& A(int i, int j, int f) { return at("/body1/hydro_coeffs/added_mass/all", (i * 6 + j) * 3 + f); }
  double& B(int i, int j, int f) { return at("/body1/hydro_coeffs/radiation_damping/all", (i * 6 + j) * 3 + f); }
  double& re(int i, int h, int f) { return at("/body1/hydro_coeffs/excitation/re", (i * 4 + h) * 3 + f); }
  double& im(int i, int h, int f) { return at("/body1/hydro_coeffs/excitation/im", (i * 4 + h) * 3 + f); }
  double& at(const std::string& name, int n) { return numbers.at(name).value[static_cast<std::size_t>(n)]; }

  void with_kernels() {
    const std::string name = "/body1/hydro_coeffs/radiation_damping/impulse_response_fun/";
    numbers[name + "t"] = {{4, 1}, {0.0, 0.2, 0.4, 0.6}};
    numbers[name + "K"] = {{6, 6, 4}, std::vector<double>(144, 0.0)};
    for (int m = 0; m < 4; ++m) at(name + "K", (2 * 6 + 2) * 4 + m) = 4.0 - m;
  }

  void write(const std::string& path) const {
    Hdf5File file(path, Hdf5File::Mode::create);
    for (const auto& [name, array] : numbers) file.write(name, array, "");
    for (const auto& [name, text] : texts) file.write(name, text);
    file.close();
  }
};

inline DatabaseFrame frame() {
  DatabaseFrame f;
  f.length = 8.0;
  f.bodies = {{Vector3(2.0, -1.0, -0.5), 0.0}};  // Bo in the centre of gravity of the small file
  f.retardation = {10.0, 0.1};
  return f;
}

inline DatabaseFrame frame_of(const HydrodynamicCoefficients& c) {
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(10.0, 4.0, -c.waterline), 0.0}};
  if (c.hulls() == 2) f.bodies.push_back({Vector3(-7.0, 60.0, -c.waterline), 0.0});
  return f;
}

inline std::vector<BemioBody> bodies_of(const HydrodynamicCoefficients& c) {
  std::vector<BemioBody> bodies = {{"crane", Vector3(12.0, 4.0, 7.0), Vector3(12.0, 4.0, -2.0), Matrix6::Identity()}};
  if (c.hulls() == 2)
    bodies.push_back({"barge", Vector3(-7.0, 61.0, 3.0), Vector3(-7.0, 61.0, -2.0), Matrix6::Identity()});
  for (std::size_t n = 0; n < bodies.size(); ++n) bodies[n].stiffness(2, 2) = c.density * c.gravity * c.waterplane[n];
  return bodies;
}

}  // namespace bemio_sample

}  // namespace stillhook
