#include "planner/verbs/operability/operability_output.h"

#include <fmt/format.h>

#include "planner/cli/commands.h"
#include "planner/cli/tables.h"
#include "planner/document_control.h"
#include "planner/verbs/operability/operability_files.h"
#include "planner/verbs/operability/operability_report.h"
#include "planner/verbs/operability/operability_tables.h"
#include "results/files.h"

namespace stillhook {

std::vector<std::string> write_operability_files(const OperabilityStudy& study, const std::string& date) {
  const std::string& folder = study.campaign.folder;
  write_or_refuse([&] {
    write_file(folder + "/operability.csv", operability_csv(study));
    write_operability_netcdf(study, folder + "/operability.nc");
  });
  const std::vector<std::string> files = {"operability.csv", "operability.nc", "case.toml", "summary.json"};
  const DocumentControl control = document_control(study.campaign.lift, date, folder + "/case.toml");
  write_or_refuse([&] { write_file(folder + "/report.html", operability_report(study, files, control)); });
  return {"operability.csv", "operability.nc", "report.html"};
}

void print_operability(const OperabilityStudy& study, const std::vector<std::string>& files) {
  fmt::print("{}\n\n{}", operability_verdict(study), table_text(limits_matrix(study)));
  if (const std::string letters = letters_text(study); !letters.empty()) fmt::print("{}\n", letters);
  fmt::print("\n{}", table_text(limits_list(study)));
  for (const std::string& note : study.notes) fmt::print("{}{}\n", note == study.notes.front() ? "\n" : "", note);
  fmt::print("\n{} runs, {:.3g} core-hours. {}: {}\n", study.collected.runs, study.collected.wall / 3600.0,
             study.campaign.folder, fmt::join(files, ", "));
}

int operability_exit(const OperabilityStudy& study) { return certified(study) ? kDone : kLimitViolated; }

}  // namespace stillhook
