// How history.nc is laid out: what its complete form (archive.cpp) and its form while a run goes on
// (archive_stream.cpp) have in common.
#pragma once

#include <string>
#include <vector>

#include "results/archive.h"
#include "results/netcdf_file.h"

namespace stillhook::archive {

/// The value of the attribute `status` while a run goes on.
inline constexpr const char* kRunning = "running";

/// A CF variable name for each channel: letters, digits and underscores, first a letter, no two alike.
std::vector<std::string> variable_names(const std::vector<Channel>& channels);

template <class Entries, class F>
auto collect(const Entries& entries, F f) {
  std::vector<decltype(f(*entries.begin()))> values;
  for (const auto& entry : entries) values.push_back(f(entry));
  return values;
}

void write_title(NetcdfFile& file, const ArchiveTitle& title, const std::string& status, const std::string& message);

/// The table of channels, and dimension `channel`.
void write_channel_table(NetcdfFile& file, const std::vector<Channel>& channels);

/// The time axis, and a variable for each channel; nothing in them yet.
struct SampleVariables {
  int time = -1;
  std::vector<int> channels;
};
SampleVariables define_samples(NetcdfFile& file, const std::vector<Channel>& channels, std::size_t samples,
                               NetcdfFile::Storage storage);

/// Dimension `operation_phase` and its variables, with what is known before the phases have run.
/// `storage`: of the rest.
struct PhaseVariables {
  int start = -1, end = -1, timed_out = -1;
  std::vector<int> extremes;  // as in kExtremes; empty if there are no channels
};
struct ExtremeField {
  const char *name, *long_name;
  double Extreme::*value;
};
inline constexpr ExtremeField kExtremes[] = {
    {"extreme_min", "smallest value of a channel in a phase, of every step, in its unit", &Extreme::min},
    {"extreme_max", "largest value of a channel in a phase, of every step, in its unit", &Extreme::max},
    {"extreme_time_of_min", "time of the smallest value, s", &Extreme::t_min},
    {"extreme_time_of_max", "time of the largest value, s", &Extreme::t_max}};
PhaseVariables define_phases(NetcdfFile& file, const std::vector<PhaseRecord>& phases, bool with_extremes,
                             NetcdfFile::Storage storage);

/// One field of the extremes of a phase, a value for each channel.
std::vector<double> extreme_row(const std::vector<Extreme>& extremes, double Extreme::*field, std::size_t channels);

/// The numbers of a contact event, one variable each.
struct ContactField {
  const char *name, *long_name, *units;
  double ContactEvent::*value;
};
inline constexpr ContactField kContactFields[] = {
    {"contact_event_start", "first touch", "s", &ContactEvent::start},
    {"contact_event_end", "end of the contact", "s", &ContactEvent::end},
    {"contact_event_approach_speed", "normal speed at first touch", "m/s", &ContactEvent::approach_speed},
    {"contact_event_peak_force", "largest normal force", "N", &ContactEvent::peak_force},
    {"contact_event_impulse", "normal impulse", "N s", &ContactEvent::impulse}};
inline constexpr const char* kContactPlace = "contact_event_place";
inline constexpr const char* kContactPlaceName = "place of the first touch in the world";
/// Meaning of a contact's role in the file, in the order of ContactSpec::Role.
void describe_roles(NetcdfFile& file, int variable);
inline constexpr const char* kContactRoleName = "what the contact is for";

void write_static_poses(NetcdfFile& file, const std::vector<StaticPose>& poses);

}  // namespace stillhook::archive
