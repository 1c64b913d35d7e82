#include <fmt/format.h>
#include <fmt/ranges.h>

#include "planner/cli/command_tree.h"
#include "planner/cli/commands.h"

namespace stillhook {
namespace {

/// Text for troff: hyphens that stay hyphens, backslashes that are no requests, no line that starts with a control
/// character.
std::string troff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool first = out.empty() || out.back() == '\n';
    if (first && (c == '.' || c == '\'')) out += "\\&";
    if (c == '-')
      out += "\\-";
    else if (c == '\\')
      out += "\\e";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + troff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + troff(text) + "\\fR"; }

std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + troff(text) + "\n";
}

std::string option_entry(const CommandOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(bold(name));
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.operand_name.empty()) head += (head.empty() ? "" : " ") + italic(option.operand_name);
  return entry(head, option.help);
}

std::string verb_section(const CommandVerb& verb) {
  std::string out = ".SS stillhook " + troff(verb.name);
  for (const CommandOption& positional : verb.positionals) out += " " + troff(positional.operand_name);
  out += "\n" + troff(verb.help) + ".\n";
  for (const CommandOption& positional : verb.positionals) out += option_entry(positional);
  for (const CommandOption& option : verb.options)
    if (option.names.back() != "--help") out += option_entry(option);
  return out;
}

constexpr const char* kEnvironment[][2] = {
    {"NO_COLOR", "When set and not empty, no colours unless --color says always."},
    {"STILLHOOK_CACHE", "Folder for computed hydrodynamic coefficients, instead of the user's cache folder."}};

constexpr const char* kExamples[][2] = {
    {"stillhook check lift.toml", "Is the case right? Poses, drafts, wire tensions, phases."},
    {"stillhook simulate lift.toml --set sea.ramp_s=20", "One run with a key changed."},
    {"stillhook plan lift.toml --evaluations 200 --out runs/first",
     "A search; Ctrl-C ends it with the best plan so far."},
    {"stillhook plan lift.toml --out runs/first --resume", "The same search gone on with."},
    {"stillhook export runs/first --xlsx --channels 'load.*'", "The load's motion as an Excel workbook."}};

}  // namespace

std::string manual_page(const CommandTree& tree, const std::string& version) {
  std::string out = fmt::format(".TH STILLHOOK 1 \"\" \"stillhook {}\" \"User commands\"\n", troff(version));
  out += ".SH NAME\nstillhook \\- plan the installation of offshore structures by crane vessel\n.SH SYNOPSIS\n";
  for (const CommandVerb& verb : tree.verbs) {
    out += bold(tree.name) + " " + bold(verb.name);
    for (const CommandOption& positional : verb.positionals) out += " " + italic(positional.operand_name);
    out += " [options]\n.br\n";
  }
  for (const CommandOption& option : tree.options)
    if (option.names.back() != "--help") out += bold(tree.name) + " " + bold(option.names.back()) + "\n";
  out += ".SH DESCRIPTION\n" + troff(tree.help) +
         "\n.PP\nA case is a TOML file that describes a lift: bodies, wires, winches, seas, the phases of the "
         "operation, limits, "
         "and what a search may change. Data go to standard output, messages and progress to standard error.\n"
         ".SH COMMANDS\n";
  for (const CommandVerb& verb : tree.verbs) out += verb_section(verb);
  out += ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : kExitMeanings) out += entry(bold(std::to_string(exit.code)), exit.text);
  const auto add = [&out](const char* title, const auto& entries) {
    out += fmt::format(".SH {}\n", title);
    for (const auto& [head, text] : entries) out += entry(bold(head), text);
  };
  add("ENVIRONMENT", kEnvironment);
  out += ".SH FILES\n" +
         entry(bold("runs/<case>-<verb>/"),
               "The folder of a run, unless --out names another. It is never overwritten without --force.");
  for (const RunFile& file : run_files()) out += entry(bold(file.name), file.meaning);
  add("EXAMPLES", kExamples);
  return out;
}

}  // namespace stillhook
