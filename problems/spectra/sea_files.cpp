#include "problems/spectra/sea_files.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "problems/spectra/elevation_file.h"
#include "problems/spectra/spectrum_netcdf.h"
#include "problems/spectra/swan_ascii.h"

namespace stillhook {
namespace {

using SpectrumFormat = SpectrumFileSpec::Format;

/// The file as it is.
std::string file_key(const std::string& file) {
  std::error_code error;
  return file + '|' + std::to_string(std::filesystem::file_size(file, error)) + '|' +
         std::to_string(std::filesystem::last_write_time(file, error).time_since_epoch().count());
}

/// What a reading depends on: the file as it is, and how it is read.
std::string key_of(const SpectrumFileSpec& s, double weight) {
  std::ostringstream key;
  key.precision(17);
  key << file_key(s.file) << '|' << static_cast<int>(s.format) << '|' << s.time << '|' << s.bearing_of_x << '|'
      << s.scale_to_height << '|' << weight;
  for (const double p : s.point) key << '|' << p;
  return key.str();
}

}  // namespace

DirectionalSpectrum read_spectrum_file(const SpectrumFileSpec& spec, double density, double gravity) {
  const bool text = is_swan_ascii(spec.file);
  if (text && spec.format != SpectrumFormat::automatic && spec.format != SpectrumFormat::swan)
    throw FileError(spec.file + ": is a text file of SWAN, which contradicts the format that the case names");
  return in_world(text ? read_swan_ascii(spec, density, gravity) : read_netcdf_spectrum(spec), spec);
}

void read_sea_file(SeaStateSpec& state, double density, double gravity) {
  if (state.type == SeaStateSpec::Type::record)
    state.record = std::make_shared<const ElevationRecord>(read_elevation_file(state.record_file));
  if (state.type != SeaStateSpec::Type::spectrum) return;
  // A search reads its case anew for every sample: the file need not be.
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const DirectionalSpectrum>> known;
  const std::lock_guard lock(mutex);
  auto& entry = known[key_of(state.spectrum_file, density * gravity)];
  if (!entry)
    entry = std::make_shared<const DirectionalSpectrum>(read_spectrum_file(state.spectrum_file, density, gravity));
  state.spectrum = entry;
}

void read_wind_record(WindSpec& wind) {
  if (wind.gusts != WindSpec::Gusts::record) return;
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const WindRecord>> known;
  const std::lock_guard lock(mutex);
  auto& entry = known[file_key(wind.record_file) + '|' + wind.column];
  if (!entry) entry = std::make_shared<const WindRecord>(read_wind_file(wind));
  wind.record = entry;
}

}  // namespace stillhook
