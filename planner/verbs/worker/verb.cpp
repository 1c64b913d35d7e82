#include <algorithm>
#include <filesystem>

#include "planner/campaign/task_worker.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/verbs.h"

namespace stillhook {
namespace {

class WorkerVerb final : public Verb {
 public:
  std::string name() const override { return "worker"; }
  std::string help() const override { return "Do one task of a campaign: what an engine starts on any machine"; }
  void add_options(VerbOptions& o) override {
    o.add({.name = "DIR",
           .target = &o.common().input,
           .operand = "",
           .help = "Folder of the campaign, made by operability",
           .required = true});
    o.add({.name = "--task",
           .target = &task_,
           .operand = "K",
           .help = "Number of the task, from 0",
           .range = std::pair(0.0, 1e6),
           .required = true});
    o.add_threads();
    o.add_messages("No messages but errors");
  }
  int run(const CommonOptions& options) override {
    const VerbRun verb(name(), options);
    std::string folder = options.input;
    while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
    const Campaign campaign = open_campaign(folder);
    const std::size_t task = static_cast<std::size_t>(task_.value_or(0));
    if (task >= campaign.plan.columns.size())
      throw UsageError(folder + ": --task " + std::to_string(task) + ": the campaign has tasks 0 to " +
                       std::to_string(campaign.plan.columns.size() - 1));
    return run_task(campaign, task, {std::max(1, options.threads), &verb.stop()}) ? kDone : kInterrupted;
  }

 private:
  std::optional<int> task_;
};

}  // namespace

std::unique_ptr<Verb> worker_verb() { return std::make_unique<WorkerVerb>(); }

}  // namespace stillhook
