#include "planner/cli/command_line.h"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <functional>
#include <new>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <variant>

#include "planner/cli/colour.h"
#include "planner/cli/command_tree.h"
#include "planner/cli/output.h"
#include "planner/cli/usage_fault.h"
#include "planner/verbs/verbs.h"
#include "planner/version.h"
#include "problems/search/store.h"
#include "results/files.h"
#include "sim/interrupted.h"

namespace stillhook {
namespace {

void set_up_messages(bool quiet, ColourWish wish) {
  const auto mode = wants_colour(wish, STDERR_FILENO) ? spdlog::color_mode::always : spdlog::color_mode::never;
  auto logger =
      std::make_shared<spdlog::logger>("stillhook", std::make_shared<spdlog::sinks::stderr_color_sink_mt>(mode));
  logger->set_pattern("%^%l%$: %v");
  logger->set_level(quiet ? spdlog::level::err : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

/// The parsed command line: what the verbs share, the verbs with their own options, and the one to run.
struct Request {
  CommonOptions common;
  std::vector<std::unique_ptr<Verb>> verbs = all_verbs();
  std::string shell;  // completion
  std::function<int()> run;
};

std::vector<std::string> words_of(const std::string& operand) {
  std::vector<std::string> words;
  std::istringstream in(operand);
  for (std::string word; std::getline(in, word, '|');) words.push_back(word);
  return words;
}

/// What a verb says of an option, told to the parser.
void add_to_parser(CLI::App& app, const VerbOption& option) {
  CLI::Option* added = std::visit(
      [&](auto* target) -> CLI::Option* {
        using T = std::remove_pointer_t<decltype(target)>;
        if constexpr (std::is_same_v<T, bool>)
          return app.add_flag(option.name, *target, option.help);
        else
          return app.add_option(option.name, *target, option.help);
      },
      option.target);
  if (!option.operand.empty()) added->type_name(option.operand);
  if (option.operand.find('|') != std::string::npos)
    added->check(CLI::IsMember(words_of(option.operand)).description(""));  // the operand's name lists them already
  const bool whole =
      std::holds_alternative<std::optional<int>*>(option.target) || std::holds_alternative<int*>(option.target);
  if (option.range && whole)
    added->check(CLI::Range(static_cast<int>(option.range->first), static_cast<int>(option.range->second)));
  if (option.range && !whole) added->check(CLI::Range(option.range->first, option.range->second));
  if (option.positive) added->check(CLI::PositiveNumber);
  if (option.delimiter != 0)
    added->delimiter(option.delimiter);
  else if (std::holds_alternative<std::vector<std::string>*>(option.target))
    added->take_all()->allow_extra_args(false);
  if (!option.excludes.empty()) added->excludes(option.excludes);
  if (option.required) added->required();
}

/// What the program says about itself.
void add_help_verbs(CLI::App& app, Request& r) {
  CLI::App* completion = app.add_subcommand("completion", "Print the completion of commands for a shell");
  add_to_parser(*completion, {.name = "SHELL",
                              .target = &r.shell,
                              .operand = "bash|zsh|fish",
                              .help = "Shell to complete for",
                              .required = true});
  completion->callback([&app, &r] {
    r.run = [&app, &r] {
      const CommandTree tree = command_tree(app);
      fmt::print("{}", r.shell == "bash"  ? bash_completion(tree)
                       : r.shell == "zsh" ? zsh_completion(tree)
                                          : fish_completion(tree));
      return static_cast<int>(kDone);
    };
  });

  CLI::App* man = app.add_subcommand("man", "Print the manual page (troff; see it with: stillhook man | man -l -)");
  man->callback([&app, &r] {
    r.run = [&app] {
      fmt::print("{}", manual_page(command_tree(app), kVersion));
      return static_cast<int>(kDone);
    };
  });
}

void add_verbs(CLI::App& app, Request& r) {
  for (const std::unique_ptr<Verb>& verb : r.verbs) {
    CLI::App* parsed = app.add_subcommand(verb->name(), verb->help());
    VerbOptions options(r.common);
    verb->add_options(options);
    for (const VerbOption& option : options.all()) add_to_parser(*parsed, option);
    parsed->callback([&r, chosen = verb.get()] { r.run = [&r, chosen] { return chosen->run(r.common); }; });
  }
  add_help_verbs(app, r);
}

std::string exit_code_text() {
  std::string text = "Exit codes:\n";
  for (const ExitMeaning& exit : kExitMeanings) text += fmt::format("  {:<26}{}\n", exit.code, exit.text);
  return text + "\nstillhook COMMAND --help lists the options of a command.";
}

/// What the user can do about a computation that the machine is too small for.
constexpr const char* kTooLittleMemory =
    "there is too little memory for this: use fewer --threads, a longer solver.output_interval_s, coarser panels "
    "(panel_method.refinement, hull.panel_length_m), or a machine with more of it";

int run_verb(const Request& request) {
  try {
    return complete_output(request.run());
  } catch (const std::bad_alloc&) {
    spdlog::error(kTooLittleMemory);
  } catch (const std::length_error&) {  // more than any machine has
    spdlog::error(kTooLittleMemory);
  } catch (const Interrupted&) {
    spdlog::warn("interrupted while the panel method ran; coefficients that were complete are kept");
    return kInterrupted;
  } catch (const SpecificationError& error) {
    spdlog::error("{}: {}", request.common.input, error.what());
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
  } catch (const std::exception& error) {
    const auto* failed_call = dynamic_cast<const std::system_error*>(&error);
    if (const std::string fault = output_fault(failed_call ? failed_call->code().value() : 0); !fault.empty()) {
      spdlog::error("{}", fault);
      return kBadInput;
    }
    spdlog::critical("{}\nThis is a bug in stillhook {}; please report it with the case and the command.", error.what(),
                     kVersion);
    return kBug;
  }
  return kBadInput;
}

/// Help and version are printed by the parser.
int help_or_version(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream text;
  app.exit(error, text, text);
  try {
    fmt::print("{}", text.str());
    return complete_output(kDone);
  } catch (const std::system_error& failed) {
    fmt::print(stderr, "error: {}\n", output_fault(failed.code().value()));
  } catch (const OutputError& failed) {
    fmt::print(stderr, "error: {}\n", failed.what());
  }
  return kBadInput;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  occupy_closed_streams();
  CLI::App app("stillhook plans the installation of offshore structures by crane vessel.", "stillhook");
  app.footer(exit_code_text());
  app.set_version_flag("--version", std::string("stillhook ") + kVersion);
  app.require_subcommand(1);
  Request request;
  add_verbs(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are the only ones that succeed.
    if (error.get_exit_code() == 0) return help_or_version(app, error);
    fmt::print(stderr, "error: {}\n", usage_fault(app, error, {argv + 1, argv + argc}));
    return kBadInput;
  }
  const ColourWish wish = request.common.colour == "always"  ? ColourWish::always
                          : request.common.colour == "never" ? ColourWish::never
                                                             : ColourWish::automatic;
  set_up_messages(request.common.quiet, wish);
  set_stdout_colour(wants_colour(wish, STDOUT_FILENO));
  // Parallel products would split sums by the number of threads; parallelism is over scenarios.
  Eigen::setNbThreads(1);
  if (request.common.threads > 0) omp_set_num_threads(request.common.threads);
  return run_verb(request);
}

}  // namespace stillhook
