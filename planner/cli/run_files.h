// Writing what a run leaves into its folder.
#pragma once

#include "planner/run.h"
#include "planner/run_folder.h"
#include "results/report.h"

namespace stillhook {

/// What history.nc says about itself.
ArchiveTitle archive_title(const Specification& specification, const Case& c, const std::string& verb);

/// Writes history.nc of a run whose samples are in memory.
void write_history(const RunFolder& folder, const RunResult& run, const Case& c, const std::string& verb);

/// Writes report.html: static tables from the model, `search` for a plan.
void write_run_report(const RunFolder& folder, const RunResult& run, const PreparedRun& prepared, const Case& c,
                      const std::string& statement, const SearchSection* search = nullptr,
                      std::vector<std::string> notes = {}, const std::vector<ReportTable>& tables = {});

}  // namespace stillhook
