#include <fmt/format.h>
#include <fmt/ranges.h>

#include "planner/cli/command_tree.h"

namespace stillhook {
namespace {

std::vector<std::string> names_of(const std::vector<CommandOption>& options) {
  std::vector<std::string> names;
  for (const CommandOption& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// In single quotes, for any shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// ---- bash -------------------------------------------------------------------------------------------------------

/// The command that fills COMPREPLY with what may stand for an operand.
std::string bash_reply(const CommandOption& option) {
  switch (option.operand) {
    case Operand::case_file:
      return "_stillhook_files '*.toml'";
    case Operand::file:
      return "_stillhook_files '*'";
    case Operand::folder:
      return "_stillhook_files ''";
    case Operand::choice:
      return fmt::format("_stillhook_words {}", quoted(fmt::format("{}", fmt::join(option.choices, " "))));
    case Operand::text:
    case Operand::none:
      break;
  }
  return ":";
}

std::string bash_verb(const CommandVerb& verb) {
  std::string operands;
  for (const CommandOption& option : verb.options)
    if (option.operand != Operand::none)
      operands += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"), bash_reply(option));
  std::string out = fmt::format("    {})\n", verb.name);
  if (!operands.empty()) out += "      case \"$previous\" in\n" + operands + "      esac\n";
  out += fmt::format("      case \"$word\" in\n        -*) _stillhook_words '{}' ;;\n        *) {} ;;\n      esac ;;\n",
                     fmt::join(names_of(verb.options), " "),
                     verb.positionals.empty() ? ":" : bash_reply(verb.positionals.front()));
  return out;
}

constexpr const char* kBashHead =
    R"(# bash completion of stillhook: source this file, or put it into ~/.local/share/bash-completion/completions/stillhook
_stillhook_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}
# Folders, and files that match a pattern unless it is empty.
_stillhook_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$word"; [ -z "$1" ] || compgen -f -X "!$1" -- "$word" | while IFS= read -r file; do
    [ -d "$file" ] || printf '%s\n' "$file"; done)
}
_stillhook() {
  local word="${COMP_WORDS[COMP_CWORD]}" previous="${COMP_WORDS[COMP_CWORD - 1]}" verb="" i
  # bash splits --option=value into three words.
  [ "$word" = "=" ] && word=""
  [ "$previous" = "=" ] && previous="${COMP_WORDS[COMP_CWORD - 2]}"
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "${COMP_WORDS[i]}" in
      -*) ;;
      *) verb="${COMP_WORDS[i]}"; break ;;
    esac
  done
  case "$verb" in
)";

// ---- zsh --------------------------------------------------------------------------------------------------------

/// Text within a specification of _arguments, where brackets and colons have a meaning.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const CommandOption& option) {
  switch (option.operand) {
    case Operand::case_file:
      return "_files -g \"*.toml\"";
    case Operand::file:
      return "_files";
    case Operand::folder:
      return "_files -/";
    case Operand::choice:
      return fmt::format("({})", fmt::join(option.choices, " "));
    case Operand::text:
    case Operand::none:
      break;
  }
  return " ";
}

std::string zsh_arguments(const std::vector<CommandOption>& options, const std::vector<CommandOption>& positionals) {
  std::string out;
  for (const CommandOption& option : options)
    for (const std::string& name : option.names) {
      const std::string operand = option.operand == Operand::none
                                      ? std::string()
                                      : ":" + zsh_text(option.operand_name) + ":" + zsh_action(option);
      out +=
          " \\\n        " + quoted((option.repeated ? "*" : "") + name + "[" + zsh_text(option.help) + "]" + operand);
    }
  for (const CommandOption& option : positionals)
    out += " \\\n        " + quoted(":" + zsh_text(option.operand_name) + ":" + zsh_action(option));
  return out;
}

// ---- fish -------------------------------------------------------------------------------------------------------

/// Options of `complete` that say what may stand for an operand.
std::string fish_operand(const CommandOption& option) {
  switch (option.operand) {
    case Operand::case_file:
      return " -k -a '(__fish_complete_suffix .toml)'";
    case Operand::file:
      return " -F";
    case Operand::folder:
      return " -a '(__fish_complete_directories)'";
    case Operand::choice:
      return fmt::format(" -a '{}'", fmt::join(option.choices, " "));
    case Operand::text:
    case Operand::none:
      break;
  }
  return {};
}

std::string fish_option(const CommandOption& option, const std::string& condition) {
  std::string line = "complete -c stillhook -n " + quoted(condition);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.operand != Operand::none) line += " -r" + fish_operand(option);
  return line + " -d " + quoted(option.help) + "\n";
}

}  // namespace

std::string bash_completion(const CommandTree& tree) {
  std::vector<std::string> first = names_of(tree.options);
  for (const CommandVerb& verb : tree.verbs) first.push_back(verb.name);
  std::string out = kBashHead + fmt::format("    '') _stillhook_words '{}' ;;\n", fmt::join(first, " "));
  for (const CommandVerb& verb : tree.verbs) out += bash_verb(verb);
  return out + "  esac\n}\ncomplete -F _stillhook stillhook\n";
}

std::string zsh_completion(const CommandTree& tree) {
  std::string out =
      "#compdef stillhook\n"
      "# zsh completion of stillhook: put this file as _stillhook into a folder of $fpath\n"
      "_stillhook() {\n  local context state line\n  local -a verbs\n  verbs=(";
  for (const CommandVerb& verb : tree.verbs) out += "\n    " + quoted(verb.name + ":" + verb.help);
  out += "\n  )\n  _arguments -C" + zsh_arguments(tree.options, {}) +
         " \\\n        '1:command:->verb' '*::argument:->rest'\n"
         "  case \"$state\" in\n    verb) _describe command verbs ;;\n    rest) case \"${line[1]}\" in\n";
  for (const CommandVerb& verb : tree.verbs)
    out += fmt::format("      {}) _arguments{} ;;\n", verb.name, zsh_arguments(verb.options, verb.positionals));
  return out +
         "    esac ;;\n  esac\n}\nif [ \"$funcstack[1]\" = _stillhook ]; then _stillhook \"$@\"; else compdef "
         "_stillhook stillhook; fi\n";
}

std::string fish_completion(const CommandTree& tree) {
  std::string out =
      "# fish completion of stillhook: put this file into ~/.config/fish/completions/stillhook.fish\n"
      "complete -c stillhook -f\n";
  for (const CommandOption& option : tree.options) out += fish_option(option, "__fish_use_subcommand");
  for (const CommandVerb& verb : tree.verbs) {
    out += fmt::format("complete -c stillhook -n __fish_use_subcommand -a {} -d {}\n", verb.name, quoted(verb.help));
    const std::string seen = "__fish_seen_subcommand_from " + verb.name;
    for (const CommandOption& option : verb.options) out += fish_option(option, seen);
    for (const CommandOption& option : verb.positionals)
      out += "complete -c stillhook -n " + quoted(seen) + fish_operand(option) + "\n";
  }
  return out;
}

}  // namespace stillhook
