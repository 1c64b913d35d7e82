#include "planner/cli/run_files.h"

#include "planner/cli/commands.h"
#include "planner/document_control.h"
#include "planner/verbs/check/static_tables.h"
#include "planner/version.h"
#include "problems/case_sources.h"
#include "results/archive.h"

namespace stillhook {

ArchiveTitle archive_title(const Specification& specification, const Case& c, const std::string& verb) {
  const std::string program = std::string("stillhook ") + kVersion;
  return {c.title.empty() ? c.name : c.title, program, specification.sea.active,
          program + ": " + verb + " of case " + c.name};
}

void write_history(const RunFolder& folder, const RunResult& run, const Case& c, const std::string& verb) {
  write_archive(run.trajectory, archive_title(run.specification, c, verb), folder.history());
}

void write_run_report(const RunFolder& folder, const RunResult& run, const PreparedRun& prepared, const Case& c,
                      const std::string& statement, const SearchSection* search, std::vector<std::string> notes,
                      const std::vector<ReportTable>& tables) {
  const std::vector<StaticPose> poses = solve_poses(prepared.model);
  std::vector<ReportTable> all = tables;
  for (ReportTable& table : static_tables(prepared.model, prepared.operation)) all.push_back(std::move(table));
  std::vector<BasisEntry> basis;
  for (const CaseSource& source : case_sources(c)) basis.push_back({source.key, source.value, source.remark});
  const ReportData data{c.title.empty() ? c.name : c.title,
                        statement,
                        resolved_text(c),
                        kVersion,
                        run.specification,
                        run.trajectory,
                        run.metrics,
                        run.limits,
                        std::move(notes),
                        poses,
                        std::move(all),
                        search,
                        run.warnings.empty() ? prepared.warnings : run.warnings,
                        std::move(basis),
                        document_control(c, run.date, folder.case_file()),
                        c.north};
  write_or_refuse([&] { write_report(data, folder.report()); });
}

}  // namespace stillhook
