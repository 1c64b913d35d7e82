// SHA-256 (FIPS 180-4): a name for a file's content that other programs find, too (`sha256sum case.toml`).
#pragma once

#include <string>
#include <string_view>

namespace stillhook {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace stillhook
