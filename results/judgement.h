// What was found out about a finished plan by further simulations: the tables of its certificate and its limit prices,
// and its sensitivities. Kept beside the plan as judgement.json, so that a report can be made again without them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/report.h"

namespace stillhook {

struct Judgement {
  std::vector<ReportTable> tables;
  std::optional<SensitivityTable> sensitivities;
  std::string certificate;  // as SearchSection has it
  bool certificate_kept = true;

  bool empty() const { return tables.empty() && !sensitivities; }
};

/// Whole or not at all. Throws FileError.
void write_judgement(const Judgement& judgement, const std::string& path);

/// Throws FileError for a file that is none: its path and what is wrong.
Judgement read_judgement(const std::string& path);

}  // namespace stillhook
