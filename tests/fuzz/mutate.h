// Damaged copies of a good file: the same for the same number, so that any of them can be made again alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stillhook::fuzz {

/// The input of this number: one of the seeds, with one to eight damages (bits, bytes, numbers, lines, pieces of
/// another seed, its end cut off).
std::string damaged(const std::vector<std::string>& seeds, std::uint64_t number);

}  // namespace stillhook::fuzz
