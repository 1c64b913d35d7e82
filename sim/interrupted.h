// The end of a long computation because the user asked for it.
#pragma once

#include "sim/error.h"

namespace stillhook {

/// Thrown by a computation whose progress callback says that it shall stop.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace stillhook
