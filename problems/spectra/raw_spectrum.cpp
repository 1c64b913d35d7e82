#include "problems/spectra/raw_spectrum.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "sim/number_text.h"
#include "sim/sea/spectrum.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

[[noreturn]] void refuse_file(const std::string& file, const std::string& sentence) {
  throw FileError(file + ": " + sentence);
}

/// Without blanks, stars and the like, in small letters, the names of angles short.
std::string bare_unit(const std::string& unit) {
  std::string bare;
  for (const char c : unit)
    if (std::string(" ^*._()").find(c) == std::string::npos)
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto shorten = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = bare.find(from); at != std::string::npos; at = bare.find(from))
      bare.replace(at, from.size(), to);
  };
  shorten("radians", "rad");
  shorten("radian", "rad");
  shorten("degrees", "deg");
  shorten("degree", "deg");
  shorten("degr", "deg");
  shorten("hertz", "hz");
  shorten("second", "s");
  return bare;
}

bool one_of(const std::string& text, std::initializer_list<const char*> list) {
  return std::ranges::any_of(list, [&](const char* entry) { return text == entry; });
}

}  // namespace

double density_factor(const std::string& unit, const std::string& file) {
  const std::string bare = bare_unit(unit);
  if (one_of(bare, {"m2srad-1", "m2s/rad", "m2/hz/rad", "m2hz-1rad-1", "m2/hzrad", "m2srad"})) return 1.0;
  if (one_of(bare, {"m2sdeg-1", "m2s/deg", "m2/hz/deg", "m2hz-1deg-1", "m2/hzdeg"})) return 1.0 / kDegree;
  refuse_file(file, "the density is in \"" + unit + "\", which is none of the known units: m2 s rad-1, m2 s degree-1");
}

double frequency_factor(const std::string& unit, const std::string& file) {
  const std::string bare = bare_unit(unit);
  if (one_of(bare, {"hz", "s-1", "1/s"})) return 1.0;
  if (one_of(bare, {"rad/s", "rads-1"})) return 1.0 / kTwoPi;
  refuse_file(file, "the frequencies are in \"" + unit + "\", which is none of the known units: Hz, s-1, rad/s");
}

double angle_factor(const std::string& unit, const std::string& file) {
  const std::string bare = bare_unit(unit);
  if (one_of(bare, {"deg", "degtrue", "degn", "degtrue-north", "degclockwisefromnorth"})) return 1.0;
  if (one_of(bare, {"rad"})) return 1.0 / kDegree;
  refuse_file(file, "the directions are in \"" + unit + "\", which is none of the known units: degree, radian");
}

double seconds_of(const std::string& iso) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, end = 0;
  double second = 0.0;
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::string text = iso;
  if (!text.empty() && (text.back() == 'Z' || text.back() == 'z')) text.pop_back();
  std::replace(text.begin(), text.end(), 'T', ' ');
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &end) != 3) return none;
  const std::string clock = text.substr(static_cast<std::size_t>(end));
  if (!clock.empty()) {
    end = 0;
    if (std::sscanf(clock.c_str(), " %2d:%2d%n", &hour, &minute, &end) != 2) return none;
    if (const std::string rest = clock.substr(static_cast<std::size_t>(end)); !rest.empty()) {
      end = 0;
      if (std::sscanf(rest.c_str(), ":%lf%n", &second, &end) != 1 || static_cast<std::size_t>(end) != rest.size())
        return none;
    }
  }
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || hour > 24 || minute > 59 || !(second >= 0.0 && second < 61.0) || hour < 0 || minute < 0)
    return none;
  const double days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  return 86400.0 * days + 3600.0 * hour + 60.0 * minute + second;
}

std::string iso_of(double seconds) {
  const double whole = std::round(seconds), day = std::floor(whole / 86400.0);
  if (!(std::abs(day) < 4e6)) return number_text(seconds) + " s since 1970";
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(static_cast<int>(day)))};
  const int rest = static_cast<int>(whole - 86400.0 * day);
  return fmt::format("{:04d}-{:02d}-{:02d}T{:02d}:{:02d}:{:02d}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), rest / 3600,
                     rest / 60 % 60, rest % 60);
}

std::size_t time_index(const SpectrumFileSpec& spec, const std::vector<double>& times) {
  const std::string& wanted = spec.time;
  std::size_t index = 0;
  const auto [end, fault] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (fault == std::errc() && end == wanted.data() + wanted.size()) {
    if (index < times.size()) return index;
    refuse_file(spec.file, "has " + std::to_string(times.size()) + " times, the first is 0; time asks for " + wanted);
  }
  const double seconds = seconds_of(wanted);
  if (std::isnan(seconds))
    refuse_file(spec.file, "time must be an index from 0 or a time like 2026-11-30T06:00, got \"" + wanted + "\"");
  constexpr double kSame = 1.0;  // s: times in files are rounded
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - seconds) <= kSame) return i;
  refuse_file(spec.file,
              "has no spectrum of " + wanted +
                  (times.empty() ? std::string()
                                 : ", its times go from " + iso_of(times.front()) + " to " + iso_of(times.back())));
}

std::size_t point_index(const SpectrumFileSpec& spec, std::size_t points, const std::vector<double>& latitude,
                        const std::vector<double>& longitude) {
  if (spec.point.empty()) {
    if (points == 1) return 0;
    refuse_file(spec.file, "has " + std::to_string(points) +
                               " points: point says which, by its index from 0 or by "
                               "latitude and longitude");
  }
  if (spec.point.size() == 1) {
    const double index = spec.point[0];
    if (index >= 0.0 && index < static_cast<double>(points) && index == std::floor(index))
      return static_cast<std::size_t>(index);
    refuse_file(spec.file,
                "has " + std::to_string(points) + " points, the first is 0; point asks for " + number_text(index));
  }
  if (latitude.size() != points || longitude.size() != points)
    refuse_file(spec.file, "does not say where its points are: name the point by its index");
  constexpr double kNear = 0.25;  // deg
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points; ++i) {
    const double east = std::remainder(longitude[i] - spec.point[1], 360.0) * std::cos(spec.point[0] * kDegree);
    const double distance = std::hypot(latitude[i] - spec.point[0], east);
    if (distance < least) least = distance, best = i;
  }
  if (!(least <= kNear))
    refuse_file(spec.file, "has no point within a quarter of a degree of " + number_text(spec.point[0]) + ", " +
                               number_text(spec.point[1]));
  return best;
}

DirectionalSpectrum in_world(const RawSpectrum& raw, const SpectrumFileSpec& spec) {
  const std::size_t n = raw.towards.size();
  std::vector<double> heading(n);
  for (std::size_t b = 0; b < n; ++b) {
    const double turned = std::fmod(spec.bearing_of_x - raw.towards[b] * kDegree, kTwoPi);
    heading[b] = turned < 0.0 ? turned + kTwoPi : turned;
    if (kTwoPi - heading[b] < 1e-9) heading[b] = 0.0;  // rounding must not tear the first from the last
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t b) { return heading[b]; });
  DirectionalSpectrum spectrum;
  spectrum.source = raw.source;
  for (const double f : raw.frequency) spectrum.frequency.push_back(kTwoPi * f);
  for (const std::size_t b : order) spectrum.heading.push_back(heading[b]);
  for (std::size_t f = 0; f < raw.frequency.size(); ++f)
    for (const std::size_t b : order) spectrum.density.push_back(raw.density[f * n + b] / kTwoPi);
  if (const std::string fault = fault_of(spectrum); !fault.empty()) refuse_file(spec.file, fault);
  if (spec.scale_to_height > 0.0) {
    const double factor = spec.scale_to_height * spec.scale_to_height / 16.0 / variance_of(spectrum);
    for (double& density : spectrum.density) density *= factor;
    spectrum.source += ", scaled to Hs " + number_text(spec.scale_to_height) + " m";
  }
  return spectrum;
}

}  // namespace stillhook
