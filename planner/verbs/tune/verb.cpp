#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/verbs/plan/plan_results.h"
#include "planner/verbs/tune/tune_report.h"
#include "planner/verbs/verbs.h"

namespace stillhook {
namespace {

void print_tuning(const Evaluator& evaluator, const GainTuning& result, const std::vector<std::string>& left_out) {
  if (const std::string scope = tuning_scope(evaluator); !scope.empty()) fmt::print("{}\n", scope);
  if (!left_out.empty())
    fmt::print("Left out, because this part of the operation does not have it: {}\n", fmt::join(left_out, ", "));
  fmt::print("{}\n\n{}", tuning_verdict(result), table_text(gain_table(evaluator, result)));
  if (result.schedule) fmt::print("\n{}\n", schedule_verdict(result));
  for (const ReportTable& table : {schedule_table(result), swing_table(result), winch_table(result)})
    if (!table.rows.empty()) fmt::print("\n{}", table_text(table));
}

class TuneVerb final : public Verb {
 public:
  std::string name() const override { return "tune"; }
  std::string help() const override { return "Tune the tagline gains: gains, damping of the swing, report"; }
  void add_options(VerbOptions& o) override;
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override { return {{"tuned.toml", "The case with the tuned gains in it."}}; }

 private:
  Case load(const CommonOptions& options) const;
  void print(const VerbRun& verb, const Evaluator& evaluator, const GainTuning& result,
             const std::vector<std::string>& left_out, bool new_case) const;

  std::optional<int> evaluations_, map_;
  std::string phase_, pose_;  // empty: as the case says
  std::optional<double> hold_;
  bool schedule_ = false;
};

void TuneVerb::add_options(VerbOptions& o) {
  o.add_case();
  o.add_folder();
  o.add_seed("Seed of the search");
  o.add({.name = "--evaluations",
         .target = &evaluations_,
         .operand = "N",
         .help = "Budget of points",
         .range = std::pair(1.0, 100000.0)});
  o.add({.name = "--map",
         .target = &map_,
         .operand = "N",
         .help = "Map the objective over the first two gains with N x N points (0 = none)",
         .range = std::pair(0.0, 200.0)});
  o.add({"--phase", &phase_, "NAME", "This phase alone, begun at rest"});
  o.add({.name = "--pose",
         .target = &pose_,
         .operand = "NAME",
         .help = "At rest in the pose that this phase ends in",
         .excludes = "--phase"});
  o.add({.name = "--hold", .target = &hold_, .operand = "S", .help = "How long in that pose, s", .positive = true});
  o.add({"--schedule", &schedule_, "", "Then factors on the gains over the length of the falls"});
}

Case TuneVerb::load(const CommonOptions& options) const {
  std::vector<Override> more;
  if (options.seed) more.push_back({"plan.seed", std::to_string(*options.seed)});
  if (evaluations_) more.push_back({"tune.evaluations", std::to_string(*evaluations_)});
  if (map_) more.push_back({"tune.map", std::to_string(*map_)});
  if (!phase_.empty()) more.push_back({"tune.phase", "\"" + phase_ + "\""});
  if (!pose_.empty()) more.push_back({"tune.pose", "\"" + pose_ + "\""});
  if (hold_) more.push_back({"tune.hold_s", fmt::format("{}", *hold_)});
  if (schedule_) more.push_back({"tune.schedule", "true"});
  return load_case(options, more);
}

void TuneVerb::print(const VerbRun& verb, const Evaluator& evaluator, const GainTuning& result,
                     const std::vector<std::string>& left_out, bool new_case) const {
  print_tuning(evaluator, result, left_out);
  if (new_case) fmt::print("\nTuned case: {}\n", verb.folder().tuned());
  if (!verb.stop()) fmt::print("Report: {}\n", verb.folder().report());
}

int TuneVerb::run(const CommonOptions& options) {
  VerbRun verb(name(), options);
  const Case c = load(options);
  std::vector<std::string> left_out;
  const Evaluator evaluator(tuning_case(c, &left_out), &verb.stop());
  // A baseline that cannot be built is a fault of the case; only the points of a search are graded.
  const std::vector<std::string> gaps = scenario_warnings(evaluator, c, verb.panel_progress());
  print_warnings(gaps);
  const RunFolder& folder = verb.open(c);
  verb.keep_case(c);
  Progress progress = verb.progress();
  TuningOptions with;
  with.stop = &verb.stop();
  with.progress = [&](const std::string& stage, double share) { progress.update(share, "tune: " + stage); };
  const GainTuning result = tune_gains(evaluator, with);
  progress.clear();

  Summary summary = tuning_summary(evaluator, result, verb.wall());
  const std::vector<std::string> found = summary.warnings;
  summary.warnings.insert(summary.warnings.begin(), gaps.begin(), gaps.end());
  summary.date = verb.date();
  const bool interrupted = summary.status == RunStatus::interrupted;
  const bool scheduled = result.schedule && result.schedule->worth_it, new_case = result.improved || scheduled;
  if (new_case)
    verb.write_case(folder.tuned(), scheduled ? *result.schedule->scheduled : evaluator.case_at(result.gains));
  if (!interrupted) verb.write(folder.report(), tuning_report(evaluator, result, verb.control(c), summary.warnings));
  verb.conclude(summary_json(summary));
  print_warnings(found);
  if (verb.prints()) print(verb, evaluator, result, left_out, new_case);
  if (interrupted) {
    spdlog::warn("interrupted; the best gains so far are kept");
    return kInterrupted;
  }
  if (summary.status == RunStatus::failed) return kLimitViolated;
  if (!result.baseline.usable && !result.tuned.usable) return kNumericalFailure;
  return result.tuned.violation() > 0.0 ? kLimitViolated : kDone;
}

}  // namespace

std::unique_ptr<Verb> tune_verb() { return std::make_unique<TuneVerb>(); }

}  // namespace stillhook
