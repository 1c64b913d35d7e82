// Numbers in sentences for people.
#pragma once

#include <cstdio>
#include <string>

namespace stillhook {

/// At most six digits, as short as they can be: "0.25", "401000", "1e-07".
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value + 0.0);  // never "-0"
  return text;
}

}  // namespace stillhook
