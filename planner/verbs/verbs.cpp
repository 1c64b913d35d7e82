#include "planner/verbs/verbs.h"

namespace stillhook {

std::vector<std::unique_ptr<Verb>> all_verbs() {
  std::vector<std::unique_ptr<Verb>> verbs;
  for (const auto& make :
       {check_verb, hydro_verb, simulate_verb, plan_verb, tune_verb, fit_verb, operability_verb, weather_verb,
        report_verb, export_verb, schema_verb, campaign_verb, worker_verb})
    verbs.push_back(make());
  return verbs;
}

const std::vector<RunFile>& run_files() {
  static const std::vector<RunFile> files = [] {
    std::vector<RunFile> all = {
        {"case.toml", "The case as it was used: the file with every --set. A case that any verb takes."},
        {"summary.json",
         "Status, metrics, limits; objective and variables of a search. Its presence says that the run is complete."},
        {"report.html", "The report, one file that a browser opens without a network."}};
    for (const std::unique_ptr<Verb>& verb : all_verbs())
      for (RunFile& file : verb->files()) all.push_back(std::move(file));
    return all;
  }();
  return files;
}

}  // namespace stillhook
