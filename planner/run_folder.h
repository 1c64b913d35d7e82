// The folder that a run leaves. Every file but the store of a search is written whole or not at all.
#pragma once

#include <string>
#include <vector>

#include "planner/folder_lock.h"
#include "problems/case.h"
#include "sim/error.h"

namespace stillhook {

/// The command line asks for something that cannot be done. what() is a sentence.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A file that runs leave in their folders.
struct RunFile {
  std::string name;     // "plan.toml"; a "*" stands for anything
  std::string meaning;  // for the manual
};

/// What any verb may leave (planner/verbs/verbs.cpp): --force removes these and nothing else.
const std::vector<RunFile>& run_files();

class RunFolder {
 public:
  enum class Mode {
    fresh,    // must not exist yet (or be empty)
    replace,  // what a former run left in it is removed; other files stay
    resume,   // must exist and is gone on with
    read      // must exist; nothing of the run itself is written
  };

  /// Makes or opens the folder and, but for `read`, locks it as long as this object lives. Throws UsageError: it exists
  /// (fresh), holds something that is no run (replace), does not exist (resume, read), cannot be made, or another
  /// process writes into it.
  RunFolder(std::string path, Mode mode);

  const std::string& path() const { return path_; }
  std::string case_file() const { return path_ + "/case.toml"; }
  std::string summary() const { return path_ + "/summary.json"; }
  std::string history() const { return path_ + "/history.nc"; }
  std::string report() const { return path_ + "/report.html"; }
  std::string plan() const { return path_ + "/plan.toml"; }
  std::string tuned() const { return path_ + "/tuned.toml"; }
  std::string fitted() const { return path_ + "/fitted.toml"; }
  std::string store() const { return path_ + "/evaluations.sqlite"; }
  std::string front_store() const { return path_ + "/front.sqlite"; }
  std::string judgement() const { return path_ + "/judgement.json"; }
  std::string csv() const { return path_ + "/history.csv"; }  // exports
  std::string xlsx() const { return path_ + "/history.xlsx"; }

 private:
  std::string path_;
  FolderLock lock_;
};

/// runs/<name>-<verb>; the name is the case's, or what a verb without a case calls its run.
std::string default_folder(const std::string& name, const std::string& verb);

}  // namespace stillhook
