#include "results/html.h"

#include <fmt/core.h>

#include <cmath>

namespace stillhook {
namespace {

constexpr const char* kMinus = "\u2212";

std::string with_minus(std::string digits) {
  // "-0.00" is a rounding of something small, not a sign worth printing.
  if (digits.starts_with('-') && digits.find_first_of("123456789") == std::string::npos) return digits.substr(1);
  if (digits.starts_with('-')) return kMinus + digits.substr(1);
  return digits;
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default: {
        const auto byte = static_cast<unsigned char>(c);
        const bool control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
        if (control)
          out += "\uFFFD";
        else
          out += c;
      }
    }
  }
  return out;
}

std::string readable_number(double value, int digits) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221e" : std::string(kMinus) + "\u221e";
  if (value == 0.0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude < 1e-4 || magnitude >= 1e7) return with_minus(fmt::format("{:.{}g}", value, digits));
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(magnitude))));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return with_minus(text);
}

std::string fixed_number(double value, int decimals) {
  if (!std::isfinite(value)) return readable_number(value);
  return with_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string readable_name(std::string_view name) {
  std::string words(name);
  for (char& c : words)
    if (c == '_') c = ' ';
  return words;
}

}  // namespace stillhook
