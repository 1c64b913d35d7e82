#include "planner/run_folder.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace stillhook {
namespace {

namespace fs = std::filesystem;

bool matches(const std::string& name, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  return name.size() + 1 >= pattern.size() && name.starts_with(pattern.substr(0, star)) &&
         name.ends_with(pattern.substr(star + 1));
}

/// A file of a run, or what a run that was killed left half written.
bool is_of_a_run(const fs::path& file) {
  const std::string name = file.filename().string(), whole = name.substr(0, name.find(".part-"));
  return std::any_of(run_files().begin(), run_files().end(),
                     [&](const RunFile& of) { return matches(name, of.name) || matches(whole, of.name); });
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
      if (occupied) {
        std::vector<fs::path> former;
        for (const auto& entry : fs::directory_iterator(path))
          if (is_of_a_run(entry.path())) former.push_back(entry.path());
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

std::string default_folder(const std::string& name, const std::string& verb) { return "runs/" + name + "-" + verb; }

}  // namespace stillhook
