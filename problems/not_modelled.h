// What engineers look for in a case and stillhook does not have, so that a key of that name gets an answer and not a
// list.
#pragma once

#include <string>

namespace stillhook {

/// "stillhook does not model wind yet ..." for a key or a choice that names such a thing; empty for any other.
std::string not_modelled(const std::string& word);

}  // namespace stillhook
