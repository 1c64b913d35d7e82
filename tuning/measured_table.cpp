#include "tuning/measured_table.h"

#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "problems/case.h"
#include "tuning/measured_csv.h"
#include "tuning/measured_netcdf.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;

}  // namespace

bool is_netcdf_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> magic{};
  in.read(magic.data(), magic.size());
  const std::string_view start(magic.data(), magic.size());
  return start.substr(0, 3) == "CDF" || start.substr(1) == "HDF";
}

std::string MeasuredTable::place(std::size_t row) const { return fmt::format("{}:{}", file, lines[row]); }

std::string fault_of_measured_path(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  switch (status.type()) {
    case fs::file_type::regular:
      return {};
    case fs::file_type::directory:
      return "is a folder; a measured run is a CSV or NetCDF file";
    case fs::file_type::fifo:
    case fs::file_type::socket:
    case fs::file_type::character:
      return "is a pipe or a device, and cannot be read again when the fit is repeated; write the run to a file first";
    case fs::file_type::not_found:
      return "there is no such file";
    default:
      return "cannot be read" + (error ? ": " + error.message() : std::string());
  }
}

MeasuredTable read_measured_table(const std::string& path, const std::vector<std::string>& names) {
  if (const std::string fault = fault_of_measured_path(path); !fault.empty())
    throw CaseError(path + ": cannot be read: " + fault);
  return is_netcdf_file(path) ? read_measured_netcdf(path, names) : read_measured_csv(path, names);
}

}  // namespace stillhook
