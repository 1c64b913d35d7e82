#pragma once

#include <string>

namespace stillhook {

/// A number with so many decimals; "-" for NaN, and no sign before a rounded zero.
std::string cell(double value, int decimals);
/// A number with four significant digits; "-" for NaN.
std::string short_number(double value);
/// "48 s", "12 min 5 s", "2 h 7 min".
std::string duration_text(double seconds);

}  // namespace stillhook
