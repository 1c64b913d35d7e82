#include "planner/campaign/parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/campaign/campaign_folder.h"
#include "results/json_number.h"
#include "results/sha256.h"
#include "results/summary.h"
#include "sim/error.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Task and attempt of a name like "3.1.jsonl".
std::optional<std::pair<std::size_t, int>> numbers_of(const fs::path& file, const char* extension) {
  if (file.extension() != extension) return std::nullopt;
  const std::string name = file.stem().string();
  const std::size_t dot = name.find('.');
  const auto digits = [](const std::string& text) {
    return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
  };
  if (dot == std::string::npos || !digits(name.substr(0, dot)) || !digits(name.substr(dot + 1))) return std::nullopt;
  return std::pair(static_cast<std::size_t>(std::stoul(name.substr(0, dot))), std::stoi(name.substr(dot + 1)));
}

/// Files of a task by attempt.
std::map<int, std::string> files_of(const std::string& folder, std::size_t task, const char* extension) {
  std::map<int, std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parts_path(folder), error))
    if (const auto numbers = numbers_of(entry.path(), extension); numbers && numbers->first == task)
      files[numbers->second] = entry.path().string();
  return files;
}

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_result(const PartRun& a, const PartRun& b) {
  if (a.crashed != b.crashed || a.lift.status != b.lift.status || a.lift.values.size() != b.lift.values.size())
    return false;
  for (std::size_t k = 0; k < a.lift.values.size(); ++k)
    if (!std::equal(a.lift.values[k].begin(), a.lift.values[k].end(), b.lift.values[k].begin(), b.lift.values[k].end(),
                    same_bits))
      return false;
  return true;
}

RunStatus status_named(const std::string& name) {
  for (const RunStatus status : {RunStatus::completed, RunStatus::failed, RunStatus::diverged})
    if (name == status_name(status)) return status;
  throw FileError("has a result of status \"" + name + "\"");
}

/// Reads one part.
class PartReader {
 public:
  PartReader(std::string path, int attempt, const RunKeys& keys, TaskParts& parts)
      : path_(std::move(path)), attempt_(attempt), keys_(keys), parts_(parts) {}

  /// Keys of the runs that were under way when it ended.
  std::set<std::string> read() {
    std::ifstream in(path_, std::ios::binary);
    if (!in) throw FileError(path_ + ": cannot be read");
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      parts_.bytes += line.size() + 1;
      const bool whole = !in.eof();  // a line without its end is torn, whatever it says
      try {
        if (whole) take(Json::parse(line));
      } catch (const nlohmann::json::exception& error) {
        if (in.peek() != std::ifstream::traits_type::eof())
          throw FileError(fmt::format("{}:{}: is damaged: {}", path_, number, error.what()));
      } catch (const FileError& error) {
        throw FileError(fmt::format("{}:{}: {}", path_, number, error.what()));
      }
    }
    return open_;
  }

 private:
  void take(const Json& line) {
    if (line.contains("attempt")) {
      arithmetic_ = line.at("arithmetic").get<std::string>();
      host_ = line.at("host").get<std::string>();
      parts_.arithmetic.insert(arithmetic_);
      parts_.hosts.insert(host_);
    } else if (line.contains("begin")) {
      open_.insert(line.at("begin").get<std::string>());
    } else if (line.contains("result")) {
      add(line, line.at("result").get<std::string>());
    } else if (line.contains("crashed")) {
      add(line, line.at("crashed").get<std::string>());
    }
  }

  void add(const Json& line, const std::string& key) {
    PartRun run;
    run.at = {line.at("seed").get<int>(), line.at("hs_m").get<double>()};
    run.crashed = line.contains("crashed");
    run.attempt = attempt_;
    run.host = host_;
    run.arithmetic = arithmetic_;
    if (!run.crashed) {
      run.lift.status = status_named(line.at("status").get<std::string>());
      run.lift.message = line.at("message").get<std::string>();
      for (const Json& row : line.at("values")) {
        run.lift.values.emplace_back();
        for (const Json& value : row) run.lift.values.back().push_back(number_of(value));
      }
      run.wall = line.at("wall_s").get<double>();
    }
    if (key != keys_.key(run.at)) throw FileError("has a result of another campaign or task");
    open_.erase(key);
    parts_.wall += run.wall;
    keep(run);
  }

  void keep(const PartRun& run) {
    const auto [known, is_new] = parts_.runs.emplace(run.at, run);
    if (is_new) return;
    if (known->second.crashed != run.crashed) {  // it did run after all
      if (known->second.crashed) known->second = run;
      return;
    }
    ++parts_.repeated;
    if (!same_result(known->second, run))
      throw FileError(fmt::format(
          "seed {} at {:.17g} m gave other values than in attempt {} on {}: the program or a machine is not "
          "deterministic (arithmetic {} and {})",
          run.at.seed, run.at.height, known->second.attempt, known->second.host, known->second.arithmetic,
          run.arithmetic));
  }

  std::string path_;
  int attempt_;
  const RunKeys& keys_;
  TaskParts& parts_;
  std::set<std::string> open_;
  std::string host_, arithmetic_;
};

std::size_t count_in(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("{\"result\"") || line.starts_with("{\"crashed\"")) ++count;
  return count;
}

}  // namespace

std::string RunKeys::key(const RunWanted& run) const {
  return sha256(fmt::format("{} {} {:016x} {}", identity_, task_, std::bit_cast<std::uint64_t>(run.height), run.seed));
}

TaskParts read_parts(const std::string& folder, const std::string& identity, std::size_t task) {
  TaskParts parts;
  const RunKeys keys(identity, task);
  const std::map<int, std::string> marks = files_of(folder, task, ".crash");
  for (const auto& [attempt, path] : files_of(folder, task, ".jsonl")) {
    ++parts.attempts;
    const std::set<std::string> open = PartReader(path, attempt, keys, parts).read();
    if (!marks.contains(attempt)) continue;
    for (const std::string& key : open) ++parts.crashes[key];
  }
  return parts;
}

std::size_t count_results(const std::string& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parts_path(folder), error))
    if (numbers_of(entry.path(), ".jsonl")) count += count_in(entry.path().string());
  return count;
}

std::size_t count_results(const std::string& folder, std::size_t task) {
  std::size_t count = 0;
  for (const auto& [attempt, path] : files_of(folder, task, ".jsonl")) count += count_in(path);
  return count;
}

void ResultsHash::add(std::size_t task, const std::map<RunWanted, PartRun>& runs) {
  for (const auto& [at, run] : runs) {
    text_ += fmt::format("{} {} {:016x} {}", task, at.seed, std::bit_cast<std::uint64_t>(at.height),
                         run.crashed ? "crashed" : status_name(run.lift.status));
    for (const std::vector<double>& row : run.lift.values)
      for (const double value : row)
        text_ += std::isnan(value) ? std::string(" -") : fmt::format(" {:016x}", std::bit_cast<std::uint64_t>(value));
    text_ += "\n";
  }
}

std::string ResultsHash::hash() const { return sha256(text_); }

}  // namespace stillhook
