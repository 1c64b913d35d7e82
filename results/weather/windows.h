// Weather windows: runs of workable samples as long as an operation needs, and the wait for the next one.
//
// A window of T at sample i: m = ceil(T/dt) workable samples in a row from i on. The wait at i is the time until the
// next window's start, 0 if one starts at i.
#pragma once

#include <array>
#include <vector>

#include "results/weather/workability.h"

namespace stillhook {

/// What is beyond the end of a record.
enum class RecordEnd {
  censor,  // nothing is known: waits that the end cuts off are left out and counted
  wrap     // the record is a ring: its first sample follows its last
};

/// Chance that a window starts within so many days, of all the starts whose horizon lies within the record.
struct ChanceWithin {
  double days = 0.0, share = 0.0;  // NaN: no such start
};

struct WaitSummary {
  std::size_t counted = 0;   // samples whose wait is known
  double start_share = 0.0;  // of samples at which a window starts, of those where it can be told; NaN for none
  double mean_h = 0.0, p50_h = 0.0, p80_h = 0.0, p90_h = 0.0;  // NaN for none
  std::vector<ChanceWithin> within;
};

struct WindowStatistics {
  double duration_h = 0.0;
  std::size_t samples = 0;     // m
  std::size_t starts = 0;      // samples at which a window starts
  std::size_t censored = 0;    // waits that the record's end cuts off
  std::vector<double> wait_h;  // of each sample; NaN: cut off
  WaitSummary all;
  std::array<WaitSummary, 12> by_month;     // of the month in which the wait begins
  std::array<YearSpread, 12> mean_by_year;  // mean wait of whole months in each year, h
};

/// `days`: horizons of the chances. Throws std::invalid_argument for a duration <= 0.
WindowStatistics find_windows(const Workability& workability, double duration_h, RecordEnd end,
                              const std::vector<double>& days);

/// Workable samples in a row, in hours, in the order of the record (not closed to a ring).
std::vector<double> calms(const Workability& workability);

}  // namespace stillhook
