// The case format: one field table per struct of a lift and of a plan. docs/case-format.md is written from these.
#pragma once

#include "problems/case.h"
#include "problems/field_table.h"

namespace stillhook {

/// The whole document; its struct is Case.
const Table& case_table();

/// The table of a kind of force element (problems/format), as a function without arguments.
template <class Spec>
const Table& element_table() {
  return case_table(static_cast<const Spec*>(nullptr));
}

const Table& sea_table();
const Table& wind_table();
const Table& current_table();
const Table& body_table();
const Table& hydrodynamics_table();
const Table& rao_table();
const Table& joint_table();
const Table& drive_table();
const Table& rigging_table();
const Table& operation_table();
const Table& pose_table();
const Table& clearance_table();
const Table& crane_curve_table();
const Table& solver_table();
const Table& panel_method_table();
const Table& limit_table();
const Table& plan_table();
const Table& tune_table();
const Table& fit_table();
const Table& operability_table();
const Table& weather_table();

}  // namespace stillhook
