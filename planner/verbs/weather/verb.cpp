#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/run.h"
#include "planner/verbs/verbs.h"
#include "planner/verbs/weather/study.h"
#include "planner/verbs/weather/weather_files.h"
#include "planner/verbs/weather/weather_report.h"
#include "planner/verbs/weather/weather_tables.h"
#include "planner/weather/limit_file.h"
#include "sim/csv_cells.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;

/// A folder of limits holds them in this file.
constexpr const char* kLimitsOfFolder = "operability.csv";

class WeatherVerb final : public Verb {
 public:
  std::string name() const override { return "weather"; }
  std::string help() const override {
    return "Workability, weather windows and go or no-go for an operation with limits on the wave height";
  }
  void add_options(VerbOptions& o) override;
  int run(const CommonOptions& options) override;
  std::vector<RunFile> files() const override {
    return {
        {"weather.csv", "Of every sample of a hindcast: its limit, whether it is workable, the wait for each window."},
        {"weather_months.csv", "Workable shares and waits by month, of all years and of each."},
        {"weather.nc", "The same as NetCDF (CF-1.8)."},
        {"forecast.csv", "Of every sample of a forecast: limits, alpha factors, whether a start is allowed."}};
  }

 private:
  WeatherTask task_of(const CommonOptions& options, std::optional<Case>& c) const;
  WeatherSpec settings(const CommonOptions& options, std::optional<Case>& c) const;
  void plan_times(WeatherTask& task, const std::optional<Case>& c, const VerbRun& verb) const;

  std::string hindcast_, scatter_, forecast_, case_;
};

void WeatherVerb::add_options(VerbOptions& o) {
  CommonOptions& common = o.common();
  o.add({.name = "LIMITS",
         .target = &common.input,
         .operand = "",
         .help = "Limiting significant wave heights: a CSV file with hs_limit [m] over tp [s] and heading [deg], a "
                 "folder with "
                 "one called operability.csv, or a single height in m",
         .required = true});
  o.add({"--hindcast", &hindcast_, "FILE", "Weather of years, CSV or NetCDF: workability by month, windows, waits"});
  o.add({"--scatter", &scatter_, "FILE", "Counts by height and period, CSV: workability, an estimate of windows"});
  o.add({"--forecast", &forecast_, "FILE", "Forecast, CSV or NetCDF: go or no-go with alpha factors"});
  o.add({"--case", &case_, "CASE", "Case whose section weather, and whose operation's durations, are used"});
  o.add({"--set", &common.sets, "KEY=VALUE", "Change a key, e.g. --set weather.bow_towards_deg=250; may be repeated"});
  o.add({"--json", &common.json, "", "Print the summary as JSON on stdout"});
  o.add_messages("Nothing but errors, and what --json prints");
  o.add({"--out", &common.out, "DIR", "Folder to write into (default runs/<limits>-weather)"});
  o.add_force("Replace the run that the folder holds");
}

WeatherSpec WeatherVerb::settings(const CommonOptions& options, std::optional<Case>& c) const {
  CommonOptions of_case = options;
  of_case.input = case_;
  const std::string beside = options.input + "/case.toml";  // of a run's folder
  if (case_.empty() && fs::is_directory(options.input) && fs::exists(beside)) of_case.input = beside;
  if (!of_case.input.empty()) {
    c = load_case(of_case);
    return c->weather;
  }
  std::vector<Override> overrides;
  for (const std::string& set : options.sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set " + set + ": must be KEY=VALUE, as in --set weather.operation_h=10");
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  return read_weather_settings(".", overrides);
}

/// The limits: a height, the file of a folder, or a file.
void take_limits(const std::string& input, WeatherTask& task) {
  if (const auto height = number_with_point(input)) {
    if (!(*height > 0.0 && *height <= 30.0))
      throw UsageError(fmt::format("LIMITS {}: a single limit must be a height above 0 and up to 30 m", input));
    task.limits.limits.phases = {{"", LimitSurface(*height)}};
    task.limits_source = fmt::format("{:g} m", *height);
    task.name = "limit";
    return;
  }
  task.limits_source = fs::is_directory(input) ? (fs::path(input) / kLimitsOfFolder).string() : input;
  if (!fs::exists(task.limits_source))
    throw UsageError(fs::is_directory(input)
                         ? fmt::format("{}: holds no {}: give the limits as a CSV file, or as one height in m", input,
                                       kLimitsOfFolder)
                         : fmt::format("{}: there is no such file, nor is it a height in m", input));
  task.limits = read_limit_file(task.limits_source);
  fs::path named = fs::path(input).lexically_normal();
  if (named.filename().empty()) named = named.parent_path();
  task.name = named.stem().string();
}

WeatherTask WeatherVerb::task_of(const CommonOptions& options, std::optional<Case>& c) const {
  WeatherTask task;
  task.spec = settings(options, c);
  take_limits(options.input, task);
  if (c) task.name = c->name;
  task.title = c && !c->title.empty() ? c->title : task.name;
  for (const auto& [given, file] :
       {std::pair(&hindcast_, &task.spec.hindcast), std::pair(&scatter_, &task.spec.scatter),
        std::pair(&forecast_, &task.spec.forecast)})
    if (!given->empty()) *file = *given;
  if (task.spec.hindcast.empty() && task.spec.scatter.empty() && task.spec.forecast.empty())
    throw UsageError("weather: there is no weather yet: give --hindcast FILE, --scatter FILE or --forecast FILE");
  return task;
}

std::vector<PlannedPhase> one_after_another(const std::vector<WeatherPhaseSpec>& phases) {
  std::vector<PlannedPhase> planned;
  double begin = 0.0;
  for (const WeatherPhaseSpec& phase : phases) {
    planned.push_back({phase.name, begin, begin + phase.duration / kHour});
    begin = planned.back().end_h;
  }
  return planned;
}

/// Durations of the phases as the case's operation has them.
std::vector<WeatherPhaseSpec> phases_of(const Case& c, const VerbRun& verb) {
  const PreparedRun prepared = prepare_run(c, c.specification, verb.panel_progress());
  std::vector<WeatherPhaseSpec> phases;
  for (const Phase& phase : prepared.operation.phases) phases.push_back({phase.name, phase.duration});
  return phases;
}

/// A limit for a phase that is not planned, or a plan without limits, is a slip of a name.
void check_phase_names(const WeatherTask& task) {
  for (const PhaseLimit& limit : task.limits.limits.phases) {
    const auto same = [&](const PlannedPhase& phase) { return phase.name == limit.phase; };
    if (!limit.phase.empty() && std::none_of(task.phases.begin(), task.phases.end(), same))
      throw UsageError(
          fmt::format("{}: has limits for a phase \"{}\", but the operation has no such phase; name it in "
                      "[[weather.phases]] with its duration",
                      task.limits_source, limit.phase));
  }
}

void WeatherVerb::plan_times(WeatherTask& task, const std::optional<Case>& c, const VerbRun& verb) const {
  std::vector<WeatherPhaseSpec> phases = task.spec.phases;
  const bool needed = !task.spec.forecast.empty() || task.spec.windows.empty();
  const bool by_phase = !task.limits.limits.phases.front().phase.empty();
  if (phases.empty() && c && needed && (!task.spec.operation || by_phase)) phases = phases_of(*c, verb);
  const std::vector<PlannedPhase> planned = one_after_another(phases);
  const double sum = planned.empty() ? 0.0 : planned.back().end_h;
  task.planned_h = task.spec.operation ? *task.spec.operation / kHour : sum;
  if (by_phase && !planned.empty()) {
    task.phases = planned;
    // Limits of some phases only: the others may be done in any sea that the limits cover, unless the whole operation
    // has one.
    std::erase_if(task.phases, [&](const PlannedPhase& phase) {
      return std::none_of(task.limits.limits.phases.begin(), task.limits.limits.phases.end(),
                          [&](const PhaseLimit& limit) { return limit.phase == phase.name || limit.phase.empty(); });
    });
    for (const PlannedPhase& phase : planned)
      if (std::none_of(task.phases.begin(), task.phases.end(),
                       [&](const PlannedPhase& p) { return p.name == phase.name; }))
        task.remarks.push_back("phase " + phase.name + " has no limits and is not judged");
    check_phase_names(task);
    if (task.planned_h > sum * (1.0 + 1e-9)) {
      task.phases.back().end_h = task.planned_h;
      task.remarks.push_back(fmt::format("the phases take {:g} h, the operation {:g} h: phase {} counts until its end",
                                         sum, task.planned_h, task.phases.back().name));
    }
  } else if (by_phase && !task.spec.forecast.empty()) {
    task.warnings.emplace_back(
        "the limits are by phase, but how long the phases take is not said: all of them are asked for "
        "during the whole operation; give [[weather.phases]] or --case");
  }
}

void print_study(const WeatherStudy& study, const std::vector<std::string>& files, const RunFolder& folder) {
  fmt::print("{}\n", verdict_of(study));
  if (study.forecast) fmt::print("\n{}", table_text(decision_table(*study.forecast)));
  if (study.hindcast)
    fmt::print("\n{}\n{}\n{}", table_text(months_table(*study.hindcast)), table_text(windows_table(*study.hindcast)),
               table_text(states_table(*study.hindcast)));
  if (study.scatter) fmt::print("\n{}", table_text(scatter_summary_table(*study.scatter)));
  for (const std::string& remark : study.remarks)
    fmt::print("{}{}\n", remark == study.remarks.front() ? "\n" : "", remark);
  std::string list;
  for (const std::string& file : files) list += (list.empty() ? "" : ", ") + file;
  fmt::print("\n{}: {}\nReport: {}\n", folder.path(), list, folder.report());
}

int WeatherVerb::run(const CommonOptions& options) {
  VerbRun verb(name(), options);
  std::optional<Case> c;
  WeatherTask task = task_of(options, c);
  plan_times(task, c, verb);
  const WeatherStudy study = study_weather(task);
  const RunFolder& folder = verb.open_named(task.name);
  std::vector<std::string> files;
  const auto write = [&](const std::string& file, const std::string& text) {
    verb.write(folder.path() + "/" + file, text);
    files.push_back(file);
  };
  if (study.hindcast) {
    write("weather.csv", samples_csv(*study.hindcast));
    write("weather_months.csv", months_csv(*study.hindcast));
    write_or_refuse(
        [&] { write_weather_netcdf(*study.hindcast, "Weather for " + task.title, folder.path() + "/weather.nc"); });
    files.emplace_back("weather.nc");
  }
  if (study.forecast) write("forecast.csv", forecast_csv(*study.forecast));
  DocumentControl control;
  if (c) control = {c->project, c->revision, c->author, c->checked_by, "", ""};
  control.date = verb.date();
  verb.write(folder.report(), weather_report(study, files, control));
  files.emplace_back("report.html");
  verb.conclude(weather_summary(study, files, verb.date()));
  for (const std::string& warning : study.warnings) spdlog::warn("{}", warning);
  if (verb.prints()) print_study(study, files, folder);
  return study.forecast && !study.forecast->decision.first_start ? kLimitViolated : kDone;
}

}  // namespace

std::unique_ptr<Verb> weather_verb() { return std::make_unique<WeatherVerb>(); }

}  // namespace stillhook
