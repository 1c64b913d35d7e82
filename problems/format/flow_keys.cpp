#include "problems/format/flow_keys.h"

#include <fmt/core.h>

#include "sim/environment/flow_coefficients.h"

namespace stillhook {
namespace {

void refuse_moved_by_sea(const std::string& name, const std::string& fluid, EntryCheck& check) {
  const BodySpec* body = entry_named(check.specification().bodies, name);
  if (body && body->moved_by_sea())
    check.report("body", fmt::format("\"{}\" moves by displacement RAOs, which no {} changes: leave the entry out",
                                     name, fluid));
}

}  // namespace

void check_area(const FlowAreaSpec& area, const std::string& fluid, EntryCheck& check) {
  if (!(area.areas.maxCoeff() > 0.0)) check.report("areas_m2", "must have one number > 0 at least");
  if (!(area.height || area.areas.head<2>().maxCoeff() > 0.0))
    check.report("height_m", "is needed with an area across z alone");
  refuse_moved_by_sea(area.body, fluid, check);
}

void check_hull(const FlowHullSpec& hull, const std::string& fluid, EntryCheck& check) {
  refuse_moved_by_sea(hull.body, fluid, check);
  if (hull.coefficient_file.empty()) return;
  try {
    read_flow_coefficients(hull.coefficient_file);
  } catch (const FileError& error) {
    check.report("coefficients", error.what());
  }
}

}  // namespace stillhook
