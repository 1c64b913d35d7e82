#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/operability/operability_files.h"
#include "planner/verbs/operability/operability_output.h"
#include "planner/verbs/operability/operability_tables.h"
#include "planner/verbs/verbs.h"
#include "results/files.h"

namespace stillhook {
namespace {

ReportTable status_table(const OperabilityStudy& study) {
  ReportTable table{
      "Columns", "", {"task", "Tp, s", "heading, deg", "state", "runs", "time, s", "limit so far, m"}, {}};
  for (std::size_t task = 0; task < study.collected.columns.size(); ++task) {
    const CollectedColumn& c = study.collected.columns[task];
    const OperabilityColumn& column = study.plan().columns[task];
    table.rows.push_back({std::to_string(task), fmt::format("{:g}", column.peak_period),
                          fmt::format("{:g}", degrees_of(column.heading)),
                          c.complete              ? "done"
                          : c.parts.attempts == 0 ? "not begun"
                                                  : "begun",
                          std::to_string(c.parts.runs.size()), fmt::format("{:.1f}", c.wall()),
                          c.parts.runs.empty() ? "-" : limit_text(study, task, 0)});
  }
  return table;
}

void print_status(const OperabilityStudy& study) {
  const Collected& all = study.collected;
  const auto done =
      std::count_if(all.columns.begin(), all.columns.end(), [](const CollectedColumn& c) { return c.complete; });
  const double expected = runs_expected(study.plan().rules).least;
  double left = 0.0;
  for (const CollectedColumn& c : all.columns)
    if (!c.complete) left += std::max(1.0, expected - static_cast<double>(c.parts.runs.size()));
  fmt::print("{}{} of {} columns are done, {} runs, {} crashed, {:.3g} core-hours", table_text(status_table(study)),
             done, all.columns.size(), all.runs, all.crashed, all.wall / 3600.0);
  if (left > 0.0 && all.runs > 0)
    fmt::print("; about {:.3g} more", left * all.wall / static_cast<double>(all.runs) / 3600.0);
  fmt::print("\n");
  if (std::filesystem::exists(cancel_path(study.campaign.folder))) fmt::print("It was told to end.\n");
}

class CampaignVerb final : public Verb {
 public:
  std::string name() const override { return "campaign"; }
  std::string help() const override { return "See, collect or end what a folder of operability holds"; }
  void add_options(VerbOptions& o) override {
    o.add({.name = "ACTION",
           .target = &action_,
           .operand = "status|collect|cancel",
           .help = "Print how far it is; write its files and report from the runs that are there; end its workers",
           .required = true});
    o.add({.name = "DIR",
           .target = &o.common().input,
           .operand = "",
           .help = "Folder of the campaign",
           .required = true});
    o.add({"--json", &o.common().json, "", "Print the summary as JSON on stdout"});
    o.add_messages("Nothing but errors, and what --json prints");
  }
  int run(const CommonOptions& options) override {
    const VerbRun verb(name(), options);
    std::string folder = options.input;
    while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
    Campaign campaign = read_campaign(folder);
    if (action_ == "cancel") {
      write_or_refuse([&] { write_file(cancel_path(folder), ""); });
      if (verb.prints())
        fmt::print("{}: its workers end with the run under way; stillhook operability --resume goes on\n", folder);
      return kDone;
    }
    return action_ == "status" ? status(verb, std::move(campaign)) : collect(verb, std::move(campaign));
  }

 private:
  static int status(const VerbRun& verb, Campaign campaign) {
    const OperabilityStudy study = study_of(std::move(campaign));
    if (verb.options().json)
      fmt::print("{}", operability_summary(study, {}, study.collected.complete() ? "completed" : "interrupted",
                                           verb.date(), verb.wall()));
    if (verb.prints()) print_status(study);
    return kDone;
  }

  static int collect(const VerbRun& verb, Campaign campaign) {
    const RunFolder folder(campaign.folder, RunFolder::Mode::resume);  // locked: nobody else writes its files
    const OperabilityStudy study = study_of(std::move(campaign));
    const std::vector<std::string> files = write_operability_files(study, verb.date());
    const std::string summary = operability_summary(
        study, files, study.collected.complete() ? "completed" : "interrupted", verb.date(), verb.wall());
    verb.write(folder.summary(), summary);
    if (verb.options().json) fmt::print("{}", summary);
    print_warnings(study.warnings);
    if (verb.prints()) print_operability(study, files);
    return operability_exit(study);
  }

  std::string action_;
};

}  // namespace

std::unique_ptr<Verb> campaign_verb() { return std::make_unique<CampaignVerb>(); }

}  // namespace stillhook
