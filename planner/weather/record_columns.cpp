#include "planner/weather/record_columns.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "problems/case.h"
#include "problems/field_table.h"
#include "results/weather/period_ratio.h"

namespace stillhook {
namespace {

using Names = std::vector<std::string>;
const Names kTimes = {"time", "valid_time", "datetime", "date_time", "timestamp", "date"};
const Names kHeights = {
    "hs", "swh", "hm0", "vhm0", "hsig", "significant_wave_height", "sea_surface_wave_significant_height"};
const Names kPeaks = {"tp",    "pp1d",        "vtpk",
                      "tpeak", "peak_period", "sea_surface_wave_period_at_variance_spectral_density_maximum"};
const Names kCrossings = {"tz", "t02", "tm02", "vtm02", "mp2"};
const Names kEnergies = {"te", "tm10", "tm_10", "tm-10", "vtm10", "mwp"};
const Names kFrom = {"wave_from", "mwd", "vmdr", "wave_from_direction", "sea_surface_wave_from_direction"};
const Names kTowards = {"wave_to", "wave_towards", "sea_surface_wave_to_direction"};
const Names kEither = {"dp", "dir", "direction", "wave_direction", "mdir", "pdir", "theta"};
const Names kWinds = {"wind_speed", "wind", "ws", "ws10", "wspd", "u10m"};

bool is_in(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names joined(std::initializer_list<Names> lists) {
  Names all;
  for (const Names& names : lists) all.insert(all.end(), names.begin(), names.end());
  return all;
}

class Chooser {
 public:
  Chooser(const std::string& place, const std::vector<OfferedColumn>& offered) : place_(place), offered_(offered) {}

  /// The column that is asked for by its header, or else the one with a usual name.
  const OfferedColumn* find(const std::string& asked, const std::string& key, const Names& names) const {
    const OfferedColumn* found = nullptr;
    Names headers;
    for (const OfferedColumn& column : offered_) {
      headers.push_back(column.header);
      const bool meant = asked.empty() ? is_in(names, lower_case(column.name)) || is_in(names, column.standard_name)
                                       : column.header == asked || column.name == asked;
      if (!meant) continue;
      if (found)
        throw CaseError(
            fmt::format("{}: has two columns that may be meant, \"{}\" and \"{}\"; say which with "
                        "weather.{}",
                        place_, found->header, column.header, key));
      found = &column;
    }
    if (!found && !asked.empty())
      throw CaseError(fmt::format("{}: has no column \"{}\"{}, which weather.{} names; it has {}", place_, asked,
                                  did_you_mean(asked, headers), key, fmt::join(headers, ", ")));
    return found;
  }

  const OfferedColumn& need(const std::string& asked, const std::string& key, const Names& names,
                            const std::string& what) const {
    if (const OfferedColumn* found = find(asked, key, names)) return *found;
    Names headers;
    for (const OfferedColumn& column : offered_) headers.push_back(column.header);
    throw CaseError(
        fmt::format("{}: has no column of {} by a usual name (\"{}\"); name it with weather.{}; the file has {}",
                    place_, what, names.front(), key, fmt::join(headers, ", ")));
  }

  ChosenColumn chosen(const OfferedColumn& column, Measure measure, const std::string& what) const {
    ChosenColumn c;
    c.header = column.header;
    c.factor = factor_of_unit(place_, column.header, column.unit, measure);
    c.unit_given = !column.unit.empty();
    c.remark =
        fmt::format("\"{}\" is {}, in {}{}", column.header, what, c.unit_given ? column.unit : usual_unit(measure),
                    c.unit_given ? "" : ", which the file does not say");
    return c;
  }

  const std::string& place() const { return place_; }

 private:
  const std::string& place_;
  const std::vector<OfferedColumn>& offered_;
};

ChosenColumn period_column(const Chooser& chooser, const OfferedColumn& column, const WeatherSpec& spec) {
  using Period = WeatherSpec::Period;
  const std::string name = lower_case(column.name);
  const auto by_name = [&]() -> Period {
    if (is_in(kPeaks, name) || is_in(kPeaks, column.standard_name)) return Period::peak;
    if (is_in(kCrossings, name)) return Period::zero_crossing;
    if (is_in(kEnergies, name)) return Period::energy;
    throw CaseError(
        fmt::format("{}: column \"{}\": which period is it? Say weather.period_kind = \"peak\", "
                    "\"zero_crossing\" or \"energy\"",
                    chooser.place(), column.header));
  };
  const Period kind = spec.period_kind ? *spec.period_kind : by_name();
  const char* what = kind == Period::peak            ? "the peak period"
                     : kind == Period::zero_crossing ? "the mean zero-crossing period"
                                                     : "the energy period";
  ChosenColumn chosen = chooser.chosen(column, Measure::time, what);
  if (kind == Period::peak) return chosen;
  const PeriodRatios ratios = period_ratios(spec.gamma);
  const double ratio = kind == Period::energy ? ratios.peak_over_energy : ratios.peak_over_zero_crossing;
  chosen.factor *= ratio;
  chosen.remark +=
      fmt::format(", times {:.4f} to the peak period of a JONSWAP spectrum with gamma {:g}", ratio, spec.gamma);
  return chosen;
}

ChosenColumn direction_column(const Chooser& chooser, const OfferedColumn& column, const WeatherSpec& spec) {
  using Sense = WeatherSpec::Sense;
  Sense sense = spec.direction_sense;
  const std::string name = lower_case(column.name);
  if (sense == Sense::by_name) {
    if (is_in(kFrom, name) || column.standard_name.find("from_direction") != std::string::npos) sense = Sense::from;
    if (is_in(kTowards, name) || column.standard_name.find("to_direction") != std::string::npos) sense = Sense::towards;
  }
  if (sense == Sense::by_name)
    throw CaseError(
        fmt::format("{}: column \"{}\": does it say where the waves come from, or travel towards? Say "
                    "weather.direction_sense = \"from\" or \"towards\"",
                    chooser.place(), column.header));
  ChosenColumn chosen = chooser.chosen(
      column, Measure::angle,
      sense == Sense::from ? "the direction that the waves come from" : "the direction that the waves travel towards");
  chosen.turned = sense == Sense::towards;
  if (chosen.turned) chosen.remark += ", turned by 180 deg";
  return chosen;
}

}  // namespace

RecordColumns choose_columns(const std::string& place, const std::vector<OfferedColumn>& offered,
                             const WeatherSpec& spec) {
  const Chooser chooser(place, offered);
  RecordColumns columns;
  columns.time = chooser.need(spec.time_column, "time_column", kTimes, "times").header;
  columns.height =
      chooser.chosen(chooser.need(spec.height_column, "height_column", kHeights, "significant wave heights"),
                     Measure::height, "the significant wave height");
  // A file may have several periods: the peak's is what limits are given over.
  const OfferedColumn* period = chooser.find(spec.period_column, "period_column", kPeaks);
  if (!period) period = chooser.find("", "period_column", joined({kCrossings, kEnergies}));
  if (period) columns.period = period_column(chooser, *period, spec);
  const OfferedColumn* from = chooser.find(spec.direction_column, "direction_column", joined({kFrom, kTowards}));
  if (!from) from = chooser.find("", "direction_column", kEither);
  if (from) columns.from = direction_column(chooser, *from, spec);
  if (const OfferedColumn* wind = chooser.find(spec.wind_column, "wind_column", kWinds))
    columns.wind = chooser.chosen(*wind, Measure::speed, "the wind speed");
  return columns;
}

}  // namespace stillhook
