#include "planner/campaign/collect.h"

#include <algorithm>

namespace stillhook {
namespace {

CollectedColumn collect_column(const Campaign& campaign, std::size_t task) {
  const OperabilityPlan& plan = campaign.plan;
  CollectedColumn collected;
  collected.parts = read_parts(campaign.folder, campaign.identity, task);
  Column column(plan.rules_of(task), cells_of(plan.criteria, plan.phases.size()),
                targets_of(plan.criteria, plan.phases));
  for (bool told = true; told && !column.done();) {
    told = false;
    for (const RunWanted& wanted : std::vector<RunWanted>(column.wanted())) {
      const auto found = collected.parts.runs.find(wanted);
      if (found == collected.parts.runs.end()) continue;
      const PartRun& run = found->second;
      column.tell({wanted, run.crashed,
                   run.crashed ? std::vector<double>() : uses_of(run.lift, plan.criteria, plan.phases_alone)});
      told = true;
    }
  }
  collected.complete = column.done();
  collected.result = column.result();
  return collected;
}

}  // namespace

bool Collected::complete() const {
  return std::all_of(columns.begin(), columns.end(), [](const CollectedColumn& c) { return c.complete; });
}

Collected collect(const Campaign& campaign) {
  Collected all;
  ResultsHash hash;
  for (std::size_t task = 0; task < campaign.plan.columns.size(); ++task) {
    const CollectedColumn& column = all.columns.emplace_back(collect_column(campaign, task));
    all.runs += column.parts.runs.size();
    all.crashed += static_cast<std::size_t>(column.result.crashed);
    all.repeated += static_cast<std::size_t>(column.parts.repeated);
    all.wall += column.parts.wall;
    all.hosts.insert(column.parts.hosts.begin(), column.parts.hosts.end());
    all.arithmetic.insert(column.parts.arithmetic.begin(), column.parts.arithmetic.end());
    hash.add(task, column.parts.runs);
  }
  all.results_sha256 = hash.hash();
  return all;
}

}  // namespace stillhook
