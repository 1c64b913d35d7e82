// The end of a long computation because the user asked for it.
#pragma once

#include <stdexcept>

namespace stillhook {

/// Thrown by a computation whose progress callback says that it shall stop.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace stillhook
