#include "sim/hull/coefficients/wamit_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>

#include "sim/hull/coefficients/wamit_text.h"
#include "sim/hull/radiation/infinite_frequency.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

// Mod and Pha are printed with 6 digits; a phase in radians, or of the other sign, is far outside.
constexpr double kSameForce = 1e-2;
// Of the largest force (or moment) of the file: what symmetry makes zero is rounding noise, of codes that compute in
// single precision up to 1e-6, and Mod and Pha of noise need not be those of Re and Im.
constexpr double kNoForce = 1e-5;
constexpr int kMostFileModes = 600;

class WamitReader {
 public:
  WamitReader(const std::string& base, const WamitUnits& units, const DatabaseFrame& frame)
      : base_(base), units_(units), frame_(frame), modes_(static_cast<int>(6 * frame.bodies.size())) {}

  HydrodynamicCoefficients read();

 private:
  /// rad/s of the first column; infinity and 0 are the limits.
  double frequency(double column) const;
  std::string named(double frequency) const;
  double scale(int i, int j) const { return std::pow(units_.ulen, (i % 6 > 2 ? 1 : 0) + (j % 6 > 2 ? 1 : 0)); }
  /// Finds out how many bodies the files are of, and which of them are read.
  void choose_bodies(const WamitText& text, HydrodynamicCoefficients& c);
  /// Column n as a mode of the set, -1 when it is one of a body that is not read.
  int mode(const WamitText& text, const WamitRow& row, std::size_t n) const {
    return local_[static_cast<std::size_t>(text.mode(row, n, static_cast<int>(local_.size())))];
  }
  void read_radiation(const std::string& path, HydrodynamicCoefficients& c);
  /// A_inf where the file has none.
  void complete_infinite(const WamitText& text, HydrodynamicCoefficients& c) const;
  void read_excitation(const std::string& path, HydrodynamicCoefficients& c) const;
  void require_polar(const WamitText& text) const;
  void read_stiffness(const std::string& path, HydrodynamicCoefficients& c) const;
  void require_units(const std::string& source) const;

  const std::string& base_;
  const WamitUnits& units_;
  const DatabaseFrame& frame_;
  int modes_;               // of the set
  std::vector<int> local_;  // mode of the set for each mode of the files
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

void WamitReader::choose_bodies(const WamitText& text, HydrodynamicCoefficients& c) {
  int highest = 0;
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 4, 5);
    highest = std::max({highest, text.mode(row, 1, kMostFileModes), text.mode(row, 2, kMostFileModes)});
  }
  const int held = highest / 6 + 1;
  local_.assign(static_cast<std::size_t>(6 * held), -1);
  int next = 0;
  for (const int body : chosen_bodies(held, frame_, text.path(), c.remarks))
    for (int i = 0; i < 6; ++i) local_[static_cast<std::size_t>(6 * body + i)] = next++;
}

void WamitReader::read_radiation(const std::string& path, HydrodynamicCoefficients& c) {
  const WamitText text(path);
  choose_bodies(text, c);
  using Pair = std::pair<int, int>;
  std::map<double, std::map<Pair, const WamitRow*>> given;
  std::set<Pair> pairs;
  for (const WamitRow& row : text.rows()) {
    const double w = frequency(row.column[0]);
    if (w > 0.0 && std::isfinite(w)) text.require_columns(row, 5, 5);
    const Pair pair(mode(text, row, 1), mode(text, row, 2));
    if (pair.first < 0 || pair.second < 0) continue;
    const auto [old, fresh] = given[w].insert({pair, &row});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second->line));
    pairs.insert(pair);
  }
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
  if (!given.contains(std::numeric_limits<double>::infinity())) complete_infinite(text, c);
}

void WamitReader::complete_infinite(const WamitText& text, HydrodynamicCoefficients& c) const {
  try {
    c.A_inf = infinite_added_mass(c.frequency);
  } catch (const std::invalid_argument& error) {
    text.fail(text.rows().back().line,
              std::string("there is no added mass at infinite frequency, and it cannot be computed of the others: ") +
                  error.what() + "; run the code for it too (PER = 0)");
  }
  c.remarks.push_back(text.path() + ": there is no added mass at infinite frequency (PER = 0): it is computed of A and B "
                                    "by Ogilvie's relation");
}

void WamitReader::require_polar(const WamitText& text) const {
  const auto rotates = [&](const WamitRow& row) {
    return text.mode(row, 2, static_cast<int>(local_.size())) % 6 > 2 ? 1U : 0U;
  };
  double largest[2] = {0.0, 0.0};
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 7, 7);
    double& of_kind = largest[rotates(row)];
    of_kind = std::max({of_kind, std::abs(row.column[3]), std::hypot(row.column[5], row.column[6])});
  }
  for (const WamitRow& row : text.rows()) {
    const Complex polar = std::polar(std::abs(row.column[3]), row.column[4] * kDegree);
    if (std::abs(polar - Complex(row.column[5], row.column[6])) >
        kSameForce * std::abs(row.column[3]) + kNoForce * largest[rotates(row)])
      text.fail(row.line, "Mod and Pha (deg) are not those of Re and Im");
  }
}

void WamitReader::read_excitation(const std::string& path, HydrodynamicCoefficients& c) const {
  const WamitText text(path);
  require_polar(text);
  std::map<std::tuple<double, double, int>, const WamitRow*> given;
  std::set<double> frequencies, headings;
  for (const WamitRow& row : text.rows()) {
    const double w = frequency(row.column[0]);
    if (w == 0.0 || std::isinf(w)) text.fail(row.line, "there is no excitation at " + named(w));
    const int i = mode(text, row, 2);
    if (i < 0) continue;
    const auto [old, fresh] = given.insert({{w, row.column[1], i}, &row});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second->line));
    frequencies.insert(w);
    headings.insert(row.column[1]);
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
  std::map<std::pair<double, double>, int> seen;
  c.waterplane.assign(frame_.bodies.size(), kNaN);
  c.stiffness.assign(frame_.bodies.size(), {Matrix6::Constant(kNaN), Vector3::Zero()});
  for (const WamitRow& row : text.rows()) {
    text.require_columns(row, 3, 3);
    const int i = mode(text, row, 0), j = mode(text, row, 1);
    const auto [old, fresh] = seen.insert({{row.column[0], row.column[1]}, row.line});
    if (!fresh) text.fail(row.line, "repeats line " + std::to_string(old->second));
    if (i < 0 || j < 0 || i / 6 != j / 6) continue;
    const auto body = static_cast<std::size_t>(i / 6);
    const double area = row.column[2] * units_.ulen * units_.ulen;
    c.stiffness[body].C(i % 6, j % 6) = units_.density * units_.gravity * area * scale(i, j);
    if (i != j || i % 6 != 2) continue;
    c.waterplane[body] = area;
    if (area < 0.0) text.fail(row.line, "the restoring in heave must be >= 0");
  }
  for (const double area : c.waterplane)
    if (std::isnan(area)) text.fail(text.rows().back().line, "the restoring in heave is missing: is the file cut off?");
}

void WamitReader::require_units(const std::string& source) const {
  require_frame(frame_, source);
  if (!(units_.density > 0.0) || !(units_.gravity > 0.0) || !(units_.ulen > 0.0))
    throw SpecificationError(source, "", "density, gravity and ULEN of a WAMIT run must be given, all > 0");
  for (const DatabaseBody& body : frame_.bodies)
    if (!(body.volume > 0.0))
      throw SpecificationError(source, "", "WAMIT files do not hold the displaced volume: it must be given");
  if (!units_.reference.empty() && units_.reference.size() != frame_.bodies.size())
    throw SpecificationError(source, "", "there must be one reference point (XBODY) a hull");
}

HydrodynamicCoefficients WamitReader::read() {
  namespace fs = std::filesystem;
  HydrodynamicCoefficients c;
  c.source = base_ + ".1";
  c.description = "WAMIT files " + base_;
  require_units(c.source);
  c.density = units_.density;
  c.gravity = units_.gravity;
  std::vector<Vector3> reference = units_.reference;
  for (const DatabaseBody& body : frame_.bodies) {
    c.volume.push_back(body.volume);
    if (units_.reference.empty()) reference.push_back(body.origin);
  }
  read_radiation(wamit_path(base_, ".1"), c);
  std::string excitation = wamit_path(base_, ".3");
  if (!fs::exists(excitation)) excitation = wamit_path(base_, ".2");
  // Without either there is calm water: what runs in waves asks for them.
  if (fs::exists(excitation)) read_excitation(excitation, c);
  if (const std::string path = wamit_path(base_, ".hst"); fs::exists(path)) read_stiffness(path, c);
  for (std::size_t n = 0; n < c.stiffness.size(); ++n) c.stiffness[n].about = reference[n] - frame_.bodies[n].origin;
  cut_frequencies(c, frame_, c.source);
  c.depth = water_of(c.excitation, c.gravity, units_.depth, frame_, excitation);
  complete_retardation(c, frame_);
  turn_heading(c, reference[0], frame_, units_.depth, excitation);
  to_body_origins(c, reference, frame_, units_.depth);
  complete_headings(c.excitation, frame_, excitation);
  return c;
}

}  // namespace

std::string wamit_path(const std::string& base, const std::string& ending) {
  std::string capitals = ending;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  if (!std::filesystem::exists(base + ending) && std::filesystem::exists(base + capitals)) return base + capitals;
  return base + ending;
}

HydrodynamicCoefficients read_wamit(const std::string& base, const WamitUnits& units, const DatabaseFrame& frame) {
  return WamitReader(base, units, frame).read();
}

}  // namespace stillhook
