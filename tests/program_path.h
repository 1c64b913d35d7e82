// Where the program is that tests start.
#pragma once

#include <cstdlib>
#include <string>

namespace stillhook {

/// That of the build, or another that STILLHOOK_TEST_PROGRAM names: one with sanitizers (tests/rotation).
inline std::string program_path() {
  const char* other = std::getenv("STILLHOOK_TEST_PROGRAM");
  return other ? other : STILLHOOK_PROGRAM;
}

}  // namespace stillhook
