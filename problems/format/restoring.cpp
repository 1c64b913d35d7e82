// Linear springs and dampers between a body and the world, in a case: keys and rules.
#include <fmt/core.h>

#include "problems/case_format.h"
#include "problems/entry_check.h"

namespace stillhook {
namespace {

/// Three numbers of the diagonal of a matrix, from `first` on.
Field& diagonal_part(TableOf<RestoringSpec>& t, const char* key, Matrix6 RestoringSpec::*matrix, int first,
                     const Unit& unit, const Range& range, const char* doc) {
  Field& field = t.numbers(
      key, {3},
      [matrix, first](RestoringSpec& s, const std::vector<double>& v) {
        for (int i = 0; i < 3; ++i) (s.*matrix)(first + i, first + i) = v[static_cast<std::size_t>(i)];
      },
      unit, range, doc);
  field.get = [matrix, first](const void* s) -> std::optional<Value> {
    const Matrix6& M = static_cast<const RestoringSpec*>(s)->*matrix;
    return Value(std::vector<double>{M(first, first), M(first + 1, first + 1), M(first + 2, first + 2)});
  };
  return field;
}

void whole_matrix(TableOf<RestoringSpec>& t, const char* key, Matrix6 RestoringSpec::*matrix, const Unit& unit,
                  const char* group, const char* doc) {
  t.rows(
       key, 6,
       [matrix](RestoringSpec& s, const std::vector<std::vector<double>>& rows) {
         for (std::size_t i = 0; i < 6; ++i)
           for (std::size_t j = 0; j < 6; ++j)
             (s.*matrix)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
       },
       unit, doc)
      .one_of(group);
}

}  // namespace

const Table& case_table(const RestoringSpec*) {
  static const Table table = [] {
    TableOf<RestoringSpec> t(
        "restoring",
        "A linear spring and damper in all six motions between a body and the world, about one point of it: a "
        "mooring or positioning system as its stiffness matrix, a hull as its hydrostatic one.");
    t.name("name", &RestoringSpec::name, "Name.");
    t.text("body", &RestoringSpec::body, "Body that it acts on.").names(Reference::body).require();
    t.vector("point_m", &RestoringSpec::point, unit::m, any_value(), "The point, in the body frame.");
    diagonal_part(t, "stiffness_kN_per_m", &RestoringSpec::stiffness, 0, unit::kN_per_m, any_value(),
                  "Along the axes: surge, sway, heave.")
        .one_of("stiffness");
    diagonal_part(t, "angular_stiffness_kN_m_per_rad", &RestoringSpec::stiffness, 3, unit::kN_m_per_rad, any_value(),
                  "About the axes: roll, pitch, yaw.")
        .one_of("angular stiffness");
    whole_matrix(t, "stiffness_matrix_kN_m", &RestoringSpec::stiffness, unit::kN_m, "stiffness",
                 "The whole 6 x 6 matrix instead, symmetric, by rows: surge, sway, heave, roll, pitch, yaw.");
    diagonal_part(t, "damping_kN_s_per_m", &RestoringSpec::damping, 0, unit::kN_s_per_m, not_negative(),
                  "Along the axes: surge, sway, heave.")
        .one_of("damping");
    diagonal_part(t, "angular_damping_kN_m_s_per_rad", &RestoringSpec::damping, 3, unit::kN_m_s_per_rad, not_negative(),
                  "About the axes: roll, pitch, yaw.")
        .one_of("angular damping");
    whole_matrix(t, "damping_matrix_kN_s_m", &RestoringSpec::damping, unit::kN_s_m, "damping",
                 "The whole 6 x 6 matrix instead, symmetric and positive semidefinite, by rows.");
    t.vector("force_at_rest_kN", &RestoringSpec::force_at_rest, unit::kN, any_value(),
             "Force on the body at rest, world axes: the weight that a hull's stiffness takes up, for example.");
    Field& rest = t.numbers(
        "rest_point_m", {3},
        [](RestoringSpec& s, const std::vector<double>& v) { s.rest_point = Vector3(v[0], v[1], v[2]); }, unit::m,
        any_value(), "Where the point is at rest, in the world.");
    rest.absent("where the body's given pose has it");
    Field& attitude = t.numbers(
        "rest_attitude_deg", {3},
        [](RestoringSpec& s, const std::vector<double>& v) {
          s.rest_attitude = RollPitchYaw{v[0], v[1], v[2]};
        },
        unit::deg, Range{-360.0, 360.0, false}, "Roll, pitch, yaw of the body at rest.");
    attitude.absent("the body's given attitude");
    t.number("axes_heading_deg", &RestoringSpec::axes_heading, unit::deg, Range{-360.0, 360.0, false},
             "Heading of the horizontal x axis that the numbers are along and about, from +x of the world.")
        .absent("the heading at rest");
    return t.build();
  }();
  return table;
}

void check_entry(const RestoringSpec& r, EntryCheck& check) {
  check.one_of("angular_stiffness_kN_m_per_rad", "stiffness_matrix_kN_m");
  check.one_of("angular_damping_kN_m_s_per_rad", "damping_matrix_kN_s_m");
  if (r.stiffness.isZero(0.0) && r.damping.isZero(0.0) && r.force_at_rest.isZero(0.0))
    check.report("", "does nothing: give it a stiffness, a damping or a force_at_rest_kN");
  const BodySpec* body = entry_named(check.specification().bodies, r.body);
  if (body && body->moved_by_sea())
    check.report(
        "body", fmt::format("\"{}\" moves by displacement RAOs, which no spring changes: leave the entry out", r.body));
}

}  // namespace stillhook
