// Text that goes into HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace stillhook {

/// & < > " ' as entities, and control characters, which XML forbids, as U+FFFD.
std::string escape_html(std::string_view text);

/// A number for people: `digits` significant ones, no exponent between 1e-4 and 1e7, a true minus sign, "–" for NaN.
std::string readable_number(double value, int digits = 4);

/// The same with a fixed number of decimals.
std::string fixed_number(double value, int decimals);

/// A name from a case file as words: "rotate_booms" -> "rotate booms".
std::string readable_name(std::string_view name);

}  // namespace stillhook
