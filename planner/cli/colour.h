// Colours of what the verbs print. They say nothing that the words beside them do not say too.
#pragma once

#include <string>

namespace stillhook {

enum class ColourWish { automatic, always, never };

/// Whether a stream (its file descriptor) gets colours: as wished, and automatically on a terminal that has them unless
/// NO_COLOR is set to anything but nothing (https://no-color.org).
bool wants_colour(ColourWish wish, int descriptor);

/// Whether coloured() does anything from now on; not before the first call.
void set_stdout_colour(bool on);

enum class Colour { good, bad, caution, strong };
std::string coloured(Colour colour, const std::string& text);

}  // namespace stillhook
