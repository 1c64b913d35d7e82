#pragma once

namespace stillhook {

/// The program's version: that of the project in CMakeLists.txt.
extern const char* const kVersion;

}  // namespace stillhook
