// history.nc while a run goes on: a file that is valid at any moment, so that a run which is killed leaves what it has
// recorded, up to the last 100 s of simulated time.
//
// The file has its full size from the start: time axis and channels for the planned duration, or for as much of it as
// 64 MB hold, NaN where nothing has been recorded yet, every variable at a fixed place. A sync writes numbers into these places and nothing else, so
// there is no moment at which the file's own bookkeeping is half written. The attribute `status` is "running", the
// variable `samples_written` says how far the samples go; phases, extremes and contacts are as of the last sync
// (contact events name their contact by `contact_event_channel`, the index of its force channel, and their phase by
// `contact_event_phase_index`). A run that outgrows the file gets one of twice the size; a run that will not
// fit on the disk is refused before it begins. At the end the file is replaced by the
// complete and compressed one of archive.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "results/archive.h"
#include "sim/samples.h"

namespace stillhook {

class ArchiveStream : public SampleSink {
 public:
  /// Nothing is written before open().
  ArchiveStream(std::string path, ArchiveTitle title);
  ~ArchiveStream() override;

  void open(const Trajectory& run, const SampleForecast& forecast) override;
  void add(const Trajectory& run, double t, std::span<const double> values) override;

  /// Puts the complete archive in the place of the growing one and gives the run its `time` and its `source`.
  /// Throws FileError, as all of them do; the growing file then stays.
  void finish(Trajectory& run);

 private:
  struct Growing;
  struct GrowingSamples;
  void flush(const Trajectory& run);
  void grow(const Trajectory& run);

  std::string path_;
  ArchiveTitle title_;
  SampleForecast forecast_;
  std::shared_ptr<Growing> file_;
  double synced_ = 0.0;                      // s
  std::vector<double> time_;                 // of the samples since the last sync
  std::vector<std::vector<double>> values_;  // by channel
};

}  // namespace stillhook
