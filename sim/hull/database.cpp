#include "sim/hull/database.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "sim/specification.h"

namespace stillhook {

HydrodynamicCoefficients read_database(const std::string& path, const DatabaseOptions& options) {
  std::string ending = std::filesystem::path(path).extension().string();
  const std::string base = path.substr(0, path.size() - ending.size());
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (ending == ".csv") return read_coefficient_file(path);
  if (ending == ".h5") return read_bemio(path, options.frame);
  if (ending == ".1" || ending == ".2" || ending == ".3" || ending == ".hst")
    return read_wamit(base, options.wamit, options.frame);
  throw SpecificationError(path, "",
                           "is no known coefficient file by its name; there are .csv (the project's own), .1 .3 .hst "
                           "(WAMIT) and .h5 (BEMIO)");
}

}  // namespace stillhook
