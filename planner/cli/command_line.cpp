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

#include "planner/cli/colour.h"
#include "planner/cli/command_tree.h"
#include "planner/cli/commands.h"
#include "planner/cli/output.h"
#include "planner/cli/usage_fault.h"
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

/// Without the list of words in the help: the operand's name says it already.
CLI::Validator one_of(std::vector<std::string> words) { return CLI::IsMember(std::move(words)).description(""); }

/// The parsed command line: options and the verb to run.
struct Request {
  CommonOptions common;
  CheckArguments check;
  PlanArguments plan;
  HydroArguments hydro;
  FitArguments fit;
  TuneArguments tune;
  int threads = 0;
  SchemaArguments schema;
  ExportArguments exports;
  std::string shell;  // completion
  std::string colour = "auto";
  std::function<int()> verb;
};

void add_colour_option(CLI::App& verb, Request& r) {
  verb.add_option("--color", r.colour,
                  "Colours: on a terminal (auto, the default, unless NO_COLOR is set), always, never")
      ->type_name("auto|always|never")
      ->check(one_of({"auto", "always", "never"}));
}

void add_output_options(CLI::App& verb, Request& r) {
  verb.add_flag("--json", r.common.json, "Print the summary as JSON on stdout");
  verb.add_flag("--quiet", r.common.quiet, "Nothing but errors, and what --json prints");
  add_colour_option(verb, r);
}

void add_case_options(CLI::App& verb, Request& r) {
  verb.add_option("CASE", r.common.input, "Case file (TOML)")->required();
  verb.add_option("--set", r.common.sets, "Change a key of the case, e.g. --set sea.ramp_s=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  add_output_options(verb, r);
}

void add_threads_option(CLI::App& verb, Request& r) {
  verb.add_option("--threads", r.threads, "Threads to use (default: all cores); results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
}

void add_folder_options(CLI::App& verb, Request& r) {
  verb.add_option("--out", r.common.out, "Folder to write into (default runs/<case>-<verb>)")->type_name("DIR");
  verb.add_flag("--force", r.common.force, "Replace the run that the folder holds");
  add_threads_option(verb, r);
}

void add_run_options(CLI::App& verb, Request& r, const char* seed_help) {
  add_folder_options(verb, r);
  verb.add_option("--seed", r.common.seed, seed_help)->type_name("N")->check(CLI::Range(0, 2147483647));
}

void add_export(CLI::App& app, Request& r) {
  CLI::App* verb = app.add_subcommand("export", "Write a run's history for other programs: CSV, or an Excel workbook");
  verb->add_option("RUN_DIR", r.common.input, "Folder that simulate or plan has written")->required();
  CLI::Option* csv = verb->add_flag("--csv", r.exports.csv, "Comma-separated values, units in the header, every digit");
  CLI::Option* xlsx =
      verb->add_flag("--xlsx", r.exports.xlsx, "Excel workbook: sheets history, metrics, limits, contacts");
  xlsx->excludes(csv);
  verb->add_option("--out", r.common.out,
                   "File to write (default history.csv or history.xlsx in the run's folder; - for stdout, CSV only)")
      ->type_name("FILE");
  verb->add_option("--channels", r.exports.channels,
                   "Only these channels, e.g. load.*,hoist_port.tension; * and ? stand for anything")
      ->type_name("NAMES")
      ->delimiter(',');
  verb->add_flag("--force", r.common.force, "Replace the file if it exists");
  verb->add_flag("--quiet", r.common.quiet, "No messages but errors");
  add_colour_option(*verb, r);
  verb->callback([&r] { r.verb = [&r] { return run_export(r.common, r.exports); }; });
}

/// What the program says about itself.
void add_help_verbs(CLI::App& app, Request& r) {
  CLI::App* schema = app.add_subcommand("schema", "Print the JSON Schema of case files");
  schema->add_flag("--reference", r.schema.reference, "Print the key reference (Markdown) instead");
  schema->add_flag("--metrics", r.schema.metrics, "Print the list of metrics (Markdown) instead");
  schema->callback([&r] { r.verb = [&r] { return run_schema(r.schema); }; });

  CLI::App* completion = app.add_subcommand("completion", "Print the completion of commands for a shell");
  completion->add_option("SHELL", r.shell, "Shell to complete for")
      ->type_name("bash|zsh|fish")
      ->check(one_of({"bash", "zsh", "fish"}))
      ->required();
  completion->callback([&app, &r] {
    r.verb = [&app, &r] {
      const CommandTree tree = command_tree(app);
      fmt::print("{}", r.shell == "bash"  ? bash_completion(tree)
                       : r.shell == "zsh" ? zsh_completion(tree)
                                          : fish_completion(tree));
      return static_cast<int>(kDone);
    };
  });

  CLI::App* man = app.add_subcommand("man", "Print the manual page (troff; see it with: stillhook man | man -l -)");
  man->callback([&app, &r] {
    r.verb = [&app] {
      fmt::print("{}", manual_page(command_tree(app), kVersion));
      return static_cast<int>(kDone);
    };
  });
}

void add_verbs(CLI::App& app, Request& r) {
  CLI::App* check =
      app.add_subcommand("check", "Validate a case; print poses, drafts, natural periods, wires, phases; draw it");
  add_case_options(*check, r);
  add_threads_option(*check, r);
  check
      ->add_option("--draw", r.check.draw,
                   "Draw the start pose, elevation and plan, into FILE.svg; into a folder: every pose")
      ->type_name("FILE");
  check->add_flag("--force", r.common.force, "Replace drawings that exist");
  check->callback([&r] { r.verb = [&r] { return run_check(r.common, r.check); }; });

  CLI::App* hydro = app.add_subcommand(
      "hydro", "Hydrodynamic coefficients of the hulls and the lift's response to waves: tables, files, report");
  add_case_options(*hydro, r);
  add_folder_options(*hydro, r);
  hydro->add_flag("--converge", r.hydro.converge, "Compute with longer and shorter panels too; print the change");
  hydro
      ->add_option("--headings", r.hydro.headings,
                   "Directions in deg the waves of the response amplitude operators travel towards, e.g. 180,90 "
                   "(default: head, bow quartering and beam seas of the first hull)")
      ->type_name("DEG")
      ->delimiter(',')
      ->check(CLI::Range(-360.0, 360.0));
  hydro->callback([&r] { r.verb = [&r] { return run_hydro(r.common, r.hydro); }; });

  CLI::App* simulate = app.add_subcommand("simulate", "Run the operation once: metrics, limits, report");
  add_case_options(*simulate, r);
  add_run_options(*simulate, r, "Seed of the active irregular sea");
  simulate->callback([&r] { r.verb = [&r] { return run_simulate(r.common); }; });

  CLI::App* plan = app.add_subcommand("plan", "Search for a better operation: plan, comparison, report");
  add_case_options(*plan, r);
  add_run_options(*plan, r, "Seed of the search");
  plan->add_option("--evaluations", r.plan.evaluations, "Budget of evaluations")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  plan->add_option("--time-budget", r.plan.time_budget,
                   "Wall time for the search in s; the random search beside it may take as long again")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  CLI::Option* resume = plan->add_flag("--resume", r.plan.resume, "Go on with the search that the folder holds");
  resume->excludes("--force");
  plan->callback([&r] { r.verb = [&r] { return run_plan(r.common, r.plan); }; });

  CLI::App* tune = app.add_subcommand("tune", "Tune the tagline gains: gains, damping of the swing, report");
  add_case_options(*tune, r);
  add_run_options(*tune, r, "Seed of the search");
  tune->add_option("--evaluations", r.tune.evaluations, "Budget of points")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  tune->add_option("--map", r.tune.map, "Map the objective over the first two gains with N x N points (0 = none)")
      ->type_name("N")
      ->check(CLI::Range(0, 200));
  tune->add_option("--phase", r.tune.phase, "This phase alone, begun at rest")->type_name("NAME");
  tune->add_option("--pose", r.tune.pose, "At rest in the pose that this phase ends in")
      ->type_name("NAME")
      ->excludes("--phase");
  tune->add_option("--hold", r.tune.hold, "How long in that pose, s")->type_name("S")->check(CLI::PositiveNumber);
  tune->add_flag("--schedule", r.tune.schedule, "Then factors on the gains over the length of the falls");
  tune->callback([&r] { r.verb = [&r] { return run_tune(r.common, r.tune); }; });

  CLI::App* fit = app.add_subcommand("fit", "Estimate parameters of the case from measured runs, with intervals");
  add_case_options(*fit, r);
  add_folder_options(*fit, r);
  fit->add_option("--measured", r.fit.measured,
                  "Measured run (CSV or NetCDF) for the record of the case that has no file; RECORD=FILE names the "
                  "record; may be repeated")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
  fit->callback([&r] { r.verb = [&r] { return run_fit(r.common, r.fit); }; });

  CLI::App* report = app.add_subcommand("report", "Rebuild the report of a run folder");
  report->add_option("RUN_DIR", r.common.input, "Folder that simulate or plan has written")->required();
  report->add_flag("--quiet", r.common.quiet, "No messages but errors");
  add_colour_option(*report, r);
  report->callback([&r] { r.verb = [&r] { return run_report(r.common); }; });

  add_export(app, r);
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
    return complete_output(request.verb());
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
  const ColourWish wish = request.colour == "always"  ? ColourWish::always
                          : request.colour == "never" ? ColourWish::never
                                                      : ColourWish::automatic;
  set_up_messages(request.common.quiet, wish);
  set_stdout_colour(wants_colour(wish, STDOUT_FILENO));
  // Parallel products would split sums by the number of threads; parallelism is over scenarios.
  Eigen::setNbThreads(1);
  if (request.threads > 0) omp_set_num_threads(request.threads);
  return run_verb(request);
}

}  // namespace stillhook
