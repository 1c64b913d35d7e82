// What the verbs of the command line share: options, exit codes, the case that they read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/run_folder.h"
#include "problems/case.h"

namespace stillhook {

enum ExitCode : int {
  kDone = 0,
  kBug = 1,
  kBadInput = 2,
  kLimitViolated = 3,  // done, but a limit is violated or no feasible plan was found
  kNumericalFailure = 4,
  kInterrupted = 130  // after Ctrl-C, with what was reached so far saved
};

struct ExitMeaning {
  int code;
  const char* text;
};
inline constexpr ExitMeaning kExitMeanings[] = {
    {kDone, "Done."},
    {kBug, "A bug in stillhook; please report it."},
    {kBadInput, "Bad input or usage, or a file that cannot be written."},
    {kLimitViolated, "Done, but a limit is violated or no plan within the limits was found."},
    {kNumericalFailure, "Numerical failure: the run diverged, and the message says where."},
    {kInterrupted, "Ended by Ctrl-C, with what was reached so far saved."}};

struct CommonOptions {
  std::string input;              // case file; for `report` the run folder
  std::vector<std::string> sets;  // KEY=VALUE
  std::string out;                // empty = runs/<case>-<verb>
  bool force = false, json = false, quiet = false;
  std::optional<int> seed;
  int threads = 0;  // 0 = all cores
  std::string colour = "auto";
};

/// The case file with every --set, and what else the verb sets on top. Throws CaseError and UsageError.
Case load_case(const CommonOptions& options, const std::vector<Override>& more = {});

/// The same with `text` in place of what the case file holds.
Case load_case_text(const CommonOptions& options, const std::string& text, const std::vector<Override>& more = {});

/// The comment that a case file opens with, without its '#': the problem in words. Empty if there is none.
std::string statement_of(const std::string& case_file);

/// The resolved case with its statement on top and its remarks on sources, as a file that read_case() takes.
std::string case_text(const Case& c, const std::string& statement);

/// Calls what writes a file; a failure (no space, no permission) becomes a UsageError with the same sentence.
template <class F>
void write_or_refuse(F write) {
  try {
    write();
  } catch (const std::runtime_error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace stillhook
