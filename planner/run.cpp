#include "planner/run.h"

#include "planner/version.h"

namespace stillhook {

PreparedRun prepare_run(const Case& c, const Specification& specification, const HydroProgress& progress) {
  try {
    return PreparedRun(specification, progress);
  } catch (const SpecificationError& error) {
    throw located(c, error);
  }
}

RunResult run_lift(const PreparedRun& prepared, const std::vector<LimitSpec>& limits, const std::atomic<bool>* stop,
                   const std::function<void(double t, double t_end)>& progress, ArchiveStream* archive) {
  RunOptions options;
  options.progress = [&](double t, double t_end) {
    if (progress) progress(t, t_end);
    return !(stop && stop->load());
  };
  options.sink = archive;
  Trajectory trajectory = simulate(prepared.model, prepared.operation, options);
  if (archive) archive->finish(trajectory);
  RunResult result = judged(prepared.model.specification(), std::move(trajectory), limits);
  result.warnings = prepared.warnings;
  return result;
}

RunResult judged(const Specification& specification, Trajectory trajectory, const std::vector<LimitSpec>& limits) {
  RunResult result;
  result.specification = specification;
  result.trajectory = std::move(trajectory);
  result.metrics = compute_metrics(result.specification, result.trajectory);
  result.limits = check_limits(limits, result.metrics);
  return result;
}

Summary summary_of(const RunResult& run, const Case& c, const std::string& verb) {
  Summary summary = summarise(run.specification, run.trajectory, run.metrics, run.limits);
  summary.case_name = c.name;
  summary.verb = verb;
  summary.sea = run.specification.sea.active;
  summary.program_version = kVersion;
  summary.date = run.date;
  summary.warnings = run.warnings;
  return summary;
}

}  // namespace stillhook
