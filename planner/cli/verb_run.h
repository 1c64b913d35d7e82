// What every verb that works on a case and leaves a folder does in the same way.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "planner/cli/commands.h"
#include "planner/cli/panel_progress.h"
#include "planner/cli/progress.h"
#include "results/document_control.h"

namespace stillhook {

class VerbRun {
 public:
  /// Starts the clock and catches interrupts. `verb` names the folder. Keeps a reference to the options.
  VerbRun(std::string verb, const CommonOptions& options);

  const CommonOptions& options() const { return options_; }
  /// Set by the first Ctrl-C.
  const std::atomic<bool>& stop() const { return stop_; }
  const std::string& date() const { return date_; }
  double wall() const;  // s since the start
  /// The comment that the case file opens with; known once the folder is open.
  const std::string& statement() const { return statement_; }
  Progress progress() const { return stderr_progress(options_.quiet); }
  HydroProgress panel_progress() const { return panel_method_progress(options_.quiet, &stop_); }

  /// Opens the folder, by default as --force says.
  const RunFolder& open(const Case& c, std::optional<RunFolder::Mode> mode = {});
  /// Opens the folder of a run that has no case, by default runs/<name>-<verb>.
  const RunFolder& open_named(const std::string& name);
  const RunFolder& folder() const { return *folder_; }
  DocumentControl control(const Case& c) const;
  /// Writes a file of the folder whole or not at all; a failure is told as the user's to mend.
  void write(const std::string& path, const std::string& text) const;
  void write_case(const std::string& path, const Case& c) const;
  /// Leaves case.toml: from then on the folder holds a run, which a later one replaces with --force only.
  void keep_case(const Case& c) const { write_case(folder().case_file(), c); }
  /// Writes summary.json, the last file: its presence says that all is there. Prints it with --json.
  void conclude(const std::string& summary_json) const;
  /// True if the verb prints tables: neither --json nor --quiet.
  bool prints() const { return !options_.json && !options_.quiet; }

 private:
  std::string verb_;
  const CommonOptions& options_;
  std::chrono::steady_clock::time_point begin_;
  std::string date_;
  const std::atomic<bool>& stop_;
  std::string statement_;
  std::optional<RunFolder> folder_;
};

}  // namespace stillhook
