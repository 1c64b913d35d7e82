#include "results/quantity.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "results/html.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// The row of a quantity: its unit, value in unit = SI x times / over, first noticeable step in the unit.
struct QuantityRow {
  Quantity quantity;
  const char* unit;
  double times, over, step;
};

constexpr double kPi = std::numbers::pi;
constexpr QuantityRow kQuantities[] = {
    {Quantity::ratio, "1", 1.0, 1.0, 1.0},        {Quantity::share, "1", 1.0, 1.0, 1.0},
    {Quantity::count, "1", 1.0, 1.0, 1.0},        {Quantity::length, "m", 1.0, 1.0, 0.1},
    {Quantity::angle, "deg", 180.0, kPi, 1.0},    {Quantity::force, "kN", 1.0, 1e3, 100.0},
    {Quantity::impulse, "kN s", 1.0, 1e3, 100.0}, {Quantity::speed, "m/s", 1.0, 1.0, 0.1},
    {Quantity::line_speed, "m/s", 1.0, 1.0, 0.1}, {Quantity::time, "s", 1.0, 1.0, 60.0},
};

const QuantityRow& row_of(Quantity quantity) {
  for (const QuantityRow& row : kQuantities)
    if (row.quantity == quantity) return row;
  throw std::logic_error("a quantity without a row");
}

}  // namespace

const char* unit_of(Quantity quantity) { return row_of(quantity).unit; }

double in_unit(double si, Quantity quantity) {
  const QuantityRow& row = row_of(quantity);
  return si * row.times / row.over;
}

double noticeable_step(Quantity quantity) { return row_of(quantity).step; }

Shown shown(Quantity quantity, double value) {
  const std::string unit = unit_of(quantity);
  if (!std::isfinite(value)) return {"–", unit == "1" ? "" : unit, ""};
  switch (quantity) {
    case Quantity::force:
      return {fixed_number(value, std::abs(value) < 100.0 ? 1 : 0), unit,
              fixed_number(1e3 * value / kTonneForce, std::abs(value) < 1000.0 ? 2 : 1) + " t"};
    case Quantity::impulse:
      return {readable_number(value), unit, ""};
    case Quantity::speed:
      return {fixed_number(value, 3), unit, ""};
    case Quantity::line_speed:
      return {fixed_number(value, 3), unit, fixed_number(value / kPerMinute, 2) + " m/min"};
    case Quantity::time:
      return {fixed_number(value, 1), unit, value >= 60.0 ? clock_time(value) : ""};
    case Quantity::length:
      return {fixed_number(value, 2), unit, ""};
    case Quantity::angle:
      return {fixed_number(value, 2), "°", ""};
    case Quantity::share:
      return {fixed_number(value, 3), "", fixed_number(100.0 * value, 1) + " %"};
    case Quantity::ratio:
    case Quantity::count:
      break;
  }
  return {value == std::round(value) ? fixed_number(value, 0) : fixed_number(value, 3), "", ""};
}

std::string clock_time(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  const long s = std::lround(seconds);
  if (s < 3600) return fmt::format("{}:{:02d}", s / 60, s % 60);
  return fmt::format("{}:{:02d}:{:02d}", s / 3600, s / 60 % 60, s % 60);
}

ShownUnit shown_unit(const std::string& si) {
  if (si == "rad") return {"deg", kDegree};
  if (si == "rad/s") return {"deg/s", kDegree};
  if (si == "N") return {"kN", 1e3};
  if (si == "N m") return {"kN m", 1e3};
  return {si, 1.0};
}

}  // namespace stillhook
