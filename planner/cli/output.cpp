#include "planner/cli/output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace stillhook {

std::string output_fault() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  if (flushed && std::ferror(stdout) == 0) return {};
  // After an earlier failure the reason is not known any more.
  return std::string("standard output cannot be written") +
         (reason != 0 ? std::string(": ") + std::strerror(reason) : std::string()) +
         "; what was to be printed is lost, files of the run are in its folder";
}

int complete_output(int code) {
  if (const std::string fault = output_fault(); !fault.empty()) throw OutputError(fault);
  return code;
}

}  // namespace stillhook
