#include "problems/spectra/swan_ascii.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "sim/number_text.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr int kMostOfAll = 10000;  // frequencies, directions, points

class SwanReader {
 public:
  SwanReader(const SpectrumFileSpec& spec, double weight) : spec_(spec), weight_(weight), in_(spec.file) {
    if (!in_) throw FileError(spec.file + ": cannot be read");
  }

  RawSpectrum read() {
    if (!next() || first_word() != "SWAN") fail("does not begin with SWAN");
    read_head();
    const std::size_t point = point_index(spec_, points_, latitude_, longitude_);
    RawSpectrum raw;
    raw.frequency = frequency_;
    raw.towards = towards_;
    std::vector<double> times;
    std::string last;
    bool found = false;
    // Which time is asked for may be known by its date alone, which stands before its blocks.
    for (std::size_t t = 0; !found; ++t) {
      if (timed_) {
        if (!next()) break;
        times.push_back(time_of(first_word()));
        last = iso_of(times.back());
      } else if (t > 0) {
        break;
      }
      const bool wanted = timed_ ? is_wanted(times) : true;
      for (std::size_t p = 0; p < points_; ++p) {
        std::vector<double> block = read_block(wanted && p == point);
        if (wanted && p == point) raw.density = std::move(block), found = true;
      }
    }
    if (!found) time_index(spec_, times), fail("ends before the time that is asked for");
    raw.source = spec_.file.substr(spec_.file.find_last_of('/') + 1);
    if (timed_) raw.source += ", " + last;
    if (points_ > 1) raw.source += ", point " + std::to_string(point);
    return raw;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw FileError(spec_.file + ":" + std::to_string(line_) + ": " + sentence);
  }

  /// The next line that is no remark.
  bool next() {
    while (std::getline(in_, text_)) {
      ++line_;
      if (!text_.empty() && text_.back() == '\r') text_.pop_back();
      if (text_.empty() || text_[0] != '$') return true;
    }
    return false;
  }
  void need() {
    if (!next()) fail("the file ends too early");
  }
  std::string first_word() const {
    std::istringstream words(text_);
    std::string word;
    words >> word;
    return word;
  }
  int count() {
    need();
    std::istringstream words(text_);
    int n = 0;
    if (!(words >> n) || n < 1 || n > kMostOfAll) fail("expected a number from 1 to " + std::to_string(kMostOfAll));
    return n;
  }
  double number() {
    need();
    std::istringstream words(text_);
    double value = 0.0;
    if (!(words >> value) || !std::isfinite(value)) fail("expected a number, got \"" + text_ + "\"");
    return value;
  }

  void read_points(bool geographic) {
    points_ = static_cast<std::size_t>(count());
    for (std::size_t p = 0; p < points_; ++p) {
      need();
      std::istringstream words(text_);
      double x = 0.0, y = 0.0;
      if (!(words >> x >> y)) fail("expected the two coordinates of a point");
      if (!geographic) continue;
      longitude_.push_back(x);
      latitude_.push_back(y);
    }
  }

  void read_head() {
    bool quantities = false;
    while (!quantities) {
      need();
      const std::string word = first_word();
      if (word == "TIME") {
        timed_ = true;
        count();
      } else if (word == "LOCATIONS" || word == "LONLAT") {
        read_points(word == "LONLAT");
      } else if (word == "AFREQ" || word == "RFREQ") {
        const int n = count();
        for (int i = 0; i < n; ++i) frequency_.push_back(number());
      } else if (word == "NDIR" || word == "CDIR") {
        const int n = count();
        for (int i = 0; i < n; ++i) towards_.push_back(word == "NDIR" ? number() + 180.0 : 90.0 - number());
      } else if (word == "QUANT") {
        read_quantity();
        quantities = true;
      } else if (!word.empty()) {
        fail("\"" + word + "\" is not known in the head of a SWAN file");
      }
    }
    if (points_ == 0) fail("names no point (LOCATIONS or LONLAT)");
    if (frequency_.empty()) fail("names no frequencies (AFREQ or RFREQ)");
    if (towards_.empty()) fail("names no directions (NDIR or CDIR): it is no 2-D spectrum");
  }

  void read_quantity() {
    if (count() != 1) fail("a 2-D spectrum has one quantity");
    need();
    const std::string quantity = first_word();
    need();
    const std::string unit = first_word();
    if (quantity == "VaDens" && unit == "m2/Hz/degr")
      factor_ = 1.0 / kDegree;
    else if (quantity == "EnDens" && unit == "J/m2/Hz/degr")
      factor_ = 1.0 / kDegree / weight_;
    else
      fail("\"" + quantity + "\" in \"" + unit + "\" is neither VaDens in m2/Hz/degr nor EnDens in J/m2/Hz/degr");
    exception_ = number();
  }

  /// "20261130.060000"
  double time_of(const std::string& word) const {
    if (word.size() < 15 || word[8] != '.') fail("expected a time like 20261130.060000, got \"" + word + "\"");
    const double seconds = seconds_of(word.substr(0, 4) + "-" + word.substr(4, 2) + "-" + word.substr(6, 2) + "T" +
                                      word.substr(9, 2) + ":" + word.substr(11, 2) + ":" + word.substr(13, 2));
    if (std::isnan(seconds)) fail("\"" + word + "\" is no time");
    return seconds;
  }

  /// The last of these is the one that is asked for.
  bool is_wanted(const std::vector<double>& times) const {
    try {
      return time_index(spec_, times) + 1 == times.size();
    } catch (const FileError&) {
      return false;  // not yet; when the file ends without it, that is told
    }
  }

  /// Densities in m2/(Hz rad) of one point; `kept`: they are asked for, and must be there.
  std::vector<double> read_block(bool kept) {
    need();
    const std::size_t size = frequency_.size() * towards_.size();
    const std::string word = first_word();
    if (word == "ZERO") return std::vector<double>(size, 0.0);
    if (word == "NODATA") {
      if (kept) fail("has no data (NODATA) at the time and point that are asked for");
      return {};
    }
    if (word != "FACTOR") fail("expected FACTOR, ZERO or NODATA, got \"" + text_ + "\"");
    const double factor = number();
    std::vector<double> values;
    while (values.size() < size) {
      need();
      std::istringstream words(text_);
      double value = 0.0;
      while (values.size() < size && words >> value)
        values.push_back(value == exception_ ? std::numeric_limits<double>::quiet_NaN() : factor * factor_ * value);
      if (values.size() < size && !words.eof()) fail("expected numbers, got \"" + text_ + "\"");
    }
    return values;
  }

  const SpectrumFileSpec& spec_;
  double weight_;  // rho g
  std::ifstream in_;
  std::string text_;
  int line_ = 0;
  bool timed_ = false;
  std::size_t points_ = 0;
  std::vector<double> latitude_, longitude_, frequency_, towards_;
  double factor_ = 0.0, exception_ = 0.0;
};

}  // namespace

bool is_swan_ascii(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  char head[4] = {};
  in.read(head, 4);
  return in && std::string(head, 4) == "SWAN";
}

RawSpectrum read_swan_ascii(const SpectrumFileSpec& spec, double density, double gravity) {
  return SwanReader(spec, density * gravity).read();
}

}  // namespace stillhook
