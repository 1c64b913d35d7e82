#include "tuning/record.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "problems/case.h"
#include "problems/field_table.h"
#include "tuning/measured_table.h"
#include "tuning/measured_unit.h"
#include "tuning/sentinel.h"

namespace stillhook {
namespace {

using Kind = FitRecordSpec::Kind;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewestRows = 20;      // of a run in motion: some samples of two or three oscillations
constexpr std::size_t kFewestStaticRows = 2;
constexpr double kMostMissing = 0.2;         // share of the rows
constexpr double kDense = 3.0;               // rows per interval from which a record is reduced
constexpr double kUpright = std::numbers::pi / 2.0;

double median_of(std::vector<double> values) {
  if (values.empty()) return kNone;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class RecordReader {
 public:
  RecordReader(const FitRecordSpec& spec, const std::vector<Channel>& channels, double output_interval)
      : spec_(spec), channels_(channels), output_interval_(output_interval) {}

  MeasuredRecord read() {
    record_.name = spec_.name;
    record_.kind = spec_.kind;
    record_.file = spec_.file;
    if (spec_.file.empty()) throw CaseError(entry() + ": has no file; give one in the case or with --measured");
    for (const FitColumnSpec& column : spec_.columns) add_channel(column);
    read_table();
    cut_window();
    for (std::size_t k = 0; k < record_.channels.size(); ++k) clean(k);
    if (spec_.kind == Kind::constant)
      take_means();
    else
      take_samples();
    return std::move(record_);
  }

 private:
  std::string entry() const { return "[fit.records." + spec_.name + "]"; }

  void add_channel(const FitColumnSpec& column) {
    const auto channel =
        std::find_if(channels_.begin(), channels_.end(), [&](const Channel& c) { return c.name == column.channel; });
    if (channel == channels_.end()) {
      std::vector<std::string> names;
      for (const Channel& c : channels_) names.push_back(c.name);
      throw CaseError(fmt::format("{} columns: the model has no channel \"{}\"{}", entry(), column.channel,
                                  did_you_mean(column.channel, names)));
    }
    const auto unit = measured_unit(column.unit);
    if (!unit)
      throw CaseError(fmt::format("{} columns.{}: unit \"{}\" is not known; there are {}", entry(), column.channel,
                                  column.unit, known_units()));
    if (unit->si != channel->unit)
      throw CaseError(fmt::format("{} columns.{}: the channel is in {}, the file's unit {} is another quantity", entry(),
                                  column.channel, channel->unit, column.unit));
    MeasuredChannel& c = record_.channels.emplace_back();
    c.spec = column;
    if (c.spec.column.empty()) c.spec.column = column.channel;
    c.unit = unit->si;
    c.file_unit = unit->factor * std::pow(spec_.model_scale, unit->froude);
    if (column.noise) c.noise = *column.noise * c.file_unit;
  }

  void read_table() {
    std::vector<std::string> names = {spec_.time_column};
    for (const MeasuredChannel& c : record_.channels) names.push_back(c.spec.column);
    table_ = read_measured_table(spec_.file, names);
    for (std::size_t k = 0; k < names.size(); ++k) {
      refuse_sentinels(k);
      check_unit_of_file(k);
    }
    std::vector<double>& t = table_.values.front();
    const double factor = spec_.time_unit * std::sqrt(spec_.model_scale);
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (std::isnan(t[i]))
        throw CaseError(fmt::format("{}: the time \"{}\" is missing", table_.place(i), spec_.time_column));
      t[i] *= factor;
      if (i > 0 && t[i] < t[i - 1])
        throw CaseError(fmt::format("{}: the clock runs backwards, from {:.6g} s to {:.6g} s", table_.place(i),
                                    t[i - 1], t[i]));
      if (i > 0 && t[i] == t[i - 1])
        throw CaseError(fmt::format("{}: the clock stands still at {:.6g} s", table_.place(i), t[i]));
    }
  }

  void refuse_sentinels(std::size_t k) const {
    const std::optional<Sentinel> sentinel = sentinel_in(table_.values[k]);
    if (!sentinel) return;
    throw CaseError(fmt::format("{}: column \"{}\" is {:.10g}, far from all its other values, {}: it seems to say that "
                                "nothing was measured; leave such cells empty or write NaN",
                                table_.place(sentinel->first), table_.names[k], sentinel->value,
                                sentinel->count == 1 ? "in this row alone"
                                                     : fmt::format("in {} rows", sentinel->count)));
  }

  /// A NetCDF file may say itself in which unit a variable is.
  void check_unit_of_file(std::size_t k) const {
    if (table_.units.size() <= k || table_.units[k].empty()) return;
    const std::string& says = table_.units[k];
    if (k == 0) {
      const auto unit = measured_time_unit(says);
      if (unit && *unit != spec_.time_unit)
        throw CaseError(fmt::format("{}: variable \"{}\" is in \"{}\" by its attribute units, {} takes it in units of "
                                    "{:g} s: set time_unit",
                                    spec_.file, table_.names[k], says, entry(), spec_.time_unit));
      return;
    }
    const FitColumnSpec& column = record_.channels[k - 1].spec;
    const auto file_unit = measured_unit(says), unit = measured_unit(column.unit);
    if (file_unit && (file_unit->si != unit->si || file_unit->factor != unit->factor))
      throw CaseError(fmt::format("{}: variable \"{}\" is in {} by its attribute units, {} columns.{} says {}", spec_.file,
                                  table_.names[k], says, entry(), column.channel, column.unit));
  }

  void cut_window() {
    std::vector<double>& t = table_.values.front();
    const auto first = spec_.start ? std::lower_bound(t.begin(), t.end(), *spec_.start) : t.begin();
    const auto last = spec_.end ? std::upper_bound(t.begin(), t.end(), *spec_.end) : t.end();
    first_row_ = static_cast<std::size_t>(first - t.begin());
    const auto end = static_cast<std::size_t>(std::max(first, last) - t.begin());
    record_.rows = end - first_row_;
    const std::size_t fewest = spec_.kind == Kind::constant ? kFewestStaticRows : kFewestRows;
    if (record_.rows < fewest)
      throw CaseError(fmt::format("{}: has {} rows{}, a {} needs at least {}", spec_.file, record_.rows,
                                  spec_.start || spec_.end ? " in the window of the case" : "",
                                  spec_.kind == Kind::constant ? "static pull" : "fit", fewest));
    const bool own_clock = spec_.kind == Kind::decay || spec_.kind == Kind::constant;
    const double shift = spec_.time_shift.value_or(own_clock ? -t[first_row_] : 0.0);
    for (std::size_t i = first_row_; i < end; ++i) time_.push_back(t[i] + shift);
  }

  /// From the file's unit to SI, gaps and spikes taken out.
  void clean(std::size_t k) {
    MeasuredChannel& c = record_.channels[k];
    std::vector<double>& raw = table_.values[k + 1];
    const auto begin = raw.begin() + static_cast<std::ptrdiff_t>(first_row_);
    std::vector<double> x(begin, begin + static_cast<std::ptrdiff_t>(record_.rows));
    for (double& value : x) value = (value - c.spec.offset) * c.file_unit * (c.spec.reversed ? -1.0 : 1.0);
    refuse_dead_sensor(c, x);
    if (spec_.kind != Kind::constant) {
      const std::vector<bool> spike = spikes(x);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (spike[i]) {
          x[i] = kNone;
          ++c.outliers;
        }
    }
    if (c.outliers > 0)
      record_.notes.push_back(fmt::format("{}: {} of {} rows of \"{}\" are spikes and were left out", spec_.name,
                                          c.outliers, record_.rows, c.spec.column));
    if (c.missing > 0)
      record_.notes.push_back(fmt::format("{}: {} of {} rows of \"{}\" are missing", spec_.name, c.missing, record_.rows,
                                          c.spec.column));
    refuse_impossible_angle(c, x);
    clean_.push_back(std::move(x));
  }

  void refuse_dead_sensor(MeasuredChannel& c, const std::vector<double>& x) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::size_t first_missing = x.size();
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::isnan(x[i])) {
        if (c.missing++ == 0) first_missing = i;
        continue;
      }
      low = std::min(low, x[i]);
      high = std::max(high, x[i]);
    }
    if (c.missing > kMostMissing * static_cast<double>(x.size()))
      throw CaseError(fmt::format("{}: column \"{}\" is NaN or empty in {} of {} rows, first here",
                                  table_.place(first_row_ + first_missing), c.spec.column, c.missing, x.size()));
    if (!(high > low) && spec_.kind != Kind::constant)
      throw CaseError(fmt::format("{}: column \"{}\" is constant, {:.6g} {} in all {} rows: the sensor did not work",
                                  spec_.file, c.spec.column, table_.values[index_of(c) + 1][first_row_], c.spec.unit,
                                  x.size()));
  }

  std::size_t index_of(const MeasuredChannel& c) const {
    return static_cast<std::size_t>(&c - record_.channels.data());
  }

  /// A roll or pitch beyond upright is another unit's.
  void refuse_impossible_angle(const MeasuredChannel& c, const std::vector<double>& x) {
    const bool tilt = c.spec.channel.ends_with(".roll") || c.spec.channel.ends_with(".pitch");
    if (!tilt || c.spec.trust_unit) return;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::abs(x[i]) > kUpright)
        throw CaseError(fmt::format("{}: column \"{}\" reaches {:.4g} {}, that is {:.0f} deg of heel or trim: {}",
                                    table_.place(first_row_ + i), c.spec.column,
                                    table_.values[index_of(c) + 1][first_row_ + i], c.spec.unit,
                                    x[i] * 180.0 / std::numbers::pi,
                                    c.spec.unit == "rad" ? "a factor 57.3 too large, as degrees taken for radians"
                                                         : "the unit or the offset is another"));
  }

  void take_means() {
    record_.time = {0.0};
    for (std::size_t k = 0; k < clean_.size(); ++k) {
      double sum = 0.0, square = 0.0, count = 0.0;
      for (const double x : clean_[k])
        if (!std::isnan(x)) sum += x, count += 1.0;
      const double mean = sum / count;
      for (const double x : clean_[k])
        if (!std::isnan(x)) square += (x - mean) * (x - mean);
      MeasuredChannel& c = record_.channels[k];
      c.value = {mean};
      // Of the mean; what moves while a lift is pulled is slow, so that a window holds few independent values.
      if (std::isnan(c.noise)) c.noise = std::sqrt(square / count / std::min(count, 10.0));
    }
  }

  void take_samples() {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time_.size(); ++i) steps.push_back(time_[i] - time_[i - 1]);
    const double own = median_of(std::move(steps));
    const double wanted = spec_.interval.value_or(output_interval_);
    if (own * kDense > wanted)
      take_rows(own);
    else
      reduce(wanted, own);
    if (record_.time.size() < kFewestRows)
      throw CaseError(fmt::format("{}: leaves {} samples after the first {:.6g} s of simulated time, a fit needs at "
                                  "least {}",
                                  spec_.file, record_.time.size(), spec_.settle, kFewestRows));
  }

  void take_rows(double own) {
    record_.interval = own;
    for (MeasuredChannel& c : record_.channels) c.value.clear();
    for (std::size_t i = 0; i < time_.size(); ++i) {
      if (time_[i] < spec_.settle) continue;
      record_.time.push_back(time_[i]);
      for (std::size_t k = 0; k < clean_.size(); ++k) record_.channels[k].value.push_back(clean_[k][i]);
    }
  }

  void reduce(double wanted, double own) {
    record_.interval = wanted;
    const auto first = static_cast<long>(std::ceil((std::max(time_.front(), spec_.settle) - 1e-9) / wanted));
    const auto last = static_cast<long>(std::floor((time_.back() + 1e-9) / wanted));
    for (long j = first; j <= last; ++j) record_.time.push_back(static_cast<double>(j) * wanted);
    const auto fewest = std::max<std::size_t>(3, static_cast<std::size_t>(0.4 * wanted / own));
    for (std::size_t k = 0; k < clean_.size(); ++k) {
      std::size_t from = 0;
      for (const double t : record_.time)
        record_.channels[k].value.push_back(local_parabola(time_, clean_[k], t, 0.5 * wanted, fewest, from));
    }
  }

  const FitRecordSpec& spec_;
  const std::vector<Channel>& channels_;
  double output_interval_;
  MeasuredTable table_;
  std::size_t first_row_ = 0;
  std::vector<double> time_;                // s, simulated, of the rows in the window
  std::vector<std::vector<double>> clean_;  // by channel, SI
  MeasuredRecord record_;
};

}  // namespace

MeasuredRecord read_record(const FitRecordSpec& spec, const std::vector<Channel>& channels, double output_interval) {
  return RecordReader(spec, channels, output_interval).read();
}

std::vector<bool> spikes(const std::vector<double>& values) {
  std::vector<double> steps, away(values.size(), 0.0), sizes;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double step = std::abs(values[i] - values[i - 1]); !std::isnan(step)) steps.push_back(step);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    std::array<double, 7> near;
    std::size_t count = 0;
    const std::size_t low = i < 3 ? 0 : i - 3, high = std::min(values.size(), i + 4);
    for (std::size_t j = low; j < high; ++j)
      if (!std::isnan(values[j])) near[count++] = values[j];
    std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count / 2),
                     near.begin() + static_cast<std::ptrdiff_t>(count));
    away[i] = std::abs(values[i] - near[count / 2]);
    sizes.push_back(away[i]);
  }
  // 1.4826: from the median of absolute deviations to the standard deviation of a normal.
  const double limit = std::max(6.0 * 1.4826 * median_of(std::move(sizes)), 3.0 * quantile_of(std::move(steps), 0.95));
  std::vector<bool> marked(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) marked[i] = away[i] > limit;
  return marked;
}

double local_parabola(const std::vector<double>& time, const std::vector<double>& value, double t, double half,
                      std::size_t fewest, std::size_t& from) {
  const double edge = half * (1.0 + 1e-9);
  while (from < time.size() && time[from] < t - edge) ++from;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = from; i < time.size() && time[i] <= t + edge; ++i) {
    if (std::isnan(value[i])) continue;
    const double s = (time[i] - t) / half;
    const Eigen::Vector3d basis(1.0, s, s * s);
    normal += basis * basis.transpose();
    right += value[i] * basis;
    ++count;
  }
  if (count < fewest) return kNone;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  return solver.rcond() > 1e-10 ? solver.solve(right)[0] : right[0] / static_cast<double>(count);
}

}  // namespace stillhook
