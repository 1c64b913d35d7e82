// The corpus of broken cases: each is told its sentence, at its place, and nothing else crashes on the way.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "planner/cli/command_line.h"
#include "problems/case.h"
#include "problems/case_document.h"

namespace stillhook {
namespace {

const std::string kFolder = std::string(STILLHOOK_SOURCE_DIR) + "/tests/bad_input";

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  REQUIRE(in);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string what_is_said(const std::string& text) {
  try {
    read_case_text(text, "bad.toml", kFolder);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

struct Broken {
  std::string name, stage, text, expect;
  int line = 1;
};

std::string string_at(const Node& entry, const std::string& key) {
  const Node* node = entry.find(key);
  return node ? node->text : std::string();
}

std::vector<Broken> corpus() {
  const std::string base = text_of(kFolder + "/base.toml");
  const Node root = parse_document(text_of(kFolder + "/broken.toml"), "broken.toml");
  std::vector<Broken> all;
  for (const Node& entry : root.find("broken")->items) {
    Broken b{string_at(entry, "name"), string_at(entry, "stage"), string_at(entry, "text"), string_at(entry, "expect"),
             1};
    if (entry.find("find")) {
      const std::string find = string_at(entry, "find");
      const std::size_t at = base.find(find);
      INFO(b.name);
      REQUIRE(at != std::string::npos);
      b.text = base;
      b.text.replace(at, find.size(), string_at(entry, "put"));
      b.line = line_of(base, at);
    }
    if (entry.find("at")) {
      const std::size_t at = b.text.find(string_at(entry, "at"));
      INFO(b.name);
      REQUIRE(at != std::string::npos);
      b.line = line_of(b.text, at);
    }
    all.push_back(b);
  }
  return all;
}

/// `stillhook check` in this process, its stderr in a file: what main() does, without 180 starts of the program at 0.1 s.
int check_here(const std::string& file, const std::string& messages) {
  std::fflush(nullptr);
  const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY), told = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  REQUIRE((out >= 0 && err >= 0 && nowhere >= 0 && told >= 0));
  dup2(nowhere, STDOUT_FILENO);
  dup2(told, STDERR_FILENO);
  std::string words[] = {"stillhook", "check", file};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  const int code = run_command_line(3, arguments);
  std::fflush(nullptr);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (const int f : {out, err, nowhere, told}) close(f);
  return code;
}

}  // namespace

TEST_CASE("the base of the corpus is a valid case", "[case][bad_input]") {
  CHECK(what_is_said(text_of(kFolder + "/base.toml")) == "");
}

TEST_CASE("every broken case is told its sentence at its place", "[case][bad_input]") {
  const std::vector<Broken> all = corpus();
  CHECK(all.size() >= 60);
  for (const Broken& b : all) {
    INFO(b.name);
    const std::string said = what_is_said(b.text);
    if (b.stage == "build") {
      CHECK(said == "");  // it reads well; building the model refuses it
      continue;
    }
    INFO(said);
    const std::string position = "bad.toml:" + std::to_string(b.line) + ":";
    std::istringstream lines(said);
    bool found = false;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t colon = line.find(": ");
      found = found || (line.compare(0, position.size(), position) == 0 && colon != std::string::npos &&
                        (b.stage == "file" ? line.find(b.expect) != std::string::npos : line.substr(colon + 2) == b.expect));
    }
    CHECK(found);
  }
}

TEST_CASE("the program tells each broken case on stderr and ends with 2", "[case][bad_input]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("stillhook bad input " + std::to_string(::getpid()));
  fs::create_directories(folder);
  for (const char* mesh : {"open.obj", "inverted.obj", "foreign.h5", "short.1", "half.csv", "breeze.csv"}) fs::copy_file(kFolder + "/" + mesh, folder / mesh);
  const std::string file = (folder / "bad.toml").string(), messages = (folder / "stderr").string();
  for (const Broken& b : corpus()) {
    INFO(b.name);
    std::ofstream(file, std::ios::binary) << b.text;
    const int code = check_here(file, messages);
    CHECK(code == 2);
    const std::string said = text_of(messages);
    INFO(said);
    CHECK(said.find(b.expect) != std::string::npos);
  }
  fs::remove_all(folder);
}

TEST_CASE("huge, deep and binary input is refused at once", "[case][bad_input]") {
  const std::clock_t start = std::clock();  // processor time: the machine may be busy with other things
  CHECK(what_is_said(std::string(10 << 20, '[')) ==
        "bad.toml:1:1: the file has 10485760 bytes, a case may have at most 4194304");
  CHECK(what_is_said("a = " + std::string(1 << 20, '[')) == "bad.toml:1:37: brackets are nested deeper than 32");
  CHECK(what_is_said(std::string(1 << 20, '{')).find("nested deeper") != std::string::npos);
  CHECK(what_is_said(std::string("\x7f"
                                 "ELF\0\0\1",
                                 7)) == "bad.toml:1:1: is a binary file, not a case in TOML text");
  CHECK(what_is_said("name = \"\xff\xfe\"").find("bad.toml:1:") == 0);
  // Generous: it takes milliseconds; quadratic or recursive parsing would take minutes or crash.
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 5.0);
}

TEST_CASE("a file that is not there, or a folder, is named", "[case][bad_input]") {
  CHECK_THROWS_WITH(read_case(kFolder + "/no_such_case.toml"),
                    kFolder + "/no_such_case.toml: cannot be read: No such file or directory");
  CHECK_THROWS_WITH(read_case(kFolder), kFolder + ": is a folder, not a case file");
}

TEST_CASE("errors are collected, in the order of the file, up to twenty", "[case][bad_input]") {
  std::string text = text_of(kFolder + "/base.toml");
  text = std::regex_replace(text, std::regex("_kN = "), "_kNN = ");
  text = std::regex_replace(text, std::regex("(point|surface)_"), "$1n_");
  const std::string said = what_is_said(text);
  std::istringstream lines(said);
  std::string line, last;
  int count = 0, previous = 0;
  for (; std::getline(lines, line); ++count) {
    last = line;
    if (count == 20) break;
    const int number = std::stoi(line.substr(line.find(':') + 1));
    CHECK(number >= previous);
    previous = number;
  }
  CHECK(count == 20);
  CHECK(last.find("... and ") == 0);
}

TEST_CASE("a truncated case is refused or valid, never a crash", "[case][bad_input]") {
  const std::string folder = std::string(STILLHOOK_SOURCE_DIR) + "/problems";
  const std::string whole = text_of(folder + "/box_installation.toml");
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); length += 200) {
    try {
      read_case_text(whole.substr(0, length), "cut.toml", folder);
    } catch (const CaseError& error) {
      ++refused;
      CHECK(std::string(error.what()).compare(0, 9, "cut.toml:") == 0);
    }
  }
  CHECK(refused > 50);  // whatever lacks its operation
}

}  // namespace stillhook
