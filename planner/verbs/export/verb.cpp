#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <stdexcept>

#include "planner/verbs/verbs.h"
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

class ExportVerb final : public Verb {
 public:
  std::string name() const override { return "export"; }
  std::string help() const override { return "Write a run's history for other programs: CSV, or an Excel workbook"; }
  void add_options(VerbOptions& o) override;
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override {
    return {{"history.csv", "The history as text, with --csv."},
            {"history.xlsx", "The history as a workbook, with --xlsx."}};
  }

 private:
  bool csv_ = false, xlsx_ = false;    // one of them
  std::vector<std::string> channels_;  // patterns; empty = all
};

void ExportVerb::add_options(VerbOptions& o) {
  o.add_run_folder("Folder that simulate or plan has written");
  o.add({"--csv", &csv_, "", "Comma-separated values, units in the header, every digit"});
  o.add({.name = "--xlsx",
         .target = &xlsx_,
         .operand = "",
         .help = "Excel workbook: sheets history, metrics, limits, contacts",
         .excludes = "--csv"});
  o.add({"--out", &o.common().out, "FILE",
         "File to write (default history.csv or history.xlsx in the run's folder; - for stdout, CSV only)"});
  o.add({.name = "--channels",
         .target = &channels_,
         .operand = "NAMES",
         .help = "Only these channels, e.g. load.*,hoist_port.tension; * and ? stand for anything",
         .delimiter = ','});
  o.add_force("Replace the file if it exists");
  o.add_messages("No messages but errors");
}

int ExportVerb::run(const CommonOptions& options) {
  if (!csv_ && !xlsx_) throw UsageError("export: say --csv or --xlsx");
  if (!fs::is_directory(options.input)) throw UsageError(options.input + ": there is no such folder");
  const RunFolder folder(options.input, RunFolder::Mode::read);
  if (!fs::exists(folder.history())) throw UsageError(folder.history() + ": is missing, there is nothing to export");
  const bool standard_output = options.out == "-";
  if (standard_output && xlsx_) throw UsageError("--out -: a workbook needs a file");
  const std::string out = !options.out.empty() ? options.out : xlsx_ ? folder.xlsx() : folder.csv();
  if (!standard_output && fs::exists(out) && !options.force)
    throw UsageError(out + ": exists already; use --force to replace it, or another --out");

  const Trajectory run = open_archive(folder.history());
  Export data{run, chosen_channels(run, channels_), {}};
  if (fs::exists(folder.summary())) data.summary = read_summary(folder.summary());
  if (run.status != RunStatus::completed) spdlog::warn("{}", run.message);
  if (xlsx_)
    write_xlsx(data, out);
  else
    write_csv(data, out);
  if (!standard_output) fmt::print("{}\n", out);
  return kDone;
}

}  // namespace

std::unique_ptr<Verb> export_verb() { return std::make_unique<ExportVerb>(); }

}  // namespace stillhook
