#include "sim/hull/coefficients/bemio_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "sim/guarded_read.h"
#include "sim/hull/coefficients/hdf5_file.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr const char* kKernels = "radiation_damping/impulse_response_fun/K";
constexpr double kUniformStep = 1e-4;  // of a time step: written in single precision by some
constexpr double kPeriod = 1e-3;   // of w T / 2 pi - 1

class BemioReader {
 public:
  BemioReader(const std::string& path, const DatabaseFrame& frame)
      : file_(path, Hdf5File::Mode::read),
        path_(path),
        frame_(frame),
        hulls_(frame.bodies.size()),
        modes_(6 * hulls_) {
    while (file_.exists("/body" + std::to_string(held_ + 1))) ++held_;
  }

  HydrodynamicCoefficients read();

 private:
  std::vector<double> list(const std::string& name) const;
  double one(const std::string& name) const;
  /// Finite numbers of exactly this shape.
  Hdf5Array shaped(const std::string& name, const std::vector<std::size_t>& shape) const;
  /// A dataset of hydro_coeffs that every body of the set has.
  bool everywhere(const std::string& dataset) const {
    for (std::size_t n = 0; n < hulls_; ++n)
      if (!file_.exists(body_name(n) + "/hydro_coeffs/" + dataset)) return false;
    return true;
  }
  HydrodynamicCoefficients prepared() const;
  double depth() const;
  void read_frequencies();
  void read_radiation(std::size_t body, HydrodynamicCoefficients& c) const;
  void read_retardation(std::size_t body, HydrodynamicCoefficients& c) const;
  void read_excitation(std::size_t body, HydrodynamicCoefficients& c) const;
  Vector3 read_properties(std::size_t body, HydrodynamicCoefficients& c) const;
  std::vector<Complex> excitation_of(std::size_t body) const;
  /// Of body n of the set.
  std::string body_name(std::size_t n) const { return "/body" + std::to_string(bodies_[n] + 1); }
  /// Column of the file for mode j of the set.
  std::size_t column(std::size_t j) const { return 6 * static_cast<std::size_t>(bodies_[j / 6]) + j % 6; }

  Hdf5File file_;
  const std::string& path_;
  const DatabaseFrame& frame_;
  std::size_t hulls_, modes_;  // of the set
  int held_ = 0;               // bodies in the file
  std::vector<int> bodies_;    // those of the set, from 0
  bool scaled_ = false;
  double density_ = 0.0, gravity_ = 0.0;
  std::vector<double> frequencies_, headings_;  // as in the file
  std::vector<std::size_t> ascending_;          // their order
};

std::vector<double> BemioReader::list(const std::string& name) const {
  const Hdf5Array array = file_.numbers(name);
  if (std::count_if(array.shape.begin(), array.shape.end(), [](std::size_t n) { return n != 1; }) > 1)
    file_.fail("the dataset " + name + " must be a list, it is " + array.shape_text());
  for (double value : array.value)
    if (!std::isfinite(value)) file_.fail("the dataset " + name + " holds a number that is not finite");
  if (array.value.empty()) file_.fail("the dataset " + name + " is empty");
  return array.value;
}

double BemioReader::one(const std::string& name) const {
  const std::vector<double> value = list(name);
  if (value.size() != 1) file_.fail("the dataset " + name + " must be one number");
  return value[0];
}

Hdf5Array BemioReader::shaped(const std::string& name, const std::vector<std::size_t>& shape) const {
  Hdf5Array array = file_.numbers(name);
  if (array.shape != shape)
    file_.fail("the dataset " + name + " must be " + Hdf5Array{shape, {}}.shape_text() +
               " for these bodies, headings " + "and frequencies, it is " + array.shape_text());
  for (double value : array.value)
    if (!std::isfinite(value)) file_.fail("the dataset " + name + " holds a number that is not finite");
  return array;
}

double BemioReader::depth() const {
  const std::string name = "/simulation_parameters/water_depth";
  if (!file_.is_text(name)) {
    const Hdf5Array array = file_.numbers(name);
    if (array.value.size() != 1 || !(array.value[0] > 0.0))
      file_.fail("the dataset " + name + " must be one number > 0");
    return array.value[0];
  }
  const std::string text = file_.text(name);
  if (text.rfind("inf", 0) != 0 && text.rfind("Inf", 0) != 0)
    file_.fail("the dataset " + name + " must be a depth or \"infinite\", got \"" + text + "\"");
  return std::numeric_limits<double>::infinity();
}

void BemioReader::read_frequencies() {
  frequencies_ = list("/simulation_parameters/w");
  headings_ = list("/simulation_parameters/wave_dir");
  ascending_.resize(frequencies_.size());
  std::iota(ascending_.begin(), ascending_.end(), std::size_t{0});
  std::sort(ascending_.begin(), ascending_.end(),
            [&](std::size_t a, std::size_t b) { return frequencies_[a] < frequencies_[b]; });
  for (std::size_t n = 0; n < ascending_.size(); ++n) {
    const double w = frequencies_[ascending_[n]];
    if (w < 0.0) file_.fail("frequencies in /simulation_parameters/w must be >= 0");
    if (n > 0 && w == frequencies_[ascending_[n - 1]])
      file_.fail("a frequency in /simulation_parameters/w comes twice");
  }
  if (!file_.exists("/simulation_parameters/T")) return;
  const Hdf5Array T = file_.numbers("/simulation_parameters/T");
  if (T.value.size() != frequencies_.size()) file_.fail("/simulation_parameters/T and w have not the same length");
  for (std::size_t n = 0; n < frequencies_.size(); ++n)
    if (frequencies_[n] > 0.0 && !(std::abs(frequencies_[n] * T.value[n] / (2.0 * std::numbers::pi) - 1.0) < kPeriod))
      file_.fail("/simulation_parameters/T is not 2 pi / w: w must be in rad/s, T in s");
}

Vector3 BemioReader::read_properties(std::size_t body, HydrodynamicCoefficients& c) const {
  const std::string name = body_name(body);
  if (file_.exists(name + "/properties/dof") && one(name + "/properties/dof") != 6.0)
    file_.fail(name + " has other than six modes: only rigid bodies are read");
  const double volume = one(name + "/properties/disp_vol");
  c.volume.push_back(frame_.bodies[body].volume > 0.0 ? frame_.bodies[body].volume : volume);
  if (!(c.volume.back() > 0.0)) file_.fail(name + "/properties/disp_vol must be > 0");
  const std::string stiffness = name + "/hydro_coeffs/linear_restoring_stiffness";
  const Hdf5Array C = shaped(stiffness, {6, 6});
  const double unit = scaled_ ? 1.0 : density_ * gravity_;
  if (C.value[14] < 0.0) file_.fail(stiffness + " is negative in heave");
  c.waterplane.push_back(C.value[14] * unit / (density_ * gravity_));
  const std::vector<double> cg = list(name + "/properties/cg");
  if (cg.size() != 3) file_.fail(name + "/properties/cg must be three numbers");
  const Vector3 about(cg[0], cg[1], cg[2]);
  c.stiffness.push_back({Matrix6::Zero(), about - frame_.bodies[body].origin});
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      c.stiffness.back().C(i, j) = unit * C.value[static_cast<std::size_t>(6 * i + j)];
  return about;
}

void BemioReader::read_radiation(std::size_t body, HydrodynamicCoefficients& c) const {
  const std::string name = body_name(body) + "/hydro_coeffs/";
  const std::size_t count = frequencies_.size(), modes = 6 * static_cast<std::size_t>(held_);
  const double unit = scaled_ ? 1.0 : density_;
  const Hdf5Array A_inf = shaped(name + "added_mass/inf_freq", {6, modes});
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < modes_; ++j)
      c.A_inf(static_cast<Eigen::Index>(6 * body + i), static_cast<Eigen::Index>(j)) =
          unit * A_inf.value[i * modes + column(j)];
  if (c.frequency.empty()) return;
  const Hdf5Array A = shaped(name + "added_mass/all", {6, modes, count});
  const Hdf5Array B = shaped(name + "radiation_damping/all", {6, modes, count});
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < modes_; ++j)
      for (std::size_t f = 0; f < count; ++f) {
        const auto at_row = static_cast<Eigen::Index>(6 * body + i), at_column = static_cast<Eigen::Index>(j);
        const std::size_t at = (i * modes + column(j)) * count + ascending_[f];
        c.frequency[f].A(at_row, at_column) = unit * A.value[at];
        c.frequency[f].B(at_row, at_column) = unit * B.value[at] * (scaled_ ? 1.0 : c.frequency[f].frequency);
      }
}

void BemioReader::read_retardation(std::size_t body, HydrodynamicCoefficients& c) const {
  const std::string name = body_name(body) + "/hydro_coeffs/radiation_damping/impulse_response_fun/";
  const std::vector<double> t = list(name + "t");
  if (t.size() < 2 || std::abs(t[0]) > kUniformStep * (t[1] - t[0])) file_.fail(name + "t must begin at 0");
  const double interval = (t.back() - t[0]) / static_cast<double>(t.size() - 1);
  for (std::size_t m = 0; m < t.size(); ++m)
    if (!(interval > 0.0) || std::abs(t[m] - t[0] - interval * static_cast<double>(m)) > kUniformStep * interval * 10.0)
      file_.fail(name + "t must be evenly spaced");
  if (body > 0 && std::abs(interval - c.retardation.interval) > kUniformStep * interval)
    file_.fail(name + "t differs from that of another body");
  c.retardation.interval = interval;
  const std::size_t modes = 6 * static_cast<std::size_t>(held_);
  const Hdf5Array K = shaped(name + "K", {6, modes, t.size()});
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < modes_; ++j) {
      const double* const from = &K.value[(i * modes + column(j)) * t.size()];
      RetardationKernel kernel{static_cast<int>(6 * body + i), static_cast<int>(j), {from, from + t.size()}};
      for (double& k : kernel.value) k *= scaled_ ? 1.0 : density_;
      if (std::any_of(kernel.value.begin(), kernel.value.end(), [](double k) { return k != 0.0; }))
        c.retardation.kernels.push_back(std::move(kernel));
    }
}

std::vector<Complex> BemioReader::excitation_of(std::size_t body) const {
  const std::string name = body_name(body) + "/hydro_coeffs/excitation/";
  const std::vector<std::size_t> shape{6, headings_.size(), frequencies_.size()};
  std::vector<Complex> X;
  // The readers of some programs take magnitude and phase (rad), so that their files have no more.
  if (!file_.exists(name + "re") && file_.exists(name + "mag")) {
    const Hdf5Array magnitude = shaped(name + "mag", shape), phase = shaped(name + "phase", shape);
    for (std::size_t n = 0; n < magnitude.value.size(); ++n)
      X.push_back(magnitude.value[n] * std::polar(1.0, phase.value[n]));
    return X;
  }
  const Hdf5Array re = shaped(name + "re", shape), im = shaped(name + "im", shape);
  for (std::size_t n = 0; n < re.value.size(); ++n) X.emplace_back(re.value[n], im.value[n]);
  return X;
}

void BemioReader::read_excitation(std::size_t body, HydrodynamicCoefficients& c) const {
  const std::size_t count = frequencies_.size();
  const std::vector<Complex> X = excitation_of(body);
  const double unit = scaled_ ? 1.0 : density_ * gravity_;
  const std::size_t zero = count - c.excitation.frequencies.size();
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t h = 0; h < headings_.size(); ++h)
      for (std::size_t f = zero; f < count; ++f) {
        const std::size_t at = (i * headings_.size() + h) * count + ascending_[f];
        c.excitation.at(static_cast<int>(f - zero), static_cast<int>(h), static_cast<int>(6 * body + i)) =
            unit * X[at];
      }
}

/// An empty set with room for the numbers of the file.
HydrodynamicCoefficients BemioReader::prepared() const {
  HydrodynamicCoefficients c;
  c.source = path_;
  c.description = "BEMIO file " + path_;
  if (file_.is_text("/bem_data/code")) c.description += " from " + file_.text("/bem_data/code");
  c.density = density_;
  c.gravity = gravity_;
  const auto modes = static_cast<Eigen::Index>(modes_);
  c.A_inf = MatrixX::Zero(modes, modes);
  ExcitationTable& X = c.excitation;
  X.modes = static_cast<int>(modes_);
  // Files may do without A and B where they have retardation functions.
  const bool table = everywhere("radiation_damping/all") || !everywhere(kKernels);
  for (std::size_t f : ascending_) {
    const double w = frequencies_[f];
    if (table) c.frequency.push_back({w, MatrixX::Zero(modes, modes), MatrixX::Zero(modes, modes)});
    if (w > 0.0) X.frequencies.push_back(w);
  }
  for (double b : headings_) X.headings.push_back(b * kDegree);
  X.value.resize(X.frequencies.size() * X.headings.size() * modes_);
  return c;
}

HydrodynamicCoefficients BemioReader::read() {
  require_frame(frame_, path_);
  if (!file_.exists("/simulation_parameters")) file_.fail("is not a BEMIO file: there is no /simulation_parameters");
  density_ = one("/simulation_parameters/rho");
  gravity_ = one("/simulation_parameters/g");
  // Files of some programs do without, and their numbers are not scaled.
  scaled_ = file_.exists("/simulation_parameters/scaled") && one("/simulation_parameters/scaled") != 0.0;
  if (!(density_ > 0.0) || !(gravity_ > 0.0)) file_.fail("rho and g in /simulation_parameters must be > 0");
  std::vector<std::string> remarks;
  bodies_ = chosen_bodies(held_, frame_, path_, remarks);
  read_frequencies();
  HydrodynamicCoefficients c = prepared();
  c.remarks = remarks;
  const bool kernels = everywhere(kKernels);
  std::vector<Vector3> cg;
  for (std::size_t n = 0; n < hulls_; ++n) {
    cg.push_back(read_properties(n, c));
    read_radiation(n, c);
    if (kernels) read_retardation(n, c);
    read_excitation(n, c);
  }
  if (std::find(c.waterplane.begin(), c.waterplane.end(), 0.0) != c.waterplane.end()) {
    c.waterplane.clear();  // a code that left the restoring out
    c.stiffness.clear();
  }
  const double h = depth();
  cut_frequencies(c, frame_, path_);
  c.depth = water_of(c.excitation, gravity_, h, frame_, path_);
  complete_retardation(c, frame_);
  turn_heading(c, cg[0], frame_, h, path_);
  to_body_origins(c, cg, frame_, h);
  complete_headings(c.excitation, frame_, path_);
  return c;
}

}  // namespace

HydrodynamicCoefficients read_bemio(const std::string& path, const DatabaseFrame& frame) {
  // What is wrong with the contents comes back from the child as the three parts of its exception.
  constexpr char kBetween = '\n';
  std::string fault;
  try {
    fault = read_in_child(path, [&]() -> std::string {
      try {
        BemioReader(path, frame).read();
        return {};
      } catch (const SpecificationError& error) {
        const std::size_t place = error.entry.size() + (error.field.empty() ? 0 : 1 + error.field.size());
        return error.entry + kBetween + error.field + kBetween + std::string(error.what()).substr(place + 2);
      }
    });
  } catch (const FileError& error) {
    const std::string sentence = error.what(), place = path + ": ";
    throw SpecificationError(path, "", sentence.substr(sentence.starts_with(place) ? place.size() : 0));
  }
  if (fault.empty()) return BemioReader(path, frame).read();
  const std::size_t first = fault.find(kBetween), second = fault.find(kBetween, first + 1);
  throw SpecificationError(fault.substr(0, first), fault.substr(first + 1, second - first - 1),
                           fault.substr(second + 1));
}

}  // namespace stillhook
