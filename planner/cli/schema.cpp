#include "problems/schema.h"

#include <fmt/format.h>

#include "planner/cli/commands.h"
#include "results/metrics_reference.h"

namespace stillhook {

int run_schema(const SchemaArguments& arguments) {
  if (arguments.reference && arguments.metrics) throw UsageError("schema: say --reference or --metrics");
  fmt::print("{}", arguments.reference ? key_reference_markdown()
                   : arguments.metrics ? metric_reference_markdown()
                                       : json_schema() + "\n");
  return kDone;
}

}  // namespace stillhook
