// What a case says about the wind. SI and radians.
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace stillhook {

/// The wind at one height, measured.
struct WindRecord {
  double step = 0.0;          // s, between values
  std::vector<double> speed;  // m/s
  std::string source;         // what was read, in words

  double length() const { return step * static_cast<double>(speed.size() - 1); }  // s
  double mean() const;                                                            // m/s
  bool operator==(const WindRecord&) const = default;
};

/// Wind over the sea: a mean that grows with height, and gusts of one direction that reach all heights at once.
struct WindSpec {
  enum class Profile { iso, power, constant };
  enum class Gusts { none, npd, api, kaimal, record };
  double speed = 0.0;             // m/s, hourly mean at 10 m above still water; 0 = no wind
  std::optional<double> from, to;  // rad, where it comes from or goes to, from +x counter-clockwise; one of them
  Profile profile = Profile::iso;
  double exponent = 0.12;         // of Profile::power
  double density = 1.226;         // kg/m3, of the air
  Gusts gusts = Gusts::none;      // by which spectrum, or as measured
  int components = 200;           // of the gusts' spectrum
  std::optional<int> seed;        // their phases come from this index; absent: from the seed of the sea
  std::optional<double> turbulence;         // 1, standard deviation over mean speed (api, kaimal); absent: ISO 19901-1
  std::optional<double> turbulence_length;  // m, (kaimal); absent: IEC 61400-1
  std::string record_file, column;          // resolved path, name of the column (record)
  double record_height = 10.0;              // m above still water (record)
  std::shared_ptr<const WindRecord> record;  // what stands in it

  bool blows() const { return speed > 0.0; }
  double towards() const { return to ? *to : from ? *from + std::numbers::pi : 0.0; }
  /// The phases of its gusts are drawn from a seed.
  bool seeded() const { return blows() && gusts != Gusts::none && gusts != Gusts::record; }
  /// That seed is the one of the sea, or the one that a scenario gives.
  bool follows_seed() const { return seeded() && !seed; }
};

}  // namespace stillhook
