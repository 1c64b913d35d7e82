#include "planner/cli/progress.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "planner/cli/text_table.h"
#include "planner/text_number.h"

using namespace stillhook;

namespace {

/// What a progress of these kinds writes when it is updated every 10 ms for `seconds`.
std::string written(bool terminal, bool quiet, double seconds) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  {
    Progress progress(out, terminal, quiet);
    const auto begin = Progress::Clock::now();
    for (int i = 0; i * 0.01 <= seconds; ++i)
      progress.update(i * 0.01 / seconds, "working", begin + std::chrono::milliseconds(10 * i));
  }
  std::fclose(out);
  const std::string result(text, size);
  std::free(text);
  return result;
}

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (std::size_t p = text.find(what); p != std::string::npos; p = text.find(what, p + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a terminal gets a bar, ten times a second at most, and a clean line at the end") {
  const std::string text = written(true, false, 3.0);
  CHECK(count(text, "working") >= 25);
  CHECK(count(text, "working") <= 31);
  CHECK(count(text, "\n") == 0);
  CHECK(text.substr(text.size() - 4) == "\r\x1b[K");
}

TEST_CASE("anything else gets a plain line every 30 s") {
  const std::string text = written(false, false, 100.0);
  CHECK(count(text, "\n") == 3);
  CHECK(count(text, "\r") == 0);
  CHECK(count(text, "\x1b") == 0);
  CHECK_THAT(text, Catch::Contains("30 %  working, about 1 min 10 s left"));
}

TEST_CASE("quiet is quiet") {
  CHECK(written(true, true, 3.0).empty());
  CHECK(written(false, true, 100.0).empty());
}

TEST_CASE("numbers and tables") {
  CHECK(duration_text(59.6) == "1 min 0 s");
  CHECK(duration_text(7620) == "2 h 7 min");
  CHECK(duration_text(-1) == "0 s");
  CHECK(cell(-0.0004, 3) == "0.000");
  CHECK(cell(-0.0006, 3) == "-0.001");
  CHECK(cell(std::nan(""), 3) == "-");
  TextTable table({"pose", "x m"});
  table.add({"a – b", "1.25"});
  table.add({"c"});
  CHECK(table.text() == "  pose    x m\n  -----------\n  a – b  1.25\n  c\n");
}
