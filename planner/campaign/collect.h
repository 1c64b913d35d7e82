// What the parts of a campaign say, column by column.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "planner/campaign/campaign_folder.h"
#include "planner/campaign/parts.h"
#include "planner/operability/column.h"

namespace stillhook {

struct CollectedColumn {
  ColumnResult result;
  bool complete = false;  // every run that the search asks for is there
  TaskParts parts;
  double wall() const { return parts.wall; }
};

struct Collected {
  std::vector<CollectedColumn> columns;  // as in the plan
  std::size_t runs = 0, crashed = 0, repeated = 0;
  double wall = 0.0;  // s, of all runs
  std::set<std::string> hosts, arithmetic;
  std::string results_sha256;
  bool complete() const;
};

/// Goes through the search of every column with the results that are there. Throws FileError for damaged parts.
Collected collect(const Campaign& campaign);

}  // namespace stillhook
