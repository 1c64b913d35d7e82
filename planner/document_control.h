// The date of a run, and what its documents say of themselves.
#pragma once

#include "problems/case.h"
#include "results/document_control.h"

namespace stillhook {

/// Now, "2026-03-01 14:05 UTC". A run asks once and keeps the answer in summary.json, so that a report made again says
/// when the run was made.
std::string date_now();

/// `case_file`: the run's case.toml, whose content is hashed; a file that cannot be read has no hash.
DocumentControl document_control(const Case& c, const std::string& date, const std::string& case_file);

}  // namespace stillhook
