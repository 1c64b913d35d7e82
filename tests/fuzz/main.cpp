// Feeds damaged files to a reader and reports what is neither taken nor refused: a signal, an exception that the reader
// does not promise, ten seconds without an answer, a request for more than 2 GB.
//
//   stillhook_fuzz READER [--executions N | --seconds S] [--first K] [--keep DIR]
//   stillhook_fuzz READER --input FILE          one file, in this process: for the debugger
//   stillhook_fuzz --list
//
// Input number k is the same in every run, so a fault is repeated with --first k --executions 1. The reader runs in a
// child process, since a crash must not end the search; a fault's input is left in DIR (default: fuzz-faults).
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "tests/fuzz/mutate.h"
#include "tests/fuzz/readers.h"

namespace fs = std::filesystem;
using namespace stillhook::fuzz;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double kLongest = 10.0;              // s for one input
constexpr rlim_t kMostMemory = 2'000'000'000;  // bytes
constexpr int kMostFaults = 20;

/// What parent and child share.
struct Shared {
  std::atomic<std::uint64_t> next{0}, taken{0};
  std::atomic<bool> running{true};
  char fault[512] = {};
};

struct Budget {
  std::uint64_t first = 0, executions = 0;
  double seconds = 0.0;
};

void write_input(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// The child: reads inputs until the budget is used. Ends with _exit(0), or with _exit(1) and a sentence in `fault`.
[[noreturn]] void read_on(const Reader& reader, const Budget& budget, Clock::time_point end, const std::string& path,
                          Shared& shared) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve address space by the terabyte
  const rlimit limit{kMostMemory, kMostMemory};
  setrlimit(RLIMIT_AS, &limit);
#endif
  std::freopen("/dev/null", "w", stderr);  // libraries complain there about what we refuse
  const std::uint64_t last = budget.first + budget.executions;
  for (; (budget.executions == 0 || shared.next < last) && (budget.seconds == 0.0 || Clock::now() < end);
       ++shared.next) {
    try {
      write_input(path, damaged(reader.seeds, shared.next));
      if (reader.read(path)) ++shared.taken;
    } catch (const std::bad_alloc&) {
      std::snprintf(shared.fault, sizeof shared.fault, "asks for more than 2 GB");
      _exit(1);
    } catch (const std::exception& error) {
      std::snprintf(shared.fault, sizeof shared.fault, "an exception that is not the reader's own: %s", error.what());
      _exit(1);
    } catch (...) {
      std::snprintf(shared.fault, sizeof shared.fault, "something thrown that is no exception");
      _exit(1);
    }
  }
  shared.running = false;
  _exit(0);
}

/// Waits for the child; ends one that hangs. Returns the fault, empty if there is none.
std::string fault_of(pid_t child, Shared& shared) {
  std::uint64_t seen = shared.next;
  Clock::time_point since = Clock::now();
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (shared.next != seen) {
      seen = shared.next;
      since = Clock::now();
    } else if (std::chrono::duration<double>(Clock::now() - since).count() > kLongest) {
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
  int faults = 0;
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
  app.add_option("--input", input, "Read this file only");
  app.add_flag("--list", list, "Name the readers");
  CLI11_PARSE(app, argc, argv);
  if (budget.executions == 0 && budget.seconds == 0.0) budget.executions = 20'000;

  std::string folder = (fs::temp_directory_path() / "stillhook-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 2;
  int code = 2;
  for (const Reader& reader : readers(folder)) {
    if (list) std::printf("%s\n", reader.name.c_str()), code = 0;
    if (list || reader.name != name) continue;
    code = input.empty() ? search(reader, budget, folder, keep)
                         : (std::printf("%s\n", reader.read(input) ? "taken" : "refused"), 0);
  }
  if (code == 2) std::fprintf(stderr, "there is no reader \"%s\"; --list names them\n", name.c_str());
  fs::remove_all(folder);
  return code;
}
