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

/// A length in the wrong unit, or of another ship: of a box that floats the program knows better.
void check_length(const FlowHullSpec& hull, EntryCheck& check) {
  constexpr double kLonger = 1.5;  // than the box: bow, stern and bridge wings may stand over it
  const BodySpec* body = entry_named(check.specification().bodies, hull.body);
  if (body && body->hull.shape == HullSpec::Shape::box && hull.length > kLonger * body->hull.size.x())
    check.report("length_m", fmt::format("is {:.4g} m, more than {} times the length of the hull of \"{}\", {:.4g} m",
                                         hull.length, kLonger, hull.body, body->hull.size.x()));
}

/// The law of a hull is that of a ship at the surface: its height is fixed and its own velocity filtered.
void refuse_load(const FlowHullSpec& hull, const std::string& fluid, EntryCheck& check) {
  const Specification& s = check.specification();
  const BodySpec* body = entry_named(s.bodies, hull.body);
  if (body && hull.body == s.operation.load && !body->floats())
    check.report("body", fmt::format("\"{}\" is the load, which does not float: give it [[{}_areas]]", hull.body, fluid));
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
  refuse_load(hull, fluid, check);
  check_length(hull, check);
  if (hull.coefficient_file.empty()) return;
  try {
    read_flow_coefficients(hull.coefficient_file);
  } catch (const FileError& error) {
    check.report("coefficients", error.what());
  }
}

}  // namespace stillhook
