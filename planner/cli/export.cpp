#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <stdexcept>

#include "planner/cli/commands.h"
#include "results/archive.h"
#include "results/export.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> chosen_channels(const Trajectory& run, const std::vector<std::string>& patterns) {
  try {
    return matching_channels(run, patterns);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--channels: ") + error.what());
  }
}

}  // namespace

int run_export(const CommonOptions& options, const ExportArguments& arguments) {
  if (!arguments.csv && !arguments.xlsx) throw UsageError("export: say --csv or --xlsx");
  if (!fs::is_directory(options.input)) throw UsageError(options.input + ": there is no such folder");
  const RunFolder folder(options.input, RunFolder::Mode::read);
  if (!fs::exists(folder.history())) throw UsageError(folder.history() + ": is missing, there is nothing to export");
  const bool standard_output = options.out == "-";
  if (standard_output && arguments.xlsx) throw UsageError("--out -: a workbook needs a file");
  const std::string out = !options.out.empty() ? options.out : arguments.xlsx ? folder.xlsx() : folder.csv();
  if (!standard_output && fs::exists(out) && !options.force)
    throw UsageError(out + ": exists already; use --force to replace it, or another --out");

  const Trajectory run = open_archive(folder.history());
  Export data{run, chosen_channels(run, arguments.channels), {}};
  if (fs::exists(folder.summary())) data.summary = read_summary(folder.summary());
  if (run.status != RunStatus::completed) spdlog::warn("{}", run.message);
  if (arguments.xlsx)
    write_xlsx(data, out);
  else
    write_csv(data, out);
  if (!standard_output) fmt::print("{}\n", out);
  return kDone;
}

}  // namespace stillhook
