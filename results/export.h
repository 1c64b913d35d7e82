// A run for other programs: its history as CSV, and history, metrics, limits and contacts as an Excel workbook.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/summary.h"
#include "sim/trajectory.h"

namespace stillhook {

/// A run as it is exported: all its samples, or those of some channels.
struct Export {
  const Trajectory& run;
  std::vector<std::size_t> channels;  // indices, in the order of the columns
  std::optional<Summary> summary;     // none if the run did not come to its end
};

/// Channels whose names match one of the patterns (shell style: * ? [abc]), in the order of the run; all without
/// patterns. Throws std::invalid_argument, with a sentence, for a pattern that nothing matches.
std::vector<std::size_t> matching_channels(const Trajectory& run, const std::vector<std::string>& patterns);

/// "time [s],load.x [m],...": a line a sample, each number in the shortest form that reads back to the same double,
/// nothing where there is no number. To standard output if `path` is "-", else whole or not at all. Throws FileError.
void write_csv(const Export& data, const std::string& path);

/// Sheets history, metrics, limits and contacts; numbers with 16 significant digits. Throws FileError, also for what
/// does not fit on a sheet (1 048 576 rows, 16 384 columns).
void write_xlsx(const Export& data, const std::string& path);

}  // namespace stillhook
