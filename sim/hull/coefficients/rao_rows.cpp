#include "sim/hull/coefficients/rao_rows.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include "sim/csv_cells.h"
#include "sim/error.h"
#include "sim/hull/coefficients/wamit_text.h"
#include "sim/number_text.h"
#include "sim/sea/dispersion.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr std::array<const char*, 6> kMotions = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr double kLargestAmplitude = 50.0;  // m/m, deg/m: more is a wrong unit or a wrong column
constexpr int kMostRaoModes = 600;          // 100 bodies
constexpr double kSameNumber = 2e-3;        // of the largest of the motion: Mod and Pha against Re and Im, as printed

/// What a positive phase of the file is as a lag behind the crest, rad.
double lag_behind_crest(const RaoSpec& spec, double phase) {
  const double after_event = spec.phase == RaoSpec::Phase::lag ? phase : -phase;
  switch (spec.event) {
    case RaoSpec::Event::crest:
      return after_event;
    case RaoSpec::Event::trough:
      return after_event + std::numbers::pi;
    case RaoSpec::Event::rising:  // a quarter of a period before the crest
      return after_event - 0.5 * std::numbers::pi;
    case RaoSpec::Event::falling:
      return after_event + 0.5 * std::numbers::pi;
  }
  return after_event;
}

/// The columns that a quantity may stand in, and what makes SI of each.
struct Alternative {
  std::string name;
  double factor = 1.0;
  enum class Kind { plain, period, slope } kind = Kind::plain;
};
using Alternatives = std::vector<Alternative>;

class RaoCsv {
 public:
  RaoCsv(const RaoSpec& spec, double gravity, double depth) : spec_(spec), gravity_(gravity), depth_(depth) { out_.path = spec.file; }

  RaoRows read() {
    std::ifstream in(spec_.file, std::ios::binary);
    if (!in) out_.fail(0, "cannot be opened");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (text.find('\0') != std::string::npos) out_.fail(0, "is not text; save the table as CSV");
    CsvRows rows(text);
    const char separator = rows.find_separator();
    std::vector<CsvCell> cells;
    while (next(rows, separator, cells)) {
      if (columns_.empty())
        take_names(cells, rows.line());
      else
        take_row(cells, rows.line());
    }
    if (out_.rows.empty()) out_.fail(0, "has no rows of numbers below a line with the names of its columns");
    return std::move(out_);
  }

 private:
  struct Column {
    std::size_t place;
    Alternative as;
  };

  bool next(CsvRows& rows, char separator, std::vector<CsvCell>& cells) {
    try {
      return rows.next(separator, cells);
    } catch (const std::runtime_error& error) {
      out_.fail(rows.line(), error.what());
    }
  }

  void take_names(const std::vector<CsvCell>& cells, int line) {
    std::map<std::string, std::size_t> place;
    for (std::size_t n = 0; n < cells.size(); ++n)
      if (!place.emplace(std::string(cells[n].text), n).second)
        out_.fail(line, "has the column \"" + std::string(cells[n].text) + "\" twice");
    const auto find = [&](const Alternatives& alternatives, const std::string& remedy) {
      std::optional<Column> found;
      std::string names;
      for (const Alternative& a : alternatives) {
        names += (names.empty() ? "\"" : " or \"") + a.name + "\"";
        const auto at = place.find(a.name);
        if (at == place.end()) continue;
        if (found) out_.fail(line, "has both \"" + found->as.name + "\" and \"" + a.name + "\", give one of them");
        found = Column{at->second, a};
        place.erase(at);
      }
      if (!found) out_.fail(line, "needs a column " + names + remedy);
      columns_.push_back(*found);
    };
    using Kind = Alternative::Kind;
    find({{"period_s", 1.0, Kind::period}, {"frequency_rad_per_s", 1.0}, {"frequency_hz", kTwoPi}}, "");
    find({{"heading_deg", kDegree}, {"heading_rad", 1.0}}, "");
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string name = kMotions[i], zeros = "; write zeros where the vessel does not move so";
      if (i < 3)
        find({{name + "_m_per_m", 1.0}}, zeros);
      else
        find({{name + "_deg_per_m", kDegree}, {name + "_rad_per_m", 1.0}, {name + "_per_slope", 1.0, Kind::slope}},
             zeros);
      find({{name + "_phase_deg", kDegree}, {name + "_phase_rad", 1.0}}, zeros);
    }
    if (!place.empty())
      out_.fail(line, "has a column \"" + place.begin()->first +
                          "\", which is none of an RAO table; the names and their units are in docs/stations.md");
  }

  double number(const std::vector<CsvCell>& cells, const Column& column, int line) const {
    if (column.place >= cells.size())
      out_.fail(line, "has " + std::to_string(cells.size()) + " cells, the names above are more: is the file cut off?");
    const std::string_view text = cells[column.place].text;
    std::optional<double> value = number_with_point(text);
    if (!value && !may_be_thousands(text)) value = number_with_comma(text);
    if (!value) out_.fail(line, "expected a number in \"" + column.as.name + "\", got \"" + std::string(text) + "\"");
    return *value * column.as.factor;
  }

  void take_row(const std::vector<CsvCell>& cells, int line) {
    if (cells.size() > columns_.size())
      out_.fail(line, "has " + std::to_string(cells.size()) + " cells, there are names for " +
                          std::to_string(columns_.size()));
    RaoRow row;
    row.line = line;
    const double first = number(cells, columns_[0], line);
    if (!(first > 0.0)) out_.fail(line, "\"" + columns_[0].as.name + "\" must be > 0, got " + number_text(first));
    row.frequency = columns_[0].as.kind == Alternative::Kind::period ? kTwoPi / first : first;
    row.heading = number(cells, columns_[1], line);
    const double k = wave_number(row.frequency, gravity_, depth_);
    for (std::size_t i = 0; i < 6; ++i) {
      const Column& column = columns_[2 + 2 * i];
      row.amplitude[i] = number(cells, column, line) * (column.as.kind == Alternative::Kind::slope ? k : 1.0);
      row.lag[i] = lag_behind_crest(spec_, number(cells, columns_[3 + 2 * i], line));
      if (!(row.amplitude[i] >= 0.0))
        out_.fail(line, "\"" + column.as.name + "\" must be >= 0, an amplitude, got a negative number");
      if (row.amplitude[i] > kLargestAmplitude * (i < 3 ? 1.0 : kDegree))
        out_.fail(line, "\"" + column.as.name + "\" means " + number_text(row.amplitude[i] / (i < 3 ? 1.0 : kDegree)) +
                            (i < 3 ? " m" : " deg") + " a metre of wave, at most " + number_text(kLargestAmplitude) +
                            " is believed: is it in the unit that its name says?");
    }
    out_.rows.push_back(row);
  }

  const RaoSpec& spec_;
  double gravity_, depth_;
  RaoRows out_;
  std::vector<Column> columns_;  // period, heading, then amplitude and phase of each motion
};

/// Rows of one body of a .4 file, a mode a line, gathered by period and heading.
class RaoWamit {
 public:
  explicit RaoWamit(const RaoSpec& spec) : spec_(spec), text_(spec.file) { out_.path = spec.file; }

  RaoRows read() {
    choose_body();
    for (const WamitRow& row : text_.rows()) {
      const int mode = text_.mode(row, 2, 6 * bodies_) - first_mode_;
      if (mode >= 0 && mode < 6) take(row, static_cast<std::size_t>(mode));
    }
    for (std::size_t n = 0; n < out_.rows.size(); ++n)
      if (held_[n] != kAllSix)
        text_.fail(out_.rows[n].line,
                   "not all six modes are given for this period and heading: is the file cut off, or were modes left "
                   "out of the run?");
    return std::move(out_);
  }

 private:
  static constexpr unsigned kAllSix = 63;  // a bit for each mode

  void choose_body() {
    for (const WamitRow& row : text_.rows()) {
      text_.require_columns(row, 7, 7);
      bodies_ = std::max(bodies_, text_.mode(row, 2, kMostRaoModes) / 6 + 1);
    }
    const int line = text_.rows().front().line;
    if (spec_.body == 0 && bodies_ > 1)
      text_.fail(line, "is of " + std::to_string(bodies_) + " bodies: say by wamit_body which of them this one is");
    if (spec_.body > bodies_)
      text_.fail(line, "is of " + std::to_string(bodies_) + (bodies_ == 1 ? " body" : " bodies") + ", wamit_body is " +
                           std::to_string(spec_.body));
    first_mode_ = 6 * std::max(0, spec_.body - 1);
    for (const WamitRow& row : text_.rows())
      if (const int i = text_.mode(row, 2, 6 * bodies_) - first_mode_; i >= 0 && i < 6) {
        double& largest = largest_[static_cast<std::size_t>(i)];
        largest = std::max(largest, std::abs(row.column[3]));
      }
  }

  void take(const WamitRow& row, std::size_t mode) {
    const double per = row.column[0];
    if (!(per > 0.0)) text_.fail(row.line, "the first column must be > 0, got " + number_text(per));
    const std::complex<double> value(row.column[5], row.column[6]);
    if (std::abs(std::polar(std::abs(row.column[3]), row.column[4] * kDegree) - value) > kSameNumber * largest_[mode])
      text_.fail(row.line, "Mod and Pha (deg) say another number than Re and Im");
    const auto [at, is_new] = place_.try_emplace({per, row.column[1]}, out_.rows.size());
    if (is_new) {
      RaoRow next;
      next.line = row.line;
      next.frequency = spec_.column == RaoSpec::Column::frequency ? per : kTwoPi / per;
      next.heading = row.column[1] * kDegree;
      out_.rows.push_back(next);
      held_.push_back(0);
    }
    const unsigned bit = 1u << mode;
    if (held_[at->second] & bit) text_.fail(row.line, "gives this mode of a period and heading for the second time");
    held_[at->second] |= bit;
    RaoRow& found = out_.rows[at->second];
    found.amplitude[mode] = std::abs(value) / (mode < 3 ? 1.0 : spec_.length);
    found.lag[mode] = -std::arg(value);  // Pha is a lead
  }

  const RaoSpec& spec_;
  WamitText text_;
  int bodies_ = 1, first_mode_ = 0;
  std::array<double, 6> largest_{};  // Mod of each mode
  RaoRows out_;
  std::map<std::pair<double, double>, std::size_t> place_;  // of a period and heading among the rows
  std::vector<unsigned> held_;                              // which modes a row has
};

}  // namespace

void RaoRows::fail(int line, const std::string& sentence) const {
  throw SpecificationError(line > 0 ? path + ":" + std::to_string(line) : path, "", sentence);
}

RaoRows read_rao_csv(const RaoSpec& spec, double gravity, double depth) { return RaoCsv(spec, gravity, depth).read(); }

RaoRows read_rao_wamit(const RaoSpec& spec) { return RaoWamit(spec).read(); }

}  // namespace stillhook
