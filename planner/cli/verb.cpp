#include "planner/cli/verb.h"

namespace stillhook {

void VerbOptions::add_messages(const char* quiet) {
  add({"--quiet", &common_.quiet, "", quiet});
  add({"--color", &common_.colour, "auto|always|never",
       "Colours: on a terminal (auto, the default, unless NO_COLOR is set), always, never"});
}

void VerbOptions::add_case() {
  add({.name = "CASE", .target = &common_.input, .operand = "", .help = "Case file (TOML)", .required = true});
  add({"--set", &common_.sets, "KEY=VALUE", "Change a key of the case, e.g. --set sea.ramp_s=20; may be repeated"});
  add({"--json", &common_.json, "", "Print the summary as JSON on stdout"});
  add_messages("Nothing but errors, and what --json prints");
}

void VerbOptions::add_run_folder(const char* help) {
  add({.name = "RUN_DIR", .target = &common_.input, .operand = "", .help = help, .required = true});
}

void VerbOptions::add_threads() {
  add({.name = "--threads",
       .target = &common_.threads,
       .operand = "N",
       .help = "Threads to use (default: all cores); results do not depend on it",
       .range = std::pair(1.0, 1024.0)});
}

void VerbOptions::add_force(const char* help) { add({"--force", &common_.force, "", help}); }

void VerbOptions::add_folder() {
  add({"--out", &common_.out, "DIR", "Folder to write into (default runs/<case>-<verb>)"});
  add_force("Replace the run that the folder holds");
  add_threads();
}

void VerbOptions::add_seed(const char* help) {
  add({.name = "--seed", .target = &common_.seed, .operand = "N", .help = help, .range = std::pair(0.0, 2147483647.0)});
}

}  // namespace stillhook
