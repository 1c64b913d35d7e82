// The part of the report that runs in the browser (viewer/), bundled at build time and carried inside the program.
#pragma once

#include <string_view>

namespace stillhook {

/// The script, which a page may put between <script> and </script> as it is; empty in a program built without npm.
std::string_view viewer_script();
/// Its style sheet.
std::string_view viewer_style();
/// What a content security policy calls it: "sha256-...".
std::string_view viewer_hash();
/// Names, versions and licence texts of the libraries in it.
std::string_view viewer_licences();
/// Why there is no script, as a sentence; empty if there is one.
std::string_view viewer_missing();

}  // namespace stillhook
