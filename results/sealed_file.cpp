#include "results/sealed_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "results/files.h"

namespace stillhook {
namespace {

constexpr std::string_view kMark = "\nstillhook seal FNV-1a ";
constexpr std::size_t kSealSize = kMark.size() + 16 + 1;  // sixteen hexadecimal digits, line end

/// Fowler, Noll & Vo's hash of the first `count` bytes: it changes with every single byte.
std::uint64_t hash_of(std::ifstream& in, std::uintmax_t count) {
  std::uint64_t hash = 14695981039346656037ull;
  std::array<char, 65536> block;
  while (count > 0 && in) {
    in.read(block.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(count, block.size())));
    const std::streamsize got = in.gcount();
    for (std::streamsize i = 0; i < got; ++i)
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 1099511628211ull;
    count -= static_cast<std::uintmax_t>(got);
  }
  return hash;
}

std::string seal_of(std::uint64_t hash) { return fmt::format("{}{:016x}\n", kMark, hash); }

}  // namespace

void seal_file(const std::string& path, const std::string& shown) {
  std::string seal;
  {
    std::ifstream in(path, std::ios::binary);
    seal = seal_of(hash_of(in, std::filesystem::file_size(path)));
  }
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << seal;
  out.flush();
  if (!out) throw FileError(fmt::format("{}: cannot be completed: {}", shown, std::strerror(errno ? errno : EIO)));
}

bool has_good_seal(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size < kSealSize) return false;
  std::ifstream in(path, std::ios::binary);
  std::string seal(kSealSize, '\0');
  in.seekg(static_cast<std::streamoff>(size - kSealSize));
  in.read(seal.data(), static_cast<std::streamsize>(seal.size()));
  if (!in || !seal.starts_with(kMark)) return false;
  in.seekg(0);
  if (seal != seal_of(hash_of(in, size - kSealSize)))
    throw FileError(path +
                    ": is damaged: its checksum is not that of what it holds; run again, or take it from a copy");
  return true;
}

}  // namespace stillhook
