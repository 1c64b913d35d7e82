#include "results/weather/windows.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "results/statistics/sample.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Durations and steps come from decimal hours: 0.3 h of 0.1 h are three samples.
std::size_t samples_in(double hours, double step_h) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(hours / step_h - 1e-9)));
}

/// Whether a window of m samples starts at each sample; a ring is gone round once more.
std::vector<char> window_starts(const Workability& w, std::size_t m, RecordEnd end) {
  const std::size_t n = w.size(), length = end == RecordEnd::wrap ? 2 * n : n;
  std::vector<char> starts(n, 0);
  std::size_t run = 0;
  for (std::size_t i = length; i-- > 0;) {
    run = w.workable(i % n) ? run + 1 : 0;
    if (i < n) starts[i] = run >= m ? 1 : 0;
  }
  return starts;
}

std::vector<double> waits(const std::vector<char>& starts, double step_h, RecordEnd end) {
  const std::size_t n = starts.size(), length = end == RecordEnd::wrap ? 2 * n : n;
  std::vector<double> wait(n, kNaN);
  std::size_t next = length;  // none
  for (std::size_t i = length; i-- > 0;) {
    if (starts[i % n]) next = i;
    if (i < n && next < length) wait[i] = static_cast<double>(next - i) * step_h;
  }
  return wait;
}

/// Gathers the waits of some samples.
class Gathered {
 public:
  Gathered(const std::vector<double>& days, double step_h) : step_h_(step_h), days_(days), tried_(days.size()) {}

  /// `left`: samples after this one at which a start can be told.
  void add(bool starts, double wait_h, bool can_be_told, std::size_t left) {
    if (can_be_told) {
      ++told_;
      starts_ += starts ? 1 : 0;
    }
    if (!std::isnan(wait_h)) waits_.push_back(wait_h);
    for (std::size_t d = 0; d < days_.size() && can_be_told; ++d) {
      if (samples_of(d) > left) continue;
      ++tried_[d].first;
      tried_[d].second += wait_h <= 24.0 * days_[d] ? 1 : 0;
    }
  }

  WaitSummary summary() const {
    WaitSummary s;
    s.counted = waits_.size();
    s.start_share = told_ == 0 ? kNaN : static_cast<double>(starts_) / static_cast<double>(told_);
    s.mean_h = mean_of(waits_);
    s.p50_h = quantile_of(waits_, 0.5);
    s.p80_h = quantile_of(waits_, 0.8);
    s.p90_h = quantile_of(waits_, 0.9);
    for (std::size_t d = 0; d < days_.size(); ++d)
      s.within.push_back(
          {days_[d],
           tried_[d].first == 0 ? kNaN : static_cast<double>(tried_[d].second) / static_cast<double>(tried_[d].first)});
    return s;
  }

 private:
  std::size_t samples_of(std::size_t d) const {
    return static_cast<std::size_t>(std::ceil(24.0 * days_[d] / step_h_ - 1e-9));
  }

  double step_h_;
  const std::vector<double>& days_;
  std::size_t told_ = 0, starts_ = 0;
  std::vector<double> waits_;
  std::vector<std::pair<std::size_t, std::size_t>> tried_;  // by horizon: starts that have it, and a window within it
};

}  // namespace

WindowStatistics find_windows(const Workability& w, double duration_h, RecordEnd end, const std::vector<double>& days) {
  if (!(duration_h > 0.0)) throw std::invalid_argument("a window must last longer than 0 h");
  WindowStatistics result;
  const double step_h = static_cast<double>(w.step) / kHour;
  result.duration_h = duration_h;
  result.samples = samples_in(duration_h, step_h);
  const std::size_t n = w.size(), m = result.samples;
  const std::vector<char> starts = window_starts(w, m, end);
  result.wait_h = waits(starts, step_h, end);

  Gathered all(days, step_h);
  std::vector<Gathered> months(12, all);
  std::map<int, std::array<std::vector<double>, 12>> years;
  // A start can be told where a whole window fits into the record.
  const std::size_t told = end == RecordEnd::wrap ? n : (n >= m ? n - m + 1 : 0);
  for (std::size_t i = 0; i < n; ++i) {
    const CalendarDate date = date_of(w.time(i));
    const std::size_t month = static_cast<std::size_t>(date.month - 1);
    const double wait = result.wait_h[i];
    const std::size_t left = end == RecordEnd::wrap ? n : (told > i ? told - i - 1 : 0);
    result.starts += starts[i] ? 1 : 0;
    result.censored += std::isnan(wait) ? 1 : 0;
    for (Gathered* gathered : {&all, &months[month]}) gathered->add(starts[i] != 0, wait, i < told, left);
    years[date.year][month].push_back(wait);
  }
  result.all = all.summary();
  for (std::size_t month = 0; month < 12; ++month) result.by_month[month] = months[month].summary();
  for (const auto& [year, of_months] : years)
    for (std::size_t month = 0; month < 12; ++month)
      // A month with waits that are cut off would count with its short ones alone: its mean is NaN.
      if (const double mean = mean_of(of_months[month]);
          !std::isnan(mean) && covers(w.start, w.step, n, year, static_cast<int>(month) + 1)) {
        result.mean_by_year[month].years.push_back(year);
        result.mean_by_year[month].values.push_back(mean);
      }
  return result;
}

std::vector<double> calms(const Workability& w) {
  std::vector<double> lengths;
  std::size_t run = 0;
  for (std::size_t i = 0; i <= w.size(); ++i) {
    if (i < w.size() && w.workable(i)) {
      ++run;
    } else if (run > 0) {
      lengths.push_back(static_cast<double>(run) * static_cast<double>(w.step) / kHour);
      run = 0;
    }
  }
  return lengths;
}

}  // namespace stillhook
