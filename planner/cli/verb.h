// A verb of the command line: its options as data, and what it does. The parser, the completions and the manual page
// are made from these; planner/verbs/verbs.cpp lists the verbs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/cli/commands.h"

namespace stillhook {

/// One option, or one positional argument.
struct VerbOption {
  using Target = std::variant<bool*, int*, std::string*, std::optional<int>*, std::optional<double>*,
                              std::vector<std::string>*, std::vector<double>*>;
  std::string name;  // "--draw"; "CASE" for a positional argument
  Target target;
  std::string operand;  // "FILE"; empty for a flag. CASE, DIR, RUN_DIR, FILE and "a|b" are known to the completions
  std::string help;
  std::optional<std::pair<double, double>> range = {};  // of numbers, both ends allowed
  bool positive = false;                                // of numbers: > 0
  std::string excludes = {};                            // an option that cannot stand beside it
  char delimiter = 0;                                   // of a list within one operand; otherwise it may be repeated
  bool required = false;
};

/// The options of one verb while it collects them.
class VerbOptions {
 public:
  explicit VerbOptions(CommonOptions& common) : common_(common) {}

  void add(VerbOption option) { all_.push_back(std::move(option)); }
  // What verbs share.
  void add_case();                        // CASE, --set, --json, --quiet, --color
  void add_run_folder(const char* help);  // RUN_DIR of a former run
  void add_messages(const char* quiet);   // --quiet, --color
  void add_threads();                     // --threads
  void add_folder();                      // --out, --force, --threads
  void add_seed(const char* help);        // --seed
  void add_force(const char* help);       // --force

  CommonOptions& common() { return common_; }
  const std::vector<VerbOption>& all() const { return all_; }

 private:
  CommonOptions& common_;
  std::vector<VerbOption> all_;
};

class Verb {
 public:
  virtual ~Verb() = default;
  virtual std::string name() const = 0;
  virtual std::string help() const = 0;
  virtual void add_options(VerbOptions& options) = 0;
  /// Returns an ExitCode. Throws stillhook::Error for what the user can mend.
  virtual int run(const CommonOptions& options) = 0;
  /// Files of its own that it leaves in the folder of a run.
  virtual std::vector<RunFile> files() const { return {}; }
};

}  // namespace stillhook
