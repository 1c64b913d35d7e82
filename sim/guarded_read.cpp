#include "sim/guarded_read.h"

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

namespace stillhook {
namespace {

constexpr rlim_t kSeconds = 3;               // of processor time, and one more for each megabyte
constexpr rlim_t kMemory = rlim_t{1} << 30;  // bytes beyond what the process has
constexpr rlim_t kMemoryPerByte = 64;        // of the file: numbers may be compressed that well

// Exit codes of the child; unlike those of a library that ends the process.
constexpr int kWhole = 71, kSentence = 72, kTooMuchMemory = 73, kNoPipe = 74;

// The sanitizers reserve terabytes of address space, and no limit on it can be set beneath them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsLimited = false;
#else
constexpr bool kMemoryIsLimited = true;
#endif

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

/// Closing the library makes it walk through all that it holds, and so finds a heap that a damaged file has spoiled.
/// Not while files of the parent are open: the child would write into them.
void close_library() {
  if (H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_FILE) == 0) H5close();
}

void send(int pipe, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::write(pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(kNoPipe);
    sent += static_cast<std::size_t>(n);
  }
}

std::string receive(int pipe) {
  std::string text;
  char buffer[65536];
  for (;;) {
    const ssize_t n = ::read(pipe, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

[[noreturn]] void be_the_child(const std::function<std::string()>& read, rlim_t bytes, int pipe) {
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM, SIGPIPE})
    std::signal(fatal, SIG_DFL);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, kSeconds + bytes / 1000000);
  if (kMemoryIsLimited) set_limit(RLIMIT_AS, address_space() + kMemory + kMemoryPerByte * bytes);
  // Messages of the C library ("free(): invalid pointer") are not for the user.
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(kNoPipe);
  int code = kWhole;
  std::string result;
  try {
    result = read();
    close_library();
  } catch (const std::bad_alloc&) {
    code = kTooMuchMemory;
  } catch (const std::length_error&) {
    code = kTooMuchMemory;
  } catch (const std::exception& error) {
    code = kSentence;
    result = error.what();
  }
  send(pipe, result);
  _exit(code);
}

}  // namespace

std::string read_in_child(const std::string& path, const std::function<std::string()>& read) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  int ends[2];
  if (::pipe(ends) != 0) throw FileError(path + ": cannot be read safely: " + std::strerror(errno));
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(read, error ? 0 : static_cast<rlim_t>(size), ends[1]);
  }
  const int fork_error = errno;
  ::close(ends[1]);
  const std::string result = child > 0 ? receive(ends[0]) : std::string();
  ::close(ends[0]);
  if (child < 0) throw FileError(path + ": cannot be read safely: " + std::strerror(fork_error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw FileError(path + ": cannot be read safely: " + std::strerror(errno));
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    throw FileError(path + ": is damaged: the HDF5 library cannot read it (" +
                    (signal == SIGXCPU ? "it does not come to an end" : ::strsignal(signal)) + ")");
  }
  const int code = WEXITSTATUS(status);
  if (code == kSentence) throw FileError(result);
  if (code == kTooMuchMemory)
    throw FileError(path + ": is damaged: it says that it holds more than a file of its size can");
  if (code != kWhole) throw FileError(path + ": is damaged: the HDF5 library ended its process");
  return result;
}

void try_reading(const std::string& path, const std::function<void()>& read) {
  read_in_child(path, [&read] {
    read();
    return std::string();
  });
}

}  // namespace stillhook
