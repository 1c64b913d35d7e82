#include "results/weather/limit_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double within_a_turn(double angle) {
  const double rest = std::fmod(angle, kTurn);
  return rest < 0.0 ? rest + kTurn : rest;
}

}  // namespace

LimitSurface::LimitSurface(double height) : heights_{{height}} {}

LimitSurface::LimitSurface(std::vector<double> periods, std::vector<double> headings,
                           std::vector<std::vector<double>> heights)
    : periods_(std::move(periods)), headings_(std::move(headings)), heights_(std::move(heights)) {
  const std::size_t columns = std::max<std::size_t>(1, headings_.size());
  if (heights_.size() != std::max<std::size_t>(1, periods_.size()))
    throw std::invalid_argument("a limit surface needs a row for each period");
  for (const std::vector<double>& row : heights_)
    if (row.size() != columns) throw std::invalid_argument("a limit surface needs a column for each heading");
}

double LimitSurface::along(const std::vector<double>& row, double heading) const {
  if (row.size() == 1) return row[0];
  if (std::isnan(heading)) return kNaN;
  const double angle = within_a_turn(heading);
  // The interval that begins at the last heading ends at the first, a turn later.
  const auto after = std::upper_bound(headings_.begin(), headings_.end(), angle);
  const std::size_t n = row.size(), next = static_cast<std::size_t>(after - headings_.begin()) % n;
  const std::size_t before = (next + n - 1) % n;
  const double width = within_a_turn(headings_[next] - headings_[before]);
  const double part = within_a_turn(angle - headings_[before]) / width;
  return row[before] + part * (row[next] - row[before]);
}

template <class RowValue>
double LimitSurface::between_periods(double period, RowValue value) const {
  if (heights_.empty()) return kNaN;
  if (periods_.empty()) return value(heights_[0]);
  if (!(period >= periods_.front() && period <= periods_.back())) return kNaN;
  if (periods_.size() == 1) return value(heights_[0]);
  const auto after = std::upper_bound(periods_.begin(), periods_.end(), period);
  const std::size_t next = std::min(static_cast<std::size_t>(after - periods_.begin()), periods_.size() - 1);
  const double low = value(heights_[next - 1]), high = value(heights_[next]);
  return low + (period - periods_[next - 1]) / (periods_[next] - periods_[next - 1]) * (high - low);
}

double LimitSurface::at(double period, double heading) const {
  return between_periods(period, [&](const std::vector<double>& row) { return along(row, heading); });
}

double LimitSurface::lowest(double period) const {
  double least = kNaN;
  const std::vector<double> any = {0.0};
  for (const double heading : headings_.empty() ? any : headings_) {
    const double limit = at(period, heading);
    if (!(limit >= least)) least = limit;
  }
  return least;
}

bool OperationLimits::depends_on_period() const {
  return std::any_of(phases.begin(), phases.end(), [](const PhaseLimit& p) { return !p.limit.periods().empty(); });
}

bool OperationLimits::depends_on_heading() const {
  return std::any_of(phases.begin(), phases.end(), [](const PhaseLimit& p) { return !p.limit.headings().empty(); });
}

double OperationLimits::at(double period, double heading) const {
  double least = std::numeric_limits<double>::infinity();
  for (const PhaseLimit& p : phases) {
    const double limit = p.limit.at(period, heading);
    if (std::isnan(limit)) return kNaN;
    least = std::min(least, limit);
  }
  return phases.empty() ? kNaN : least;
}

double OperationLimits::lowest(double period) const {
  double least = std::numeric_limits<double>::infinity();
  for (const PhaseLimit& p : phases) {
    const double limit = p.limit.lowest(period);
    if (std::isnan(limit)) return kNaN;
    least = std::min(least, limit);
  }
  return phases.empty() ? kNaN : least;
}

double OperationLimits::highest(double period) const {
  if (!depends_on_heading()) return at(period, 0.0);
  double most = kNaN;
  const auto consider = [&](double heading) {
    const double limit = at(period, heading);
    if (!(limit <= most)) most = limit;
  };
  for (const PhaseLimit& p : phases)
    for (const double heading : p.limit.headings()) consider(heading);
  if (phases.size() > 1)
    for (int degree = 0; degree < 360; ++degree) consider(degree * std::numbers::pi / 180.0);
  return most;
}

}  // namespace stillhook
