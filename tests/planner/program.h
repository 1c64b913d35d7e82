// Runs the program as a user does: in a folder of its own, its streams in files, its exit code.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/program_path.h"

namespace stillhook {

/// A folder that is gone with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "stillhook-test-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
  std::filesystem::path path;
};

inline std::string content(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Result {
  int code = -1;  // minus the signal that ended it
  std::string out, err;
};

/// Starts the program in `folder` with stdout and stderr in files there, and coefficients cached in `cache`, a folder
/// (the user's own if empty).
inline pid_t start(const Folder& folder, std::vector<std::string> arguments, const std::string& cache = "") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child > 0) return child;
  if (chdir(folder.path.c_str()) != 0) _exit(99);
  if (!cache.empty()) setenv("STILLHOOK_CACHE", cache.c_str(), 1);
  const int out = open("stdout.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err = open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  arguments.insert(arguments.begin(), program_path());
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(98);
}

inline Result finish(const Folder& folder, pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content(folder / "stdout.txt"),
          content(folder / "stderr.txt")};
}

inline Result run(const Folder& folder, const std::vector<std::string>& arguments, const std::string& cache = "") {
  return finish(folder, start(folder, arguments, cache));
}

}  // namespace stillhook
