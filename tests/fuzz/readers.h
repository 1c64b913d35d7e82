// The readers of files, as the fuzzer sees them.
#pragma once

#include <string>
#include <vector>

namespace stillhook::fuzz {

struct Reader {
  std::string name;
  std::string file;                // name of the input file: readers choose by its end
  std::vector<std::string> seeds;  // contents of good files
  /// Reads the file. Returns the sentence of a refusal with the reader's own error, which is no fault; empty when the
  /// file is taken. Any other exception, a signal, a hang or a request for too much memory is a fault.
  std::string (*read)(const std::string& path);
  std::string program_case = {};   // a case for `stillhook check` that reads the file; empty: the file is no part of one
  std::vector<std::string> faults = {};  // contents of files that a reader once failed at
};

/// All of them. `folder`: where seeds that only a library can write are made, with files that belong to an input.
std::vector<Reader> readers(const std::string& folder);

}  // namespace stillhook::fuzz
