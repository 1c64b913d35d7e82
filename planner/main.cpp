#include "planner/cli/command_line.h"

int main(int argc, char** argv) { return stillhook::run_command_line(argc, argv); }
