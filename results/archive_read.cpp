#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "results/archive_layout.h"
#include "results/files.h"
#include "results/netcdf_file.h"
#include "results/sealed_file.h"
#include "results/summary.h"
#include "sim/guarded_read.h"
#include "sim/samples.h"

namespace stillhook {
namespace {

RunStatus status_from(const std::string& name, const std::string& path) {
  for (RunStatus s : {RunStatus::not_run, RunStatus::completed, RunStatus::interrupted, RunStatus::diverged})
    if (status_name(s) == name) return s;
  throw FileError(path + ": unknown status \"" + name + "\"");
}

/// The samples of an archive, read when they are asked for.
class FileSamples : public SampleSource {
 public:
  FileSamples(std::shared_ptr<const NetcdfFile> file, const std::vector<Channel>& channels, std::size_t count)
      : file_(std::move(file)), count_(count) {
    // Channels find their variable by the attribute, whatever the variable had to be called.
    std::map<std::string, int> variable_of;
    int variables = 0;
    file_->check(nc_inq_nvars(file_->id(), &variables), "cannot be read");
    for (int v = 0; v < variables; ++v)
      if (nc_inq_attid(file_->id(), v, "channel", nullptr) == NC_NOERR) variable_of[file_->text(v, "channel")] = v;
    for (const Channel& channel : channels) {
      const auto found = variable_of.find(channel.name);
      if (found == variable_of.end()) file_->check(NC_ENOTVAR, "holds no samples of channel " + channel.name);
      variables_.push_back(found->second);
    }
  }
  std::vector<double> series(std::size_t channel) const override {
    return file_->first_doubles(variables_[channel], count_);
  }

 private:
  std::shared_ptr<const NetcdfFile> file_;
  std::size_t count_;
  std::vector<int> variables_;
};

void read_channels(const std::shared_ptr<const NetcdfFile>& file, Trajectory& run, std::size_t samples) {
  const std::size_t count = file->size("channel");
  if (count == 0) return;
  const auto names = file->texts("channel_name", count), units = file->texts("channel_unit", count),
             descriptions = file->texts("channel_description", count);
  for (std::size_t c = 0; c < count; ++c) run.channels.push_back({names[c], units[c], descriptions[c]});
  if (samples == 0) return;
  run.time = file->first_doubles(file->find("time"), samples);
  run.source = std::make_shared<FileSamples>(file, run.channels, samples);
}

void read_phases(const NetcdfFile& file, Trajectory& run) {
  const std::size_t count = file.size("operation_phase"), channels = run.channels.size();
  if (count == 0) return;
  const auto names = file.texts("phase_name", count);
  const auto stages = file.integers("phase_stage", count), timeouts = file.integers("phase_event_timed_out", count);
  const auto starts = file.doubles("phase_start", count), ends = file.doubles("phase_end", count);
  for (std::size_t p = 0; p < count; ++p)
    run.phases.push_back(
        {names[p], static_cast<PhaseSpec::Stage>(std::clamp(stages[p], 0, 4)), starts[p], ends[p], timeouts[p] != 0});
  if (channels == 0 || !file.has("extreme_min")) return;
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
  const auto names = file.texts("contact_event_name", count), phases = file.texts("contact_event_phase", count);
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

// ---- what a run leaves that was killed ---------------------------------------------------------------------------

int single(const NetcdfFile& file, const char* variable) { return file.integers(variable, 1).front(); }

std::size_t written_samples(const NetcdfFile& file) {
  return static_cast<std::size_t>(std::max(0, single(file, "samples_written")));
}

void read_contacts_so_far(const NetcdfFile& file, Trajectory& run) {
  const std::size_t room = file.size("contact_event");
  const std::size_t count = std::min(room, static_cast<std::size_t>(std::max(0, single(file, "contact_event_count"))));
  const auto channels = file.integers("contact_event_channel", room),
             phases = file.integers("contact_event_phase_index", room),
             roles = file.integers("contact_event_role", room);
  const auto places = file.doubles(archive::kContactPlace, 3 * room);
  std::vector<std::vector<double>> fields;
  for (const auto& field : archive::kContactFields) fields.push_back(file.doubles(field.name, room));
  const auto entry = [](const auto& entries, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < entries.size()
               ? entries[static_cast<std::size_t>(index)].name
               : std::string();
  };
  for (std::size_t i = 0; i < count; ++i) {
    ContactEvent event;
    event.contact = entry(run.channels, channels[i]);
    event.contact.resize(event.contact.rfind('.') == std::string::npos ? 0 : event.contact.rfind('.'));
    event.phase = entry(run.phases, phases[i]);
    event.role = static_cast<ContactSpec::Role>(std::clamp(roles[i], 0, 2));
    event.place = Vector3(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    for (std::size_t k = 0; k < fields.size(); ++k) event.*archive::kContactFields[k].value = fields[k][i];
    run.contacts.push_back(event);
  }
}

void read_running(const NetcdfFile& file, Trajectory& run) {
  run.status = RunStatus::interrupted;
  run.message = run.time.empty() ? "incomplete: the program ended before anything was recorded"
                                 : fmt::format("incomplete: the program ended in mid-run; recorded until t = {:g} s",
                                               run.time.back());
  read_phases(file, run);
  // Phases that had not begun have no times.
  std::size_t begun = 0;
  while (begun < run.phases.size() && std::isfinite(run.phases[begun].start)) ++begun;
  run.phases.resize(begun);
  run.extremes.resize(std::min(begun, run.extremes.size()));
  read_contacts_so_far(file, run);
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
  for (const std::string& name : file.texts("static_pose_name", count)) run.static_poses.emplace_back().name = name;
  read_pose_bodies(file, run, file.integers("static_pose_bodies", count));
  const auto drive_counts = file.integers("static_pose_drives", count);
  if (drives > 0) {
    const auto position = file.doubles("static_pose_drive", count * drives);
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t d = 0; d < std::min(drives, static_cast<std::size_t>(std::max(0, drive_counts[p]))); ++d)
        run.static_poses[p].drives.push_back(position[p * drives + d]);
  }
  if (keys == 0) return;
  const auto names = file.texts("static_value_name", keys);
  const auto values = file.doubles("static_pose_value", count * keys);
  const auto present = file.integers("static_pose_value_present", count * keys);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t k = 0; k < keys; ++k)
      if (present[p * keys + k]) run.static_poses[p].values[names[k]] = values[p * keys + k];
}

/// Opens a file that can be trusted.
Trajectory open_whole(const std::string& path) {
  const auto file = std::make_shared<const NetcdfFile>(path, NetcdfFile::Mode::read, path);
  Trajectory run;
  const std::string status = file->text(NC_GLOBAL, "status");
  const bool running = status == archive::kRunning;
  read_channels(file, run, running ? written_samples(*file) : file->size("time"));
  if (running) {
    read_running(*file, run);
  } else {
    run.status = status_from(status, path);
    run.message = file->text(NC_GLOBAL, "message");
    run.steps = static_cast<long>(file->number(NC_GLOBAL, "steps"));
    run.residuals = static_cast<long>(file->number(NC_GLOBAL, "residuals"));
    run.factorisations = static_cast<long>(file->number(NC_GLOBAL, "factorisations"));
    read_phases(*file, run);
    read_contacts(*file, run);
  }
  read_static_poses(*file, run);
  return run;
}

void take_all_samples(Trajectory& run) {
  if (!run.source) return;
  for (std::size_t c = 0; c < run.channels.size(); ++c) run.values.push_back(run.source->series(c));
  run.source.reset();
}

}  // namespace

Trajectory open_archive(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw FileError(path + ": cannot be read: there is no such file");
  if (has_good_seal(path)) return open_whole(path);
  // The file of a run that was killed, or of another program.
  try_reading(path, [&path] {
    Trajectory run = open_whole(path);
    take_all_samples(run);
  });
  return open_whole(path);
}

Trajectory read_archive(const std::string& path) {
  Trajectory run = open_archive(path);
  take_all_samples(run);
  return run;
}

}  // namespace stillhook
