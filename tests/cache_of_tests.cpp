// A test program that is started by hand keeps the coefficients that it computes with the build, as under CTest, and
// leaves the user's own cache alone: a change of the method is then tested with what it gives.
#include <cstdlib>

namespace {

[[maybe_unused]] const int kCacheIsOfTheBuild = setenv("STILLHOOK_CACHE", STILLHOOK_TEST_CACHE, 0);

}  // namespace
