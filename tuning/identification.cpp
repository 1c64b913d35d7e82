#include "tuning/identification.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <memory>

#include "tuning/estimates.h"
#include "tuning/meeting_keys.h"
#include "tuning/segments.h"
#include "tuning/size_check.h"

namespace stillhook {
namespace {

constexpr double kSharedNoise = 0.03;    // of a channel's spread: first guess of what the model cannot explain
constexpr double kLeastNoise = 1e-6;     // of a channel's spread
constexpr int kWeightRounds = 3;
constexpr double kWeightChange = 0.1;    // relative change of a weight that is worth another round
constexpr double kTies[] = {2.0, 20.0, 200.0};  // continuity, drawn tight

double robust_spread(std::vector<double> r) {
  if (r.empty()) return 0.0;
  for (double& v : r) v = std::abs(v);
  const auto middle = r.begin() + static_cast<std::ptrdiff_t>(r.size() / 2);
  std::nth_element(r.begin(), middle, r.end());
  return 1.4826 * *middle;  // of a normal
}

/// Standard deviation of what changes from sample to sample: second differences take a smooth motion out.
double scatter_of(const std::vector<double>& values) {
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const double d = values[i + 1] - 2.0 * values[i] + values[i - 1];
    if (!std::isnan(d)) second.push_back(d / std::sqrt(6.0));
  }
  return robust_spread(std::move(second));
}

class Identifier {
 public:
  Identifier(const Case& c, const IdentificationOptions& options) : case_(c), options_(options) {}

  Identification run() {
    const auto begin = std::chrono::steady_clock::now();
    read();
    choose_start();
    if (case_.fit.shooting == FitSpec::Shooting::multiple && !stopped()) shoot_in_segments();
    const FitOutcome outcome = solve_with_weights();
    result_.usable = outcome.usable;
    result_.interrupted = outcome.interrupted || stopped();
    result_.message = outcome.usable ? (outcome.converged ? "converged" : "not converged: " + outcome.message)
                                     : "no solution: " + outcome.message;
    if (!outcome.converged && !result_.interrupted)
      result_.warnings.push_back("The search for the best fit did not come to an end: " + outcome.message);
    if (result_.usable && !result_.interrupted) conclude();
    result_.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  bool stopped() const { return options_.stop && options_.stop->load(); }

  RunOptions run_options() const {
    RunOptions o;
    if (options_.stop) o.progress = [stop = options_.stop](double, double) { return !stop->load(); };
    return o;
  }

  FitOptions fit_options(const std::string& stage) const {
    FitOptions o;
    o.robust = case_.fit.robust;
    o.iterations = case_.fit.iterations;
    o.stop = options_.stop;
    if (options_.progress)
      o.progress = [this, stage](const FitProgress& p) { options_.progress(stage, p.iteration, p.cost); };
    return o;
  }

  void read() {
    if (case_.fit.parameters.empty())
      throw CaseError(case_.file + ": [fit.parameters] is empty: there is nothing to estimate");
    if (case_.fit.records.empty())
      throw CaseError(case_.file + ": [[fit.records]] is empty: there is nothing to fit to");
    parameters_.specs = case_.fit.parameters;
    for (const FitRecordSpec& spec : case_.fit.records) {
      models_.push_back(record_model(case_, spec));
      for (const std::string& note : models_.back().data.notes) result_.notes.push_back(note);
    }
    values_.resize(static_cast<Eigen::Index>(parameters_.specs.size()));
    for (std::size_t i = 0; i < parameters_.specs.size(); ++i) {
      FitEstimate e;
      e.spec = parameters_.specs[i];
      e.unit = key_unit(case_, e.spec.key);
      e.start = key_value(case_, e.spec.key);
      e.started_from = "the case";
      values_[static_cast<Eigen::Index>(i)] = e.start;
      result_.estimates.push_back(e);
    }
  }

  /// Runs `of` for every record, in parallel; the first that throws is heard.
  void for_each_record(const std::function<void(std::size_t)>& of) const {
    std::vector<std::exception_ptr> errors(models_.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t r = 0; r < models_.size(); ++r) {
      try {
        of(r);
      } catch (...) {
        errors[r] = std::current_exception();
      }
    }
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
  }

  /// The case's own values show whether the record is in the units it says, and what its beginning looks like. Returns
  /// the start values that its decays give.
  std::map<std::string, double> first_look(const RecordModel& model, VectorX& own) const {
    const VectorX values = parameters_.of(model, values_);
    Prediction simulated = predict(model, values, VectorX::Zero(model.own()), false, run_options());
    own = own_start(model, values);
    bool moves = simulated.ok;
    for (std::size_t k = 0; k < model.data.channels.size() && moves; ++k) {
      const VectorX& z = simulated.value[k];
      moves = spread_of({z.data(), z.data() + z.size()}) > 1e-4 * spread_of(model.data.channels[k].value);
    }
    if (model.body >= 0 && moves) refuse_other_units(model, simulated);
    if (model.body >= 0) simulated = predict(model, values, own, false, run_options());
    if (!moves || model.body < 0) refuse_other_units(model, simulated);
    return start_from_decay(model, compare_decays(model, simulated));
  }

  void choose_start() {
    own_.resize(models_.size());
    std::vector<std::map<std::string, double>> starts(models_.size());
    for_each_record([&](std::size_t r) { starts[r] = first_look(models_[r], own_[r]); });
    std::map<std::string, std::pair<double, std::string>> from_decays;
    for (std::size_t r = 0; r < models_.size(); ++r)
      for (const auto& [key, value] : starts[r]) from_decays.emplace(key, std::pair{value, models_[r].data.name});
    for (std::size_t i = 0; i < parameters_.specs.size(); ++i) {
      const FitParameterSpec& spec = parameters_.specs[i];
      FitEstimate& e = result_.estimates[i];
      const auto decay = from_decays.find(spec.key);
      if (spec.start) {
        e.start = *spec.start;
        e.started_from = "the fit's own start";
      } else if (decay != from_decays.end()) {
        e.start = decay->second.first;
        e.started_from = "the p-q line of " + decay->second.second;
      }
      // Well inside the bounds, from where both ways are open.
      const double margin = 1e-3 * (spec.upper - spec.lower);
      e.start = std::clamp(e.start, spec.lower + margin, spec.upper - margin);
      values_[static_cast<Eigen::Index>(i)] = e.start;
    }
    for (const RecordModel& model : models_) {
      std::vector<double> sigma;
      for (const MeasuredChannel& channel : model.data.channels)
        sigma.push_back(std::isnan(channel.noise)
                            ? std::max({1e-12, kSharedNoise * spread_of(channel.value), scatter_of(channel.value)})
                            : channel.noise);
      sigma_.push_back(sigma);
    }
    before_.resize(models_.size());
    for_each_record([&](std::size_t r) {
      before_[r] = predict(models_[r], parameters_.of(models_[r], values_), own_[r], false, run_options());
    });
  }

  /// Blocks: keys, then each record's own.
  FitProblem blocks() const {
    FitProblem problem;
    const Eigen::Index n = values_.size();
    problem.blocks.push_back({parameters_.scaled(values_), VectorX::Zero(n), VectorX::Ones(n), false});
    for (const VectorX& own : own_) problem.blocks.push_back({own, {}, {}, false});
    return problem;
  }

  void take(const FitProblem& problem) {
    values_ = parameters_.values(problem.blocks[0].value);
    for (std::size_t r = 0; r < own_.size(); ++r) own_[r] = problem.blocks[r + 1].value;
  }

  void count(const FitProblem& problem, const FitOutcome& outcome) {
    result_.iterations += outcome.iterations;
    for (const FitUnit& unit : problem.units)
      if (unit.simulates) result_.simulations += outcome.evaluations;
  }

  void shoot_in_segments() {
    std::vector<std::unique_ptr<SegmentedRecord>> records;
    for (std::size_t r = 0; r < models_.size(); ++r) {
      records.push_back(nullptr);
      if (models_[r].data.kind == FitRecordSpec::Kind::constant) continue;
      records.back() = std::make_unique<SegmentedRecord>(models_[r], case_.fit.segments);
      records.back()->lay_out(parameters_.of(models_[r], values_), own_[r], run_options());
    }
    for (const double ties : kTies) {
      FitProblem problem = blocks();
      std::vector<int> first_block;
      for (std::size_t r = 0; r < models_.size(); ++r) {
        first_block.push_back(static_cast<int>(problem.blocks.size()));
        const int own = static_cast<int>(r) + 1;
        if (records[r])
          records[r]->add_to(problem, parameters_, sigma_[r], own, ties, run_options());
        else
          problem.units.push_back(record_unit(models_[r], parameters_, sigma_[r], own, run_options()));
      }
      problem.units.push_back(prior_unit(parameters_));
      const FitOutcome outcome = solve_fit(problem, fit_options("segments"));
      count(problem, outcome);
      if (!outcome.usable || stopped()) return;
      take(problem);
      for (std::size_t r = 0; r < records.size(); ++r)
        if (records[r]) records[r]->take_from(problem, first_block[r]);
    }
  }

  FitProblem whole_records() const {
    FitProblem problem = blocks();
    for (std::size_t r = 0; r < models_.size(); ++r)
      problem.units.push_back(
          record_unit(models_[r], parameters_, sigma_[r], static_cast<int>(r) + 1, run_options()));
    problem.units.push_back(prior_unit(parameters_));
    return problem;
  }

  FitOutcome solve_with_weights() {
    FitOutcome outcome;
    // Far from the solution most residuals are beyond Huber's threshold, and steps then creep: at first the threshold
    // is that of residuals as they are at the start.
    double loose = std::max(1.0, spread_at_start());
    for (int round = 0; round < kWeightRounds; ++round) {
      FitProblem problem = whole_records();
      FitOptions options = fit_options(round == 0 ? "fit" : "fit, weights from residuals");
      options.robust *= loose;
      if (loose > 1.0) options.tolerance *= 10.0;  // to be gone on from
      outcome = solve_fit(problem, options);
      count(problem, outcome);
      if (!outcome.usable || stopped()) return outcome;
      take(problem);
      solution_ = std::move(outcome.units);
      const bool again = new_weights() || loose > 1.0;
      loose = 1.0;
      if (!again) break;
    }
    return outcome;
  }

  /// Of the weighted residuals at the start values, the channel that is furthest off.
  double spread_at_start() const {
    double worst = 0.0;
    for (std::size_t r = 0; r < models_.size(); ++r)
      for (std::size_t k = 0; before_[r].ok && k < models_[r].data.channels.size(); ++k) {
        const std::vector<double>& y = models_[r].data.channels[k].value;
        std::vector<double> residuals;
        for (std::size_t i = 0; i < y.size(); ++i)
          if (!std::isnan(y[i]))
            residuals.push_back((before_[r].value[k][static_cast<Eigen::Index>(i)] - y[i]) / sigma_[r][k]);
        worst = std::max(worst, robust_spread(std::move(residuals)));
      }
    return worst;
  }

  /// Weights from what the fit leaves, where the case gives no noise. True if that changes them.
  bool new_weights() {
    bool changed = false;
    for (std::size_t r = 0; r < models_.size(); ++r) {
      const SampleIndex index = valid_samples(models_[r].data);
      for (std::size_t k = 0; k < models_[r].data.channels.size(); ++k) {
        const MeasuredChannel& channel = models_[r].data.channels[k];
        if (!std::isnan(channel.noise)) continue;
        std::vector<double> residuals;
        for (std::size_t i = 0; i < index.size(); ++i)
          if (index.channel[i] == static_cast<int>(k))
            residuals.push_back(solution_[r].r[static_cast<Eigen::Index>(i)] * sigma_[r][k]);
        const double now = std::max(robust_spread(std::move(residuals)), kLeastNoise * spread_of(channel.value));
        changed = changed || std::abs(now / sigma_[r][k] - 1.0) > kWeightChange;
        reweigh(solution_[r], index, static_cast<int>(k), sigma_[r][k] / now);
        sigma_[r][k] = now;
      }
    }
    return changed;
  }

  /// A record's residuals and derivatives of one channel, times `factor`.
  static void reweigh(UnitValues& unit, const SampleIndex& index, int channel, double factor) {
    for (std::size_t i = 0; i < index.size(); ++i) {
      if (index.channel[i] != channel) continue;
      const auto row = static_cast<Eigen::Index>(i);
      unit.r[row] *= factor;
      for (MatrixX& J : unit.J) J.row(row) *= factor;
    }
  }

  void conclude() {
    const EstimateInput input{case_, parameters_, models_, values_, own_, sigma_, before_, solution_};
    fill_estimates(input, result_);
    if (case_.fit.cross_validate && models_.size() > 1) cross_validate();
    judge(case_, result_);
  }

  /// Without each record in turn.
  void cross_validate() {
    for (std::size_t left = 0; left < models_.size() && !stopped(); ++left) {
      if (models_[left].data.kind == FitRecordSpec::Kind::constant) continue;
      FitProblem others = whole_records();
      others.units.erase(others.units.begin() + static_cast<std::ptrdiff_t>(left));
      const FitOptions options = fit_options("without " + models_[left].data.name);
      count(others, solve_fit(others, options));
      FitProblem alone = blocks();
      alone.blocks[0] = others.blocks[0];
      alone.blocks[0].constant = true;
      alone.units.push_back(
          record_unit(models_[left], parameters_, sigma_[left], static_cast<int>(left) + 1, run_options()));
      if (models_[left].own() > 0) count(alone, solve_fit(alone, options));
      const std::vector<UnitValues> units = evaluate_units(alone);
      if (stopped()) return;
      LeftOut out;
      out.record = models_[left].data.name;
      const VectorX values = parameters_.values(others.blocks[0].value);
      out.values.assign(values.data(), values.data() + values.size());
      out.ratio = units[0].ok ? units[0].r.norm() / residual_norm(left) : std::numeric_limits<double>::infinity();
      result_.cross.push_back(out);
    }
  }

  /// Of a record with the fit to all, weighted.
  double residual_norm(std::size_t r) const {
    double square = 0.0;
    const RecordFit& fit = result_.records[r];
    for (std::size_t k = 0; k < fit.channels.size(); ++k)
      square += fit.channels[k].samples * std::pow(fit.channels[k].rms_after / sigma_[r][k], 2);
    return std::sqrt(square);
  }

  const Case& case_;
  const IdentificationOptions& options_;
  FitParameters parameters_;
  std::vector<RecordModel> models_;
  VectorX values_;
  std::vector<VectorX> own_;
  std::vector<std::vector<double>> sigma_;
  std::vector<Prediction> before_;
  std::vector<UnitValues> solution_;  // of the records and of what is known beforehand, at the estimates
  Identification result_;
};

}  // namespace

Identification identify(const Case& c, const IdentificationOptions& options) {
  check_fit_within_plan(c);
  return Identifier(c, options).run();
}

Case fitted_case(const Case& c, const Identification& result) {
  std::vector<std::pair<std::string, double>> values;
  for (const FitEstimate& e : result.estimates) values.emplace_back(e.spec.key, e.value);
  return with_values(c, values);
}

}  // namespace stillhook
