#include "planner/verbs/check/rigging_table.h"

#include <fmt/core.h>

#include <cmath>

#include "planner/text_number.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// The same slings without errors of length.
RiggingSpec exact(RiggingSpec rigging) {
  for (SlingSpec& s : rigging.slings) s.length_error = 0.0;
  for (SlingSpec& s : rigging.spreader.slings) s.length_error = 0.0;
  return rigging;
}

/// How the block rings between slings and nothing else, and what the time step makes of it.
std::string ringing(const RiggingSpec& rigging, const RiggingPose& pose, double time_step) {
  if (!(pose.vertical_stiffness > 0.0)) return {};
  const double period = kTwoPi * std::sqrt(rigging.mass / pose.vertical_stiffness);
  std::string text = fmt::format(" On its slings alone the block rings with {} s", cell(period, 3));
  // Between two and ten steps a vibration is neither resolved nor damped out by the integrator.
  if (period > 2.0 * time_step && period < 10.0 * time_step)
    text += fmt::format(
        ": solver.time_step_s is more than a tenth of that; halve it to see whether tensions of slings depend "
        "on it");
  return text + ".";
}

ReportTable table_of(const RiggingSpec& rigging, const Specification& spec) {
  const RiggingPose pose = rigging_pose(rigging, spec, 1.0, RiggingLoad::turns);
  const RiggingPose without = rigging_pose(exact(rigging), spec, 1.0, RiggingLoad::turns);
  const RollPitchYaw turned = roll_pitch_yaw(pose.load.R);
  ReportTable table;
  table.title = "Slings of " + rigging.name;
  table.note = fmt::format(
      "With {} hanging at rest, its centre of gravity under the hook: roll {} deg, pitch {} deg. Skew: tension over "
      "that "
      "without errors of length. Use: of the breaking load.",
      rigging.load, cell(turned.roll / kDegree, 2), cell(turned.pitch / kDegree, 2));
  table.note += ringing(rigging, pose, spec.solver.time_step);
  table.header = {"sling", "length m", "error mm", "tension kN", "angle to horizontal deg", "skew", "use %"};
  const std::size_t uppers = rigging.spreader.slings.size();
  for (std::size_t i = 0; i < pose.slings.size(); ++i) {
    const SlingSpec& s = i < uppers ? rigging.spreader.slings[i] : rigging.slings[i - uppers];
    const RiggingPose::Sling& now = pose.slings[i];
    const double alone = without.slings[i].tension;
    table.rows.push_back({s.name, cell(s.length + s.length_error, 3), cell(1e3 * s.length_error, 1),
                          cell(now.tension / 1e3, 1), cell(now.angle / kDegree, 1),
                          alone > 0.0 ? cell(now.tension / alone, 3) : "-",
                          s.breaking_load > 0.0 ? cell(100.0 * now.tension / s.breaking_load, 1) : "-"});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> rigging_tables(const Case& c) {
  std::vector<ReportTable> tables;
  for (const RiggingSpec& rigging : c.rigging) tables.push_back(table_of(rigging, c.specification));
  return tables;
}

}  // namespace stillhook
