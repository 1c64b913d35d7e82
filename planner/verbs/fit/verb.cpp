#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/fit/fit_report.h"
#include "planner/verbs/verbs.h"
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
        throw UsageError(
            fmt::format("--measured {}: for which record of the case? Write --measured RECORD=FILE; its "
                        "[[fit.records]] say what the columns are",
                        argument));
    }
    const std::string file = absolute_file(named ? argument.substr(equals + 1) : argument);
    const auto [first, is_new] = taken.emplace(record, file);
    if (!is_new)
      throw UsageError(
          fmt::format("--measured {}: record \"{}\" has a file already, {}; a record is one file: give it "
                      "once, or write another [[fit.records]]",
                      argument, record, first->second));
    files.push_back({"fit.records." + record + ".file", "'" + file + "'"});
  }
  return files;
}

void print_result(const Identification& result, const std::vector<std::string>& files, const RunFolder& folder) {
  fmt::print("{}\n\n{}\n{}", verdict_of(result), table_text(estimate_table(result)),
             table_text(residual_table(result)));
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

class FitVerb final : public Verb {
 public:
  std::string name() const override { return "fit"; }
  std::string help() const override { return "Estimate parameters of the case from measured runs, with intervals"; }
  void add_options(VerbOptions& o) override {
    o.add_case();
    o.add_folder();
    o.add({"--measured", &measured_, "FILE",
           "Measured run (CSV or NetCDF) for the record of the case that has no file; RECORD=FILE names the record; "
           "may be "
           "repeated"});
  }
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override { return {{"fitted.toml", "The case with the estimates in it."}}; }

 private:
  Case load(const CommonOptions& options) const;

  std::vector<std::string> measured_;  // FILE or RECORD=FILE
};

Case FitVerb::load(const CommonOptions& options) const {
  Case c = load_case(options);
  if (measured_.empty()) return c;
  std::vector<Override> overrides = c.overrides;
  for (Override& file : measured_files(c, measured_)) overrides.push_back(std::move(file));
  return read_case_text(c.text, c.file, c.directory, overrides);  // a case from a pipe can be read only once
}

int FitVerb::run(const CommonOptions& options) {
  VerbRun verb(name(), options);
  const Case c = load(options);
  const RunFolder& folder = verb.open(c);
  Progress progress = verb.progress();
  IdentificationOptions with;
  with.stop = &verb.stop();
  with.progress = [&](const std::string& stage, int iteration, double cost) {
    progress.update(std::min(1.0, static_cast<double>(iteration) / c.fit.iterations),
                    fmt::format("{}: iteration {}, cost {:.6g}", stage, iteration, cost));
  };
  const Identification result = identify(c, with);
  progress.clear();

  verb.keep_case(c);
  std::vector<std::string> files = {"case.toml"};
  if (result.trusted) {
    verb.write_case(folder.fitted(), fitted_case(c, result));
    files.push_back("fitted.toml");
  }
  const bool whole = result.usable && !result.interrupted;
  if (whole) verb.write(folder.report(), fit_report(c, result, files, verb.control(c)));
  verb.conclude(fit_summary(c, result, files, verb.date()));
  print_warnings(result.warnings);
  if (verb.prints() && whole) print_result(result, files, folder);
  if (result.interrupted) spdlog::warn("interrupted before the fit was done");
  if (!result.usable && !result.interrupted) spdlog::error("{}", result.message);
  return exit_code(result);
}

}  // namespace

std::unique_ptr<Verb> fit_verb() { return std::make_unique<FitVerb>(); }

}  // namespace stillhook
