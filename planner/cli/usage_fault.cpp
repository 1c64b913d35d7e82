#include "planner/cli/usage_fault.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "problems/field_table.h"

namespace stillhook {
namespace {

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  return verbs;
}

std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

std::string verb_fault(const CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<std::string> verbs = verbs_of(app);
  const auto word = std::find_if_not(words.begin(), words.end(), is_option);
  if (word == words.end() && !words.empty())
    return fmt::format("there is no option \"{}\"{}; a command comes first: stillhook COMMAND, one of {}",
                       words.front(), did_you_mean(words.front(), options_of(app)), fmt::join(verbs, ", "));
  if (word == words.end())
    return fmt::format("a command is missing: stillhook COMMAND, one of {}", fmt::join(verbs, ", "));
  const std::string hint = did_you_mean(*word, verbs);
  return fmt::format("there is no command \"{}\"{} The commands are {}{}", *word, hint.empty() ? "." : hint,
                     fmt::join(verbs, ", "),
                     word->ends_with(".toml") ? fmt::format("; to check a case: stillhook check {}", *word) : "");
}

std::string extras_fault(const CLI::App& verb) {
  const std::vector<std::string> extras = verb.remaining();
  const std::string name = verb.get_name();
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option != extras.end()) {
    const std::string asked = option->substr(0, option->find('='));
    return fmt::format("{0}: there is no option \"{1}\"{2}{3} stillhook {0} --help lists them", name, asked,
                       did_you_mean(asked, options_of(verb)), did_you_mean(asked, options_of(verb)).empty() ? ";" : "");
  }
  return fmt::format("{0}: does not take \"{1}\"; stillhook {0} --help says what it takes", name,
                     fmt::join(extras, "\", \""));
}

}  // namespace

std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  if (parsed.empty()) return verb_fault(app, words);
  const CLI::App& verb = *parsed.front();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !verb.remaining().empty()) return extras_fault(verb);
  return fmt::format("{0}: {1}; stillhook {0} --help says what it takes", verb.get_name(), error.what());
}

}  // namespace stillhook
