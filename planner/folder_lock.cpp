#include "planner/folder_lock.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>

#include "planner/run_folder.h"

namespace stillhook {
namespace {

/// Process that holds a lock on this inode, by /proc/locks ("1: FLOCK  ADVISORY  WRITE 4711 08:01:131090 0 EOF"); 0 if
/// it does not say.
long holder_of(ino_t inode) {
  std::ifstream locks("/proc/locks");
  const std::string tail = ":" + std::to_string(inode);
  for (std::string line; std::getline(locks, line);) {
    std::istringstream in(line);
    std::string number, kind, manner, access, place;
    long process = 0;
    if (in >> number >> kind >> manner >> access >> process >> place && kind == "FLOCK" && place.ends_with(tail))
      return process;
  }
  return 0;
}

std::string command_of(long process) {
  std::ifstream in(fmt::format("/proc/{}/cmdline", process), std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  while (!text.empty() && text.back() == '\0') text.pop_back();
  std::replace(text.begin(), text.end(), '\0', ' ');
  if (text.size() > 120) text = text.substr(0, 117) + "...";
  return text;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;  // what is wrong with the folder shows in writing into it
  descriptor_ = std::shared_ptr<const int>(new int(fd), [](const int* held) {
    ::close(*held);
    delete held;
  });
  if (::flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  struct stat info = {};
  const long process = ::fstat(fd, &info) == 0 ? holder_of(info.st_ino) : 0;
  const std::string command = process > 0 ? command_of(process) : std::string();
  throw UsageError(
      fmt::format("{}: another run is writing into this folder, {}{}; wait until it ends, or use another --out", folder,
                  process > 0 ? fmt::format("process {}", process) : "of a process unknown",
                  command.empty() ? "" : " (" + command + ")"));
}

}  // namespace stillhook
