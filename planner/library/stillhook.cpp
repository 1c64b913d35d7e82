#include "planner/library/stillhook.h"

#include <algorithm>
#include <limits>

#include "planner/run.h"
#include "planner/version.h"
#include "results/summary.h"

namespace stillhook {

struct Lift::Data {
  std::string text, name, directory;
  std::string path;  // empty: from text
  std::vector<Override> overrides;
  Case read;

  void read_again() { read = path.empty() ? read_case_text(text, name, directory, overrides) : read_case(path, overrides); }
};

struct LiftRun::Data {
  RunResult run;
  std::string summary;

  int channel(const std::string& name) const {
    const int found = run.trajectory.find(name);
    if (found < 0) throw Error("the run has no channel \"" + name + "\"");
    return found;
  }
};

Lift Lift::read(const std::string& path) {
  auto data = std::make_shared<Data>();
  data->path = path;
  data->read_again();
  Lift lift;
  lift.data_ = std::move(data);
  return lift;
}

Lift Lift::parse(const std::string& text, const std::string& name, const std::string& directory) {
  auto data = std::make_shared<Data>();
  data->text = text;
  data->name = name;
  data->directory = directory;
  data->read_again();
  Lift lift;
  lift.data_ = std::move(data);
  return lift;
}

void Lift::set(const std::string& key, const std::string& value) {
  auto changed = std::make_shared<Data>(*data_);
  changed->overrides.push_back({key, value});
  changed->read_again();
  data_ = std::move(changed);
}

double Lift::value(const std::string& key) const { return key_value(data_->read, key); }

void Lift::add(OwnElement element) { own_.push_back(std::move(element)); }

LiftRun Lift::simulate(const std::function<bool(double t, double t_end)>& progress) const {
  const Case& c = data_->read;
  Specification specification = c.specification;
  specification.own_elements.insert(specification.own_elements.end(), own_.begin(), own_.end());
  const PreparedRun prepared = prepare_run(c, specification);
  auto data = std::make_shared<LiftRun::Data>();
  RunOptions options;
  options.progress = progress;
  data->run = judged(prepared.model.specification(), stillhook::simulate(prepared.model, prepared.operation, options),
                     c.limits);
  data->run.warnings = prepared.warnings;
  data->summary = summary_json(summary_of(data->run, c, "simulate"));
  LiftRun run;
  run.data_ = std::move(data);
  return run;
}

bool LiftRun::passed() const { return data_->run.passed(); }
std::string LiftRun::status() const { return status_name(data_->run.metrics.status); }
std::string LiftRun::message() const { return data_->run.metrics.message; }
std::vector<std::string> LiftRun::warnings() const { return data_->run.warnings; }
const std::vector<double>& LiftRun::time() const { return data_->run.trajectory.time; }
std::string LiftRun::summary() const { return data_->summary; }

std::vector<std::string> LiftRun::channels() const {
  std::vector<std::string> names;
  for (const Channel& channel : data_->run.trajectory.channels) names.push_back(channel.name);
  return names;
}

std::string LiftRun::unit(const std::string& channel) const {
  return data_->run.trajectory.channels[data_->channel(channel)].unit;
}

std::vector<double> LiftRun::series(const std::string& channel) const {
  return data_->run.trajectory.values[data_->channel(channel)];
}

double LiftRun::metric(const std::string& name) const { return data_->run.metrics.value(name); }

std::map<std::string, double> LiftRun::metrics() const {
  std::map<std::string, double> values;
  for (const Metric& metric : data_->run.metrics.items) values[metric.name] = metric.value;
  return values;
}

std::vector<LiftLimit> LiftRun::limits() const {
  std::vector<LiftLimit> limits;
  for (const LimitCheck& check : data_->run.limits)
    limits.push_back({check.metric, check.unit, check.value, check.limit, check.pass, check.hard});
  return limits;
}

std::string library_version() { return kVersion; }

}  // namespace stillhook
