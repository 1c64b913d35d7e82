#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "results/archive.h"
#include "results/netcdf_file.h"
#include "results/summary.h"

namespace stillhook {
namespace {

RunStatus status_from(const std::string& name, const std::string& path) {
  for (RunStatus s : {RunStatus::not_run, RunStatus::completed, RunStatus::interrupted, RunStatus::diverged})
    if (status_name(s) == name) return s;
  throw std::runtime_error(path + ": unknown status \"" + name + "\"");
}

void read_channels(const NetcdfFile& file, Trajectory& run) {
  const std::size_t count = file.size("channel"), samples = file.size("time");
  if (count == 0) return;
  const auto names = file.strings("channel_name", count), units = file.strings("channel_unit", count),
             descriptions = file.strings("channel_description", count);
  for (std::size_t c = 0; c < count; ++c) run.channels.push_back({names[c], units[c], descriptions[c]});
  if (samples == 0) return;
  run.time = file.doubles("time", samples);

  // Channels find their variable by the attribute, whatever the variable had to be called.
  std::map<std::string, std::string> variable_of;
  int variables = 0;
  file.check(nc_inq_nvars(file.id(), &variables), "cannot be read");
  for (int v = 0; v < variables; ++v) {
    char name[NC_MAX_NAME + 1] = {};
    file.check(nc_inq_varname(file.id(), v, name), "cannot be read");
    if (nc_inq_attid(file.id(), v, "channel", nullptr) == NC_NOERR) variable_of[file.text(v, "channel")] = name;
  }
  for (const std::string& name : names) run.values.push_back(file.doubles(variable_of[name], samples));
}

void read_phases(const NetcdfFile& file, Trajectory& run) {
  const std::size_t count = file.size("operation_phase"), channels = run.channels.size();
  if (count == 0) return;
  const auto names = file.strings("phase_name", count);
  const auto stages = file.integers("phase_stage", count), timeouts = file.integers("phase_event_timed_out", count);
  const auto starts = file.doubles("phase_start", count), ends = file.doubles("phase_end", count);
  for (std::size_t p = 0; p < count; ++p)
    run.phases.push_back(
        {names[p], static_cast<PhaseSpec::Stage>(std::clamp(stages[p], 0, 4)), starts[p], ends[p], timeouts[p] != 0});
  int variable = -1;
  if (channels == 0 || nc_inq_varid(file.id(), "extreme_min", &variable) != NC_NOERR) return;
  const auto min = file.doubles("extreme_min", count * channels), max = file.doubles("extreme_max", count * channels),
             t_min = file.doubles("extreme_time_of_min", count * channels),
             t_max = file.doubles("extreme_time_of_max", count * channels);
  for (std::size_t p = 0, i = 0; p < count; ++p) {
    run.extremes.emplace_back();
    for (std::size_t c = 0; c < channels; ++c, ++i) run.extremes.back().push_back({min[i], max[i], t_min[i], t_max[i]});
  }
}

void read_contacts(const NetcdfFile& file, Trajectory& run) {
  const std::size_t count = file.size("contact_event");
  if (count == 0) return;
  const auto names = file.strings("contact_event_name", count), phases = file.strings("contact_event_phase", count);
  const auto roles = file.integers("contact_event_role", count);
  const auto starts = file.doubles("contact_event_start", count), ends = file.doubles("contact_event_end", count),
             speeds = file.doubles("contact_event_approach_speed", count),
             forces = file.doubles("contact_event_peak_force", count),
             impulses = file.doubles("contact_event_impulse", count),
             places = file.doubles("contact_event_place", 3 * count);
  for (std::size_t i = 0; i < count; ++i)
    run.contacts.push_back({names[i], static_cast<ContactSpec::Role>(std::clamp(roles[i], 0, 2)), starts[i], ends[i],
                            Vector3(places[3 * i], places[3 * i + 1], places[3 * i + 2]), speeds[i], forces[i],
                            impulses[i], phases[i]});
}

void read_pose_bodies(const NetcdfFile& file, Trajectory& run, const std::vector<int>& body_counts) {
  const std::size_t count = run.static_poses.size(), bodies = file.size("body");
  if (bodies == 0) return;
  const auto position = file.doubles("static_pose_position", count * bodies * 3),
             rotation = file.doubles("static_pose_rotation", count * bodies * 9);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t b = 0; b < std::min(bodies, static_cast<std::size_t>(std::max(0, body_counts[p]))); ++b) {
      Pose X;
      for (int i = 0; i < 3; ++i) {
        X.p[i] = position[(p * bodies + b) * 3 + static_cast<std::size_t>(i)];
        for (int j = 0; j < 3; ++j) X.R(i, j) = rotation[(p * bodies + b) * 9 + static_cast<std::size_t>(3 * i + j)];
      }
      run.static_poses[p].bodies.push_back(X);
    }
}

void read_static_poses(const NetcdfFile& file, Trajectory& run) {
  const std::size_t count = file.size("static_pose"), drives = file.size("drive"), keys = file.size("static_value");
  if (count == 0) return;
  for (const std::string& name : file.strings("static_pose_name", count)) run.static_poses.emplace_back().name = name;
  read_pose_bodies(file, run, file.integers("static_pose_bodies", count));
  const auto drive_counts = file.integers("static_pose_drives", count);
  if (drives > 0) {
    const auto position = file.doubles("static_pose_drive", count * drives);
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t d = 0; d < std::min(drives, static_cast<std::size_t>(std::max(0, drive_counts[p]))); ++d)
        run.static_poses[p].drives.push_back(position[p * drives + d]);
  }
  if (keys == 0) return;
  const auto names = file.strings("static_value_name", keys);
  const auto values = file.doubles("static_pose_value", count * keys);
  const auto present = file.integers("static_pose_value_present", count * keys);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t k = 0; k < keys; ++k)
      if (present[p * keys + k]) run.static_poses[p].values[names[k]] = values[p * keys + k];
}

}  // namespace

Trajectory read_archive(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error(path + ": cannot be read: there is no such file");
  const NetcdfFile file(path, NetcdfFile::Mode::read, path);
  Trajectory run;
  run.status = status_from(file.text(NC_GLOBAL, "status"), path);
  run.message = file.text(NC_GLOBAL, "message");
  run.steps = static_cast<long>(file.number(NC_GLOBAL, "steps"));
  run.residuals = static_cast<long>(file.number(NC_GLOBAL, "residuals"));
  run.factorisations = static_cast<long>(file.number(NC_GLOBAL, "factorisations"));
  run.wall = file.number(NC_GLOBAL, "wall_s");
  read_channels(file, run);
  read_phases(file, run);
  read_contacts(file, run);
  read_static_poses(file, run);
  return run;
}

}  // namespace stillhook
