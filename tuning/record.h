// A measured run as the fit uses it: channels of the simulation in SI at full scale, on simulated time, resampled.
//
// A file's row becomes: offset off, sign turned, unit to SI, model to full scale by Froude, clock to simulated time. Cells
// that are empty leave gaps; spikes that stand off their neighbours are marked and left out. A record sampled more
// densely than asked for is reduced by a local parabola over each interval (Savitzky & Golay 1964), which takes noise
// away and leaves a motion's amplitude alone, as a mean would not.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "problems/fit_spec.h"
#include "sim/multibody/force_element.h"

namespace stillhook {

/// One channel of a record.
struct MeasuredChannel {
  FitColumnSpec spec;
  std::string unit;               // SI
  double file_unit = 1.0;         // of the file's unit in SI at full scale, without sign
  std::vector<double> value;      // by sample; NaN where there is none
  double noise = std::numeric_limits<double>::quiet_NaN();  // standard deviation of a sample if the case gives it
  int missing = 0, outliers = 0;  // rows left out
};

struct MeasuredRecord {
  std::string name, file;
  FitRecordSpec::Kind kind = FitRecordSpec::Kind::decay;
  std::vector<double> time;  // s, simulated; one sample at 0 for a static pull
  double interval = 0.0;     // s, between samples
  std::size_t rows = 0;      // of the file, in the window
  std::vector<MeasuredChannel> channels;
  std::vector<std::string> notes;  // what was left out, one sentence each

  double end() const { return time.empty() ? 0.0 : time.back(); }
};

/// Reads and prepares a record. `channels`: of the model; `output_interval` (s): of the samples where the record does not
/// say. Throws CaseError with file and line: a channel that the model has not, units that do not belong to it, a clock
/// that runs backwards, too few rows, a sensor that is constant, mostly missing, or out of range.
MeasuredRecord read_record(const FitRecordSpec& spec, const std::vector<Channel>& channels, double output_interval);

/// Marks (true) values that stand off the median of their seven neighbours by more than six robust standard deviations
/// and more than the signal's own steps.
std::vector<bool> spikes(const std::vector<double>& values);

/// Value at t of the parabola that fits the samples (time, value) within t +- half best; NaN with fewer than `fewest` valid
/// ones. `from`: index to look from, moved on.
double local_parabola(const std::vector<double>& time, const std::vector<double>& value, double t, double half,
                      std::size_t fewest, std::size_t& from);

}  // namespace stillhook
