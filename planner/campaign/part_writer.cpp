#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "planner/campaign/campaign_folder.h"
#include "planner/campaign/parts.h"
#include "results/files.h"
#include "results/json_number.h"
#include "results/summary.h"
#include "sim/error.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

/// Names come from case files: bytes that are not UTF-8 are replaced.
std::string json_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

[[noreturn]] void fail_on(const std::string& path, const char* what) {
  throw FileError(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

}  // namespace

std::string result_line(const std::string& key, const RunWanted& at, const LiftValues& lift, double wall) {
  Json values = Json::array();
  for (const std::vector<double>& row : lift.values) {
    Json& of_criterion = values.emplace_back(Json::array());
    for (const double value : row) of_criterion.push_back(json_number(value));
  }
  return json_line({{"result", key},
                    {"seed", at.seed},
                    {"hs_m", at.height},
                    {"status", status_name(lift.status)},
                    {"message", lift.message},
                    {"values", values},
                    {"wall_s", wall}});
}

PartWriter::PartWriter(const std::string& folder, std::size_t task) {
  std::error_code error;
  std::filesystem::create_directories(parts_path(folder), error);
  int attempt = 0;
  do {
    path_ = fmt::format("{}/{}.{}.jsonl", parts_path(folder), task, ++attempt);
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail_on(path_, "cannot be made");
  line(json_line({{"attempt", attempt},
                  {"task", task},
                  {"pid", static_cast<long>(::getpid())},
                  {"host", host_name()},
                  {"arithmetic", arithmetic_fingerprint()}}));
}

PartWriter::~PartWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PartWriter::line(const std::string& text, bool flush) {
  const std::lock_guard lock(mutex_);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_on(path_, "cannot be written");
    done += static_cast<std::size_t>(written);
  }
  if (flush && ::fsync(descriptor_) != 0) fail_on(path_, "cannot be written");
}

// A power cut may take this line away. What matters is that it outlives the process: a machine that is lost leaves no
// mark by which a run would be looked at again.
void PartWriter::begin(const std::string& key) { line(json_line({{"begin", key}}), false); }

void PartWriter::result(const std::string& key, const RunWanted& at, const LiftValues& lift, double wall) {
  line(result_line(key, at, lift, wall));
}

void PartWriter::crashed(const std::string& key, const RunWanted& at) {
  line(json_line({{"crashed", key}, {"seed", at.seed}, {"hs_m", at.height}}));
}

void mark_crash(const std::string& folder, std::size_t task, int signal) {
  int attempt = 0;
  while (std::filesystem::exists(fmt::format("{}/{}.{}.jsonl", parts_path(folder), task, attempt + 1))) ++attempt;
  if (attempt == 0) return;  // it ended before it had begun anything
  write_file(fmt::format("{}/{}.{}.crash", parts_path(folder), task, attempt), fmt::format("{}\n", signal));
}

}  // namespace stillhook
