#include "results/metrics_reference.h"

#include <fmt/format.h>

#include "results/metrics.h"

namespace stillhook {

std::string metric_reference_markdown() {
  std::string out = "| metric | unit | meaning |\n|---|---|---|\n";
  for (const MetricDefinition& d : metric_catalogue())
    out += fmt::format("| `{}` | {} | {}{} |\n", d.name, d.unit, d.description,
                       d.element == MetricElement::none ? std::string() : "; % is a " + word_of(d));
  return out;
}

}  // namespace stillhook
