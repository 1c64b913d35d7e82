// Units that a fit's tables and plots show instead of SI.
#pragma once

#include <string>

namespace stillhook {

struct ShownUnit {
  std::string name;
  double factor = 1.0;  // SI per shown
};
ShownUnit shown_unit(const std::string& si);

}  // namespace stillhook
