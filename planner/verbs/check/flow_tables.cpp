#include "planner/verbs/check/flow_tables.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/text_number.h"
#include "sim/environment/gusts.h"
#include "sim/multibody/system.h"
#include "sim/spatial/constants.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

constexpr double kBeforeTheRun = -1.0;  // s, when there are no gusts

Vector3 place_of(const Model& model, const std::string& name, const Vector3& p_B) {
  const int i = model.body_index(name);
  if (i == kWorld) return p_B;
  const BodyKinematics& k = model.initial_state().body[static_cast<std::size_t>(i)];
  return k.p_WC + k.R_WB * (p_B - model.specification().bodies[static_cast<std::size_t>(i)].cog);
}

ReportTable wind_table_of(const Model& model) {
  const Specification& spec = model.specification();
  const WindSpec& wind = spec.wind;
  ReportTable table;
  table.title = "Wind";
  table.note =
      "At the start. Mean of an hour, largest means of 60 s and 3 s in it (ISO 19901-1), q: pressure 1/2 rho U^2. A "
      "usual limit of cranes is 250 N/m2 (20 m/s).";
  if (wind.seeded())
    table.note +=
        " Simulated gusts: standard deviation of those from 1/600 to 0.5 Hz, the band in which the spectra were "
        "measured; quasi-steady loads have no others.";
  table.header = {"place",       "height m",  "mean m/s", "60 s m/s", "3 s m/s", "simulated gusts m/s",
                  "q mean N/m2", "q 3 s N/m2"};
  const auto add = [&](const std::string& name, double z) {
    const double mean = wind_speed(wind, z, Instant()).value, gust = gust_speed(wind, z, 3.0);
    const bool gusts = wind.gusts != WindSpec::Gusts::none;
    table.rows.push_back({name, cell(z, 1), cell(mean, 2), cell(gust_speed(wind, z, 60.0), 2), cell(gust, 2),
                          gusts ? cell(gust_deviation(wind, z), 2) : "-", cell(0.5 * wind.density * mean * mean, 0),
                          cell(0.5 * wind.density * gust * gust, 0)});
  };
  add("reference", 10.0);
  if (!spec.operation.load.empty()) {
    const double z = place_of(model, spec.operation.load, spec.operation.load_reference).z();
    if (z > 0.0) add(spec.operation.load, z);
  }
  for (const WireSpec& wire : spec.wires)
    if (wire.role == WireSpec::Role::hoist) {
      const double z = place_of(model, wire.from, wire.point_from).z();
      if (z > 0.0) add(wire.name + " tip", z);
    }
  return table;
}

/// The names of everything that wind or current pushes.
std::vector<std::string> flow_elements(const Specification& spec) {
  std::vector<std::string> names;
  const auto add = [&](const auto& entries) {
    for (const auto& entry : entries) names.push_back(entry.name);
  };
  add(spec.wind_areas);
  add(spec.wind_hulls);
  add(spec.current_areas);
  add(spec.current_hulls);
  return names;
}

/// Mean forces at the start, 6 rows a body.
VectorX mean_forces(const Model& model) {
  const MultibodySystem& system = model.system();
  SystemState state = model.initial_state();
  state.t = kBeforeTheRun;
  for (BodyKinematics& k : state.body) k.v_WC = k.w_B = Vector3::Zero();
  SystemWorkspace work = system.make_workspace();
  system.start_elements(state, work);
  ForceSum sum(static_cast<int>(system.bodies.size()));
  for (const std::string& name : flow_elements(model.specification())) {
    const int e = model.element_index(name);
    system.elements[static_cast<std::size_t>(e)]->add_forces(state.instant(), 0.0, system.memory(e, state, work), sum);
  }
  return sum.value();
}

/// The lift at rest without wind and current; none where it has no equilibrium.
std::optional<Model> becalmed(const Model& model) {
  Specification spec = model.specification();
  if (!spec.solver.static_start) return std::nullopt;
  spec.wind_areas.clear();
  spec.wind_hulls.clear();
  spec.current_areas.clear();
  spec.current_hulls.clear();
  for (BodySpec& body : spec.bodies)
    if (!body.moved_by_sea()) body.hydrodynamics = {};  // statics ask for none
  try {
    return build_model(spec);
  } catch (const SpecificationError&) {
    return std::nullopt;
  }
}

RollPitchYaw attitude_of(const Model& model, std::size_t body) {
  return roll_pitch_yaw(model.initial_state().body[body].R_WB);
}

ReportTable body_table_of(const Model& model, const std::optional<Model>& calm) {
  const Specification& spec = model.specification();
  ReportTable table;
  table.title = "Wind and current on bodies";
  table.note =
      "Means at the start: force in the world, moment about the vertical through the centre of gravity; heel + port "
      "side up and trim + bow down against the lift without wind and current.";
  table.header = {"body", "force x kN", "force y kN", "yaw moment kN m", "heel deg", "trim deg"};
  const VectorX Q = mean_forces(model);
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    const Vector3 F = Q.segment<3>(6 * static_cast<Eigen::Index>(i)),
                  M = Q.segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
    if (F.isZero(0.0) && M.isZero(0.0)) continue;
    double heel = kNaN, trim = kNaN;
    if (calm && spec.bodies[i].floats()) {
      heel = attitude_of(model, i).roll - attitude_of(*calm, i).roll;
      trim = attitude_of(model, i).pitch - attitude_of(*calm, i).pitch;
    }
    table.rows.push_back({spec.bodies[i].name, cell(F.x() / 1e3, 1), cell(F.y() / 1e3, 1),
                          cell((model.initial_state().body[i].R_WB * M).z() / 1e3, 1), cell(heel / kDegree, 3),
                          cell(trim / kDegree, 3)});
  }
  return table;
}

Eigen::Vector2d offset_of(const Model& model, const WireSpec& wire) {
  return (place_of(model, wire.to, wire.point_to) - place_of(model, wire.from, wire.point_from)).head<2>();
}

ReportTable fall_table(const Model& model, const std::optional<Model>& calm) {
  ReportTable table;
  table.title = "Falls in wind and current";
  table.note =
      "Hoist wires at the start: angle from the vertical, how far the lower end lies from the upper one across, and "
      "how "
      "much of that wind and current do.";
  table.header = {"wire", "angle deg", "across m", "by wind and current m"};
  for (const WireSpec& wire : model.specification().wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    const Eigen::Vector2d across = offset_of(model, wire);
    const double down = place_of(model, wire.from, wire.point_from).z() - place_of(model, wire.to, wire.point_to).z();
    table.rows.push_back({wire.name, cell(std::atan2(across.norm(), down) / kDegree, 3), cell(across.norm(), 3),
                          calm ? cell((across - offset_of(*calm, wire)).norm(), 3) : "-"});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> flow_tables(const Model& model) {
  std::vector<ReportTable> tables;
  if (model.specification().wind.blows()) tables.push_back(wind_table_of(model));
  if (flow_elements(model.specification()).empty()) return tables;
  const std::optional<Model> calm = becalmed(model);
  tables.push_back(body_table_of(model, calm));
  if (ReportTable falls = fall_table(model, calm); !falls.rows.empty()) tables.push_back(std::move(falls));
  return tables;
}

}  // namespace stillhook
