#include "sim/hull/radiation/state_space_cache.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/hull/coefficients/content_hash.h"
#include "sim/hull/coefficients/whole_file.h"

namespace stillhook {
namespace {

// Changes whenever the same set would give another fit.
constexpr const char* kFitVersion = "state space 1";
constexpr const char* kFirstLine = "stillhook_state_space 1";

std::string fit_key(const HydrodynamicCoefficients& set, double tolerance) {
  ContentHash hash;
  hash.add(std::string(kFitVersion));
  hash.add(tolerance);
  hash.add(set.A_inf);
  for (const FrequencyCoefficients& f : set.frequency) {
    hash.add(f.frequency);
    hash.add(f.A);
    hash.add(f.B);
  }
  hash.add(set.retardation.interval);
  for (const RetardationKernel& kernel : set.retardation.kernels) {
    hash.add(static_cast<double>(64 * kernel.i + kernel.j));
    for (const double K : kernel.value) hash.add(K);
  }
  return hash.text();
}

/// Numbers with all their digits: a fit reads back to the last bit.
std::string text_of(const KnownStateSpace& known) {
  std::ostringstream out;
  out << std::setprecision(17) << kFirstLine << '\n';
  if (!known.fit) {
    out << "none " << known.fault << '\n';
    return out.str();
  }
  out << "modes " << known.fit->modes << ' ' << known.fit->blocks.size() << '\n';
  for (const StateSpaceBlock& block : known.fit->blocks) {
    out << "block " << block.modes.size() << ' ' << block.K.poles.size();
    for (const int mode : block.modes) out << ' ' << mode;
    out << '\n';
    for (std::size_t k = 0; k < block.K.poles.size(); ++k) {
      out << block.K.poles[k].real() << ' ' << block.K.poles[k].imag();
      for (const Complex& r : block.K.residues[k].reshaped()) out << ' ' << r.real() << ' ' << r.imag();
      out << '\n';
    }
  }
  out << "end\n";
  return out.str();
}

}  // namespace

std::optional<KnownStateSpace> read_state_space(const std::string& path, int modes) {
  std::ifstream in(path);
  std::string line, word;
  if (!std::getline(in, line) || line != kFirstLine || !(in >> word)) return std::nullopt;
  KnownStateSpace known;
  if (word == "none") {
    in.ignore();
    if (!std::getline(in, known.fault)) return std::nullopt;
    return known;
  }
  StateSpaceFit fit;
  std::size_t blocks = 0;
  if (word != "modes" || !(in >> fit.modes >> blocks) || fit.modes != modes) return std::nullopt;
  for (std::size_t b = 0; b < blocks; ++b) {
    std::size_t size = 0, poles = 0;
    if (!(in >> word >> size >> poles) || word != "block" || size > static_cast<std::size_t>(modes) || poles > 1000)
      return std::nullopt;
    StateSpaceBlock block;
    block.modes.resize(size);
    for (int& mode : block.modes)
      if (!(in >> mode) || mode < 0 || mode >= modes) return std::nullopt;
    const auto number = [&in] {
      double value = std::numeric_limits<double>::quiet_NaN();
      in >> value;
      return value;
    };
    for (std::size_t k = 0; k < poles; ++k) {
      const double re = number(), im = number();
      block.K.poles.emplace_back(re, im);
      MatrixXc R(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
      for (Complex& r : R.reshaped()) {
        const double real = number();
        r = {real, number()};
      }
      block.K.residues.push_back(std::move(R));
    }
    fit.blocks.push_back(std::move(block));
  }
  if (!(in >> word) || word != "end") return std::nullopt;
  known.fit = std::make_shared<const StateSpaceFit>(std::move(fit));
  return known;
}

std::string state_space_file(const HydrodynamicCoefficients& set, double tolerance) {
  const std::string folder = cache_folder();
  return folder.empty() ? "" : (std::filesystem::path(folder) / ("fit-" + fit_key(set, tolerance) + ".txt")).string();
}

KnownStateSpace known_state_space(const HydrodynamicCoefficients& set, double tolerance) {
  static std::mutex mutex;
  static std::map<std::string, KnownStateSpace> memory;
  const std::string key = fit_key(set, tolerance);
  const std::lock_guard lock(mutex);
  if (const auto it = memory.find(key); it != memory.end()) return it->second;
  const std::string file = state_space_file(set, tolerance);
  if (!file.empty())
    if (std::optional<KnownStateSpace> stored = read_state_space(file, set.modes()))
      return memory[key] = std::move(*stored);
  KnownStateSpace known;
  try {
    StateSpaceOptions options;
    options.tolerance = tolerance;
    known.fit = std::make_shared<const StateSpaceFit>(fit_state_space(set, options).fit);
  } catch (const SpecificationError& error) {
    // Without the name of the set, which may lie elsewhere the next time.
    known.fault = std::string(error.what()).substr(set.source.size() + 2);
  }
  if (!file.empty()) try {
      std::error_code error;
      std::filesystem::create_directories(cache_folder(), error);
      WholeFile whole(file);
      whole.write(text_of(known));
      whole.commit();
    } catch (const SpecificationError&) {
      // No place to keep it: it is found anew the next time.
    }
  return memory[key] = std::move(known);
}

}  // namespace stillhook
