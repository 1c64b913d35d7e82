// Standard output as something that can fail: a full disk, a closed pipe.
#pragma once

#include <stdexcept>
#include <string>

namespace stillhook {

/// Standard output cannot be written; what() is a sentence with the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Hands everything printed to the system and returns `code`. Throws OutputError if some of it did not arrive.
int complete_output(int code);

/// The same as a sentence, for a failure that showed before the end; empty if all went well so far.
std::string output_fault();

}  // namespace stillhook
