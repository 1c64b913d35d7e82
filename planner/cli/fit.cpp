#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "planner/cli/commands.h"
#include "planner/cli/interrupt.h"
#include "planner/cli/progress.h"
#include "planner/cli/tables.h"
#include "planner/document_control.h"
#include "planner/fit_report.h"
#include "results/files.h"
#include "tuning/measured_table.h"

namespace stillhook {
namespace {

std::string absolute_file(const std::string& path) {
  if (const std::string fault = fault_of_measured_path(path); !fault.empty())
    throw UsageError("--measured " + path + ": " + fault);
  // Standard input may be a file by another name, which means nothing when the fit is repeated.
  const bool other_name = path.starts_with("/dev/") || path.starts_with("/proc/");
  return (other_name ? std::filesystem::canonical(path) : std::filesystem::absolute(path).lexically_normal()).string();
}

/// --measured RECORD=FILE goes to that record, --measured FILE to the records without a file, in order.
std::vector<Override> measured_files(const Case& c, const std::vector<std::string>& measured) {
  std::vector<std::string> open;
  for (const FitRecordSpec& record : c.fit.records)
    if (record.file.empty()) open.push_back(record.name);
  std::vector<Override> files;
  std::map<std::string, std::string> taken;  // file by record
  std::size_t next = 0;
  for (const std::string& argument : measured) {
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals == std::string::npos ? 0 : equals);
    const bool named = std::any_of(c.fit.records.begin(), c.fit.records.end(),
                                   [&](const FitRecordSpec& record) { return record.name == name; });
    std::string record = name;
    if (!named) {
      while (next < open.size() && taken.count(open[next])) ++next;
      if (next < open.size())
        record = open[next++];
      else if (c.fit.records.size() == 1)
        record = c.fit.records.front().name;
      else
        throw UsageError(fmt::format("--measured {}: for which record of the case? Write --measured RECORD=FILE; its "
                                     "[[fit.records]] say what the columns are",
                                     argument));
    }
    const std::string file = absolute_file(named ? argument.substr(equals + 1) : argument);
    const auto [first, is_new] = taken.emplace(record, file);
    if (!is_new)
      throw UsageError(fmt::format("--measured {}: record \"{}\" has a file already, {}; a record is one file: give it "
                                   "once, or write another [[fit.records]]",
                                   argument, record, first->second));
    files.push_back({"fit.records." + record + ".file", "'" + file + "'"});
  }
  return files;
}

void print_result(const Identification& result, const std::vector<std::string>& files, const RunFolder& folder) {
  fmt::print("{}\n\n{}\n{}", verdict_of(result), table_text(estimate_table(result)), table_text(residual_table(result)));
  for (const ReportTable& table : {decay_table(result), cross_table(result)})
    if (!table.rows.empty()) fmt::print("\n{}", table_text(table));
  for (const std::string& file : files)
    if (file == "fitted.toml") fmt::print("\nFitted case: {}\n", folder.fitted());
  fmt::print("Report: {}\n", folder.report());
}

int exit_code(const Identification& result) {
  if (result.interrupted) return kInterrupted;
  if (!result.usable) return kNumericalFailure;
  return result.trusted ? kDone : kLimitViolated;
}

}  // namespace

int run_fit(const CommonOptions& options, const FitArguments& arguments) {
  const std::string date = date_now();
  const std::atomic<bool>& stop = catch_interrupts();
  Case c = load_case(options);
  if (!arguments.measured.empty()) {
    std::vector<Override> overrides = c.overrides;
    for (Override& file : measured_files(c, arguments.measured)) overrides.push_back(std::move(file));
    c = read_case_text(c.text, c.file, c.directory, overrides);  // a case from a pipe can be read only once
  }
  const std::string statement = statement_of(options.input);
  const RunFolder folder(folder_path(options, c, "fit"),
                         options.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh);
  Progress progress = stderr_progress(options.quiet);
  IdentificationOptions with;
  with.stop = &stop;
  with.progress = [&](const std::string& stage, int iteration, double cost) {
    progress.update(std::min(1.0, static_cast<double>(iteration) / c.fit.iterations),
                    fmt::format("{}: iteration {}, cost {:.6g}", stage, iteration, cost));
  };
  const Identification result = identify(c, with);
  progress.clear();

  write_or_refuse([&] { write_file(folder.case_file(), case_text(c, statement)); });
  std::vector<std::string> files = {"case.toml"};
  if (result.trusted) {
    const Case fitted = fitted_case(c, result);
    write_or_refuse([&] { write_file(folder.fitted(), case_text(fitted, statement)); });
    files.push_back("fitted.toml");
  }
  const DocumentControl control = document_control(c, date, folder.case_file());
  if (result.usable && !result.interrupted)
    write_or_refuse([&] { write_file(folder.report(), fit_report(c, result, files, control)); });
  const std::string summary = fit_summary(c, result, files, date);
  write_or_refuse([&] { write_file(folder.summary(), summary); });  // last: its presence says that all is there
  for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
  if (options.json)
    fmt::print("{}", summary);
  else if (!options.quiet && result.usable && !result.interrupted)
    print_result(result, files, folder);
  if (result.interrupted) spdlog::warn("interrupted before the fit was done");
  if (!result.usable && !result.interrupted) spdlog::error("{}", result.message);
  return exit_code(result);
}

}  // namespace stillhook
