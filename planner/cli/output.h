// Standard output as something that can fail: a full disk, a closed pipe.
#pragma once

#include <string>

#include "sim/error.h"

namespace stillhook {

/// Standard output cannot be written; what() is a sentence with the reason.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// Hands everything printed to the system and returns `code`. Throws OutputError if some of it did not arrive.
int complete_output(int code);

/// The same as a sentence, for a failure that showed before the end, of which errno was `known`; empty if all went
/// well.
std::string output_fault(int known = 0);

/// Gives standard streams that are closed a file that refuses them: else the first file of the run would take their
/// place.
void occupy_closed_streams();

}  // namespace stillhook
