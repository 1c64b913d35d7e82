// Units that tables and plots show instead of SI.
#pragma once

#include <string>

namespace stillhook {

/// The unit that is shown for a quantity: value in SI / factor is in `name`.
struct ShownUnit {
  std::string name;
  double factor = 1.0;  // SI per shown
};
ShownUnit shown_unit(const std::string& si);

}  // namespace stillhook
