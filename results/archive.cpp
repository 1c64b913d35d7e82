#include "results/archive.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "results/files.h"
#include "results/netcdf_file.h"
#include "results/summary.h"

namespace stillhook {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A dimension of size zero means "unlimited" to NetCDF, so what is empty is left out, and missing reads back as empty.

/// Names of variables that are not channels, and of dimensions; no channel's variable may take one.
const std::set<std::string> kReserved = {"time",        "channel", "operation_phase", "contact_event",
                                         "static_pose", "body",    "drive",           "static_value",
                                         "vector",      "row",     "column"};

/// A CF variable name for each channel: letters, digits and underscores, first a letter, no two alike.
std::vector<std::string> variable_names(const std::vector<Channel>& channels) {
  std::set<std::string> taken = kReserved;
  std::vector<std::string> names;
  for (const Channel& channel : channels) {
    std::string name;
    for (const char c : channel.name)
      name += std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128 ? c : '_';
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) name = "c_" + name;
    for (const char* prefix : {"phase_", "contact_event_", "extreme_", "static_", "channel_"})
      if (name.starts_with(prefix)) name = "c_" + name;
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    names.push_back(unique);
  }
  return names;
}

template <class Entries, class F>
auto collect(const Entries& entries, F f) {
  std::vector<decltype(f(*entries.begin()))> values;
  for (const auto& entry : entries) values.push_back(f(entry));
  return values;
}

// ---- writing ----------------------------------------------------------------------------------------------------

void write_title(NetcdfFile& file, const Trajectory& run, const ArchiveTitle& title) {
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", title.title);
  file.attribute(NC_GLOBAL, "source", title.source);
  file.attribute(NC_GLOBAL, "comment", "sea state " + title.sea + "; SI units and radians; z up, angles ZYX");
  file.attribute(NC_GLOBAL, "status", status_name(run.status));
  file.attribute(NC_GLOBAL, "message", run.message);
  file.attribute(NC_GLOBAL, "steps", static_cast<double>(run.steps));
  file.attribute(NC_GLOBAL, "residuals", static_cast<double>(run.residuals));
  file.attribute(NC_GLOBAL, "factorisations", static_cast<double>(run.factorisations));
  file.attribute(NC_GLOBAL, "wall_s", run.wall);
}

void write_channels(NetcdfFile& file, const Trajectory& run) {
  if (run.channels.empty()) return;
  const int channel = file.define_dimension("channel", run.channels.size());
  file.put(file.define("channel_name", NC_STRING, {channel}), collect(run.channels, [](auto& c) { return c.name; }));
  file.put(file.define("channel_unit", NC_STRING, {channel}), collect(run.channels, [](auto& c) { return c.unit; }));
  file.put(file.define("channel_description", NC_STRING, {channel}),
           collect(run.channels, [](auto& c) { return c.description; }));
  if (run.time.empty()) return;

  const int time = file.define_dimension("time", run.time.size());
  const int axis = file.define("time", NC_DOUBLE, {time});
  file.attribute(axis, "units", "s");
  file.attribute(axis, "long_name", "time since the start of the run");
  file.attribute(axis, "axis", "T");
  file.compress(axis);
  file.put(axis, run.time);
  const std::vector<std::string> names = variable_names(run.channels);
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    const int variable = file.define(names[c], NC_DOUBLE, {time});
    file.attribute(variable, "units", run.channels[c].unit);
    file.attribute(variable, "long_name",
                   run.channels[c].description.empty() ? run.channels[c].name : run.channels[c].description);
    file.attribute(variable, "channel", run.channels[c].name);
    file.compress(variable);
    std::vector<double> padded;
    if (c >= run.values.size() || run.values[c].size() != run.time.size()) padded.assign(run.time.size(), kNaN);
    file.put(variable, padded.empty() ? run.values[c] : padded);
  }
}

void write_phases(NetcdfFile& file, const Trajectory& run) {
  if (run.phases.empty()) return;
  const int phase = file.define_dimension("operation_phase", run.phases.size());
  const auto define = [&](const char* name, nc_type type, const char* long_name) {
    const int variable = file.define(name, type, {phase});
    file.attribute(variable, "long_name", long_name);
    if (type == NC_DOUBLE) file.attribute(variable, "units", "s");
    return variable;
  };
  file.put(define("phase_name", NC_STRING, "name of the phase"), collect(run.phases, [](auto& p) { return p.name; }));
  const int stage = define("phase_stage", NC_INT, "stage of the lift");
  const int flags[] = {0, 1, 2, 3, 4};
  file.check(nc_put_att_int(file.id(), stage, "flag_values", NC_INT, 5, flags), "attribute flag_values");
  file.attribute(stage, "flag_meanings", "on_barge transfer hanging set_down landed");
  file.put(stage, collect(run.phases, [](auto& p) { return static_cast<int>(p.stage); }));
  file.put(define("phase_start", NC_DOUBLE, "start of the phase"),
           collect(run.phases, [](auto& p) { return p.start; }));
  file.put(define("phase_end", NC_DOUBLE, "end of the phase"), collect(run.phases, [](auto& p) { return p.end; }));
  file.put(define("phase_event_timed_out", NC_INT, "1 if the event waited for never came"),
           collect(run.phases, [](auto& p) { return p.event_timed_out ? 1 : 0; }));

  if (run.channels.empty() || run.extremes.size() != run.phases.size()) return;
  int channel = -1;
  file.check(nc_inq_dimid(file.id(), "channel", &channel), "dimension channel");
  const auto write = [&](const char* name, double Extreme::*field) {
    std::vector<double> values;
    for (const std::vector<Extreme>& row : run.extremes)
      for (std::size_t c = 0; c < run.channels.size(); ++c) values.push_back(c < row.size() ? row[c].*field : kNaN);
    const int variable = file.define(name, NC_DOUBLE, {phase, channel});
    file.compress(variable);
    file.put(variable, values);
  };
  write("extreme_min", &Extreme::min);
  write("extreme_max", &Extreme::max);
  write("extreme_time_of_min", &Extreme::t_min);
  write("extreme_time_of_max", &Extreme::t_max);
}

void write_contacts(NetcdfFile& file, const Trajectory& run) {
  if (run.contacts.empty()) return;
  const int event = file.define_dimension("contact_event", run.contacts.size());
  const int vector = file.define_dimension("vector", 3);
  const auto write = [&](const char* name, const char* unit, double ContactEvent::*field) {
    const int variable = file.define(name, NC_DOUBLE, {event});
    file.attribute(variable, "units", unit);
    file.put(variable, collect(run.contacts, [&](auto& c) { return c.*field; }));
  };
  file.put(file.define("contact_event_name", NC_STRING, {event}),
           collect(run.contacts, [](auto& c) { return c.contact; }));
  file.put(file.define("contact_event_phase", NC_STRING, {event}),
           collect(run.contacts, [](auto& c) { return c.phase; }));
  const int role = file.define("contact_event_role", NC_INT, {event});
  const int flags[] = {0, 1, 2};
  file.check(nc_put_att_int(file.id(), role, "flag_values", NC_INT, 3, flags), "attribute flag_values");
  file.attribute(role, "flag_meanings", "other pickup target");
  file.put(role, collect(run.contacts, [](auto& c) { return static_cast<int>(c.role); }));
  write("contact_event_start", "s", &ContactEvent::start);
  write("contact_event_end", "s", &ContactEvent::end);
  write("contact_event_approach_speed", "m/s", &ContactEvent::approach_speed);
  write("contact_event_peak_force", "N", &ContactEvent::peak_force);
  write("contact_event_impulse", "N s", &ContactEvent::impulse);
  const int place = file.define("contact_event_place", NC_DOUBLE, {event, vector});
  file.attribute(place, "units", "m");
  std::vector<double> places;
  for (const ContactEvent& c : run.contacts) places.insert(places.end(), {c.place.x(), c.place.y(), c.place.z()});
  file.put(place, places);
}

void write_pose_bodies(NetcdfFile& file, const Trajectory& run, int pose, std::size_t bodies) {
  const int body = file.define_dimension("body", bodies);
  const int row = file.define_dimension("row", 3), column = file.define_dimension("column", 3);
  std::vector<double> positions, rotations;
  for (const StaticPose& p : run.static_poses)
    for (std::size_t b = 0; b < bodies; ++b) {
      const Pose X = b < p.bodies.size() ? p.bodies[b] : Pose{Matrix3::Constant(kNaN), Vector3::Constant(kNaN)};
      positions.insert(positions.end(), {X.p.x(), X.p.y(), X.p.z()});
      for (int i = 0; i < 3; ++i) rotations.insert(rotations.end(), {X.R(i, 0), X.R(i, 1), X.R(i, 2)});
    }
  file.put(file.define("static_pose_position", NC_DOUBLE, {pose, body, row}), positions);
  file.put(file.define("static_pose_rotation", NC_DOUBLE, {pose, body, row, column}), rotations);
}

void write_static_poses(NetcdfFile& file, const Trajectory& run) {
  if (run.static_poses.empty()) return;
  const int pose = file.define_dimension("static_pose", run.static_poses.size());
  file.put(file.define("static_pose_name", NC_STRING, {pose}),
           collect(run.static_poses, [](auto& p) { return p.name; }));
  std::size_t bodies = 0, drives = 0;
  std::set<std::string> keys;
  for (const StaticPose& p : run.static_poses) {
    bodies = std::max(bodies, p.bodies.size());
    drives = std::max(drives, p.drives.size());
    for (const auto& [key, value] : p.values) keys.insert(key);
  }
  const auto counts = [&](const char* name, auto size) {
    file.put(file.define(name, NC_INT, {pose}),
             collect(run.static_poses, [&](auto& p) { return static_cast<int>(size(p)); }));
  };
  counts("static_pose_bodies", [](auto& p) { return p.bodies.size(); });
  counts("static_pose_drives", [](auto& p) { return p.drives.size(); });
  if (bodies > 0) write_pose_bodies(file, run, pose, bodies);
  if (drives > 0) {
    const int drive = file.define_dimension("drive", drives);
    std::vector<double> positions;
    for (const StaticPose& p : run.static_poses)
      for (std::size_t d = 0; d < drives; ++d) positions.push_back(d < p.drives.size() ? p.drives[d] : kNaN);
    file.put(file.define("static_pose_drive", NC_DOUBLE, {pose, drive}), positions);
  }
  if (keys.empty()) return;
  const int value = file.define_dimension("static_value", keys.size());
  std::vector<double> values;
  std::vector<int> present;
  for (const StaticPose& p : run.static_poses)
    for (const std::string& key : keys) {
      const auto found = p.values.find(key);
      present.push_back(found != p.values.end());
      values.push_back(found != p.values.end() ? found->second : kNaN);
    }
  file.put(file.define("static_value_name", NC_STRING, {value}), std::vector<std::string>(keys.begin(), keys.end()));
  const int table = file.define("static_pose_value", NC_DOUBLE, {pose, value});
  file.compress(table);
  file.put(table, values);
  file.put(file.define("static_pose_value_present", NC_INT, {pose, value}), present);
}

}  // namespace

void write_archive(const Trajectory& trajectory, const ArchiveTitle& title, const std::string& path) {
  PendingFile pending(path);
  NetcdfFile file(pending.temporary(), NetcdfFile::Mode::create, path);
  write_title(file, trajectory, title);
  write_channels(file, trajectory);
  write_phases(file, trajectory);
  write_contacts(file, trajectory);
  write_static_poses(file, trajectory);
  file.close();
  pending.commit();
}

}  // namespace stillhook
