#include "planner/version.h"

namespace stillhook {

const char* const kVersion = STILLHOOK_VERSION;

}  // namespace stillhook
