#include "planner/cli/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace stillhook {

std::string output_fault(int known) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int reason = known != 0 ? known : errno;
  if (flushed && std::ferror(stdout) == 0) return {};
  // After an earlier failure the reason is not known any more.
  return std::string("standard output cannot be written") +
         (reason != 0 ? std::string(": ") + std::strerror(reason) : std::string()) +
         "; what was to be printed is lost, files of the run are in its folder";
}

void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
}

int complete_output(int code) {
  if (const std::string fault = output_fault(); !fault.empty()) throw OutputError(fault);
  return code;
}

}  // namespace stillhook
