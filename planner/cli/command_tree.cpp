#include "planner/cli/command_tree.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace stillhook {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

void describe_operand(CommandOption& option) {
  const std::string& name = option.operand_name;
  if (name == "CASE")
    option.operand = Operand::case_file;
  else if (name == "RUN_DIR" || name == "DIR")
    option.operand = Operand::folder;
  else if (name == "FILE" || name == "LIMITS")
    option.operand = Operand::file;
  else if (name.find('|') != std::string::npos)
    option.operand = Operand::choice, option.choices = split(name, '|');
  else if (!name.empty())
    option.operand = Operand::text;
}

CommandOption described(const CLI::Option& from) {
  CommandOption option;
  for (const std::string& name : from.get_snames()) option.names.push_back("-" + name);
  for (const std::string& name : from.get_lnames()) option.names.push_back("--" + name);
  option.help = from.get_description();
  option.required = from.get_required();
  option.repeated = from.get_expected_max() > 1 || from.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  // "N:INT in [1 - 1024]": the name, then what the parser checks. One without a name of its own is called as it stands.
  const std::string type = from.get_type_name().substr(0, from.get_type_name().find(':'));
  if (option.names.empty())
    option.operand_name = type.empty() || type == "TEXT" ? from.get_name(true) : type;
  else if (from.get_items_expected_max() != 0)
    option.operand_name = type;
  describe_operand(option);
  return option;
}

void add_options(const CLI::App& app, std::vector<CommandOption>& options, std::vector<CommandOption>* positionals) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional())
      options.push_back(described(*option));
    else if (positionals)
      positionals->push_back(described(*option));
  }
}

}  // namespace

CommandTree command_tree(const CLI::App& app) {
  CommandTree tree;
  tree.name = app.get_name();
  tree.help = app.get_description();
  add_options(app, tree.options, nullptr);
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandVerb& added = tree.verbs.emplace_back();
    added.name = verb->get_name();
    added.help = verb->get_description();
    add_options(*verb, added.options, &added.positionals);
  }
  return tree;
}

}  // namespace stillhook
