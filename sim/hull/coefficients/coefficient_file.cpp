#include "sim/hull/coefficients/coefficient_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "sim/hull/coefficients/coefficient_text.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kReciprocity = 0.02;               // relative to the geometric mean of the diagonals
constexpr double kUniform = 1e-6;                   // relative deviation of a time step from the first
constexpr double kLargestSpacing = 90.5 * kDegree;  // rad between neighbouring headings
constexpr double kEvenHeading = 1e-6;               // rad

using Pair = std::pair<int, int>;

class CoefficientReader {
 public:
  explicit CoefficientReader(const std::string& path) : text_(path) {}

  HydrodynamicCoefficients read() const;

 private:
  std::vector<const CoefficientRow*> rows_of(const std::string& quantity) const;
  void check_duplicates() const;
  MatrixX matrix_of(const std::vector<const CoefficientRow*>& rows, bool non_negative_diagonal) const;
  void fill_retardation(HydrodynamicCoefficients& c) const;
  void fill_frequencies(HydrodynamicCoefficients& c) const;
  void fill_excitation(HydrodynamicCoefficients& c) const;

  CoefficientText text_;
};

std::vector<const CoefficientRow*> CoefficientReader::rows_of(const std::string& quantity) const {
  std::vector<const CoefficientRow*> result;
  for (const CoefficientRow& row : text_.rows())
    if (row.quantity == quantity) result.push_back(&row);
  return result;
}

void CoefficientReader::check_duplicates() const {
  std::map<std::tuple<std::string, int, double, double>, int> seen;
  for (const CoefficientRow& row : text_.rows()) {
    const auto [old, fresh] = seen.insert({{row.quantity, row.i, row.column, row.argument}, row.line});
    if (!fresh) text_.fail(row.line, "repeats line " + std::to_string(old->second));
  }
}

MatrixX CoefficientReader::matrix_of(const std::vector<const CoefficientRow*>& rows, bool non_negative_diagonal) const {
  MatrixX X = MatrixX::Zero(text_.modes(), text_.modes());
  std::map<Pair, const CoefficientRow*> given;
  for (const CoefficientRow* row : rows) {
    X(row->i, row->pair().second) = row->value;
    given[row->pair()] = row;
    if (non_negative_diagonal && row->i == row->pair().second && row->value < 0.0)
      text_.fail(row->line, row->quantity + " must not be negative on the diagonal");
  }
  for (const auto& [pair, row] : given) {
    const auto [i, j] = pair;
    if (!given.contains({j, i})) {
      X(j, i) = row->value;
    } else if (i < j) {
      const double scale = std::sqrt(std::abs(X(i, i) * X(j, j)));
      if (std::abs(X(i, j) - X(j, i)) > kReciprocity * scale) {
        std::ostringstream sentence;
        sentence << row->quantity << " is not symmetric: line " << given.at({j, i})->line << " has " << X(j, i)
                 << ", here it is " << X(i, j);
        text_.fail(row->line, sentence.str());
      }
      X(i, j) = X(j, i) = 0.5 * (X(i, j) + X(j, i));
    }
  }
  return X;
}

void CoefficientReader::fill_retardation(HydrodynamicCoefficients& c) const {
  std::map<Pair, std::vector<const CoefficientRow*>> series;
  for (const CoefficientRow* row : rows_of("K")) series[row->pair()].push_back(row);
  if (series.empty()) text_.fail(text_.last_line(), "there are no retardation functions K");
  RetardationFunctions& K = c.retardation;
  const std::vector<const CoefficientRow*>& first = series.begin()->second;
  if (first.size() < 2) text_.fail(first[0]->line, "K needs at least two times");
  K.interval = first[1]->argument - first[0]->argument;
  for (const auto& [pair, rows] : series) {
    if (rows[0]->argument != 0.0) text_.fail(rows[0]->line, "K must begin at t = 0");
    RetardationKernel kernel{pair.first, pair.second, {}};
    for (std::size_t m = 0; m < rows.size(); ++m) {
      if (m > 0 && rows[m]->argument <= rows[m - 1]->argument)
        text_.fail(rows[m]->line, "the times of K must increase");
      const double expected = K.interval * static_cast<double>(m);
      if (std::abs(rows[m]->argument - expected) > kUniform * K.interval * static_cast<double>(m + 1)) {
        std::ostringstream sentence;
        sentence << "the times of K must be evenly spaced and the same for all pairs: expected " << expected
                 << " s, got " << rows[m]->argument << " s";
        text_.fail(rows[m]->line, sentence.str());
      }
      kernel.value.push_back(rows[m]->value);
    }
    K.kernels.push_back(kernel);
    if (pair.first != pair.second && !series.contains({pair.second, pair.first})) {
      std::swap(kernel.i, kernel.j);
      K.kernels.push_back(kernel);
    }
  }
  // Reciprocity of pairs given twice, on the scale of the diagonals' peaks.
  std::map<Pair, const RetardationKernel*> by_pair;
  for (const RetardationKernel& kernel : K.kernels) by_pair[{kernel.i, kernel.j}] = &kernel;
  const auto peak = [&](int i) {
    double p = 0.0;
    if (const auto found = by_pair.find({i, i}); found != by_pair.end())
      for (double k : found->second->value) p = std::max(p, std::abs(k));
    return p;
  };
  for (const auto& [pair, rows] : series) {
    const auto other = series.find({pair.second, pair.first});
    if (pair.first >= pair.second || other == series.end()) continue;
    if (other->second.size() != rows.size())
      text_.fail(rows.back()->line, "K is not symmetric: its transpose has another length");
    const double scale = std::sqrt(peak(pair.first) * peak(pair.second));
    for (std::size_t m = 0; m < rows.size(); ++m)
      if (std::abs(rows[m]->value - other->second[m]->value) > kReciprocity * scale)
        text_.fail(rows[m]->line, "K is not symmetric: see line " + std::to_string(other->second[m]->line));
  }
}

void CoefficientReader::fill_frequencies(HydrodynamicCoefficients& c) const {
  using Rows = std::vector<const CoefficientRow*>;
  std::map<double, std::pair<Rows, Rows>> by_frequency;
  std::map<double, Rows> gap;
  for (const CoefficientRow* row : rows_of("Bgap")) gap[row->argument].push_back(row);
  for (const CoefficientRow* row : rows_of("A")) by_frequency[row->argument].first.push_back(row);
  for (const CoefficientRow* row : rows_of("B")) {
    if (!by_frequency.contains(row->argument)) text_.fail(row->line, "B is given at a frequency without A");
    by_frequency[row->argument].second.push_back(row);
  }
  for (const auto& [frequency, rows] : by_frequency) {
    if (frequency > 0.0 && rows.second.empty()) text_.fail(rows.first[0]->line, "A is given at a frequency without B");
    c.frequency.push_back({frequency, matrix_of(rows.first, false), matrix_of(rows.second, false)});
    if (const auto taken = gap.extract(frequency)) c.frequency.back().gap = matrix_of(taken.mapped(), false);
  }
  if (!gap.empty()) text_.fail(gap.begin()->second[0]->line, "Bgap is given at a frequency without A and B");
  VectorX largest = VectorX::Zero(text_.modes());
  for (const FrequencyCoefficients& f : c.frequency) largest = largest.cwiseMax(f.B.diagonal().cwiseAbs());
  for (const auto& [frequency, rows] : by_frequency)
    for (const CoefficientRow* row : rows.second)
      if (row->i == row->pair().second && row->value < -kNegativeDamping * largest(row->i))
        text_.fail(row->line, "B must not be negative on the diagonal");
}

void CoefficientReader::fill_excitation(HydrodynamicCoefficients& c) const {
  const std::vector<const CoefficientRow*> rows = rows_of("X");
  if (rows.empty()) return;
  std::set<double> frequencies, headings;
  std::map<std::tuple<double, double, int>, const CoefficientRow*> given;
  for (const CoefficientRow* row : rows) {
    frequencies.insert(row->argument);
    headings.insert(row->column);
    given[{row->argument, row->column, row->i}] = row;
  }
  ExcitationTable& X = c.excitation;
  X.modes = text_.modes();
  X.frequencies.assign(frequencies.begin(), frequencies.end());
  for (double b : headings) X.headings.push_back(b * kDegree);
  if (text_.mirrored()) {
    if (!headings.contains(0.0) || !headings.contains(180.0))
      text_.fail(rows[0]->line, "X with port_starboard symmetry needs the headings 0 and 180 deg");
    for (auto b = headings.rbegin(); b != headings.rend(); ++b)
      if (*b > 0.0 && *b < 180.0) X.headings.push_back((360.0 - *b) * kDegree);
  }
  const double spacing = 360.0 * kDegree / static_cast<double>(X.headings.size());
  for (std::size_t h = 0; h < X.headings.size(); ++h)
    if (std::abs(X.headings[h] - X.headings[0] - spacing * static_cast<double>(h)) > kEvenHeading)
      text_.fail(rows[0]->line, "the headings of X must be evenly spaced over " +
                                    std::string(text_.mirrored() ? "0..180 deg" : "the circle"));
  if (spacing > kLargestSpacing) text_.fail(rows[0]->line, "the headings of X are more than 90 deg apart");
  if (text_.mirrored())
    for (const CoefficientRow* row : rows)
      if (row->i % 2 == 1 && (row->column == 0.0 || row->column == 180.0) && row->value > 0.0)
        text_.fail(row->line, "sway, roll and yaw must vanish in following and head seas with port_starboard symmetry");
  X.value.resize(X.frequencies.size() * X.headings.size() * text_.modes());
  for (std::size_t f = 0; f < X.frequencies.size(); ++f)
    for (std::size_t h = 0; h < X.headings.size(); ++h)
      for (int i = 0; i < text_.modes(); ++i) {
        const bool mirror = h >= headings.size();
        const double heading =
            *std::next(headings.begin(), static_cast<std::ptrdiff_t>(mirror ? 2 * (headings.size() - 1) - h : h));
        const auto found = given.find({X.frequencies[f], heading, i});
        if (found == given.end()) {
          std::ostringstream sentence;
          sentence << "X is incomplete: mode " << i + 1 << " at " << X.frequencies[f] << " rad/s and " << heading
                   << " deg is missing";
          text_.fail(rows.back()->line, sentence.str());
        }
        // Seen in the mirror, sway, roll and yaw change sign.
        const double sign = mirror && (i % 2 == 1) ? -1.0 : 1.0;
        X.at(static_cast<int>(f), static_cast<int>(h), i) =
            sign * std::polar(found->second->value, found->second->phase * kDegree);
      }
}

HydrodynamicCoefficients CoefficientReader::read() const {
  HydrodynamicCoefficients c;
  c.source = text_.path();
  c.description = text_.header_text("description");
  c.waterline = text_.header_number("waterline_m", -1e6, false);
  c.density = text_.header_number("density_kg_m3", 0.0, true);
  c.gravity = text_.header_number("gravity_m_s2", 0.0, true);
  c.length = text_.header_number("length_m", 0.0, true);
  c.volume = text_.per_hull("volume_m3");
  c.waterplane = text_.per_hull("waterplane_m2");
  if (text_.has("depth_m")) c.depth = text_.header_number("depth_m", 0.0, true);
  if (text_.has("gap_rise")) c.gap_rise = text_.header_number("gap_rise", 0.0, true);
  if (text_.has("gap_frequency_rad_s")) c.gap_frequency = text_.header_number("gap_frequency_rad_s", 0.0, true);
  check_duplicates();
  const std::vector<const CoefficientRow*> A_inf = rows_of("Ainf");
  if (A_inf.empty()) text_.fail(text_.last_line(), "there is no added mass Ainf");
  c.A_inf = matrix_of(A_inf, true);
  fill_retardation(c);
  fill_frequencies(c);
  fill_excitation(c);
  return c;
}

}  // namespace

HydrodynamicCoefficients read_coefficient_file(const std::string& path) { return CoefficientReader(path).read(); }

}  // namespace stillhook
