#include "planner/operability/column.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/statistics/binomial.h"

namespace stillhook {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestStep = 1.5;    // of the height, from one rung to the next
constexpr double kSmallestStep = 1.05;  // a rung closer than that would tell little
constexpr int kRankMargin = 2;          // ranks beyond the upper one that a rung aims at
constexpr int kRunsBeforeBisection = 6;
constexpr double kIslandShare = 0.7, kLowerIslandShare = 0.5;  // of the estimate, where seeds are looked at for islands

void check_rules(const ColumnRules& r, const std::vector<ColumnTarget>& targets) {
  const bool ascending = !r.looks.empty() && r.looks.front() >= 1 &&
                         std::adjacent_find(r.looks.begin(), r.looks.end(), std::greater_equal<>()) == r.looks.end();
  if (!ascending) throw std::invalid_argument("the looks of a column must ascend from at least one seed");
  if (!(r.level > 0.0 && r.level < 1.0 && r.tolerance > 0.0 && r.resolution > 0.0))
    throw std::invalid_argument("level, tolerance and resolution of a column must be > 0, the level < 1");
  if (!(r.lowest > 0.0 && r.highest > r.lowest))
    throw std::invalid_argument("the heights of a column must go from above 0 to a larger one");
  if (targets.empty()) throw std::invalid_argument("a column needs a target");
}

/// The seed's height among others: the nth smallest, from 1.
double nth(std::vector<double> values, int n) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::clamp(n, 1, static_cast<int>(values.size())) - 1)];
}

}  // namespace

bool SeedBracket::found() const { return high < kInfinity; }

double SeedBracket::height() const {
  if (!found()) return kInfinity;
  return low > 0.0 ? std::sqrt(low * high) : 0.0;
}

Column::Column(ColumnRules rules, std::vector<ColumnCell> cells, std::vector<ColumnTarget> targets)
    : rules_(std::move(rules)), cells_(std::move(cells)), targets_(std::move(targets)) {
  check_rules(rules_, targets_);
  take_seeds(rules_.looks.front());
  runs_.resize(static_cast<std::size_t>(rules_.looks.back()));
  start_ = std::clamp(rules_.guess, rules_.lowest, rules_.highest);
  plan_round();
}

void Column::tell(const ColumnRun& run) {
  const auto asked = std::lower_bound(wanted_.begin(), wanted_.end(), run.at);
  if (asked == wanted_.end() || *asked != run.at)
    throw std::logic_error("a column was told a run that it did not ask for");
  if (!run.crashed && run.use.size() != cells_.size())
    throw std::logic_error("a run has another number of cells than its column");
  runs_[static_cast<std::size_t>(run.at.seed)][run.at.height] = run;
  wanted_.erase(asked);
  if (wanted_.empty()) plan_round();
}

void Column::plan_round() {
  while (wanted_.empty() && stage_ != Stage::end) {
    for (const RunWanted& run : next_runs())
      if (!runs_[static_cast<std::size_t>(run.seed)].contains(run.height)) wanted_.push_back(run);
  }
  std::sort(wanted_.begin(), wanted_.end());
}

/// The next round, or none after a step to the next stage.
std::vector<RunWanted> Column::next_runs() {
  if (stage_ == Stage::search) {
    std::vector<RunWanted> runs = search(0);
    if (!runs.empty()) return runs;
    const double estimate = limit_of(0).limit.height;
    const bool looks_for_islands = look_ == 0 || !monotone();
    stage_ = Stage::island;
    if (looks_for_islands && estimate > 0.0) return all_seeds_at(std::max(rules_.lowest, kIslandShare * estimate));
    return {};
  }
  if (stage_ == Stage::island) {
    stage_ = Stage::lower_island;
    const double estimate = limit_of(0).limit.height;
    if (!monotone() && estimate > 0.0) return all_seeds_at(std::max(rules_.lowest, kLowerIslandShare * estimate));
    return {};
  }
  if (stage_ == Stage::lower_island) {
    std::vector<RunWanted> runs = search(0);  // what the islands have changed
    if (runs.empty()) finish_look();
    return runs;
  }
  if (!rules_.every_target || ++target_ >= targets_.size()) {
    stage_ = Stage::end;
    return {};
  }
  std::vector<RunWanted> runs = search(target_);
  if (!runs.empty()) --target_;  // come back to it
  return runs;
}

/// Width alone decides: a limit that is good enough does not end the search.
void Column::finish_look() {
  const TargetLimit whole = limit_of(0);
  const LimitingHeight& l = whole.limit;
  const bool within = whole.at_least || whole.below_lowest || 0.5 * (l.high - l.low) <= rules_.tolerance * l.height;
  if (look_ + 1 == rules_.looks.size() || (within && !std::isnan(l.low))) {
    stage_ = Stage::targets;
    return;
  }
  // New seeds begin where the upper rank of these lies: nearly all that matter break there.
  std::vector<double> highs;
  for (const SeedBracket& b : whole.seeds) highs.push_back(std::min(b.high, rules_.highest));
  start_ = nth(highs, upper_);
  ++look_;
  take_seeds(rules_.looks[look_]);
  stage_ = Stage::search;
}

/// Ranks from 1 up to `upper_` must be known: that of the upper bound, and those of the point estimate.
void Column::take_seeds(int seeds) {
  seeds_ = seeds;
  const double share = 1.0 - rules_.level;
  const QuantileRanks ranks = quantile_ranks(seeds, share);
  const int point = static_cast<int>(std::floor(share * (seeds - 1))) + 2;
  upper_ = rules_.every_seed || ranks.upper == 0 ? seeds : std::min(seeds, std::max(ranks.upper, point));
  certifiable_ = ranks.lower > 0;
}

std::vector<RunWanted> Column::search(std::size_t target) {
  const std::vector<SeedBracket> seeds = brackets(target);
  std::vector<RunWanted> runs;
  for (int i = 0; i < seeds_; ++i)
    if (runs_[static_cast<std::size_t>(i)].empty()) runs.push_back({i, start_});
  if (!runs.empty()) return runs;

  runs = rung_up(seeds, target);
  if (!runs.empty()) return runs;
  std::vector<double> highs;
  for (const SeedBracket& b : seeds) highs.push_back(std::min(b.high, rules_.highest));
  const double top = nth(highs, upper_);
  for (int i = 0; i < seeds_; ++i)
    if (const SeedBracket& b = seeds[static_cast<std::size_t>(i)]; !b.found() && b.low < top) runs.push_back({i, top});
  if (!runs.empty()) return runs;
  runs = rung_down(seeds, target);
  if (!runs.empty()) return runs;
  for (int i = 0; i < seeds_; ++i) {
    const SeedBracket& b = seeds[static_cast<std::size_t>(i)];
    if (b.found() && b.low < top && !narrow(b)) runs.push_back({i, refined(b, i, target)});
  }
  return runs;
}

/// While fewer seeds break than the upper rank needs: those that do not, higher.
std::vector<RunWanted> Column::rung_up(const std::vector<SeedBracket>& seeds, std::size_t target) const {
  std::vector<std::pair<int, double>> open;  // seed, how high it was
  double common = 0.0;
  for (int i = 0; i < seeds_; ++i) {
    const SeedBracket& b = seeds[static_cast<std::size_t>(i)];
    if (b.found()) continue;
    open.emplace_back(i, b.low);
    common = std::max(common, b.low);
  }
  const int found = seeds_ - static_cast<int>(open.size());
  if (found >= upper_ || open.empty()) return {};
  std::vector<RunWanted> runs;
  for (const auto& [seed, low] : open)
    if (low < common) runs.push_back({seed, common});
  if (!runs.empty() || common >= rules_.highest) return runs;
  std::vector<double> falling;  // negative, so that the smallest is the largest use
  for (const auto& [seed, low] : open) falling.push_back(-use_at(seed, common, target));
  const double use = -nth(falling, upper_ + kRankMargin - found);
  const double step = use > 0.0 ? std::clamp(1.0 / use, kSmallestStep, kLargestStep) : kLargestStep;
  for (const auto& [seed, low] : open) runs.push_back({seed, std::min(rules_.highest, common * step)});
  return runs;
}

/// While more seeds break at every height that they were run at than matter: all of those at once, lower.
std::vector<RunWanted> Column::rung_down(const std::vector<SeedBracket>& seeds, std::size_t target) const {
  std::vector<int> broken;
  double base = kInfinity;
  for (int i = 0; i < seeds_; ++i) {
    const SeedBracket& b = seeds[static_cast<std::size_t>(i)];
    if (b.low > 0.0 || !b.found() || narrow(b)) continue;
    broken.push_back(i);
    base = std::min(base, b.high);
  }
  if (static_cast<int>(broken.size()) <= upper_ + kRankMargin) return {};
  std::vector<double> falling;
  for (const int i : broken) falling.push_back(-use_at(i, seeds[static_cast<std::size_t>(i)].high, target));
  const double step = std::clamp(-nth(falling, upper_ + kRankMargin), kSmallestStep, kLargestStep);
  std::vector<RunWanted> runs;
  for (const int i : broken) runs.push_back({i, std::max(rules_.lowest, base / step)});
  return runs;
}

/// Where a seed runs next, inside its bracket.
double Column::refined(const SeedBracket& b, int seed, std::size_t target) const {
  const double use_high = use_at(seed, b.high, target);
  if (!(b.low > 0.0))
    return std::max(rules_.lowest,
                    b.high / std::clamp(use_high * (1.0 + rules_.resolution), kSmallestStep, kLargestStep));
  const double width = std::log(b.high / b.low);
  const double fine = 0.9 * std::log1p(rules_.resolution);  // below the resolution, for rounding
  const double middle = std::sqrt(b.low * b.high);
  const double use_low = use_at(seed, b.low, target);
  if (width <= 2.0 * fine || b.runs > kRunsBeforeBisection || !(use_low > 0.0) || !(use_high < kInfinity))
    return middle;
  const double part = -std::log(use_low) / (std::log(use_high) - std::log(use_low)) * width;
  if (part <= fine) return b.low * std::exp(fine);
  if (width - part <= fine) return b.high * std::exp(-fine);
  return b.low * std::exp(part - 0.5 * fine);  // a little short of it: the next run then closes the bracket
}

/// Every seed that is not known to break below.
std::vector<RunWanted> Column::all_seeds_at(double height) const {
  std::vector<RunWanted> runs;
  for (int i = 0; i < seeds_; ++i)
    if (bracket_of(i, 0).high > height) runs.push_back({i, height});
  return runs;
}

double Column::use_at(int seed, double height, std::size_t target) const {
  const ColumnRun& run = runs_[static_cast<std::size_t>(seed)].at(height);
  if (run.crashed) return kInfinity;
  double use = 0.0;
  for (const std::size_t cell : targets_[target].cells)
    if (!std::isnan(run.use[cell])) use = std::max(use, run.use[cell]);
  return use;
}

/// The broken cell whose limit is reached first as far as one run can tell: the largest finite use, else the first.
std::size_t Column::criterion_at(const ColumnRun& run, std::size_t target) const {
  const std::vector<std::size_t>& cells = targets_[target].cells;
  std::size_t chosen = cells_.size();
  double most = 1.0;
  if (run.crashed) return chosen;
  for (const std::size_t cell : cells) {
    if (!(run.use[cell] > most) || !(run.use[cell] < kInfinity)) continue;
    most = run.use[cell];
    chosen = cell;
  }
  for (const std::size_t cell : cells)
    if (chosen == cells_.size() && run.use[cell] == kInfinity) chosen = cell;
  return chosen;
}

SeedBracket Column::bracket_of(int seed, std::size_t target) const {
  SeedBracket b;
  b.high = kInfinity;
  b.criterion = cells_.size();
  const auto& runs = runs_[static_cast<std::size_t>(seed)];
  b.runs = static_cast<int>(runs.size());
  for (const auto& [height, run] : runs) {  // ascending: up to the first that breaks
    if (use_at(seed, height, target) > 1.0) {
      b.high = height;
      b.criterion = criterion_at(run, target);
      break;
    }
    b.low = height;
  }
  return b;
}

std::vector<SeedBracket> Column::brackets(std::size_t target) const {
  std::vector<SeedBracket> all;
  for (int i = 0; i < seeds_; ++i) all.push_back(bracket_of(i, target));
  return all;
}

bool Column::narrow(const SeedBracket& b) const {
  return b.high <= rules_.lowest || (b.low > 0.0 && b.high <= b.low * (1.0 + rules_.resolution));
}

bool Column::resolved(std::size_t target) const {
  const std::vector<SeedBracket> seeds = brackets(target);
  std::vector<double> highs;
  for (const SeedBracket& b : seeds) highs.push_back(std::min(b.high, rules_.highest));
  const double top = nth(highs, upper_);
  return std::all_of(seeds.begin(), seeds.end(),
                     [&](const SeedBracket& b) { return b.runs > 0 && (b.low >= top || (b.found() && narrow(b))); });
}

TargetLimit Column::limit_of(std::size_t target) const {
  TargetLimit result;
  result.name = targets_[target].name;
  result.seeds = brackets(target);
  result.resolved = resolved(target);
  std::vector<Crossing> middles, lows, highs;
  for (const SeedBracket& b : result.seeds) {
    const bool known = b.criterion < cells_.size();
    Crossing c{b.height(), known ? cells_[b.criterion].name : "crashed", b.found(),
               known && cells_[b.criterion].smooth};
    c.smooth = c.smooth && narrow(b);
    middles.push_back(c);
    highs.push_back(c);
    highs.back().height = b.high;
    // A bracket that is not narrow yet only says what is kept.
    lows.push_back(c);
    lows.back().height = b.low;
    lows.back().found = c.found || !result.resolved;
  }
  const LimitingHeight low = limiting_height(lows, rules_.level);
  result.limit = limiting_height(middles, rules_.level);
  result.limit.low = low.low;
  result.limit.high = limiting_height(highs, rules_.level).high;
  if (!result.resolved) {
    result.limit = low;
    result.limit.high = result.limit.gumbel = result.limit.governing_share = kNaN;
    result.limit.governing.clear();
    for (double* height : {&result.limit.height, &result.limit.low})
      if (!(*height > 0.0)) *height = kNaN;  // nothing is known yet
    result.at_least = true;
  } else if (std::isnan(result.limit.height)) {
    result.limit.height = rules_.highest;
    result.at_least = true;
  }
  // The rank of the lower bound did not break up to there either.
  if (result.resolved && result.at_least && std::isnan(result.limit.low) && certifiable_)
    result.limit.low = rules_.highest;
  result.below_lowest = result.resolved && !(result.limit.height > 0.0);
  return result;
}

bool Column::monotone() const {
  for (int i = 0; i < seeds_; ++i) {
    const double high = bracket_of(i, 0).high;
    for (const auto& [height, run] : runs_[static_cast<std::size_t>(i)])
      if (height > high && use_at(i, height, 0) <= 1.0) return false;
  }
  return true;
}

ColumnResult Column::result() const {
  ColumnResult result;
  result.seeds = seeds_;
  for (std::size_t t = 0; t < targets_.size(); ++t) result.targets.push_back(limit_of(t));
  for (const auto& of_seed : runs_)
    for (const auto& [height, run] : of_seed) {
      ++result.runs;
      result.crashed += run.crashed ? 1 : 0;
    }
  const TargetLimit& whole = result.targets.front();
  const LimitingHeight& l = whole.limit;
  result.monotone = monotone();
  result.certified = done() && whole.resolved && result.crashed == 0 && !std::isnan(l.low);
  result.within_tolerance = result.certified && (whole.at_least || whole.below_lowest ||
                                                 0.5 * (l.high - l.low) <= rules_.tolerance * l.height);
  return result;
}

}  // namespace stillhook
