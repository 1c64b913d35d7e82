// Writing what a run leaves into its folder.
#pragma once

#include "planner/run.h"
#include "planner/run_folder.h"
#include "results/report.h"

namespace stillhook {

/// Writes history.nc.
void write_history(const RunFolder& folder, const RunResult& run, const Case& c);

/// Writes report.html: static tables from the model, `search` for a plan.
void write_run_report(const RunFolder& folder, const RunResult& run, const PreparedRun& prepared, const Case& c,
                      const std::string& statement, const SearchSection* search = nullptr,
                      std::vector<std::string> notes = {}, const std::vector<ReportTable>& tables = {});

}  // namespace stillhook
