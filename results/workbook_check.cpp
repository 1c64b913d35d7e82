#include "results/workbook_check.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

namespace stillhook {
namespace {

// A workbook is a ZIP archive (PKWARE APPNOTE 4.3): members, then their directory, then where that is.
constexpr std::size_t kEndSize = 22, kEntrySize = 46, kHeaderSize = 30;
constexpr std::uint32_t kEndMark = 0x06054b50, kEntryMark = 0x02014b50;

std::uint32_t number(const std::vector<unsigned char>& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = size; i-- > 0;) value = value << 8 | bytes.at(at + static_cast<std::size_t>(i));
  return value;
}

std::vector<unsigned char> read_at(std::ifstream& in, std::uint64_t offset, std::size_t size) {
  std::vector<unsigned char> bytes(size);
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return bytes;
}

struct Member {
  std::string name;
  std::uint32_t compressed = 0, offset = 0;
};

/// Empty if the archive's directory cannot be found.
std::vector<Member> members_of(std::ifstream& in) {
  std::vector<Member> members;
  in.seekg(0, std::ios::end);
  const std::uint64_t size = static_cast<std::uint64_t>(in.tellg());
  if (size < kEndSize) return members;
  const auto end = read_at(in, size - kEndSize, kEndSize);
  if (!in || number(end, 0, 4) != kEndMark) return members;
  const auto directory = read_at(in, number(end, 16, 4), number(end, 12, 4));
  for (std::size_t at = 0; in && at + kEntrySize <= directory.size() && number(directory, at, 4) == kEntryMark;) {
    const std::size_t name = number(directory, at + 28, 2);
    members.push_back({std::string(directory.begin() + static_cast<std::ptrdiff_t>(at + kEntrySize),
                                   directory.begin() + static_cast<std::ptrdiff_t>(at + kEntrySize + name)),
                       number(directory, at + 20, 4), number(directory, at + 42, 4)});
    at += kEntrySize + name + number(directory, at + 30, 2) + number(directory, at + 32, 2);
  }
  return members;
}

/// The end of what a member unpacks to; empty if it does not unpack.
std::string end_of(std::ifstream& in, const Member& member) {
  constexpr std::size_t kKept = 32;
  const auto header = read_at(in, member.offset, kHeaderSize);
  if (!in) return {};
  in.seekg(static_cast<std::streamoff>(member.offset + kHeaderSize + number(header, 26, 2) + number(header, 28, 2)));
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return {};
  std::array<unsigned char, 65536> packed, unpacked;
  std::string tail;
  std::uint32_t left = member.compressed;
  int state = Z_OK;
  while (state == Z_OK && left > 0) {
    const std::uint32_t some = std::min<std::uint32_t>(left, packed.size());
    if (!in.read(reinterpret_cast<char*>(packed.data()), some)) break;
    left -= some;
    stream.next_in = packed.data();
    stream.avail_in = some;
    do {
      stream.next_out = unpacked.data();
      stream.avail_out = unpacked.size();
      state = inflate(&stream, Z_NO_FLUSH);
      tail.append(reinterpret_cast<char*>(unpacked.data()), unpacked.size() - stream.avail_out);
      if (tail.size() > kKept) tail.erase(0, tail.size() - kKept);
    } while (state == Z_OK && stream.avail_out == 0);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) return {};
  tail.erase(tail.find_last_not_of(" \r\n") + 1);
  return tail;
}

}  // namespace

std::string workbook_fault(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<Member> members = members_of(in);
  if (members.empty()) return "is not a complete archive";
  for (const Member& member : members) {
    const bool sheet = member.name.starts_with("xl/worksheets/sheet");
    if (!end_of(in, member).ends_with(sheet ? "</worksheet>" : ">")) return member.name + " in it is incomplete";
  }
  return {};
}

}  // namespace stillhook
