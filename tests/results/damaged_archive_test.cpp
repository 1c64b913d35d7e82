// history.nc after a bad disk, a broken copy or a kill: refused with a sentence, or read as it was written.
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "results/archive.h"
#include "results/files.h"
#include "results/sealed_file.h"
#include "sim/guarded_read.h"
#include "tests/results/synthetic_lift.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;
using Catch::Contains;
namespace fs = std::filesystem;

/// Defined where AddressSanitizer is linked in.
extern "C" void __asan_init() __attribute__((weak));

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes a new file in the place of an old one. Some file systems wait for the disk when one is overwritten.
std::string replaced(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  fs::remove(folder / name);
  return folder.write(name, bytes);
}

/// What reading a file says; empty if it could be read.
std::string fault_of(const std::string& path) {
  try {
    read_archive(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

/// A run with few channels and samples, whose archive is quickly read and mostly bookkeeping.
Trajectory short_run() {
  constexpr std::size_t kChannels = 8, kSamples = 500;
  Trajectory run = truth::SyntheticLift().trajectory;
  run.channels.resize(kChannels);
  run.values.resize(kChannels);
  run.time.resize(kSamples);
  for (std::vector<double>& values : run.values) values.resize(kSamples);
  for (std::vector<Extreme>& phase : run.extremes) phase.resize(kChannels);
  return run;
}

/// How many of `places` copies without a seal are refused, each with sixteen wrong bytes at another place; every
/// refusal must name the file.
int refused_copies(const Trajectory& run, std::size_t places) {
  const TemporaryFolder folder;
  const std::string good = folder / "history.nc";
  write_archive(run, {"t", "s", "w"}, good);
  std::string bytes = bytes_of(good);
  bytes.resize(bytes.rfind("\nstillhook seal"));
  int refused = 0;
  // Blocks of wrong addresses, lengths and counts: this ended the process before.
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / places) {
    std::string changed = bytes;
    for (std::size_t i = at; i < std::min(at + 16, bytes.size()); ++i) changed[i] = static_cast<char>(~changed[i]);
    const std::string fault = fault_of(replaced(folder, "bad.nc", changed));
    if (fault.empty()) continue;
    ++refused;
    CHECK_THAT(fault, Contains("bad.nc: "));
  }
  return refused;
}

}  // namespace

TEST_CASE("a finished archive is sealed: one changed byte anywhere is seen", "[archive][damage]") {
  const TemporaryFolder folder;
  const std::string good = folder / "history.nc";
  write_archive(short_run(), {"t", "s", "w"}, good);
  CHECK(has_good_seal(good));
  const std::string bytes = bytes_of(good);
  const std::size_t body = bytes.rfind("\nstillhook seal");
  REQUIRE(body != std::string::npos);
  for (std::size_t at = 0; at < body; at += 97) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    CAPTURE(at);
    REQUIRE_THAT(fault_of(replaced(folder, "bad.nc", changed)), Contains("bad.nc: is damaged: its checksum"));
  }
  // Longer, shorter, another file's end.
  CHECK_THAT(fault_of(folder.write("bad.nc", bytes.substr(0, 1000) + bytes.substr(1100))), Contains("is damaged"));
  CHECK_THAT(fault_of(folder.write("bad.nc", bytes.substr(0, body / 2))), Contains("bad.nc: "));
  CHECK(fault_of(folder.write("bad.nc", bytes.substr(0, body))).empty());  // the seal alone is lost, the data are whole
  CHECK_FALSE(has_good_seal(folder / "bad.nc"));
}

TEST_CASE("an archive without a seal is tried where it can do no harm", "[archive][damage]") {
  CHECK(refused_copies(short_run(), 15) > 2);  // much of the file is bookkeeping, and the samples have checksums
}

TEST_CASE("a whole archive without a seal is tried where it can do no harm", "[archive][damage][slow]") {
  CHECK(refused_copies(truth::SyntheticLift().trajectory, 200) > 20);
}

TEST_CASE("a reader that does not come to an end is stopped", "[damage][slow]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("x.nc", "x");
  const auto for_ever = [] {
    volatile bool turning = true;
    while (turning) {
    }
  };
  CHECK_THROWS_WITH(try_reading(path, for_ever), Contains("cannot read it (it does not come to an end)"));
}

TEST_CASE("a reader that crashes or eats the memory is a sentence", "[damage]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("x.nc", "x");
  CHECK_THROWS_WITH(try_reading(path, [] { std::raise(SIGSEGV); }),
                    Contains("x.nc: is damaged: the HDF5 library cannot read it (Segmentation fault)"));
  CHECK_THROWS_WITH(try_reading(path, [] { std::abort(); }), Contains("is damaged"));
  // AddressSanitizer ends a process that asks for more than there is, where operator new throws.
  CHECK_THROWS_WITH(try_reading(path, [] { std::vector<double> all(std::size_t{1} << 40, 1.0); }),
                    Contains(__asan_init ? "ended its process" : "says that it holds more"));
  CHECK_THROWS_WITH(try_reading(path, [] { throw FileError("x.nc: a sentence"); }), "x.nc: a sentence");
  CHECK_THROWS_WITH(try_reading(path, [] { std::exit(0); }), Contains("ended its process"));
  // More than a pipe holds at once, with every byte there is.
  std::string long_one(300000, ' ');
  for (std::size_t i = 0; i < long_one.size(); ++i) long_one[i] = static_cast<char>(i % 256);
  CHECK(read_in_child(path, [&] { return long_one; }) == long_one);
  CHECK_NOTHROW(try_reading(path, [] {}));
}
