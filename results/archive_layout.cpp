#include "results/archive_layout.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "sim/spatial/constants.h"

namespace stillhook::archive {
namespace {

/// Names of variables that are not channels, and of dimensions; no channel's variable may take one.
const std::set<std::string> kReserved = {"time",        "channel", "operation_phase", "contact_event",
                                         "static_pose", "body",    "drive",           "static_value",
                                         "vector",      "row",     "column"};

void write_pose_bodies(NetcdfFile& file, const std::vector<StaticPose>& poses, int pose, std::size_t bodies) {
  const int body = file.define_dimension("body", bodies);
  const int row = file.define_dimension("row", 3), column = file.define_dimension("column", 3);
  std::vector<double> positions, rotations;
  for (const StaticPose& p : poses)
    for (std::size_t b = 0; b < bodies; ++b) {
      const Pose X = b < p.bodies.size() ? p.bodies[b] : Pose{Matrix3::Constant(kNaN), Vector3::Constant(kNaN)};
      positions.insert(positions.end(), {X.p.x(), X.p.y(), X.p.z()});
      for (int i = 0; i < 3; ++i) rotations.insert(rotations.end(), {X.R(i, 0), X.R(i, 1), X.R(i, 2)});
    }
  file.put(file.define("static_pose_position", NC_DOUBLE, {pose, body, row}, "origin of a body in the world", "m"),
           positions);
  file.put(file.define("static_pose_rotation", NC_DOUBLE, {pose, body, row, column},
                       "rotation matrix from body to world axes", "1"),
           rotations);
}

}  // namespace

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

void write_title(NetcdfFile& file, const ArchiveTitle& title, const std::string& status, const std::string& message) {
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", title.title);
  file.attribute(NC_GLOBAL, "source", title.source);
  file.attribute(NC_GLOBAL, "history", title.history);
  file.attribute(NC_GLOBAL, "comment", "sea state " + title.sea + "; SI units and radians; z up, angles ZYX");
  file.attribute(NC_GLOBAL, "status", status);
  file.attribute(NC_GLOBAL, "message", message);
}

void write_channel_table(NetcdfFile& file, const std::vector<Channel>& channels) {
  const int channel = file.define_dimension("channel", channels.size());
  const auto write = [&](const char* name, const char* long_name, std::string Channel::*field) {
    file.put_texts(name, channel, long_name, collect(channels, [&](const Channel& c) { return c.*field; }));
  };
  write("channel_name", "name of the channel", &Channel::name);
  write("channel_unit", "unit of the channel", &Channel::unit);
  write("channel_description", "what the channel is", &Channel::description);
}

SampleVariables define_samples(NetcdfFile& file, const std::vector<Channel>& channels, std::size_t samples,
                               NetcdfFile::Storage storage) {
  SampleVariables variables;
  const int time = file.define_dimension("time", samples);
  // Simulated time has no date: an elapsed time, not a calendar's.
  variables.time = file.define("time", NC_DOUBLE, {time}, "time since the start of the run", "s", storage);
  const std::vector<std::string> names = variable_names(channels);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Channel& channel = channels[c];
    const std::string& long_name = channel.description.empty() ? channel.name : channel.description;
    variables.channels.push_back(file.define(names[c], NC_DOUBLE, {time}, long_name, channel.unit, storage));
    file.attribute(variables.channels.back(), "channel", channel.name);
  }
  return variables;
}

PhaseVariables define_phases(NetcdfFile& file, const std::vector<PhaseRecord>& phases, bool with_extremes,
                             NetcdfFile::Storage storage) {
  PhaseVariables variables;
  const int phase = file.define_dimension("operation_phase", phases.size());
  const auto define = [&](const char* name, nc_type type, const char* long_name, const char* units) {
    const bool plain = storage != NetcdfFile::Storage::whole;
    return file.define(name, type, {phase}, long_name, units, plain ? NetcdfFile::Storage::plain : storage);
  };
  variables.start = define("phase_start", NC_DOUBLE, "start of the phase", "s");
  variables.end = define("phase_end", NC_DOUBLE, "end of the phase", "s");
  variables.timed_out = define("phase_event_timed_out", NC_INT, "1 if the event waited for never came", "1");
  if (with_extremes)
    for (const ExtremeField& field : kExtremes)
      variables.extremes.push_back(
          file.define(field.name, NC_DOUBLE, {phase, file.dimension("channel")}, field.long_name, "", storage));
  const int stage = file.define("phase_stage", NC_INT, {phase}, "stage of the lift");
  file.attribute(stage, "flag_values", std::vector<int>{0, 1, 2, 3, 4});
  file.attribute(stage, "flag_meanings", "on_barge transfer hanging set_down landed");
  file.put(stage, collect(phases, [](auto& p) { return static_cast<int>(p.stage); }));
  file.put_texts("phase_name", phase, "name of the phase", collect(phases, [](auto& p) { return p.name; }));
  return variables;
}

std::vector<double> extreme_row(const std::vector<Extreme>& extremes, double Extreme::*field, std::size_t channels) {
  std::vector<double> row(channels, kNaN);
  for (std::size_t c = 0; c < std::min(channels, extremes.size()); ++c) row[c] = extremes[c].*field;
  return row;
}

void describe_roles(NetcdfFile& file, int variable) {
  file.attribute(variable, "flag_values", std::vector<int>{0, 1, 2});
  file.attribute(variable, "flag_meanings", "other pickup target");
}

void write_static_poses(NetcdfFile& file, const std::vector<StaticPose>& poses) {
  if (poses.empty()) return;
  const int pose = file.define_dimension("static_pose", poses.size());
  file.put_texts("static_pose_name", pose, "static equilibrium: of the start, then of the end of each phase",
                 collect(poses, [](auto& p) { return p.name; }));
  std::size_t bodies = 0, drives = 0;
  std::set<std::string> keys;
  for (const StaticPose& p : poses) {
    bodies = std::max(bodies, p.bodies.size());
    drives = std::max(drives, p.drives.size());
    for (const auto& [key, value] : p.values) keys.insert(key);
  }
  const auto counts = [&](const char* name, const char* long_name, auto size) {
    file.put(file.define(name, NC_INT, {pose}, long_name, "1"),
             collect(poses, [&](auto& p) { return static_cast<int>(size(p)); }));
  };
  counts("static_pose_bodies", "number of bodies", [](auto& p) { return p.bodies.size(); });
  counts("static_pose_drives", "number of drives", [](auto& p) { return p.drives.size(); });
  if (bodies > 0) write_pose_bodies(file, poses, pose, bodies);
  if (drives > 0) {
    const int drive = file.define_dimension("drive", drives);
    std::vector<double> positions;
    for (const StaticPose& p : poses)
      for (std::size_t d = 0; d < drives; ++d) positions.push_back(d < p.drives.size() ? p.drives[d] : kNaN);
    file.put(file.define("static_pose_drive", NC_DOUBLE, {pose, drive}, "position of a drive, m or rad or share"),
             positions);
  }
  if (keys.empty()) return;
  const int value = file.define_dimension("static_value", keys.size());
  std::vector<double> values;
  std::vector<int> present;
  for (const StaticPose& p : poses)
    for (const std::string& key : keys) {
      const auto found = p.values.find(key);
      present.push_back(found != p.values.end());
      values.push_back(found != p.values.end() ? found->second : kNaN);
    }
  file.put_texts("static_value_name", value, "channel that has a value at rest", {keys.begin(), keys.end()});
  const int table = file.define("static_pose_value", NC_DOUBLE, {pose, value},
                                "value of a channel at rest, in its unit", "", NetcdfFile::Storage::compressed);
  file.put(table, values);
  file.put(file.define("static_pose_value_present", NC_INT, {pose, value}, "1 if the pose has that value", "1"),
           present);
}

}  // namespace stillhook::archive
