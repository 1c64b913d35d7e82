#pragma once

#include <string>

namespace stillhook {

/// Every metric with its unit and meaning, as a Markdown table: the list in docs/summary.md.
std::string metric_reference_markdown();

}  // namespace stillhook
