// history.nc: everything a run leaves, as NetCDF-4 following CF-1.8, so that a report can be rebuilt from it and
// xarray, h5py or MATLAB can open it.
//
// Layout: dimension `time` (s since the start of the run) and one double variable per channel with units, long_name and
// the attribute `channel` (the channel's name; the variable's own name has only letters, digits and underscores).
// Dimension `operation_phase`: phase_name, phase_stage, phase_start, phase_end, phase_event_timed_out. Dimension
// `contact_event`: contact_*. Extremes over every step: extreme_min, extreme_max, extreme_time_of_min,
// extreme_time_of_max (operation_phase, channel). Static poses: static_pose_*. Status and cost: global attributes.
// Numbers are stored losslessly (float64, shuffle, deflate): what is read back is bit for bit what was written, and the
// same run gives the same file. Texts are characters of fixed length (dimensions *_length), which need nothing of the
// file's heap. Compressed variables have checksums (Fletcher 32), and the finished file a seal at its end over
// all of it (sealed_file.h), so that a damaged one is refused before the HDF5 library can trip over it. How the file
// looks while a run goes on: archive_stream.h.
#pragma once

#include <string>

#include "sim/trajectory.h"

namespace stillhook {

/// What the file says about itself.
struct ArchiveTitle {
  std::string title;         // of the case
  std::string source;        // program and version
  std::string sea;           // name of the sea state
  std::string history = "";  // what was done to get the file
};

/// Writes a trajectory, whole or not at all: an existing file is replaced only by a complete one. Samples come from
/// where the trajectory has them, one channel at a time. Throws FileError that names file and reason. The NetCDF
/// library is not thread-safe: one call at a time.
void write_archive(const Trajectory& trajectory, const ArchiveTitle& title, const std::string& path);

/// Reads a trajectory back, samples and all. One whose program was killed in mid-run comes back as far as it was on the
/// disk, as an interrupted run with a message that says so. Throws FileError that names the file and what is missing or
/// wrong in it.
Trajectory read_archive(const std::string& path);

/// The same with the samples left in the file: `values` is empty, `source` reads a channel when it is asked for.
Trajectory open_archive(const std::string& path);

}  // namespace stillhook
