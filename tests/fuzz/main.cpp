// Feeds damaged files to a reader and reports what is neither taken nor refused: a signal, an exception that the reader
// does not promise, ten seconds of work without an answer, a request for more than 2 GB. With --program also an exit
// code that `stillhook check` of a case with such a file does not promise.
//
//   stillhook_fuzz READER [--executions N | --seconds S] [--first K] [--keep DIR] [--program PATH [--every N]]
//   stillhook_fuzz READER --input FILE          one file, in this process: for the debugger
//   stillhook_fuzz --list
//
// Input number k is the same in every run, so a fault is repeated with --first k --executions 1. The reader runs in a
// child process, since a crash must not end the search; a fault's input is left in DIR (default: fuzz-faults). What has
// been mended since is kept in corpus/READER/fault-* and read first, and so are the good files, which must be taken.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "tests/fuzz/mutate.h"
#include "tests/fuzz/readers.h"

namespace fs = std::filesystem;

// There in programs that are linked with a sanitizer.
extern "C" {
__attribute__((weak)) void __asan_init();
__attribute__((weak)) void __tsan_init();
}

using namespace stillhook::fuzz;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double kLongest = 10.0;              // s of processor time for one input
constexpr double kLongestWait = 300.0;         // s, for one that waits, on a machine that is busy with other things
constexpr rlim_t kMostMemory = 2'000'000'000;  // bytes
constexpr int kMostFaults = 20;
constexpr int kTimedOut = 124;  // exit code of `timeout`
constexpr int kTooSlow = 128 + SIGXCPU;

/// What parent and child share.
struct Shared {
  std::atomic<std::uint64_t> next{0}, taken{0};
  std::atomic<bool> running{true};
  char fault[512] = {};
};

struct Budget {
  std::uint64_t first = 0, executions = 0;
  double seconds = 0.0;
  std::string program;  // checked with every `every`th input; empty: not at all
  std::uint64_t every = 20;
};

void write_input(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// What `stillhook check` of a case with this input does wrong; empty if it ends as promised.
std::string fault_of_program(const Reader& reader, const std::string& program, const std::string& input) {
  const fs::path folder = fs::path(input).parent_path();
  std::string file = input;
  if (reader.program_case != "itself") write_input(file = (folder / "program.toml").string(), reader.program_case);
  const std::string command = "ulimit -t 10; timeout 200 '" + program + "' check '" + file + "' > /dev/null 2>&1";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code == kTimedOut || code == kTooSlow) return "the program gives no answer within 10 s";
  return code == 0 || (code >= 2 && code <= 4) ? "" : "the program ends with exit code " + std::to_string(code);
}

/// One input. Ends the process with _exit(1) and a sentence in `fault` where the reader or the program fails.
void read_one(const Reader& reader, const Budget& budget, const std::string& path, Shared& shared) {
  const auto fail = [&shared](const std::string& fault) {
    std::snprintf(shared.fault, sizeof shared.fault, "%s", fault.c_str());
    _exit(1);
  };
  try {
    write_input(path, damaged(reader.seeds, shared.next));
    if (reader.read(path).empty()) ++shared.taken;
    if (!budget.program.empty() && !reader.program_case.empty() && shared.next % budget.every == 0) {
      const std::string fault = fault_of_program(reader, budget.program, path);
      if (!fault.empty()) fail(fault);
    }
  } catch (const std::bad_alloc&) {
    fail("asks for more than 2 GB");
  } catch (const std::exception& error) {
    fail(std::string("an exception that is not the reader's own: ") + error.what());
  } catch (...) {
    fail("something thrown that is no exception");
  }
}

/// The child: reads inputs until the budget is used. Ends with _exit(0), or with _exit(1) and a sentence in `fault`.
[[noreturn]] void read_on(const Reader& reader, const Budget& budget, Clock::time_point end, const std::string& path,
                          Shared& shared) {
  // The sanitizers reserve address space by the terabyte. They may come with the other objects of the link alone, so the
  // program that runs is asked, not the compiler.
  if (&__asan_init == nullptr && &__tsan_init == nullptr) {
    const rlimit limit{kMostMemory, kMostMemory};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::freopen("/dev/null", "w", stderr);  // libraries complain there about what we refuse
  const std::uint64_t last = budget.first + budget.executions;
  for (; (budget.executions == 0 || shared.next < last) && (budget.seconds == 0.0 || Clock::now() < end); ++shared.next)
    read_one(reader, budget, path, shared);
  shared.running = false;
  _exit(0);
}

/// Reads one whole file in a child process. Returns its fault, empty if there is none.
std::string fault_of(pid_t child, Shared& shared);
std::string fault_of_file(const Reader& reader, const std::string& content, bool good, const std::string& path,
                          Shared& shared) {
  shared.fault[0] = 0;
  const pid_t child = fork();
  if (child == 0) {
    write_input(path, content);
    try {
      const std::string refusal = reader.read(path);
      if (refusal.empty() || !good) _exit(0);
      std::snprintf(shared.fault, sizeof shared.fault, "a good file is refused: %s", refusal.c_str());
    } catch (const std::exception& error) {
      std::snprintf(shared.fault, sizeof shared.fault, "an exception that is not the reader's own: %s", error.what());
    }
    _exit(1);
  }
  return fault_of(child, shared);
}

/// How many of the kept files are not read as they must be.
int faults_of_kept(const Reader& reader, const std::string& path, Shared& shared) {
  int faults = 0;
  for (const bool good : {true, false})
    for (const std::string& content : good ? reader.seeds : reader.faults) {
      const std::string fault = fault_of_file(reader, content, good, path, shared);
      if (fault.empty()) continue;
      ++faults;
      std::printf("%s: kept file \"%.40s...\": %s\n", reader.name.c_str(), content.c_str(), fault.c_str());
    }
  return faults;
}

/// Processor time of a process, s; of its children none.
double processor_time(pid_t process) {
  clockid_t clock;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// Waits for the child; ends one that hangs. Returns the fault, empty if there is none.
std::string fault_of(pid_t child, Shared& shared) {
  std::uint64_t seen = shared.next;
  Clock::time_point since = Clock::now();
  double used = 0.0;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (shared.next != seen) {
      seen = shared.next;
      since = Clock::now();
      used = processor_time(child);
    } else if (processor_time(child) - used > kLongest ||
               std::chrono::duration<double>(Clock::now() - since).count() > kLongestWait) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return "no answer within 10 s";
    }
  }
  if (WIFSIGNALED(status)) return std::string("ended by ") + strsignal(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0)
    return shared.fault[0] ? shared.fault : "ended with exit code " + std::to_string(WEXITSTATUS(status));
  return "";
}

int search(const Reader& reader, const Budget& budget, const std::string& folder, const std::string& keep) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  Shared& shared = *new (memory) Shared;
  shared.next = budget.first;
  const Clock::time_point end =
      Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * budget.seconds));
  int faults = faults_of_kept(reader, folder + "/" + reader.file, shared);
  while (shared.running && faults < kMostFaults) {
    shared.fault[0] = 0;
    const pid_t child = fork();
    if (child == 0) read_on(reader, budget, end, folder + "/" + reader.file, shared);
    const std::string fault = fault_of(child, shared);
    if (fault.empty()) break;
    ++faults;
    fs::create_directories(keep);
    const std::string input =
        keep + "/" + reader.name + "-" + std::to_string(shared.next) + fs::path(reader.file).extension().string();
    write_input(input, damaged(reader.seeds, shared.next));
    std::printf("%s: input %llu: %s; kept as %s\n", reader.name.c_str(), static_cast<unsigned long long>(shared.next),
                fault.c_str(), input.c_str());
    ++shared.next;
  }
  std::printf("%s: %llu inputs, %llu taken, %d faults\n", reader.name.c_str(),
              static_cast<unsigned long long>(shared.next - budget.first),
              static_cast<unsigned long long>(shared.taken), faults);
  return faults == 0 ? 0 : 1;
}

std::string verdict_of(const Reader& reader, const std::string& input) {
  const std::string refusal = reader.read(input);
  return refusal.empty() ? "taken" : "refused: " + refusal;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Feeds damaged files to the readers");
  std::string name, keep = "fuzz-faults", input;
  Budget budget;
  bool list = false;
  app.add_option("READER", name, "Which reader");
  app.add_option("--executions", budget.executions, "Inputs to try (default 20000 without --seconds)");
  app.add_option("--seconds", budget.seconds, "Time to spend");
  app.add_option("--first", budget.first, "Number of the first input");
  app.add_option("--keep", keep, "Folder for the inputs of faults");
  app.add_option("--program", budget.program, "Check cases with the inputs with this program too");
  app.add_option("--every", budget.every, "With every how-many-th input")->check(CLI::PositiveNumber);
  app.add_option("--input", input, "Read this file only");
  app.add_flag("--list", list, "Name the readers");
  CLI11_PARSE(app, argc, argv);
  if (budget.executions == 0 && budget.seconds == 0.0) budget.executions = 20'000;

  // In memory where that can be: writing an input to a disk takes fifty times as long as reading it.
  const bool memory = access("/dev/shm", W_OK) == 0 && !std::getenv("TMPDIR");
  std::string folder = ((memory ? fs::path("/dev/shm") : fs::temp_directory_path()) / "stillhook-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 2;
  int code = 2;
  for (const Reader& reader : readers(folder)) {
    if (list) std::printf("%s\n", reader.name.c_str()), code = 0;
    if (list || reader.name != name) continue;
    code = input.empty() ? search(reader, budget, folder, keep)
                         : (std::printf("%s\n", verdict_of(reader, input).c_str()), 0);
  }
  if (code == 2) std::fprintf(stderr, "there is no reader \"%s\"; --list names them\n", name.c_str());
  fs::remove_all(folder);
  return code;
}
