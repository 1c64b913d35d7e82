// The command line as data, read off the parser itself, for what is generated from it: completions and the manual.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stillhook {

/// What stands after an option, or in the place of a positional argument.
enum class Operand { none, text, file, folder, case_file, choice };

struct CommandOption {
  std::vector<std::string> names;  // "-h", "--help"; empty for a positional argument
  std::string operand_name;        // "DIR"; empty for a flag
  Operand operand = Operand::none;
  std::vector<std::string> choices;  // of a choice
  std::string help;
  bool repeated = false, required = false;
};

struct CommandVerb {
  std::string name, help;
  std::vector<CommandOption> options, positionals;
};

struct CommandTree {
  std::string name, help;
  std::vector<CommandOption> options;  // before the verb
  std::vector<CommandVerb> verbs;
};

/// Names of operands that the parser uses, and what they mean for completion: CASE a case file, RUN_DIR and DIR a
/// folder, FILE a file, "a|b|c" one of these words, anything else text.
CommandTree command_tree(const CLI::App& app);

/// Programs for the shell to source, that complete verbs, options and their operands.
std::string bash_completion(const CommandTree& tree);
std::string zsh_completion(const CommandTree& tree);
std::string fish_completion(const CommandTree& tree);

/// The manual page, as troff with the man macros.
std::string manual_page(const CommandTree& tree, const std::string& version);

}  // namespace stillhook
