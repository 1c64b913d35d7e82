#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <random>

namespace stillhook::fuzz {
namespace {

using Random = std::mt19937_64;

constexpr std::size_t kLargest = 400'000;  // bytes; what is larger slows the search and shows nothing new

std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); }

/// What readers of numbers and of names stumble over.
std::string awkward(Random& random) {
  static const std::vector<std::string> kWords = {"0",
                                                  "-1",
                                                  "1e308",
                                                  "-1e308",
                                                  "1e-320",
                                                  "nan",
                                                  "inf",
                                                  "-inf",
                                                  "99999999999999999999",
                                                  "2147483648",
                                                  "-2147483649",
                                                  "4294967296",
                                                  "0x10",
                                                  "1e",
                                                  ".",
                                                  "-",
                                                  "+",
                                                  "1,5",
                                                  "1.5.2",
                                                  "true",
                                                  "[",
                                                  "]",
                                                  "{",
                                                  "}",
                                                  "\"",
                                                  "'",
                                                  "#",
                                                  "=",
                                                  ",",
                                                  ";",
                                                  "\t",
                                                  "\r\n",
                                                  "\n\n",
                                                  "\0x",
                                                  "\xEF\xBB\xBF",
                                                  "\xFF\xFE",
                                                  "\xC3",
                                                  "*",
                                                  "[[",
                                                  "[bodies]",
                                                  "[[bodies]]",
                                                  "f 1 2 3",
                                                  "f -1 -2 -3",
                                                  "v 1e9 1e9 1e9",
                                                  "solid",
                                                  "endsolid",
                                                  "facet",
                                                  "vertex nan 0 0",
                                                  "1 1 1",
                                                  "1000000000"};
  return kWords[below(random, kWords.size())];
}

/// [begin, end) of a run of digits and the like near a random place; empty if there is none.
std::pair<std::size_t, std::size_t> number_near(const std::string& text, Random& random) {
  const auto part = [&](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == 'e' || c == 'E';
  };
  std::size_t begin = below(random, text.size());
  const std::size_t stop = std::min(text.size(), begin + 300);
  while (begin < stop && !std::isdigit(static_cast<unsigned char>(text[begin]))) ++begin;
  if (begin >= stop) return {0, 0};
  while (begin > 0 && part(text[begin - 1])) --begin;
  std::size_t end = begin;
  while (end < text.size() && part(text[end])) ++end;
  return {begin, end};
}

/// [begin, end) of the line at a random place, its end included.
std::pair<std::size_t, std::size_t> line_near(const std::string& text, Random& random) {
  const std::size_t at = below(random, text.size());
  const std::size_t before = text.rfind('\n', at == 0 ? 0 : at - 1), after = text.find('\n', at);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return {std::min(begin, at), after == std::string::npos ? text.size() : after + 1};
}

void damage_bytes(std::string& text, Random& random) {
  switch (below(random, 5)) {
    case 0:
      text[below(random, text.size())] ^= static_cast<char>(1U << below(random, 8));
      break;
    case 1:
      text[below(random, text.size())] = static_cast<char>(random());
      break;
    case 2: {  // a word of four or eight bytes: sizes and offsets of binary files
      static constexpr std::array<std::uint64_t, 7> kWords = {0,          1,     0x7FFFFFFF,        0x80000000,
                                                              0xFFFFFFFF, ~0ULL, 0x7FFFFFFFFFFFFFFF};
      const std::uint64_t word = kWords[below(random, kWords.size())];
      const std::size_t width = random() % 2 ? 4 : 8, at = below(random, text.size());
      for (std::size_t k = 0; k < width && at + k < text.size(); ++k) text[at + k] = static_cast<char>(word >> (8 * k));
      break;
    }
    case 3: {
      const std::size_t at = below(random, text.size());
      text.erase(at, 1 + below(random, std::min<std::size_t>(64, text.size() - at)));
      break;
    }
    default: {
      std::string more(1 + below(random, 16), ' ');
      for (char& c : more) c = static_cast<char>(random());
      text.insert(below(random, text.size()), more);
    }
  }
}

void damage_text(std::string& text, const std::vector<std::string>& seeds, Random& random) {
  switch (below(random, 16)) {
    case 0:  // the end cut off: seldom, since nothing after it can show anything
      text.resize(below(random, text.size()));
      break;
    case 1:
    case 2: {
      const auto [begin, end] = number_near(text, random);
      if (end > begin) text.replace(begin, end - begin, awkward(random));
      break;
    }
    case 3:
    case 4:
      text.insert(below(random, text.size()), awkward(random));
      break;
    case 5:
    case 6: {
      const auto [begin, end] = line_near(text, random);
      text.erase(begin, end - begin);
      break;
    }
    case 7:
    case 8: {
      const auto [begin, end] = line_near(text, random);
      const std::string line = text.substr(begin, std::min<std::size_t>(end - begin, 4000));
      text.insert(line_near(text, random).first, line);
      break;
    }
    case 9:
    case 10: {
      const std::string& other = seeds[below(random, seeds.size())];
      if (other.empty()) break;
      const std::size_t from = below(random, other.size());
      text.insert(below(random, text.size()), other.substr(from, 1 + below(random, 400)));
      break;
    }
    default: {  // another number of the same length: what is still a number gets further into a reader
      const auto [begin, end] = number_near(text, random);
      for (std::size_t k = begin; k < end; ++k)
        if (std::isdigit(static_cast<unsigned char>(text[k])) && random() % 2)
          text[k] = static_cast<char>('0' + below(random, 10));
    }
  }
}

}  // namespace

std::string damaged(const std::vector<std::string>& seeds, std::uint64_t number) {
  Random random(number * 0x9E3779B97F4A7C15ULL + 1);
  std::string text = seeds[below(random, seeds.size())];
  const std::size_t damages = random() % 2 ? 1 : 2 + below(random, 7);  // one alone gets furthest
  for (std::size_t k = 0; k < damages && !text.empty(); ++k) {
    if (random() % 3 == 0)
      damage_bytes(text, random);
    else
      damage_text(text, seeds, random);
  }
  if (text.size() > kLargest) text.resize(kLargest);
  return text;
}

}  // namespace stillhook::fuzz
