#include "tuning/measured_unit.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {


const std::vector<MeasuredUnit>& units() {
  static const std::vector<MeasuredUnit> all = {
      {"m", "m", 1.0, 1.0},           {"mm", "m", 1e-3, 1.0},          {"cm", "m", 1e-2, 1.0},
      {"ft", "m", 0.3048, 1.0},       {"deg", "rad", kDegree, 0.0},    {"rad", "rad", 1.0, 0.0},
      {"mrad", "rad", 1e-3, 0.0},     {"m/s", "m/s", 1.0, 0.5},        {"mm/s", "m/s", 1e-3, 0.5},
      {"m/min", "m/s", 1.0 / 60.0, 0.5}, {"deg/s", "rad/s", kDegree, -0.5}, {"rad/s", "rad/s", 1.0, -0.5},
      {"N", "N", 1.0, 3.0},           {"kN", "N", 1e3, 3.0},           {"MN", "N", 1e6, 3.0},
      {"t", "N", 1e3 * kStandardGravity, 3.0},      {"kgf", "N", kStandardGravity, 3.0},           {"N m", "N m", 1.0, 4.0},
      {"kN m", "N m", 1e3, 4.0},      {"MN m", "N m", 1e6, 4.0},       {"m3", "m3", 1.0, 3.0},
      {"1", "1", 1.0, 0.0}};
  return all;
}

struct Mistake {
  double factor;
  const char* si;  // of the channel
  const char* larger;
  const char* smaller;
};

constexpr Mistake kMistakes[] = {
    {1.0 / kDegree, "rad", "as degrees taken for radians", "as radians taken for degrees"},
    {1.0 / kDegree, "rad/s", "as degrees taken for radians", "as radians taken for degrees"},
    {1e3, "rad", "as milliradians taken for radians", "as radians taken for milliradians"},
    {1e3, "m", "as millimetres taken for metres", "as metres taken for millimetres"},
    {1e2, "m", "as centimetres taken for metres", "as metres taken for centimetres"},
    {1e3, "m/s", "as mm/s taken for m/s", "as m/s taken for mm/s"},
    {60.0, "m/s", "as m/min taken for m/s", "as m/s taken for m/min"},
    {1e3, "N", "as newtons taken for kilonewtons", "as kilonewtons taken for newtons"},
    {1e3 * kStandardGravity, "N", "as newtons taken for tonnes", "as tonnes taken for newtons"},
    {1e3, "N m", "as N m taken for kN m", "as kN m taken for N m"}};

/// As UDUNITS, and so CF, spells them.
struct TimeUnit {
  std::array<const char*, 5> names;
  double seconds;
};
constexpr TimeUnit kTimeUnits[] = {{{"s", "sec", "secs", "second", "seconds"}, 1.0},
                                   {{"ms", "msec", "millisec", "millisecond", "milliseconds"}, 1e-3},
                                   {{"min", "mins", "minute", "minutes"}, 60.0},
                                   {{"h", "hr", "hrs", "hour", "hours"}, 3600.0},
                                   {{"d", "day", "days"}, 86400.0}};

}  // namespace

std::optional<MeasuredUnit> measured_unit(const std::string& name) {
  for (const MeasuredUnit& unit : units())
    if (unit.name == name) return unit;
  return std::nullopt;
}

std::optional<double> measured_time_unit(const std::string& text) {
  const std::string word = text.substr(0, text.find(' '));
  for (const auto& [names, seconds] : kTimeUnits)
    for (const char* name : names)
      if (name && word == name) return seconds;
  return std::nullopt;
}

std::string known_units() {
  std::string all;
  for (const MeasuredUnit& unit : units()) all += (all.empty() ? "" : ", ") + unit.name;
  return all;
}

std::string mistaken_unit(double ratio, const std::string& si) {
  const double size = ratio > 1.0 ? ratio : 1.0 / ratio;
  const Mistake* best = nullptr;
  double nearest = std::log(1.35);
  for (const Mistake& mistake : kMistakes) {
    if (si != mistake.si) continue;
    const double distance = std::abs(std::log(size / mistake.factor));
    if (distance >= nearest) continue;
    nearest = distance;
    best = &mistake;
  }
  if (!best) return {};
  return fmt::format("a factor {:.3g} too {}, {}", best->factor, ratio > 1.0 ? "large" : "small",
                     ratio > 1.0 ? best->larger : best->smaller);
}

}  // namespace stillhook
