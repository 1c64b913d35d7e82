#include "planner/weather/scatter_file.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "planner/weather/columns.h"
#include "problems/case.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Two numbers with a hyphen or a dash between them: "0.5-1", "7 – 8".
std::optional<std::pair<double, double>> range_of(std::string_view text) {
  for (const std::string_view dash : {std::string_view("-"), std::string_view("\u2013")}) {
    const std::size_t at = text.find(dash, 1);
    if (text.empty() || at == std::string_view::npos) continue;
    const auto trimmed = [](std::string_view part) {
      while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
      while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
      return part;
    };
    const auto low = number_with_point(trimmed(text.substr(0, at)));
    const auto high = number_with_point(trimmed(text.substr(at + dash.size())));
    if (low && high) return std::pair(*low, *high);
  }
  return std::nullopt;
}

[[noreturn]] void refuse_cell(const CsvFile& file, const std::string& column, const std::string& rule,
                              std::string_view cell) {
  throw CaseError(fmt::format("{}: column \"{}\": must be {}, got \"{}\"", file.place(), column, rule, cell));
}

/// A row a bin.
class LongScatterReader {
 public:
  explicit LongScatterReader(CsvFile& file) : file_(file), numbers_(file) {}

  ScatterTable read() {
    low_ = need_column(file_, {"hs_low"}, Measure::height, "hs_low [m]");
    high_ = need_column(file_, {"hs_high"}, Measure::height, "hs_high [m]");
    period_low_ = need_column(file_, {"tp_low"}, Measure::time, "tp_low [s]");
    period_high_ = need_column(file_, {"tp_high"}, Measure::time, "tp_high [s]");
    count_ = need_column(file_, {"count"}, Measure::count, "count");
    month_ = find_column(file_, {"month"}, Measure::count);
    from_ = find_column(file_, {"wave_from", "from"}, Measure::angle);
    ScatterTable table;
    for (std::vector<CsvCell> cells; file_.next(cells, {low_.index, high_.index, count_.index});)
      table.bins.push_back(bin_of(cells));
    numbers_.refuse_ambiguous_commas();
    table.remarks.push_back(from_ ? "directions are those that the waves come from, middles of sectors"
                                  : "the table has no directions");
    return table;
  }

 private:
  double number(const std::vector<CsvCell>& cells, const FoundColumn& column, double least, const char* rule) {
    const double value = numbers_.take(cells[column.index], column.header) * column.factor;
    if (!(value >= least)) refuse_cell(file_, column.header, rule, cells[column.index].text);
    return value;
  }

  ScatterBin bin_of(const std::vector<CsvCell>& cells) {
    ScatterBin bin;
    bin.height_low = number(cells, low_, 0.0, "a height of 0 m or more");
    bin.height_high = number(cells, high_, std::nextafter(bin.height_low, 1e9), "above the bin's lower height");
    bin.period_low = number(cells, period_low_, 0.0, "a period of 0 s or more");
    bin.period_high =
        number(cells, period_high_, std::nextafter(bin.period_low, 1e9), "above the bin's shorter period");
    bin.count = number(cells, count_, 0.0, "a count of 0 or more");
    if (month_) {
      const double month = number(cells, *month_, 1.0, "a month from 1 to 12");
      if (month > 12.0 || month != std::floor(month))
        refuse_cell(file_, month_->header, "a month from 1 to 12", cells[month_->index].text);
      bin.month = static_cast<int>(month);
    }
    bin.from = from_ ? number(cells, *from_, -2.0 * 3.1415927, "an angle from -360 to 360 deg") : kNaN;
    return bin;
  }

  CsvFile& file_;
  CsvNumbers numbers_;
  FoundColumn low_, high_, period_low_, period_high_, count_;
  std::optional<FoundColumn> month_, from_;
};

/// As in reports: heights down, periods across.
ScatterTable read_wide_scatter(CsvFile& file) {
  std::vector<std::pair<double, double>> periods;
  std::vector<std::size_t> columns;
  for (std::size_t i = 1; i < file.names().size(); ++i) {
    const auto range = range_of(file.names()[i]);
    if (!range || !(range->first < range->second))
      throw CaseError(
          fmt::format("{}:{}: column {}: must be a range of peak periods in s, as \"7-8\", got \"{}\"; or give "
                      "the table a row a bin with the columns hs_low [m], hs_high [m], tp_low [s], "
                      "tp_high [s], count",
                      file.path(), file.line_of_names(), i + 1, file.names()[i]));
    periods.push_back(*range);
    columns.push_back(i);
  }
  ScatterTable table;
  CsvNumbers numbers(file);
  for (std::vector<CsvCell> cells; file.next(cells, columns);) {
    const auto heights = range_of(cells[0].text);
    if (!heights || !(heights->first >= 0.0 && heights->first < heights->second))
      refuse_cell(file, file.names()[0], "a range of heights in m, as \"0.5-1\"", cells[0].text);
    for (const std::size_t i : columns) {
      const double count = numbers.take(cells[i], file.names()[i]);
      if (!(count >= 0.0)) refuse_cell(file, file.names()[i], "a count of 0 or more", cells[i].text);
      if (count > 0.0)
        table.bins.push_back(
            {0, kNaN, heights->first, heights->second, periods[i - 1].first, periods[i - 1].second, count});
    }
  }
  numbers.refuse_ambiguous_commas();
  table.remarks.emplace_back("heights in m down and peak periods in s across, of all directions and the whole year");
  return table;
}

}  // namespace

ScatterTable read_scatter_file(const std::string& path) {
  CsvFile file(path, "a scatter table must be CSV");
  const bool wide =
      !find_column(file, {"hs_low"}, Measure::height) && file.names().size() > 1 && range_of(file.names()[1]);
  ScatterTable table = wide ? read_wide_scatter(file) : LongScatterReader(file).read();
  if (!(table.total() > 0.0)) throw CaseError(path + ": has no counts");
  return table;
}

AlphaTable read_alpha_file(const std::string& path) {
  CsvFile file(path, "a table of alpha factors must be CSV");
  const FoundColumn time = need_column(file, {"t_pop_at_most"}, Measure::time, "t_pop_at_most [h]");
  const FoundColumn height = need_column(file, {"hs"}, Measure::height, "hs [m]");
  const FoundColumn factor = need_column(file, {"alpha"}, Measure::count, "alpha");
  if (time.unit.empty())
    throw CaseError(fmt::format("{}:{}: column \"{}\" has no unit: write t_pop_at_most [h]", path, file.line_of_names(),
                                time.header));
  CsvNumbers numbers(file);
  std::vector<AlphaTable::Row> rows;
  for (std::vector<CsvCell> cells; file.next(cells, {time.index, height.index, factor.index});) {
    const auto number = [&](const FoundColumn& column, const char* rule) {
      const double value = numbers.take(cells[column.index], column.header) * column.factor;
      if (!(value > 0.0)) refuse_cell(file, column.header, rule, cells[column.index].text);
      return value;
    };
    rows.push_back({number(time, "a duration above 0") / kHour, number(height, "a height above 0"),
                    number(factor, "a factor above 0 and up to 1")});
    if (rows.back().factor > 1.0)
      refuse_cell(file, factor.header, "a factor above 0 and up to 1", cells[factor.index].text);
  }
  numbers.refuse_ambiguous_commas();
  try {
    return AlphaTable(rows);
  } catch (const std::invalid_argument& error) {
    throw CaseError(path + ": " + error.what());
  }
}

}  // namespace stillhook
