// The exceptions of stillhook. Everything that it throws on purpose derives from Error; anything else is a defect of the
// program, or too little memory (std::bad_alloc).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace stillhook {

/// Base of all; what() is a sentence for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file cannot be read or written; what() names it and the reason, in one sentence.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A specification that cannot be built: which entry ("wires.hoist_port"), which field of it (may be empty), the rule
/// that is broken and the value, as a sentence.
class SpecificationError : public Error {
 public:
  SpecificationError(std::string entry_, std::string field_, const std::string& sentence)
      : Error(entry_ + (field_.empty() ? "" : "." + field_) + ": " + sentence),
        entry(std::move(entry_)),
        field(std::move(field_)) {}
  std::string entry, field;
};

}  // namespace stillhook
