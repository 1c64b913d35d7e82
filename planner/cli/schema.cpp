#include "problems/schema.h"

#include <fmt/format.h>

#include "planner/cli/commands.h"

namespace stillhook {

int run_schema(bool reference) {
  fmt::print("{}", reference ? key_reference_markdown() : json_schema() + "\n");
  return kDone;
}

}  // namespace stillhook
