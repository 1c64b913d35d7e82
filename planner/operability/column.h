// The search for the limiting significant wave height of one column: one peak period and one heading.
//
// Every seed has a height h at which its run first breaks a limit; it has no noise, since the same seed draws the same
// phases at every height, and is found by bracketing. The limit at level p is the (1 - p) quantile of h, with an
// interval by order statistics (results/statistics). Only seeds that can decide that quantile are bracketed finely:
//
//   1. all seeds at a guess, then at heights scaled by the use of the limits, until as many break as the upper rank
//      needs;
//   2. those that break below the upper rank's height are bracketed to `resolution`: regula falsi on the logarithm of
//      the use over the logarithm of the height; bisection for counts, and from the seventh run of a seed on;
//   3. at the first look every seed also runs at 0.7 of the estimate. One that breaks there has an island: it takes the
//      lower height, and all run at 0.5 of the estimate as well;
//   4. at each look (a number of seeds) the search ends when half the interval is within `tolerance` of the limit.
//
// The column asks for runs in rounds, and decides when a round is complete, from results in order of seed and height:
// neither their order of arrival nor who made them can change what it asks for next.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "results/statistics/limiting_height.h"

namespace stillhook {

struct ColumnRules {
  std::vector<int> looks = {30, 60, 90};  // seeds at each look, ascending
  double level = 0.90;                    // share of the runs that shall keep the limits
  double tolerance = 0.08;                // of the limit: half-width of its interval
  double resolution = 0.02;               // of a seed's height: width of its bracket
  double guess = 1.0;                     // m
  double highest = 30.0;                  // m, the search goes no further
  double lowest = 0.05;                   // m, a seed that breaks there has the height 0
  bool every_target = false;              // bracket the limits of every target, not of the first alone
  bool every_seed = false;                // and those of every seed
};

/// A limit, perhaps of one phase: what a run's `use` is given for.
struct ColumnCell {
  std::string name;    // of the criterion
  bool smooth = true;  // its use changes smoothly with the height; false for counts
};

/// What a limiting height is wanted for: the whole lift, a phase, a criterion. It is broken where one of its cells is.
struct ColumnTarget {
  std::string name;
  std::vector<std::size_t> cells;
};

struct RunWanted {
  int seed = 0;         // index, from 0
  double height = 0.0;  // m
  auto operator<=>(const RunWanted&) const = default;
};

struct ColumnRun {
  RunWanted at;
  bool crashed = false;     // nothing is known of it
  std::vector<double> use;  // by cell: share of what its limit allows, above 1 = broken; NaN: has none
};

/// Where one seed breaks, for one target: it keeps its limits at `low` and breaks them at `high`.
struct SeedBracket {
  double low = 0.0, high = 0.0;  // m; high is infinite while nothing breaks
  std::size_t criterion = 0;     // cell that breaks at `high`
  int runs = 0;                  // at different heights
  bool found() const;
  double height() const;  // m, the middle; 0 if it breaks at the lowest height, infinite if it does not break
};

struct TargetLimit {
  std::string name;
  LimitingHeight limit;       // height, low, high in m; by the middles, the lows and the highs of the brackets
  bool at_least = false;      // the limit was not reached: `limit.height` is only known to be kept
  bool resolved = false;      // every bracket that decides it is as fine as asked for
  bool below_lowest = false;  // breaks at the lowest height of all
  std::vector<SeedBracket> seeds;
};

struct ColumnResult {
  int seeds = 0;
  std::vector<TargetLimit> targets;  // as given; the first is the whole
  bool certified = false;            // the whole's limit has a lower bound and no run crashed
  bool within_tolerance = false;
  bool monotone = true;  // no seed keeps the limits at a height above one at which it breaks them
  int crashed = 0;       // runs
  int runs = 0;
};

class Column {
 public:
  /// Throws std::invalid_argument for rules that make no sense, or without targets.
  Column(ColumnRules rules, std::vector<ColumnCell> cells, std::vector<ColumnTarget> targets);

  /// The runs of the round that are still missing, in order; none: the search is done.
  const std::vector<RunWanted>& wanted() const { return wanted_; }
  bool done() const { return wanted_.empty(); }
  /// A result, in any order. One that was not asked for in this round, or a second one, is an error of the caller.
  void tell(const ColumnRun& run);
  /// What is known; of a search that is not done, only bounds.
  ColumnResult result() const;

 private:
  enum class Stage { search, island, lower_island, targets, end };

  void plan_round();
  std::vector<RunWanted> next_runs();
  std::vector<RunWanted> search(std::size_t target);
  std::vector<RunWanted> rung_up(const std::vector<SeedBracket>& seeds, std::size_t target) const;
  std::vector<RunWanted> rung_down(const std::vector<SeedBracket>& seeds, std::size_t target) const;
  double refined(const SeedBracket& bracket, int seed, std::size_t target) const;
  std::vector<RunWanted> all_seeds_at(double height) const;
  void finish_look();
  void take_seeds(int seeds);

  SeedBracket bracket_of(int seed, std::size_t target) const;
  std::vector<SeedBracket> brackets(std::size_t target) const;
  bool narrow(const SeedBracket& bracket) const;
  bool resolved(std::size_t target) const;
  double use_at(int seed, double height, std::size_t target) const;
  std::size_t criterion_at(const ColumnRun& run, std::size_t target) const;
  TargetLimit limit_of(std::size_t target) const;
  bool monotone() const;

  ColumnRules rules_;
  std::vector<ColumnCell> cells_;
  std::vector<ColumnTarget> targets_;
  std::vector<std::map<double, ColumnRun>> runs_;  // by seed and height
  std::vector<RunWanted> wanted_;
  Stage stage_ = Stage::search;
  std::size_t look_ = 0, target_ = 0;
  int seeds_ = 0;             // of this look
  int upper_ = 0;             // the highest rank among them that must be known
  bool certifiable_ = false;  // they are enough for a lower bound
  double start_ = 0.0;        // m, where seeds without a run begin
};

}  // namespace stillhook
