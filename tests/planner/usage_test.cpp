// The command line when something is wrong with it or with where its words go.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/planner/program.h"

using namespace stillhook;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kLift = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

/// Exit code of a shell command; $S is the program.
int shell(const Folder& folder, const std::string& command) {
  const std::string all =
      "cd '" + folder.path.string() + "' && S='" + program_path() + "' && { " + command + "; } 2> err.txt";
  const int status = std::system(all.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("a wrong command or option is answered with the nearest right one") {
  const Folder folder;
  const auto fault = [&](const std::vector<std::string>& words) {
    const Result result = run(folder, words);
    CHECK(result.code == 2);
    CHECK(result.out.empty());
    return result.err;
  };
  CHECK_THAT(fault({"simulat", "x.toml"}), Contains("there is no command \"simulat\", did you mean \"simulate\"?") &&
                                               Contains("check, hydro, simulate, plan, tune, fit, operability, weather, report, export"));
  CHECK_THAT(fault({"frobnicate"}), Contains("there is no command \"frobnicate\".") && Contains("fit"));
  CHECK_THAT(fault({"lift.toml"}), Contains("stillhook check lift.toml"));
  CHECK_THAT(fault({}), Contains("a command is missing") && Contains("simulate"));
  CHECK_THAT(fault({"--thread", "1"}),
             Contains("there is no command \"1\"") || Contains("there is no option \"--thread\""));
  CHECK_THAT(fault({"simulate", kLift, "--thread", "1"}),
             Contains("simulate: there is no option \"--thread\", did you mean \"--threads\"?"));
  CHECK_THAT(fault({"check", kLift, "b.toml"}), Contains("check: does not take \"b.toml\""));
  CHECK_THAT(fault({"simulate"}), Contains("simulate: CASE"));
  CHECK(run(folder, {"check", kLift, "--threads", "1"}).code == 0);
}

TEST_CASE("output that does not arrive is no success") {
  if (!fs::exists("/dev/full")) return;
  const Folder folder;
  fs::copy_file(kLift, folder / "lift.toml");
  REQUIRE(shell(folder, "$S simulate lift.toml --out run > /dev/null") == 0);
  for (const std::string verb :
       {"check lift.toml", "check lift.toml --json", "simulate lift.toml --force", "report run",
        "export run --csv --out -", "export run --csv --force", "schema", "schema --metrics", "man", "completion bash",
        "--help", "--version", "plan --help", "plan lift.toml --evaluations 2 --force"}) {
    CAPTURE(verb);
    CHECK(shell(folder, "$S " + verb + " > /dev/full") == 2);
    CHECK_THAT(content(folder / "err.txt"), Contains("No space left on device"));
    CHECK_THAT(content(folder / "err.txt"), !Contains("bug"));
  }
  CHECK(fs::exists(folder / "runs/small_lift-simulate/summary.json"));  // the run itself is whole
  CHECK(shell(folder, "$S check lift.toml >&-") == 2);
}

TEST_CASE("a lift without a degree of freedom has no periods") {
  const Folder folder;
  std::ofstream(folder / "clamped.toml") << R"(name = "clamped"
[[bodies]]
name = "float"
mass_t = 1.0
gyration_m = [1.0, 1.0, 1.0]
hull = { shape = "box", size_m = [2.0, 2.0, 1.0] }
[[joints]]
name = "clamp"
type = "fixed"
parent = "world"
child = "float"
[operation]
load = "float"
[[operation.phases]]
name = "rest"
duration_s = 1.0
)";
  const Result check = run(folder, {"check", "clamped.toml"});
  CHECK(check.code == 0);
  CHECK_THAT(check.out, Contains("Natural periods of float"));
  const int simulated = run(folder, {"simulate", "clamped.toml"}).code;
  CHECK(simulated >= 0);  // no signal ended it
  CHECK(simulated != 1);
}

TEST_CASE("too little memory is no bug") {
  const Folder folder;
  fs::copy_file(kLift, folder / "lift.toml");
  // The matrices of panels as fine as these need gigabytes; without them, the program takes 120 MB of addresses.
  const int code = shell(folder,
                         "sed -i 's/^hydrodynamics = .*/hydrodynamics = { kind = \"panels\" }/' lift.toml && "
                         "S='" STILLHOOK_PROGRAM "' && "  // the sanitizers reserve more address space than that
                         "ulimit -v 200000 && STILLHOOK_CACHE=cache $S hydro lift.toml --threads 1 "
                         "--set panel_method.refinement=2 > out.txt");
  CHECK(code == 2);
  CHECK_THAT(content(folder / "err.txt"), Contains("there is too little memory for this") && !Contains("bug"));
}
