// The step-by-step procedure in an operator's units, the static poses, and what was assumed.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "results/flow_words.h"
#include "results/html.h"
#include "results/pose_drawing.h"
#include "results/report_parts.h"
#include "results/sea_words.h"
#include "sim/crane_parts.h"
#include "sim/drive_unit.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

double value_of(const StaticPose& pose, const std::string& key) {
  const auto found = pose.values.find(key);
  return found == pose.values.end() ? kNaN : found->second;
}

std::string travel_text(const Specification& s, const DriveSpec& drive, double travel) {
  if (std::isnan(travel)) return "travel by the goal";
  switch (drive.kind) {
    case DriveSpec::Kind::winch:
      return (travel >= 0 ? "haul in " : "pay out ") + fixed_number(std::abs(travel), 2) + " m";
    case DriveSpec::Kind::ballast:
      return fmt::format("shift {} % of the ballast", fixed_number(100.0 * travel, 0));
    case DriveSpec::Kind::tow:
      return "tow " + fixed_number(travel, 1) + " m";
    case DriveSpec::Kind::joint:
      break;
  }
  return drive_motion(s, drive) == DriveMotion::angle ? "turn " + fixed_number(degrees(travel), 2) + "°"
                                                      : "move " + fixed_number(travel, 2) + " m";
}

std::string speed_text(const Specification& s, const DriveSpec& drive, double speed) {
  const double per_minute = 60.0 * std::abs(speed);
  if (drive.kind == DriveSpec::Kind::ballast) return fixed_number(100.0 * per_minute, 1) + " %/min";
  if (drive_motion(s, drive) == DriveMotion::angle) return fixed_number(degrees(per_minute), 2) + " °/min";
  return fixed_number(per_minute, 2) + " m/min";
}

std::string moves_text(const ReportData& data, const RunView& view, std::size_t p, const PhaseSpec& phase) {
  if (phase.moves.empty()) return "nothing moves";
  std::string text;
  const std::vector<StaticPose>& poses = data.trajectory.static_poses;
  for (const MoveSpec& move : phase.moves) {
    const auto drive = std::find_if(data.specification.drives.begin(), data.specification.drives.end(),
                                    [&](const DriveSpec& d) { return d.name == move.drive; });
    if (drive == data.specification.drives.end()) continue;
    const std::size_t d = static_cast<std::size_t>(drive - data.specification.drives.begin());
    double travel = move.travel.value_or(kNaN);
    if (std::isnan(travel) && p + 1 < poses.size() && d < poses[p].drives.size() && d < poses[p + 1].drives.size())
      travel = poses[p + 1].drives[d] - poses[p].drives[d];
    const double peak = view.largest_magnitude(drive_channels::rate.of(*drive), {p}).value;
    text += fmt::format("{}<b>{}</b>: {} at {}", text.empty() ? "" : "<br>", escape_html(readable_name(move.drive)),
                        travel_text(data.specification, *drive, travel),
                        speed_text(data.specification, *drive, std::isnan(peak) ? move.speed : peak));
    if (move.delay > 0.0) text += ", " + fixed_number(move.delay, 0) + " s after the start";
    if (move.background) text += ", may run on into the next step";
  }
  return text;
}

std::string hold_point(const PhaseSpec& phase, const PhaseRecord& record) {
  if (phase.wait_for.type == EventSpec::Type::none) return "–";
  std::string text = fmt::format("wait until {} is clear for {} s", escape_html(readable_name(phase.wait_for.contact)),
                                 fixed_number(phase.wait_for.hold, 0));
  if (record.event_timed_out)
    text += fmt::format(" <span class=\"warn\">went on after {} s without it</span>",
                        fixed_number(phase.wait_for.timeout, 0));
  return text;
}

double hook_load(const ReportData& data, const StaticPose& pose) {
  double sum = 0.0;
  for (const WireSpec& wire : data.specification.wires)
    if (wire.role == WireSpec::Role::hoist) sum += value_of(pose, wire_channels::tension.of(wire));
  return sum;
}

using Rows = std::vector<std::vector<std::string>>;

template <class F>
void add_row(Rows& rows, const std::string& label, const std::vector<StaticPose>& poses, int decimals, F value) {
  std::vector<std::string> row = {label};
  bool any = false;
  for (const StaticPose& pose : poses) {
    const double v = value(pose);
    any = any || std::isfinite(v);
    row.push_back(fixed_number(v, decimals));
  }
  if (any) rows.push_back(row);
}

void add_body_rows(Rows& rows, const ReportData& data, const std::vector<StaticPose>& poses) {
  const Specification& s = data.specification;
  std::vector<std::string> names = crane_vessels(s);
  if (!s.operation.load.empty()) names.insert(names.begin(), s.operation.load);
  for (const std::string& name : names) {
    rows.push_back({escape_html(readable_name(name))});
    for (const auto& axis : body_channels::position)
      add_row(rows, fmt::format("{}, m", axis.quantity), poses, 2, [&](auto& p) { return value_of(p, axis.of(name)); });
    const bool crane = name != s.operation.load;
    for (const auto& [quantity, label] : {std::pair{body_channels::roll, crane ? "heel" : "roll"},
                                          {body_channels::pitch, crane ? "trim" : "pitch"},
                                          {body_channels::yaw, "yaw"}})
      add_row(rows, fmt::format("{}, °", label), poses, 3,
              [&](auto& p) { return degrees(value_of(p, quantity.of(name))); });
  }
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const HullSpec& hull = s.bodies[b].hull;
    if (hull.shape != HullSpec::Shape::box) continue;
    const Vector3 keel = hull.centre - Vector3(0.0, 0.0, 0.5 * hull.size.z());
    add_row(rows, escape_html(readable_name(s.bodies[b].name)) + ": draft amidships, m", poses, 3,
            [&](auto& p) { return b < p.bodies.size() ? std::max(0.0, -(p.bodies[b] * keel).z()) : kNaN; });
  }
}

std::string poses_table(const ReportData& data, const std::vector<StaticPose>& poses) {
  const Specification& s = data.specification;
  Rows rows;
  rows.push_back({"drives, from the start"});
  for (std::size_t d = 0; d < s.drives.size(); ++d) {
    const DriveSpec& drive = s.drives[d];
    const bool angle = drive_motion(s, drive) == DriveMotion::angle;
    const bool share = drive_motion(s, drive) == DriveMotion::share;
    add_row(rows,
            escape_html(readable_name(drive.name)) + (angle   ? ", °"
                                                      : share ? ", %"
                                                              : ", m"),
            poses, 2, [&](auto& p) {
              const double position = d < p.drives.size() ? p.drives[d] : kNaN;
              return angle ? degrees(position) : share ? 100.0 * position : position;
            });
  }
  add_body_rows(rows, data, poses);
  rows.push_back({"joints, from the start"});
  for (const JointSpec& joint : s.joints) {
    add_row(rows, escape_html(readable_name(joint.name)) + ", °", poses, 2,
            [&](auto& p) { return degrees(value_of(p, joint_channels::angle.of(joint))); });
    add_row(rows, escape_html(readable_name(joint.name)) + ", m", poses, 3,
            [&](auto& p) { return value_of(p, joint_channels::slide.of(joint)); });
  }
  rows.push_back({"wire tensions, t"});
  for (const WireSpec& wire : s.wires)
    add_row(rows, escape_html(readable_name(wire.name)), poses, 1,
            [&](auto& p) { return value_of(p, wire_channels::tension.of(wire)) / 1000.0 / kStandardGravity; });
  rows.push_back({"stretched wire lengths, m"});
  for (const WireSpec& wire : s.wires)
    add_row(rows, escape_html(readable_name(wire.name)), poses, 2,
            [&](auto& p) { return value_of(p, wire_channels::length.of(wire)); });
  rows.push_back({"contact forces, t"});
  for (const ContactSpec& contact : s.contacts)
    add_row(rows, escape_html(readable_name(contact.name)), poses, 1,
            [&](auto& p) { return value_of(p, contact_channels::force.of(contact)) / 1000.0 / kStandardGravity; });

  Rows filled;  // headings with nothing under them go
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].size() > 1 || (i + 1 < rows.size() && rows[i + 1].size() > 1)) filled.push_back(rows[i]);
  std::vector<std::string> header = {"calm water"};
  for (std::size_t i = 0; i < poses.size(); ++i) header.push_back(escape_html(readable_name(poses[i].name)));
  return html_table(header, filled);
}

std::string gear_sentences(const Specification& s) {
  std::string out;
  for (const BodySpec& body : s.bodies) {
    if (body.moved_by_sea())
      out += fmt::format("<li>{}: displacement RAOs from {}; it moves as in the sea alone, without the lift.</li>",
                         escape_html(readable_name(body.name)),
                         escape_html(std::filesystem::path(body.hydrodynamics.rao.file).filename().string()));
    if (!body.floats()) continue;
    const HydrodynamicsSpec& h = body.hydrodynamics;
    const char* radiation = h.kind == HydrodynamicsSpec::Kind::constant ? "constant added mass and damping"
                            : h.kind == HydrodynamicsSpec::Kind::table ? "retardation functions from a coefficient file"
                            : h.kind == HydrodynamicsSpec::Kind::database ? "coefficients from a database"
                            : h.kind == HydrodynamicsSpec::Kind::panels   ? "coefficients from the panel method"
                                                                          : "no radiation forces";
    out += fmt::format("<li>{}: {}, {} Froude–Krylov model; extra roll damping {} % of critical.</li>",
                       escape_html(readable_name(body.name)), radiation,
                       body.hull.froude_krylov == HullSpec::FroudeKrylov::pressure ? "pressure" : "volume",
                       fixed_number(100.0 * h.critical_fraction[3], 1));
  }
  for (const TaglineSpec& line : s.taglines)
    out += fmt::format("<li>Tagline {}: {}, Kp {} kN/°, Kd {} kN s/°{}, tension to {} t, line speed {}.</li>",
                       escape_html(readable_name(line.name)), line.active ? "active" : "not used",
                       fixed_number(line.kp * std::numbers::pi / 180.0 / 1000.0, 1),
                       fixed_number(line.kd * std::numbers::pi / 180.0 / 1000.0, 1),
                       line.gain_schedule.empty() ? "" : " times factors over the fall length",
                       fixed_number(line.tension_max / 1000.0 / kStandardGravity, 1),
                       line.speed_max > 0.0 ? "to " + fixed_number(60.0 * line.speed_max, 1) + " m/min" : "unlimited");
  return out;
}

}  // namespace

std::string procedure_part(const ReportData& data, const RunView& view) {
  const std::vector<PhaseRecord>& records = data.trajectory.phases;
  Rows rows;
  for (std::size_t p = 0; p < records.size(); ++p) {
    const auto phase =
        std::find_if(data.specification.operation.phases.begin(), data.specification.operation.phases.end(),
                     [&](const PhaseSpec& s) { return s.name == records[p].name; });
    if (phase == data.specification.operation.phases.end()) continue;
    const double load =
        p + 1 < data.trajectory.static_poses.size() ? hook_load(data, data.trajectory.static_poses[p + 1]) : kNaN;
    rows.push_back({std::to_string(p + 1) + " " + escape_html(readable_name(records[p].name)),
                    clock_time(records[p].start), clock_time(records[p].end - records[p].start),
                    moves_text(data, view, p, *phase), hold_point(*phase, records[p]),
                    fixed_number(load / 1000.0 / kStandardGravity, 0)});
  }
  return html_table({"step", "start", "duration", "what moves, how far, at what speed at most", "hold point before it",
                     "static hook load at its end, t"},
                    rows, -1);
}

std::string poses_part(const ReportData& data, const Scene& scene) {
  std::string out;
  const std::vector<std::string> drawings =
      draw_poses(scene, data.trajectory.static_poses, data.specification.operation.target);
  for (const std::string& drawing : drawings) out += "<figure>" + drawing + "</figure>";
  if (!out.empty())
    out = "<div class=\"poses\">" + out +
          "</div><p><small>Calm water, to scale. Above: elevation from starboard, below: "
          "plan; x to the right. Cross: target. Booms as thick as their section allows.</small></p>";
  if (!data.trajectory.static_poses.empty())
    out += "<h3>At the start and at the end of each phase</h3>" + poses_table(data, data.trajectory.static_poses);
  if (!data.poses.empty()) out += "<h3>Poses asked for by the case</h3>" + poses_table(data, data.poses);
  return out;
}

std::string assumptions_part(const ReportData& data) {
  const Specification& s = data.specification;
  const bool waves = std::any_of(s.sea.states.begin(), s.sea.states.end(), [&](const SeaStateSpec& state) {
    return state.name == s.sea.active && state.type != SeaStateSpec::Type::calm;
  });
  std::string out = "<ul><li>" + escape_html(sea_sentence(s.sea, data.north));
  if (waves) out += "; the waves grow over the first " + fixed_number(s.sea.ramp, 0) + " s";
  out += ".</li>";
  if (const std::string wind = wind_sentence(s, data.north); !wind.empty())
    out += "<li>" + escape_html(wind) + "; static poses are those in the mean wind.</li>";
  if (const std::string current = current_sentence(s.sea, data.north); !current.empty())
    out += "<li>" + escape_html(current) + "; static poses are those in it.</li>";
  out += gear_sentences(s);
  out += fmt::format(
      "<li>Implicit HHT integration, α = {}, time step {} s; samples every {} s. Extremes of a single quantity are "
      "taken from every step; rms values, means, total hook load, sway and clearances from the samples.</li>",
      fixed_number(s.solver.hht_alpha, 2), readable_number(s.solver.time_step),
      readable_number(s.solver.output_interval));
  out +=
      "<li>DAF is the largest tension over the static tension at that moment of the operation, over the hanging "
      "phases.</li>";
  for (const std::string& note : data.notes) out += "<li>" + escape_html(note) + "</li>";
  return out + "</ul><p>Standards are quoted for comparison; no compliance with them is claimed.</p>";
}

}  // namespace stillhook
