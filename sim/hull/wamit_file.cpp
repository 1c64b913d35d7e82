#include "sim/hull/wamit_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "sim/hull/wamit_text.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

// Mod and Pha are printed with 6 digits; a phase in radians, or of the other sign, is far outside.
constexpr double kSameForce = 1e-2;

class WamitReader {
 public:
  WamitReader(const std::string& base, const WamitUnits& units, const DatabaseFrame& frame)
      : base_(base), units_(units), frame_(frame), modes_(static_cast<int>(6 * frame.bodies.size())) {}

  HydrodynamicCoefficients read() const;

 private:
  /// rad/s of the first column; infinity and 0 are the limits.
  double frequency(double column) const;
  std::string named(double frequency) const;
  double scale(int i, int j) const { return std::pow(units_.ulen, (i % 6 > 2 ? 1 : 0) + (j % 6 > 2 ? 1 : 0)); }
  void read_radiation(const std::string& path, HydrodynamicCoefficients& c) const;
  void read_excitation(const std::string& path, HydrodynamicCoefficients& c) const;
  void read_stiffness(const std::string& path, HydrodynamicCoefficients& c) const;

  const std::string& base_;
  const WamitUnits& units_;
  const DatabaseFrame& frame_;
  int modes_;
};

double WamitReader::frequency(double column) const {
  const double infinite = std::numeric_limits<double>::infinity();
  if (units_.column == WamitUnits::Column::frequency) return column < 0.0 ? infinite : column;
  if (column == 0.0) return infinite;
  return column < 0.0 ? 0.0 : 2.0 * std::numbers::pi / column;
}

std::string WamitReader::named(double w) const {
  if (std::isinf(w)) return "infinite frequency";
  std::ostringstream out;
  if (w == 0.0 || units_.column == WamitUnits::Column::frequency)
    out << w << " rad/s";
  else
    out << "the period " << 2.0 * std::numbers::pi / w << " s";
  return out.str();
}

void WamitReader::read_radiation(const std::string& path, HydrodynamicCoefficients& c) const {
  const WamitText text(path);
  using Pair = std::pair<int, int>;
  std::map<double, std::map<Pair, const WamitRow*>> given;
  std::set<Pair> pairs;
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 4, 5);
    const double w = frequency(row.column[0]);
    if (w > 0.0 && std::isfinite(w)) text.require_columns(row, 5, 5);
    const Pair pair(text.mode(row, 1, modes_), text.mode(row, 2, modes_));
    const auto [old, fresh] = given[w].insert({pair, &row});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second->line));
    pairs.insert(pair);
  }
  const int last = text.rows().back().line;
  if (!given.contains(std::numeric_limits<double>::infinity()))
    text.fail(last, "there is no added mass at infinite frequency: run the code for it too (PER = 0)");
  if (pairs.rbegin()->first < modes_ - 6)
    text.fail(last, "holds fewer than the " + std::to_string(modes_ / 6) + " hulls it is read for");
  for (const auto& [w, rows] : given) {
    MatrixX A = MatrixX::Zero(modes_, modes_), B = A;
    for (const auto& [i, j] : pairs) {
      const auto found = rows.find({i, j});
      if (found == rows.end()) {
        int end = 0;
        for (const auto& [pair, row] : rows) end = std::max(end, row->line);
        text.fail(end, "mode pair " + std::to_string(i + 1) + "," + std::to_string(j + 1) + " is missing at " +
                           named(w) + ", other frequencies have it: is the file cut off?");
      }
      const double factor = units_.density * std::pow(units_.ulen, 3) * scale(i, j);
      A(i, j) = found->second->column[3] * factor;
      if (w > 0.0 && std::isfinite(w)) B(i, j) = found->second->column[4] * factor * w;
    }
    if (std::isinf(w))
      c.A_inf = A;
    else
      c.frequency.push_back({w, A, B});
  }
}

void WamitReader::read_excitation(const std::string& path, HydrodynamicCoefficients& c) const {
  const WamitText text(path);
  std::map<std::tuple<double, double, int>, const WamitRow*> given;
  std::set<double> frequencies, headings;
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 7, 7);
    const double w = frequency(row.column[0]);
    if (w == 0.0 || std::isinf(w)) text.fail(row.line, "there is no excitation at " + named(w));
    const auto [old, fresh] = given.insert({{w, row.column[1], text.mode(row, 2, modes_)}, &row});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second->line));
    frequencies.insert(w);
    headings.insert(row.column[1]);
    const Complex polar = std::polar(std::abs(row.column[3]), row.column[4] * kDegree);
    if (std::abs(polar - Complex(row.column[5], row.column[6])) > kSameForce * std::abs(row.column[3]))
      text.fail(row.line, "Mod and Pha (deg) are not those of Re and Im");
  }
  ExcitationTable& X = c.excitation;
  X.modes = modes_;
  X.frequencies.assign(frequencies.begin(), frequencies.end());
  for (double b : headings) X.headings.push_back(b * kDegree);
  for (double w : frequencies)
    for (double b : headings)
      for (int i = 0; i < modes_; ++i) {
        const auto found = given.find({w, b, i});
        if (found == given.end()) {
          std::ostringstream sentence;
          sentence << "mode " << i + 1 << " is missing at " << named(w) << " and " << b
                   << " deg, other headings or periods have it: is the file cut off?";
          text.fail(text.rows().back().line, sentence.str());
        }
        const double factor = units_.density * units_.gravity * std::pow(units_.ulen, i % 6 > 2 ? 3 : 2);
        X.value.push_back(factor * Complex(found->second->column[5], found->second->column[6]));
      }
}

void WamitReader::read_stiffness(const std::string& path, HydrodynamicCoefficients& c) const {
  const WamitText text(path);
  std::map<std::pair<int, int>, int> seen;
  std::vector<double> area(frame_.bodies.size(), 0.0);
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 3, 3);
    const int i = text.mode(row, 0, modes_), j = text.mode(row, 1, modes_);
    const auto [old, fresh] = seen.insert({{i, j}, row.line});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second));
    if (i == j && i % 6 == 2) {
      area[static_cast<std::size_t>(i / 6)] = row.column[2] * units_.ulen * units_.ulen;
      if (row.column[2] < 0.0) text.fail(row.line, "the restoring in heave must be >= 0");
    }
  }
  for (int n = 0; n < modes_; n += 6)
    if (!seen.contains({n + 2, n + 2}))
      text.fail(text.rows().back().line, "the restoring in heave is missing: is the file cut off?");
  c.waterplane = area;
}

HydrodynamicCoefficients WamitReader::read() const {
  HydrodynamicCoefficients c;
  c.source = base_ + ".1";
  c.description = "WAMIT files " + base_;
  require_frame(frame_, c.source);
  if (!(units_.density > 0.0) || !(units_.gravity > 0.0) || !(units_.ulen > 0.0))
    throw SpecificationError(c.source, "", "density, gravity and ULEN of a WAMIT run must be given, all > 0");
  c.density = units_.density;
  c.gravity = units_.gravity;
  std::vector<Vector3> reference = units_.reference;
  for (const DatabaseBody& body : frame_.bodies) {
    if (!(body.volume > 0.0))
      throw SpecificationError(c.source, "", "WAMIT files do not hold the displaced volume: it must be given");
    c.volume.push_back(body.volume);
    if (units_.reference.empty()) reference.push_back(body.origin);
  }
  if (reference.size() != frame_.bodies.size())
    throw SpecificationError(c.source, "", "there must be one reference point (XBODY) a hull");
  read_radiation(base_ + ".1", c);
  const bool diffraction = std::filesystem::exists(base_ + ".3");
  const std::string excitation = base_ + (diffraction ? ".3" : ".2");
  if (!diffraction && !std::filesystem::exists(excitation))
    throw SpecificationError(base_ + ".3", "", "cannot be opened, nor " + excitation + ": no excitation forces");
  read_excitation(excitation, c);
  if (std::filesystem::exists(base_ + ".hst")) read_stiffness(base_ + ".hst", c);
  require_deep_water(c.excitation, c.gravity, units_.depth, frame_, excitation);
  complete_retardation(c, frame_);
  to_body_origins(c, reference, frame_, units_.depth);
  complete_headings(c.excitation, frame_, excitation);
  return c;
}

}  // namespace

HydrodynamicCoefficients read_wamit(const std::string& base, const WamitUnits& units, const DatabaseFrame& frame) {
  return WamitReader(base, units, frame).read();
}

}  // namespace stillhook
