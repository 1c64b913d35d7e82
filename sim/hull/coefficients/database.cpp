#include "sim/hull/coefficients/database.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "sim/specification.h"

namespace stillhook {

namespace {

/// In small letters.
std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

}  // namespace

bool is_bemio(const std::string& path) { return ending_of(path) == ".h5"; }

bool is_wamit(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".1" || ending == ".2" || ending == ".3" || ending == ".hst";
}

std::vector<std::string> database_files(const std::string& path) {
  if (!is_wamit(path)) return {path};
  const std::string base = path.substr(0, path.size() - ending_of(path).size());
  return {wamit_path(base, ".1"), wamit_path(base, ".2"), wamit_path(base, ".3"), wamit_path(base, ".hst")};
}

HydrodynamicCoefficients read_database(const std::string& path, const DatabaseOptions& options) {
  const std::string ending = ending_of(path);
  if (ending == ".csv") return read_coefficient_file(path);
  if (is_bemio(path)) return read_bemio(path, options.frame);
  if (is_wamit(path)) return read_wamit(path.substr(0, path.size() - ending.size()), options.wamit, options.frame);
  throw SpecificationError(path, "",
                           "is no known coefficient file by its name; there are .csv (the project's own), .1 .3 .hst "
                           "(WAMIT) and .h5 (BEMIO)" +
                               (ending == ".nc" ? std::string("; Capytaine writes its datasets as WAMIT files with "
                                                              "capytaine.io.wamit.export_to_wamit")
                                                : std::string()));
}

}  // namespace stillhook
