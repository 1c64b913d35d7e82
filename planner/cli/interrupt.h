#pragma once

#include <atomic>

namespace stillhook {

/// From now on the first SIGINT or SIGTERM sets the returned flag, and the second one kills the process.
const std::atomic<bool>& catch_interrupts();

}  // namespace stillhook
