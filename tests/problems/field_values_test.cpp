// Keys that no shipped case and no other test sets, and those whose struct the field tables cannot be asked for: where
// their value arrives, in SI.
#include <catch2/catch.hpp>

#include "problems/case_format.h"
#include "problems/case_reader.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

/// A struct filled from some lines of its table; what else it would need is not asked for.
template <class S>
S read_into(const Table& table, const std::string& toml) {
  S object;
  Findings findings("case.toml");
  Node root = parse_document(toml + "\n", "case.toml");
  TableReader(STILLHOOK_SOURCE_DIR "/tests/problems/cases", findings).read(table, root, &object, "here");
  try {
    findings.throw_if_any();
  } catch (const CaseError& error) {
    const std::string text = error.what();
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      INFO(line);
      CHECK((line.find("is required") != std::string::npos || line.find("needs its") != std::string::npos));
      at = end + 1;
    }
  }
  return object;
}

const Table& inside(const Table& table, const std::string& key) { return table.find(key)->table(); }

Matrix6 counted(double factor) {
  Matrix6 m;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) m(i, j) = factor * (10 * (i + 1) + j + 1);
  return m;
}

const std::string kCounted =
    "[[11, 12, 13, 14, 15, 16], [21, 22, 23, 24, 25, 26], [31, 32, 33, 34, 35, 36], [41, 42, 43, 44, 45, 46], "
    "[51, 52, 53, 54, 55, 56], [61, 62, 63, 64, 65, 66]]";

}  // namespace

TEST_CASE("keys of bodies, hulls and their hydrodynamics arrive in SI", "[case]") {
  const Table& body = body_table();
  const auto b = read_into<BodySpec>(body, R"(name = "b"
mass_t = 2.5
cog_m = [1.0, 2.0, 3.0]
inertia_t_m2 = [10.0, 20.0, 30.0, 1.0, 2.0, 3.0]
position_m = [4.0, 5.0, 6.0]
attitude_deg = [10.0, -20.0, 30.0]
velocity_m_per_s = [0.1, 0.2, 0.3]
angular_velocity_deg_per_s = [1.0, -2.0, 3.0])");
  CHECK(b.mass == Approx(2500.0));
  CHECK(b.cog == Vector3(1.0, 2.0, 3.0));
  CHECK(b.inertia.isApprox((Matrix3() << 10e3, 1e3, 2e3, 1e3, 20e3, 3e3, 2e3, 3e3, 30e3).finished(), 1e-15));
  CHECK(b.position == Vector3(4.0, 5.0, 6.0));
  CHECK(b.attitude.roll == Approx(10.0 * kDegree));
  CHECK(b.attitude.pitch == Approx(-20.0 * kDegree));
  CHECK(b.attitude.yaw == Approx(30.0 * kDegree));
  CHECK(b.velocity == Vector3(0.1, 0.2, 0.3));
  CHECK(b.angular_velocity.isApprox(Vector3(1.0, -2.0, 3.0) * kDegree, 1e-15));

  const auto hull = read_into<HullSpec>(inside(body, "hull"), R"(shape = "mesh"
mesh_file = "sphere.obj"
mesh_scale = 0.0254
mesh_origin_m = [1.0, -2.0, 3.0]
mesh_attitude_deg = [180.0, 0.0, 90.0])");
  CHECK(hull.mesh_scale == 0.0254);
  CHECK(hull.mesh_origin == Vector3(1.0, -2.0, 3.0));
  CHECK(hull.mesh_attitude.roll == Approx(180.0 * kDegree));
  CHECK(hull.mesh_attitude.yaw == Approx(90.0 * kDegree));

  const Table& hydro = inside(body, "hydrodynamics");
  const auto constant = read_into<HydrodynamicsSpec>(
      hydro, "kind = \"constant\"\nadded_mass_matrix_t_m = " + kCounted + "\ndamping_matrix_kN_s_m = " + kCounted);
  CHECK(constant.added_mass.isApprox(counted(1e3), 1e-15));
  CHECK(constant.damping.isApprox(counted(1e3), 1e-15));
  const auto halves = read_into<HydrodynamicsSpec>(hydro, R"(kind = "constant"
added_mass_t = [1.0, 2.0, 3.0]
added_inertia_t_m2 = [4.0, 5.0, 6.0]
damping_kN_s_per_m = [7.0, 8.0, 9.0]
angular_damping_kN_m_s_per_rad = [10.0, 11.0, 12.0]
linear_damping_kN_s_per_m = [0.1, 0.2, 0.3]
linear_angular_damping_kN_m_s_per_rad = [0.4, 0.5, 0.6]
quadratic_damping_kN_s2_per_m2 = [1.1, 1.2, 1.3]
quadratic_angular_damping_kN_m_s2_per_rad2 = [1.4, 1.5, 1.6]
critical_fraction_heave = 0.1
critical_fraction_roll = 0.2
critical_fraction_pitch = 0.3)");
  CHECK(halves.added_mass.diagonal().isApprox(1e3 * (Vector6() << 1, 2, 3, 4, 5, 6).finished(), 1e-15));
  CHECK(halves.damping.diagonal().isApprox(1e3 * (Vector6() << 7, 8, 9, 10, 11, 12).finished(), 1e-15));
  CHECK(halves.linear_damping.isApprox(1e3 * (Vector6() << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6).finished(), 1e-15));
  CHECK(halves.quadratic_damping.isApprox(1e3 * (Vector6() << 1.1, 1.2, 1.3, 1.4, 1.5, 1.6).finished(), 1e-15));
  CHECK(halves.critical_fraction.isApprox((Vector6() << 0, 0, 0.1, 0.2, 0.3, 0).finished(), 1e-15));
  const auto database = read_into<HydrodynamicsSpec>(hydro, R"(kind = "database"
coefficient_file = "sphere.obj"
database_origin_m = [1.0, 2.0, -3.0]
database_length_m = 0.3048
port_starboard = true)");
  CHECK(database.database_origin == Vector3(1.0, 2.0, -3.0));
  CHECK(database.database_length == 0.3048);
  CHECK(database.port_starboard);

  const auto panels = read_into<PanelMethodSpec>(panel_method_table(), R"(lowest_rad_per_s = 0.11
highest_rad_per_s = 3.1
direct_step_s = 0.21
direct_lowest_rad_per_s = 0.35
direct_highest_rad_per_s = 1.45
symmetry_tolerance = 0.011
negative_damping_tolerance = 0.012
kramers_kronig_tolerance = 0.013
coupled_kramers_kronig_tolerance = 0.0135
kernel_tail_tolerance = 0.014
haskind_tolerance = 0.015
coupled_haskind_tolerance = 0.016
long_wave_phase_tolerance = 0.017
long_wave_heave_tolerance = 0.018)");
  CHECK(panels.tolerances == SelfCheckTolerances{0.011, 0.012, 0.013, 0.0135, 0.014, 0.015, 0.016, 0.017, 0.018});
  CHECK(panels.frequencies == 0);
  CHECK(panels.lowest == 0.11);
  CHECK(panels.highest == 3.1);
  CHECK(panels.direct_step == 0.21);
  CHECK(panels.direct_lowest == 0.35);
  CHECK(panels.direct_highest == 1.45);
}

TEST_CASE("keys of joints and gear arrive in SI", "[case]") {
  const auto turning = read_into<JointSpec>(joint_table(), R"(name = "j"
type = "revolute"
angular_stiffness_kN_m_per_rad = 2.0
angular_damping_kN_m_s_per_rad = 3.0
rest_deg = 45.0)");
  CHECK(turning.stiffness == 2000.0);
  CHECK(turning.damping == 3000.0);
  CHECK(turning.rest == Approx(45.0 * kDegree));
  const auto sliding = read_into<JointSpec>(joint_table(), R"(name = "j"
type = "prismatic"
stiffness_kN_per_m = 4.0
damping_kN_s_per_m = 5.0
rest_m = 0.7)");
  CHECK(sliding.stiffness == 4000.0);
  CHECK(sliding.damping == 5000.0);
  CHECK(sliding.rest == 0.7);

  const auto ballast = read_into<DriveSpec>(drive_table(), R"(name = "d"
kind = "ballast"
speed_max_share_per_min = 0.6
acceleration_max_share_per_s2 = 0.02)");
  CHECK(ballast.speed_max == Approx(0.01));
  CHECK(ballast.acceleration_max == 0.02);

  const auto tagline = read_into<TaglineSpec>(element_table<TaglineSpec>(), R"(name = "t"
kp_kN_per_deg = 20.0
kd_kN_s_per_deg = 100.0
set_point_deg = -1.5
pretension_kN = 20.0
speed_max_m_per_min = 30.0
axial_stiffness_kN = 5.0)");
  CHECK(tagline.kp == Approx(20e3 / kDegree));
  CHECK(tagline.kd == Approx(100e3 / kDegree));
  CHECK(tagline.set_point == Approx(-1.5 * kDegree));
  CHECK(tagline.pretension == 20e3);
  CHECK(tagline.speed_max == Approx(0.5));
  CHECK(tagline.axial_stiffness == 5e3);

  const auto contact = read_into<ContactSpec>(element_table<ContactSpec>(), R"(name = "c"
points_m = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
damping_depth_m = 0.013)");
  REQUIRE(contact.points.size() == 2);
  CHECK(contact.points[1] == Vector3(4.0, 5.0, 6.0));
  CHECK(contact.damping_depth == 0.013);
}

TEST_CASE("keys of poses, goals and moves arrive in SI", "[case]") {
  const auto pose = read_into<PoseSpec>(pose_table(), R"(name = "p"
drives = [{ drive = "a", position_deg = 30.0 }, { drive = "b", position_m = -2.0 }, { drive = "c", position_share = 0.4 }]
holds = [{ joint = "j", angle_deg = -60.0, drive = "a" }, { joint = "k", slide_m = 0.3, drive = "b" }]
goals = [{ joint = "j", value_deg = 15.0, drive = "a" }, { wire = "w", value_kN = 7.0, drive = "b" },
         { body = "x", axis = "y", point_m = [1.0, 2.0, 3.0], value_m = 8.0, drive = "c" }])");
  REQUIRE(pose.drives.size() == 3);
  CHECK(pose.drives[0].position == Approx(30.0 * kDegree));
  CHECK(pose.drives[1].position == -2.0);
  CHECK(pose.drives[2].position == 0.4);
  REQUIRE(pose.holds.size() == 2);
  CHECK(pose.holds[0].coordinate == Approx(-60.0 * kDegree));
  CHECK(pose.holds[1].coordinate == 0.3);
  REQUIRE(pose.goals.size() == 3);
  CHECK(pose.goals[0].value == Approx(15.0 * kDegree));
  CHECK(pose.goals[1].value == 7000.0);
  CHECK(pose.goals[2].value == 8.0);
  CHECK(pose.goals[2].coordinate.axis == 1);
  CHECK(pose.goals[2].coordinate.point == Vector3(1.0, 2.0, 3.0));

  const auto operation = read_into<OperationSpec>(operation_table(), R"([[phases]]
name = "turn"
[[phases.moves]]
drive = "a"
speed_deg_per_s = 2.0
goal = { joint = "j", value_deg = 40.0 }
[[phases.moves]]
drive = "b"
speed_share_per_min = 3.0
travel_share = 0.5
profile = "knots"
knots = [0.5, 1.0]
[[phases.moves]]
drive = "c"
speed_m_per_min = 6.0
travel_deg = 5.0
shaper = "zv"
shaper_period_s = 12.0
shaper_damping = 0.05
delay_s = 3.0
background = true)");
  REQUIRE(operation.phases.size() == 1);
  const std::vector<MoveSpec>& moves = operation.phases[0].moves;
  REQUIRE(moves.size() == 3);
  CHECK(moves[0].speed == Approx(2.0 * kDegree));
  REQUIRE(moves[0].goal);
  CHECK(moves[0].goal->joint == "j");
  CHECK(moves[0].goal_value == Approx(40.0 * kDegree));
  CHECK(moves[1].speed == Approx(0.05));
  CHECK(moves[1].travel == 0.5);
  CHECK(moves[1].profile.knots == std::vector<double>{0.5, 1.0});
  CHECK(moves[2].speed == Approx(0.1));
  REQUIRE(moves[2].travel);
  CHECK(*moves[2].travel == Approx(5.0 * kDegree));
  CHECK(moves[2].profile.shaper_period == 12.0);
  CHECK(moves[2].profile.shaper_damping == 0.05);
  CHECK(moves[2].delay == 3.0);
  CHECK(moves[2].background);
}

TEST_CASE("keys of searches and fits arrive", "[case]") {
  const auto plan = read_into<PlanSpec>(plan_table(), R"(aggregate = "tail"
tail_share = 0.15
time_budget_s = 90.0)");
  CHECK(plan.aggregate == PlanSpec::Aggregate::tail);
  CHECK(plan.tail_share == 0.15);
  CHECK(plan.time_budget == 90.0);
  const auto fit = read_into<FitSpec>(fit_table(), R"([[records]]
name = "r"
kind = "decay"
time_column = "zeit"
time_unit = "ms"
time_shift_s = -4.0
start_s = 1.0
end_s = 9.0
settle_s = 2.5
model_scale = 36.0
interval_s = 0.25
[[records.columns]]
channel = "a.z"
unit = "mm"
trust_unit = true
reversed = true
offset = 0.5
noise = 0.2)");
  REQUIRE(fit.records.size() == 1);
  const FitRecordSpec& record = fit.records[0];
  CHECK(record.time_column == "zeit");
  CHECK(record.time_unit == 1e-3);
  CHECK(record.time_shift == -4.0);
  CHECK(record.start == 1.0);
  CHECK(record.end == 9.0);
  CHECK(record.settle == 2.5);
  CHECK(record.model_scale == 36.0);
  CHECK(record.interval == 0.25);
  REQUIRE(record.columns.size() == 1);
  CHECK(record.columns[0].trust_unit);
  CHECK(record.columns[0].reversed);
  CHECK(record.columns[0].offset == 0.5);
}
