#include "results/archive_stream.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "results/archive_layout.h"
#include "results/files.h"
#include "sim/lifting/contact.h"

namespace stillhook {

using namespace archive;

namespace {

constexpr double kSyncEvery = 100.0;         // s of simulated time
constexpr std::size_t kSyncSamples = 10000;  // or as many samples, if they are dense
constexpr std::size_t kContacts = 4096;      // events that a growing file has room for
constexpr double kFirstRoom = 64e6;          // bytes of samples: a longer run gets more when it comes to need it

double sample_bytes(std::size_t channels) { return static_cast<double>(sizeof(double) * (channels + 1)); }

/// Samples that a growing file of so many channels has room for at first: the whole run if it is of ordinary length.
std::size_t room_for(const SampleForecast& forecast, std::size_t channels) {
  // A run that waits for events takes longer than planned, most of them by less than this.
  const std::size_t whole =
      forecast.expected + forecast.expected / 50 + static_cast<std::size_t>(kSyncEvery / forecast.interval) + 1;
  return std::min(whole, static_cast<std::size_t>(kFirstRoom / sample_bytes(channels)) + 1);
}

/// Throws FileError when the run as planned will not fit on the disk: before hours are spent on it, not after them.
void require_space(const std::string& path, const SampleForecast& forecast, std::size_t channels) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error) return;  // a file system that does not tell; writing will
  const double samples = static_cast<double>(forecast.expected), needed = samples * sample_bytes(channels);
  if (needed <= static_cast<double>(space.available)) return;
  throw FileError(
      fmt::format("{}: the run is planned to last {:.6g} s, which is {:.3g} samples of {} channels, {:.3g} GB, and the "
                  "disk has {:.3g} GB free: shorten the run (solver.max_duration_s, duration_s of the phases, faster "
                  "moves) or record less often (solver.output_interval_s, {:.6g} s here)",
                  path, samples * forecast.interval, samples, channels, needed / 1e9,
                  static_cast<double>(space.available) / 1e9, forecast.interval));
}

}  // namespace

/// The growing file: its variables, and how far it is.
struct ArchiveStream::Growing {
  Growing(const std::string& path, const ArchiveTitle& title, const Trajectory& run, const SampleForecast& forecast,
          std::size_t capacity_)
      : capacity(capacity_), pending(path), file(pending.temporary(), NetcdfFile::Mode::create, path) {
    write_title(file, title, kRunning,
                "This run goes on, or its program was killed: there are as many samples as samples_written says, NaN "
                "after them.");
    write_channel_table(file, run.channels);
    samples = define_samples(file, run.channels, capacity, NetcdfFile::Storage::whole);
    phases = define_phases(file, forecast.phases, true, NetcdfFile::Storage::whole);
    define_contacts();
    written = file.define("samples_written", NC_INT, {}, "number of samples written so far", "1");
    write_static_poses(file, run.static_poses);
    fill(forecast.begin, forecast.interval);
  }

  /// From now on the file has its name.
  void publish() {
    file.sync();
    pending.commit(PendingFile::Flush::no);  // a kill does not need it, and the file is large
  }

  void define_contacts() {
    const int event = file.define_dimension("contact_event", kContacts), vector = file.define_dimension("vector", 3);
    contact_count = file.define("contact_event_count", NC_INT, {}, "number of contact events so far", "1");
    const auto define = [&](const char* name, nc_type type, const char* long_name, const char* units = "") {
      return file.define(name, type, {event}, long_name, units, NetcdfFile::Storage::whole);
    };
    contact_channel = define("contact_event_channel", NC_INT, "index of the contact's force channel");
    contact_phase = define("contact_event_phase_index", NC_INT, "index of the phase of the first touch");
    contact_role = define("contact_event_role", NC_INT, kContactRoleName);
    describe_roles(file, contact_role);
    for (const ContactField& field : kContactFields)
      contact_fields.push_back(define(field.name, NC_DOUBLE, field.long_name, field.units));
    contact_place =
        file.define(kContactPlace, NC_DOUBLE, {event, vector}, kContactPlaceName, "m", NetcdfFile::Storage::whole);
  }

  /// Every variable that will be written takes its place in the file now.
  void fill(double begin, double interval) {
    std::vector<int> doubles = samples.channels;
    doubles.insert(doubles.end(), phases.extremes.begin(), phases.extremes.end());
    doubles.insert(doubles.end(), contact_fields.begin(), contact_fields.end());
    doubles.insert(doubles.end(), {samples.time, phases.start, phases.end, contact_place});
    const std::vector<double> nothing(std::max<std::size_t>(3, file.size("channel")),
                                      std::numeric_limits<double>::quiet_NaN());
    for (const int variable : doubles) file.put_rows(variable, 0, 1, nothing.data());
    const int none = -1;
    for (const int variable : {phases.timed_out, contact_channel, contact_phase, contact_role})
      file.put_rows(variable, 0, 1, &none);
    std::vector<double> axis(capacity);
    for (std::size_t i = 0; i < capacity; ++i) axis[i] = begin + static_cast<double>(i) * interval;
    file.put(samples.time, axis);
    file.put(written, std::vector<int>{0});
    file.put(contact_count, std::vector<int>{0});
  }

  void put_samples(const std::vector<double>& time, const std::vector<std::vector<double>>& values) {
    file.put_rows(samples.time, count, time.size(), time.data());
    for (std::size_t c = 0; c < values.size(); ++c)
      file.put_rows(samples.channels[c], count, time.size(), values[c].data());
    count += time.size();
  }

  void take_samples(const Growing& old) {
    count = old.count;
    const auto take = [&](int from, int to) {
      file.put_rows(to, 0, count, old.file.first_doubles(from, count).data());
    };
    take(old.samples.time, samples.time);
    for (std::size_t c = 0; c < samples.channels.size(); ++c) take(old.samples.channels[c], samples.channels[c]);
  }

  void put_phases(const Trajectory& run, double now) {
    for (std::size_t p = 0; p < run.phases.size(); ++p) {
      const PhaseRecord& phase = run.phases[p];
      const double end = p + 1 == run.phases.size() ? now : phase.end;
      const int timed_out = phase.event_timed_out ? 1 : 0;
      file.put_rows(phases.start, p, 1, &phase.start);
      file.put_rows(phases.end, p, 1, &end);
      file.put_rows(phases.timed_out, p, 1, &timed_out);
      for (std::size_t k = 0; k < phases.extremes.size(); ++k)
        file.put_rows(phases.extremes[k], p, 1,
                      extreme_row(run.extremes[p], kExtremes[k].value, run.channels.size()).data());
    }
  }

  void put_contacts(const Trajectory& run) {
    for (; contacts < std::min(run.contacts.size(), kContacts); ++contacts) {
      const ContactEvent& event = run.contacts[contacts];
      const int channel = run.find(contact_channels::force.of(event.contact)), role = static_cast<int>(event.role);
      const auto phase = std::find_if(run.phases.begin(), run.phases.end(),
                                      [&](const PhaseRecord& p) { return p.name == event.phase; });
      const int phase_index = static_cast<int>(phase - run.phases.begin());
      file.put_rows(contact_channel, contacts, 1, &channel);
      file.put_rows(contact_phase, contacts, 1, &phase_index);
      file.put_rows(contact_role, contacts, 1, &role);
      for (std::size_t k = 0; k < contact_fields.size(); ++k)
        file.put_rows(contact_fields[k], contacts, 1, &(event.*kContactFields[k].value));
      file.put_rows(contact_place, contacts, 1, event.place.data());
    }
    file.put(contact_count, std::vector<int>{static_cast<int>(run.contacts.size())});
  }

  /// First the data, then the count that vouches for it.
  void sync() {
    file.sync();
    file.put(written, std::vector<int>{static_cast<int>(count)});
    file.sync();
  }

  const std::size_t capacity;
  PendingFile pending;
  NetcdfFile file;
  SampleVariables samples;
  PhaseVariables phases;
  int written = -1, contact_count = -1, contact_channel = -1, contact_phase = -1, contact_role = -1, contact_place = -1;
  std::vector<int> contact_fields;
  std::size_t count = 0, contacts = 0;  // written
};

/// What is in the growing file already.
struct ArchiveStream::GrowingSamples : SampleSource {
  explicit GrowingSamples(std::shared_ptr<const Growing> from_) : from(std::move(from_)) {}
  std::vector<double> series(std::size_t channel) const override {
    return from->file.first_doubles(from->samples.channels[channel], from->count);
  }
  std::shared_ptr<const Growing> from;
};

ArchiveStream::ArchiveStream(std::string path, ArchiveTitle title) : path_(std::move(path)), title_(std::move(title)) {}

ArchiveStream::~ArchiveStream() = default;

void ArchiveStream::open(const Trajectory& run, const SampleForecast& forecast) {
  forecast_ = forecast;
  synced_ = forecast.begin;
  values_.assign(run.channels.size(), {});
  require_space(path_, forecast, run.channels.size());
  file_ = std::make_shared<Growing>(path_, title_, run, forecast, room_for(forecast, run.channels.size()));
  file_->publish();
}

void ArchiveStream::add(const Trajectory& run, double t, std::span<const double> values) {
  time_.push_back(t);
  for (std::size_t c = 0; c < values.size(); ++c) values_[c].push_back(values[c]);
  if (t - synced_ >= kSyncEvery || time_.size() >= kSyncSamples) flush(run);
}

void ArchiveStream::flush(const Trajectory& run) {
  if (time_.empty()) return;
  const double now = time_.back();
  if (file_->count + time_.size() > file_->capacity) grow(run);
  file_->put_samples(time_, values_);
  file_->put_phases(run, now);
  file_->put_contacts(run);
  file_->sync();
  synced_ = now;
  time_.clear();
  for (std::vector<double>& values : values_) values.clear();
}

void ArchiveStream::grow(const Trajectory& run) {
  const Growing& old = *file_;
  auto larger = std::make_shared<Growing>(path_, title_, run, forecast_, 2 * old.capacity + time_.size());
  larger->take_samples(old);
  larger->put_phases(run, time_.front());
  larger->put_contacts(run);
  larger->sync();
  larger->publish();
  file_ = std::move(larger);
}

void ArchiveStream::finish(Trajectory& run) {
  flush(run);
  run.time = file_->file.first_doubles(file_->samples.time, file_->count);
  run.source = std::make_shared<GrowingSamples>(file_);
  write_archive(run, title_, path_);
  file_.reset();
  run.source = open_archive(path_).source;
}

}  // namespace stillhook
