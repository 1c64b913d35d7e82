// What the attempts at a task of a campaign have left: JSON lines. A result is on the disk before the next run begins.
//
//     {"attempt": 1, "task": 3, "pid": 4711, "host": "n1", "arithmetic": "..."}
//     {"begin": KEY}                      before every run
//     {"result": KEY, "seed", "hs_m", "status", "message", "values": [[...]], "wall_s"}      after it
//     {"crashed": KEY, "seed", "hs_m"}    two attempts were ended in this run by a signal of their own making
//
// KEY is the SHA-256 of the manifest's hash, the task, the bits of Hs and the seed. An attempt makes a file of its own;
// a last line that is torn is ignored.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "planner/operability/column.h"
#include "planner/operability/criteria.h"

namespace stillhook {

/// A run as a part holds it.
struct PartRun {
  RunWanted at;
  bool crashed = false;
  LiftValues lift;
  double wall = 0.0;  // s
  std::string host, arithmetic;
  int attempt = 0;
};

/// Names runs of one task.
class RunKeys {
 public:
  RunKeys(std::string identity, std::size_t task) : identity_(std::move(identity)), task_(task) {}
  std::string key(const RunWanted& run) const;

 private:
  std::string identity_;
  std::size_t task_;
};

/// What is known of a task.
struct TaskParts {
  std::map<RunWanted, PartRun> runs;
  std::map<std::string, int> crashes;  // by key: attempts that a signal ended in that run
  std::set<std::string> arithmetic, hosts;
  int attempts = 0, repeated = 0;  // repeated: results that two attempts have, equal
  double wall = 0.0;               // s, of all results, repeated ones included
  std::size_t bytes = 0;
};

/// Reads every part of a task. Throws FileError: a line that is broken though others follow, a result that belongs to
/// another campaign, two results of one run that differ.
TaskParts read_parts(const std::string& folder, const std::string& identity, std::size_t task);

/// How many results the parts of all tasks hold, by a count of lines.
std::size_t count_results(const std::string& folder);

/// Of one task.
std::size_t count_results(const std::string& folder, std::size_t task);

/// Leaves the mark that the newest attempt at a task was ended by a signal of its own making.
void mark_crash(const std::string& folder, std::size_t task, int signal);

/// SHA-256 over runs of tasks in order, without times and hosts.
class ResultsHash {
 public:
  void add(std::size_t task, const std::map<RunWanted, PartRun>& runs);
  std::string hash() const;

 private:
  std::string text_;
};

/// The lines of one attempt. Its methods may be called from several threads.
class PartWriter {
 public:
  /// Makes the next file of the task. Throws FileError.
  PartWriter(const std::string& folder, std::size_t task);
  ~PartWriter();
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;

  void begin(const std::string& key);
  void result(const std::string& key, const RunWanted& at, const LiftValues& lift, double wall);
  void crashed(const std::string& key, const RunWanted& at);

 private:
  void line(const std::string& text, bool flush = true);

  std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
};

/// The line of a result, for an estimate of its size.
std::string result_line(const std::string& key, const RunWanted& at, const LiftValues& lift, double wall);

}  // namespace stillhook
