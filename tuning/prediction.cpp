#include "tuning/prediction.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "problems/case_key.h"
#include "problems/field_table.h"
#include "sim/recorder.h"

namespace stillhook {
namespace {

using Kind = FitRecordSpec::Kind;

std::string entry_of(const FitRecordSpec& spec) { return "[fit.records." + spec.name + "]"; }

/// Coordinates named in `free`, or those that the record's channels show, with their rates.
std::vector<int> free_coordinates(const FitRecordSpec& spec) {
  const std::vector<std::string>& names = start_coordinate_names();
  std::vector<int> free;
  const auto add = [&free](int k) {
    if (std::find(free.begin(), free.end(), k) == free.end()) free.push_back(k);
  };
  if (spec.free.empty()) {
    for (const FitColumnSpec& column : spec.columns)
      for (int k = 0; k < kStartCoordinates; ++k)
        if (column.channel == spec.free_body + "." + names[static_cast<std::size_t>(k)]) {
          add(k % 6);
          add(k % 6 + 6);
        }
    if (free.empty())
      throw CaseError(entry_of(spec) + " free: no measured channel shows how " + spec.free_body +
                      " moves; name what is estimated, e.g. free = \"roll, wx\"");
  } else {
    std::istringstream words(spec.free);
    for (std::string word; std::getline(words, word, ',');) {
      word.erase(0, word.find_first_not_of(' '));
      word.erase(word.find_last_not_of(' ') + 1);
      const auto at = std::find(names.begin(), names.end(), word);
      if (at == names.end())
        throw CaseError(fmt::format("{} free: there is no coordinate \"{}\"{}", entry_of(spec), word,
                                    did_you_mean(word, names)));
      add(static_cast<int>(at - names.begin()));
    }
  }
  std::sort(free.begin(), free.end());
  return free;
}

/// False for keys of a sea state that is not the record's.
bool matters(const std::string& key, const std::string& sea) {
  const std::vector<std::string> steps = steps_of(key);
  return steps.size() < 3 || steps[0] != "sea" || steps[1] != "states" || steps[2] == "*" || steps[2] == sea;
}

Model built(const Case& c) {
  try {
    return build_model(c.specification);
  } catch (const SpecificationError& error) {
    throw located(c, error);
  }
}

DisplacedStart::Coordinates coordinates_of(const RecordModel& model, const VectorX& own) {
  DisplacedStart::Coordinates q = DisplacedStart::Coordinates::Zero();
  for (std::size_t i = 0; i < model.free.size(); ++i) q[model.free[i]] = own[static_cast<Eigen::Index>(i)];
  return q;
}

/// Centre of gravity of a body with a key moved to either side; the case's own for keys that do not move it.
std::array<Vector3, 2> cogs_of(const Case& c, const std::string& key, double width, std::size_t body) {
  const Vector3& now = c.specification.bodies[body].cog;
  if (key.find("cog_m") == std::string::npos) return {now, now};
  const double x = key_value(c, key);
  return {with_values(c, {{key, x - 0.5 * width}}).specification.bodies[body].cog,
          with_values(c, {{key, x + 0.5 * width}}).specification.bodies[body].cog};
}

/// How the reference state changes with the keys: a column each, from the static poses on either side.
MatrixX reference_tangent(const RecordModel& model, const Case& c, const SystemState& reference, const TangentRun& run) {
  MatrixX D = MatrixX::Zero(change_size(reference), static_cast<Eigen::Index>(model.keys.size()));
  for (std::size_t j = 0; j < model.keys.size(); ++j) {
    const double width = run.widths[j];
    const std::vector<Pose>&low = run.static_poses[j][0].front().bodies, &high = run.static_poses[j][1].front().bodies;
    for (std::size_t i = 0; i < low.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(j), row = static_cast<Eigen::Index>(6 * i);
      const std::array<Vector3, 2> cog = cogs_of(c, model.keys[j], width, i);
      D.block<3, 1>(row, column) = (high[i] * cog[1] - low[i] * cog[0]) / width;
      D.block<3, 1>(row + 3, column) = log_rotation(low[i].R.transpose() * high[i].R) / width;
    }
  }
  return D;
}

}  // namespace

std::string RecordModel::own_name(int i) const {
  if (i < static_cast<int>(free.size()))
    return start_coordinate_names()[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] + " of " +
           base.specification.bodies[static_cast<std::size_t>(body)].name + " at the start";
  const auto k = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) - free.size()]);
  return "zero of " + data.channels[k].spec.channel;
}

std::string RecordModel::own_unit(int i) const {
  if (i < static_cast<int>(free.size())) return start_coordinate_unit(free[static_cast<std::size_t>(i)]);
  return data.channels[static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) - free.size()])].unit;
}

Case case_at(const RecordModel& model, const VectorX& values) {
  std::vector<std::pair<std::string, double>> changes;
  for (std::size_t i = 0; i < model.keys.size(); ++i)
    changes.emplace_back(model.keys[i], values[static_cast<Eigen::Index>(i)]);
  return with_values(model.base, changes);
}

RecordStart record_start(const RecordModel& model, const Case& at, const VectorX& own) {
  RecordStart start;
  if (model.body < 0) return start;
  start.model = std::make_shared<const Model>(built(at));
  start.q = coordinates_of(model, own);
  start.from = DisplacedStart(start.model->system(), model.body).state(start.model->initial_state(), start.q);
  return start;
}

MatrixX start_tangent(const RecordModel& model, const Case& at, const RecordStart& start, const TangentRun& run) {
  const SystemState& rest = start.model->initial_state();
  const DisplacedStart displaced(start.model->system(), model.body);
  const auto keys = static_cast<Eigen::Index>(model.keys.size());
  MatrixX by = MatrixX::Zero(change_size(rest), keys + static_cast<Eigen::Index>(model.free.size()));
  by.leftCols(keys) = displaced.carried(rest, start.q, reference_tangent(model, at, rest, run));
  const MatrixX by_q = displaced.by_coordinates(rest, start.q);
  for (std::size_t i = 0; i < model.free.size(); ++i) by.col(keys + static_cast<Eigen::Index>(i)) = by_q.col(model.free[i]);
  return by;
}

TangentRun tangent_run(const Case& at, const TangentRequest& request, const RunOptions& options) {
  try {
    return run_with_tangents(at, request, options);
  } catch (const SpecificationError& error) {
    throw located(at, error);
  }
}

Case record_case(const Case& c, const FitRecordSpec& spec) {
  std::vector<Override> overrides = c.overrides;
  for (const FitSettingSpec& setting : spec.settings) overrides.push_back({setting.key, setting.value});
  const bool calm = spec.kind == Kind::decay || spec.kind == Kind::constant;
  const std::string sea = !spec.sea.empty() ? spec.sea : calm ? "calm" : c.specification.sea.active;
  overrides.push_back({"sea.active", "\"" + sea + "\""});
  return read_case_text(c.text, c.file, c.directory, overrides);
}

RecordModel record_model(const Case& c, const FitRecordSpec& spec) {
  RecordModel m;
  m.base = record_case(c, spec);
  const Model model = built(m.base);
  const SolverSpec& solver = m.base.specification.solver;
  const ChannelBoard board(model);
  m.data = read_record(spec, board.channels(), solver.output_interval);
  const double step = solver.time_step;
  const double until = spec.kind == Kind::constant ? 2.0 * step : m.data.end() + 4.0 * step;
  // Half the samples' interval keeps the error of cubic interpolation out of sight.
  const double output =
      spec.kind == Kind::constant ? step : step * std::max(1.0, std::floor(0.5 * m.data.interval / step + 1e-9));
  m.base = with_values(m.base, {{"solver.max_duration_s", until}, {"solver.output_interval_s", output}});
  for (std::size_t i = 0; i < c.fit.parameters.size(); ++i) {
    if (!matters(c.fit.parameters[i].key, m.base.specification.sea.active)) continue;
    m.keys.push_back(c.fit.parameters[i].key);
    m.ranges.push_back(c.fit.parameters[i].upper - c.fit.parameters[i].lower);
    m.parameters.push_back(static_cast<int>(i));
  }
  if (!spec.free_body.empty()) {
    m.body = model.body_index(spec.free_body);
    m.free = free_coordinates(spec);
  }
  for (std::size_t k = 0; k < m.data.channels.size(); ++k)
    if (m.data.channels[k].spec.estimate_offset) m.offsets.push_back(static_cast<int>(k));
  return m;
}

Prediction predict(const RecordModel& model, const VectorX& values, const VectorX& own, bool derivatives,
                   const RunOptions& options) {
  const Case c = case_at(model, values);
  TangentRequest request;
  if (derivatives) request.keys = model.keys;
  for (const MeasuredChannel& channel : model.data.channels) request.channels.push_back(channel.spec.channel);
  const auto keys = static_cast<Eigen::Index>(model.keys.size());
  if (derivatives) request.ranges = model.ranges;
  const RecordStart start = record_start(model, c, own);
  request.from = start.from;
  if (derivatives && start.from)
    request.start_change = [&](const TangentRun& twins) { return start_tangent(model, c, start, twins); };
  const TangentRun run = tangent_run(c, request, options);
  Prediction p;
  p.message = run.trajectory.message;
  const Interpolation at(run.trajectory.time, model.data.time);
  if (run.trajectory.status == RunStatus::completed && !at.complete())
    throw CaseError(fmt::format("[fit.records.{}]: the record lasts until {:.6g} s, the case ends at {:.6g} s",
                                model.data.name, model.data.end(),
                                run.trajectory.time.empty() ? 0.0 : run.trajectory.time.back()));
  if (run.trajectory.status != RunStatus::completed || (derivatives && !run.tangents.valid)) {
    if (p.message.empty()) p.message = "the derivatives grew beyond use";
    return p;
  }
  p.ok = true;
  for (std::size_t k = 0; k < model.data.channels.size(); ++k) {
    const auto channel = static_cast<std::size_t>(run.trajectory.find(request.channels[k]));
    const std::vector<double>& series = run.trajectory.values[channel];
    p.value.push_back(at(Eigen::Map<const VectorX>(series.data(), static_cast<Eigen::Index>(series.size()))));
    const auto offset = std::find(model.offsets.begin(), model.offsets.end(), static_cast<int>(k));
    const Eigen::Index place = static_cast<Eigen::Index>(model.free.size()) + (offset - model.offsets.begin());
    if (offset != model.offsets.end()) p.value.back().array() += own[place];
    if (!derivatives) continue;
    const MatrixX simulated = at(run.tangents.values[k]);
    MatrixX& tangent = p.tangent.emplace_back(MatrixX::Zero(simulated.rows(), keys + model.own()));
    tangent.leftCols(simulated.cols()) = simulated;
    if (offset != model.offsets.end()) tangent.col(keys + place).setOnes();
  }
  return p;
}

VectorX own_start(const RecordModel& model, const VectorX& values) {
  VectorX own = VectorX::Zero(model.own());
  if (model.free.empty()) return own;
  const Case c = case_at(model, values);
  const Model built_model = built(c);
  const std::map<std::string, double> reference = channel_values(built_model, built_model.initial_state());
  const std::string& body = c.specification.bodies[static_cast<std::size_t>(model.body)].name;
  const std::vector<std::string>& names = start_coordinate_names();
  for (const MeasuredChannel& channel : model.data.channels)
    for (int k = 0; k < kStartCoordinates; ++k) {
      const std::string name = body + "." + names[static_cast<std::size_t>(k)];
      const auto at = std::find(model.free.begin(), model.free.end(), k);
      if (name != channel.spec.channel || at == model.free.end() || channel.value.size() < 3) continue;
      // Level and slope of the first samples that are there.
      std::vector<double> t, x;
      for (std::size_t i = 0; i < channel.value.size() && t.size() < 5; ++i)
        if (!std::isnan(channel.value[i])) t.push_back(model.data.time[i]), x.push_back(channel.value[i]);
      const double slope = (x.back() - x.front()) / (t.back() - t.front());
      own[at - model.free.begin()] = x.front() - slope * t.front() - reference.at(name);
      const auto rate = std::find(model.free.begin(), model.free.end(), k + 6);
      if (k < 6 && rate != model.free.end() && own[rate - model.free.begin()] == 0.0)
        own[rate - model.free.begin()] = slope;
    }
  return own;
}

Interpolation::Interpolation(const std::vector<double>& simulated, const std::vector<double>& wanted) {
  const std::size_t n = simulated.size();
  for (const double t : wanted) {
    if (n < 4 || t > simulated.back() + 1e-6) {
      // A static pull is one sample at the start.
      if (n > 0 && std::abs(t - simulated.front()) < 1e-9) {
        at_.push_back({0, {1.0, 0.0, 0.0, 0.0}});
        continue;
      }
      complete_ = false;
      return;
    }
    const auto above = std::upper_bound(simulated.begin(), simulated.end(), t) - simulated.begin();
    const auto first = std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(n) - 4);
    Weights weights{first, {1.0, 1.0, 1.0, 1.0}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (j != i)
          weights.w[static_cast<std::size_t>(i)] *=
              (t - simulated[static_cast<std::size_t>(first + j)]) /
              (simulated[static_cast<std::size_t>(first + i)] - simulated[static_cast<std::size_t>(first + j)]);
    at_.push_back(weights);
  }
}

MatrixX Interpolation::operator()(const Eigen::Ref<const MatrixX>& samples) const {
  MatrixX out = MatrixX::Zero(static_cast<Eigen::Index>(at_.size()), samples.cols());
  for (std::size_t i = 0; i < at_.size(); ++i)
    for (int k = 0; k < 4; ++k)
      if (at_[i].w[static_cast<std::size_t>(k)] != 0.0)
        out.row(static_cast<Eigen::Index>(i)) +=
            at_[i].w[static_cast<std::size_t>(k)] * samples.row(at_[i].first + k);
  return out;
}

}  // namespace stillhook
