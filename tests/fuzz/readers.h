// The readers of files, as the fuzzer sees them.
#pragma once

#include <string>
#include <vector>

namespace stillhook::fuzz {

struct Reader {
  std::string name;
  std::string file;                // name of the input file: readers choose by its end
  std::vector<std::string> seeds;  // contents of good files
  /// Reads the file. Returns whether it was taken; a refusal with the reader's own error is not a fault. Any other
  /// exception, a signal, a hang or a request for too much memory is one.
  bool (*read)(const std::string& path);
};

/// All of them. `folder`: where seeds that only a library can write are made.
std::vector<Reader> readers(const std::string& folder);

}  // namespace stillhook::fuzz
