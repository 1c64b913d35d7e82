#include "results/safe_netcdf.h"

#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include "results/files.h"

namespace stillhook {
namespace {

constexpr rlim_t kSeconds = 3;               // of processor time, and one more for each megabyte
constexpr rlim_t kMemory = rlim_t{1} << 30;  // bytes beyond what the process has
constexpr rlim_t kMemoryPerByte = 64;        // of the file: numbers may be compressed that well
constexpr int kTooMuchMemory = 3;            // exit code of the child

void set_limit(int what, rlim_t value) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource_t>(what), &limit);
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? value : std::min(value, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource_t>(what), &limit);
}

rlim_t address_space() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

[[noreturn]] void be_the_child(const std::function<void()>& read, rlim_t bytes) {
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM})
    std::signal(fatal, SIG_DFL);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, kSeconds + bytes / 1000000);
  set_limit(RLIMIT_AS, address_space() + kMemory + kMemoryPerByte * bytes);
  // Messages of the C library ("free(): invalid pointer") are not for the user.
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(0);
  int code = 0;
  try {
    read();
  } catch (const std::bad_alloc&) {
    code = kTooMuchMemory;
  } catch (const std::length_error&) {
    code = kTooMuchMemory;
  } catch (...) {
    // A sentence that the parent will hear, too.
  }
  _exit(code);
}

}  // namespace

void try_reading(const std::string& path, const std::function<void()>& read) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const pid_t child = ::fork();
  if (child < 0) return;  // no process is to be had: as it is, then
  if (child == 0) be_the_child(read, error ? 0 : static_cast<rlim_t>(size));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return;
  if (WIFSIGNALED(status))
    throw FileError(
        fmt::format("{}: is damaged: the NetCDF library cannot read it ({})", path,
                    WTERMSIG(status) == SIGXCPU ? "it does not come to an end" : ::strsignal(WTERMSIG(status))));
  if (WIFEXITED(status) && WEXITSTATUS(status) == kTooMuchMemory)
    throw FileError(path + ": is damaged: it says that it holds more than a file of its size can");
}

}  // namespace stillhook
