// A 2-D spectrum as files have it, by compass, and what all readers of such files have in common.
#pragma once

#include <string>
#include <vector>

#include "sim/error.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

/// What a file says of one time and point, in one sense of direction.
struct RawSpectrum {
  std::vector<double> frequency;  // Hz, as they stand in the file
  std::vector<double> towards;    // deg clockwise from north that the waves travel to, in any order
  std::vector<double> density;    // m2/(Hz rad), [frequency * directions + direction]
  std::string source;             // file, time, point
};

/// The spectrum in the world: bearing_of_x is the compass bearing (rad) that +x points to, so that
/// heading = bearing_of_x - towards; per rad/s instead of per Hz; scaled to an Hs of scale_to_height (m) where that is
/// > 0. Throws FileError for a spectrum that is none (spectrum.h's fault_of) with the file's name.
DirectionalSpectrum in_world(const RawSpectrum& raw, const SpectrumFileSpec& spec);

/// Factor from a density in `unit` to m2/(Hz rad); "m2 s degree-1", "m**2 s radian**-1", "m2/Hz/degr" and the like.
/// Throws FileError for any other text.
double density_factor(const std::string& unit, const std::string& file);
/// Factor from a frequency in `unit` to Hz; from an angle in `unit` to degrees. The same.
double frequency_factor(const std::string& unit, const std::string& file);
double angle_factor(const std::string& unit, const std::string& file);

/// Seconds since 1970-01-01 of an ISO 8601 time, "2026-11-30T06:00:00Z" or shorter; UTC. NaN for other text.
double seconds_of(const std::string& iso);
/// The inverse, to the second.
std::string iso_of(double seconds);

/// The entry of `times` (s since 1970) that spec.time names, an index from 0 or a time. Throws FileError if there is
/// none, with the first and the last that are there.
std::size_t time_index(const SpectrumFileSpec& spec, const std::vector<double>& times);

/// The entry of points (deg) that spec.point names: an index from 0, or the nearest within a quarter of a degree to a
/// latitude and longitude. Throws FileError.
std::size_t point_index(const SpectrumFileSpec& spec, std::size_t points, const std::vector<double>& latitude,
                        const std::vector<double>& longitude);

}  // namespace stillhook
