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
#include "results/safe_netcdf.h"
#include "results/sealed_file.h"
#include "tests/results/synthetic_lift.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
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

}  // namespace

TEST_CASE("a finished archive is sealed: one changed byte anywhere is seen", "[archive][damage]") {
  const truth::SyntheticLift lift;
  const TemporaryFolder folder;
  const std::string good = folder / "history.nc";
  write_archive(lift.trajectory, {"t", "s", "w"}, good);
  CHECK(has_good_seal(good));
  const std::string bytes = bytes_of(good);
  const std::size_t body = bytes.rfind("\nstillhook seal");
  REQUIRE(body != std::string::npos);
  for (std::size_t at = 0; at < body; at += 97) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    CAPTURE(at);
    REQUIRE_THAT(fault_of(folder.write("bad.nc", changed)), Contains("bad.nc: is damaged: its checksum"));
  }
  // Longer, shorter, another file's end.
  CHECK_THAT(fault_of(folder.write("bad.nc", bytes.substr(0, 1000) + bytes.substr(1100))), Contains("is damaged"));
  CHECK_THAT(fault_of(folder.write("bad.nc", bytes.substr(0, body / 2))), Contains("bad.nc: "));
  CHECK(fault_of(folder.write("bad.nc", bytes.substr(0, body))).empty());  // the seal alone is lost, the data are whole
  CHECK_FALSE(has_good_seal(folder / "bad.nc"));
}

TEST_CASE("an archive without a seal is tried where it can do no harm", "[archive][damage]") {
  const truth::SyntheticLift lift;
  const TemporaryFolder folder;
  const std::string good = folder / "history.nc";
  write_archive(lift.trajectory, {"t", "s", "w"}, good);
  std::string bytes = bytes_of(good);
  bytes.resize(bytes.rfind("\nstillhook seal"));
  int refused = 0, read = 0;
  // Blocks of wrong addresses, lengths and counts: this ended the process before.
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 200) {
    std::string changed = bytes;
    for (std::size_t i = at; i < std::min(at + 16, bytes.size()); ++i) changed[i] = static_cast<char>(~changed[i]);
    const std::string fault = fault_of(folder.write("bad.nc", changed));
    ++(fault.empty() ? read : refused);
    if (!fault.empty()) CHECK_THAT(fault, Contains("bad.nc: "));
  }
  CHECK(refused > 20);  // much of the file is bookkeeping, and the samples have checksums of their own
}

TEST_CASE("a reader that crashes, hangs or eats the memory is a sentence", "[damage]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("x.nc", "x");
  CHECK_THROWS_WITH(try_reading(path, [] { std::raise(SIGSEGV); }),
                    Contains("x.nc: is damaged: the NetCDF library cannot read it (Segmentation fault)"));
  CHECK_THROWS_WITH(try_reading(path, [] { std::abort(); }), Contains("is damaged"));
  CHECK_THROWS_WITH(try_reading(path, [] { std::vector<double> all(std::size_t{1} << 40, 1.0); }),
                    Contains("says that it holds more"));
  CHECK_NOTHROW(try_reading(path, [] { throw FileError("a sentence for later"); }));
  CHECK_NOTHROW(try_reading(path, [] {}));
}
