#include "planner/weather/limit_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "planner/weather/columns.h"
#include "problems/case.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kHeadingDegree = std::numbers::pi / 180.0;

struct LimitRow {
  double period = 0.0, heading = 0.0;  // s; deg, as an exact number of the file within [0, 360)
  std::string phase;
  double height = 0.0, low = kNaN, high = kNaN;  // m
  int line = 0;
};

class LimitFileReader {
 public:
  explicit LimitFileReader(const std::string& path) : file_(path, "limits must be CSV"), numbers_(file_) {}

  LimitFile read() {
    find_columns();
    for (std::vector<CsvCell> cells; file_.next(cells, columns_);) take_row(cells);
    numbers_.refuse_ambiguous_commas();
    if (rows_.empty()) throw CaseError(file_.path() + ": has no limits under its names");
    find_phases();
    LimitFile result;
    result.limits = limits_of(&LimitRow::height);
    const auto known = [&](double LimitRow::*member) {
      return std::none_of(rows_.begin(), rows_.end(), [&](const LimitRow& r) { return std::isnan(r.*member); });
    };
    // The bounds are those of the whole operation, where the file has them.
    if (has_whole_) {
      phases_ = {""};
      std::erase_if(rows_, [](const LimitRow& row) { return !row.phase.empty(); });
    }
    if (low_ && known(&LimitRow::low)) result.low = limits_of(&LimitRow::low);
    if (high_ && known(&LimitRow::high)) result.high = limits_of(&LimitRow::high);
    add_remarks(result);
    return result;
  }

 private:
  void find_columns() {
    height_ = need_column(file_, {"hs_limit", "hs_lim"}, Measure::height, "hs_limit [m]");
    period_ = find_column(file_, {"tp"}, Measure::time);
    heading_ = find_column(file_, {"heading"}, Measure::angle);
    low_ = find_column(file_, {"hs_low"}, Measure::height);
    high_ = find_column(file_, {"hs_high"}, Measure::height);
    phase_ = find_column(file_, {"phase"}, Measure::count);
    columns_ = {height_.index};
    for (const auto& column : {period_, heading_})
      if (column) columns_.push_back(column->index);
  }

  double number(const std::vector<CsvCell>& cells, const FoundColumn& column) {
    return numbers_.take(cells[column.index], column.header) * column.factor;
  }

  [[noreturn]] void refuse(const FoundColumn& column, const std::string& rule, const CsvCell& cell) const {
    throw CaseError(
        fmt::format("{}: column \"{}\": must be {}, got \"{}\"", file_.place(), column.header, rule, cell.text));
  }

  void take_row(const std::vector<CsvCell>& cells) {
    LimitRow row;
    row.line = file_.line();
    row.height = number(cells, height_);
    if (row.height < 0.0 || row.height > 30.0) refuse(height_, "a height from 0 to 30 m", cells[height_.index]);
    if (std::isnan(row.height)) ++without_limit_;
    if (period_) {
      row.period = number(cells, *period_);
      if (!(row.period > 0.0 && row.period <= 60.0))
        refuse(*period_, "a peak period above 0 and up to 60 s", cells[period_->index]);
    }
    if (heading_) {
      const double degrees = number(cells, *heading_) * 180.0 / std::numbers::pi;
      if (!(std::abs(degrees) <= 360.0)) refuse(*heading_, "an angle from -360 to 360 deg", cells[heading_->index]);
      // Rounded: 6.2832 rad and 0 are one heading.
      row.heading = std::round(std::fmod(degrees + 360.0, 360.0) * 1e3) / 1e3;
      if (row.heading >= 360.0) row.heading = 0.0;
    }
    if (low_) row.low = number(cells, *low_);
    if (high_) row.high = number(cells, *high_);
    if (phase_) row.phase = std::string(cells[phase_->index].text);
    rows_.push_back(row);
  }

  std::string condition(double period, double heading) const {
    std::string text;
    if (period_) text = fmt::format("tp {:g} s", period);
    if (heading_) text += fmt::format("{}heading {:g} deg", text.empty() ? "" : ", ", heading);
    return text.empty() ? "the only condition" : text;
  }

  /// By phase if a condition stands in several rows.
  void find_phases() {
    std::map<std::pair<double, double>, std::map<std::string, int>> lines;
    bool several = false;
    for (const LimitRow& row : rows_) {
      auto& of_condition = lines[{row.period, row.heading}];
      const auto [first, is_new] = of_condition.emplace(is_whole(row.phase) ? "" : row.phase, row.line);
      if (!is_new)
        throw CaseError(
            fmt::format("{}:{}: {}{} stands in line {} already; keep one of them, or name the phases that they "
                        "are limits of in a column \"phase\"",
                        file_.path(), row.line, condition(row.period, row.heading),
                        row.phase.empty() ? "" : " of phase \"" + row.phase + "\"", first->second));
      several = several || of_condition.size() > 1;
    }
    if (!several) {
      for (LimitRow& row : rows_) row.phase.clear();
      phases_ = {""};
      return;
    }
    for (LimitRow& row : rows_) {
      if (is_whole(row.phase)) {
        row.phase.clear();
        has_whole_ = true;
      } else if (std::find(phases_.begin(), phases_.end(), row.phase) == phases_.end()) {
        phases_.push_back(row.phase);
      }
    }
    if (has_whole_) phases_.emplace_back();  // without a name, behind the phases
  }

  /// The limit of the whole operation, which is lower than that of each phase: any of them may break.
  static bool is_whole(const std::string& phase) { return phase.empty() || phase == "all"; }

  OperationLimits limits_of(double LimitRow::*member) const {
    std::set<double> periods, headings;
    for (const LimitRow& row : rows_) {
      periods.insert(row.period);
      headings.insert(row.heading);
    }
    OperationLimits limits;
    for (const std::string& phase : phases_) {
      std::map<std::pair<double, double>, double> height;
      for (const LimitRow& row : rows_)
        if (row.phase == phase) height[{row.period, row.heading}] = row.*member;
      std::vector<std::vector<double>> grid;
      for (const double period : periods) {
        grid.emplace_back();
        for (const double heading : headings) {
          const auto at = height.find({period, heading});
          if (at == height.end())
            throw CaseError(fmt::format("{}: has no limit for {}{}; every heading must be there at every period{}",
                                        file_.path(), condition(period, heading),
                                        phase.empty() ? "" : " of phase \"" + phase + "\"",
                                        phase.empty() ? "" : " and in every phase"));
          grid.back().push_back(at->second);
        }
      }
      limits.phases.push_back(
          {phase, LimitSurface(axis(period_.has_value(), periods, 1.0),
                               axis(heading_.has_value(), headings, std::numbers::pi / 180.0), grid)});
    }
    return limits;
  }

  static std::vector<double> axis(bool given, const std::set<double>& values, double factor) {
    std::vector<double> axis;
    for (const double value : values)
      if (given) axis.push_back(value * factor);
    return axis;
  }

  void add_remarks(LimitFile& result) const {
    if (without_limit_ > 0)
      result.remarks.push_back(
          fmt::format("{} of the limits are empty: beside them nothing is workable", without_limit_));
    const std::vector<double>& headings = result.limits.phases.front().limit.headings();
    if (headings.size() == 1)
      result.remarks.push_back("the limits are for one heading only and are taken for all of them");
    double widest = 0.0, from = 0.0;
    for (std::size_t i = 0; i < headings.size() && headings.size() > 1; ++i) {
      const double next = i + 1 < headings.size() ? headings[i + 1] : headings[0] + 2.0 * std::numbers::pi;
      if (next - headings[i] > widest) {
        widest = next - headings[i];
        from = headings[i];
      }
    }
    if (widest > 91.0 * kHeadingDegree)
      result.remarks.push_back(
          fmt::format("there is no limit for {:.0f} deg of heading from {:.0f} deg on; between, it is "
                      "taken as linear",
                      widest / kHeadingDegree, from / kHeadingDegree));
  }

  CsvFile file_;
  CsvNumbers numbers_;
  FoundColumn height_;
  std::optional<FoundColumn> period_, heading_, low_, high_, phase_;
  std::vector<std::size_t> columns_;  // of numbers
  std::vector<LimitRow> rows_;
  std::vector<std::string> phases_;
  int without_limit_ = 0;
  bool has_whole_ = false;
};

}  // namespace

LimitFile read_limit_file(const std::string& path) { return LimitFileReader(path).read(); }

}  // namespace stillhook
