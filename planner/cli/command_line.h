#pragma once

namespace stillhook {

/// Runs the stillhook command line and returns the exit code: 0 done, 1 our bug, 2 bad input or usage, 3 done but a
/// limit is violated or no feasible plan was found, 4 numerical failure, 130 after Ctrl-C.
int run_command_line(int argc, char** argv);

}  // namespace stillhook
