// What is wrong with a command line, with the nearest word that would have been right.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace stillhook {

/// One sentence. `words`: the command line without the program's name.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace stillhook
