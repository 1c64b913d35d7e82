#pragma once

namespace stillhook {

/// The program's version, as in CMakeLists.txt.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace stillhook
