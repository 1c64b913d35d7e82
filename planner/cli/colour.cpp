#include "planner/cli/colour.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace stillhook {
namespace {

bool on_stdout = false;

}  // namespace

bool wants_colour(ColourWish wish, int descriptor) {
  if (wish != ColourWish::automatic) return wish == ColourWish::always;
  const char *no_colour = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  if (no_colour && *no_colour) return false;
  return isatty(descriptor) == 1 && terminal && std::string_view(terminal) != "dumb";
}

void set_stdout_colour(bool on) { on_stdout = on; }

std::string coloured(Colour colour, const std::string& text) {
  if (!on_stdout || text.empty()) return text;
  const char* code = colour == Colour::good      ? "32"
                     : colour == Colour::bad     ? "1;31"
                     : colour == Colour::caution ? "33"
                                                 : "1";
  return std::string("\x1b[") + code + "m" + text + "\x1b[0m";
}

}  // namespace stillhook
