#pragma once

#include <stdexcept>

namespace stillhook {

/// A file cannot be read or written; what() names it and the reason, in one sentence.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace stillhook
