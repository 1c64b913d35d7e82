#include "planner/run_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

namespace stillhook {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles = {"case.toml",
                               "summary.json",
                               "history.nc",
                               "history.csv",
                               "history.xlsx",
                               "report.html",
                               "plan.toml",
                               "fitted.toml",
                               "tuned.toml",
                               "evaluations.sqlite",
                               "evaluations.sqlite-wal",
                               "evaluations.sqlite-shm",
                               "front.sqlite",
                               "front.sqlite-wal",
                               "front.sqlite-shm",
                               "judgement.json"};

/// What a run that was killed left half written.
bool is_unfinished(const fs::path& file) {
  const std::string name = file.filename().string();
  return std::any_of(kFiles.begin(), kFiles.end(),
                     [&](const char* of) { return name.starts_with(std::string(of) + ".part-"); });
}

/// coefficients-<set>.csv and the like.
bool is_coefficient_file(const fs::path& file) {
  const std::string name = file.filename().string(), ending = file.extension().string();
  return name.starts_with("coefficients-") &&
         (ending == ".csv" || ending == ".h5" || ending == ".1" || ending == ".3" || ending == ".hst");
}

bool holds_a_run(const fs::path& path) {
  return fs::exists(path / "case.toml") || fs::exists(path / "summary.json") || fs::exists(path / "evaluations.sqlite");
}

FolderLock opened(const fs::path& path, RunFolder::Mode mode) {
  const std::string name = path.string();
  const bool exists = fs::exists(path);
  if (exists && !fs::is_directory(path)) throw UsageError(name + ": is a file, a run needs a folder");
  const bool only_goes_on = mode == RunFolder::Mode::resume || mode == RunFolder::Mode::read;
  if (!exists && only_goes_on) throw UsageError(name + ": does not exist, there is nothing to resume");
  fs::create_directories(path);
  return mode == RunFolder::Mode::read ? FolderLock() : FolderLock(name);
}

/// Makes room for the run. The folder is locked: nobody else is in it.
void prepare(const fs::path& path, RunFolder::Mode mode) {
  const std::string name = path.string();
  const bool occupied = !fs::is_empty(path);
  switch (mode) {
    case RunFolder::Mode::fresh:
      if (occupied) throw UsageError(name + ": exists already; use --force to replace the run in it, or another --out");
      break;
    case RunFolder::Mode::replace:
      if (occupied && !holds_a_run(path))
        throw UsageError(name + ": holds files but no run of stillhook; --force does not touch it, use another --out");
      for (const char* file : kFiles) fs::remove(path / file);
      if (occupied) {
        std::vector<fs::path> former;
        for (const auto& entry : fs::directory_iterator(path))
          if (is_coefficient_file(entry.path()) || is_unfinished(entry.path())) former.push_back(entry.path());
        for (const fs::path& file : former) fs::remove(file);
      }
      break;
    case RunFolder::Mode::resume:
    case RunFolder::Mode::read:
      break;
  }
}

}  // namespace

RunFolder::RunFolder(std::string path, Mode mode) : path_(std::move(path)) {
  while (path_.size() > 1 && path_.back() == '/') path_.pop_back();
  try {
    lock_ = opened(path_, mode);
    prepare(path_, mode);
  } catch (const fs::filesystem_error& error) {
    throw UsageError(path_ + ": " + error.code().message());
  }
}

std::string default_folder(const Case& c, const std::string& verb) { return "runs/" + c.name + "-" + verb; }

}  // namespace stillhook
