#include "sim/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/multibody/hht.h"
#include "sim/number_text.h"
#include "sim/operation_clock.h"
#include "sim/recorder.h"
#include "sim/specification.h"
#include "sim/tangent_pass.h"

namespace stillhook {
namespace {

constexpr int kHalvings = 8;              // of a step that does not converge
constexpr double kProgressEvery = 5.0;    // s, simulated
constexpr const char* kWholeRun = "run";  // the phase of a run without an operation
constexpr double kMostSamples = 1e15;     // that a forecast says: no disk holds them, and they are still a number
constexpr double kLost = 1e5;             // m from the origin: no longer a lift

// One run; its parts share the state.
class Run {
 public:
  Run(const Model& model, const Operation& operation, const RunOptions& options, Trajectory& out)
      : model_(model),
        options_(options),
        out_(out),
        state_(options.from ? *options.from : model.initial_state()),
        stepper_(model.system(), hht_options(model.specification().solver)),
        board_(model),
        recorder_(model, board_, options.record, out, options.sink),
        operation_(operation),
        clock_(operation),
        drives_(model.specification().drives.size()) {}

  HhtStepper& stepper() { return stepper_; }
  void carry(TangentPass& tangents) { tangents_ = &tangents; }
  const SystemState& state() const { return state_; }

  void go() {
    const SolverSpec& solver = model_.specification().solver;
    const double h = solver.time_step, begin = state_.t;
    const long every = std::max(1L, std::lround(solver.output_interval / h));
    if (options_.sink) options_.sink->open(out_, forecast(every * h));
    stepper_.start(state_);
    if (tangents_) tangents_->start(state_);
    advance_clock(begin);
    if (clock_.phase() < 0) recorder_.open_phase(kWholeRun, PhaseSpec::Stage::hanging, begin, false);
    note(h, true);
    double next_progress = begin + kProgressEvery;
    for (long k = 1;; ++k) {
      const double t = begin + k * h;
      // After its operation a run goes on to the next sample, so that the last phase can end between two.
      const bool sampled = !options_.record || (k - 1) % every == 0;
      if (limit_reached(t - h) || (operation_over(t - h) && sampled)) break;
      clock_.foresee(t);
      if (tangents_) tangents_->follow(clock_);
      if (!advance(t, h)) {
        out_.status = RunStatus::diverged;
        break;
      }
      advance_clock(t);
      state_.phase = phase();
      note(h, k % every == 0);
      if (t < next_progress || !options_.progress) continue;
      next_progress += kProgressEvery;
      if (!options_.progress(t, end_expected(t))) {
        out_.status = RunStatus::interrupted;
        out_.message = "interrupted at " + number_text(t) + " s";
        break;
      }
    }
    if (out_.status == RunStatus::not_run) out_.status = RunStatus::completed;
    recorder_.close(operation_over(state_.t) ? clock_.phase_end() : state_.t);
    out_.residuals = stepper_.residuals();
    out_.factorisations = stepper_.factorisations();
  }

 private:
  static HhtOptions hht_options(const SolverSpec& solver) {
    HhtOptions options;
    options.alpha = solver.hht_alpha;
    options.tolerance = solver.newton_tolerance;
    return options;
  }

  int phase() const { return std::max(0, clock_.phase()); }

  SampleForecast forecast(double interval) const {
    SampleForecast f;
    f.begin = state_.t;
    f.interval = interval;
    f.expected = 1 + static_cast<std::size_t>(std::clamp((planned_end() - f.begin) / interval, 0.0, kMostSamples));
    for (const Phase& p : operation_.phases) f.phases.push_back({p.name, p.stage});
    if (f.phases.empty()) f.phases.push_back({kWholeRun, PhaseSpec::Stage::hanging});
    return f;
  }

  double planned_end() const {
    const double limit = time_limit();
    if (operation_.phases.empty()) return limit;
    return limit > 0.0 ? std::min(limit, operation_.planned_duration()) : operation_.planned_duration();
  }

  void advance_clock(double t) {
    clock_.advance(t, recorder_);
    if (tangents_) tangents_->follow(clock_);
  }

  double time_limit() const {
    return options_.until > 0.0 ? options_.until : model_.specification().solver.max_duration;
  }

  bool limit_reached(double t) const {
    const double limit = time_limit();
    return limit > 0.0 && t >= limit - 1e-9;
  }

  bool operation_over(double t) const { return clock_.phase() >= 0 && clock_.finished(t); }

  double end_expected(double t) const {
    const double limit = time_limit();
    const double end = clock_.phase() >= 0 ? clock_.expected_end(t) : limit;
    return limit > 0.0 ? std::min(limit, end) : end;
  }

  void note(double h, bool sample) {
    board_.measure(state_, stepper_.workspace(), phase(), sample);
    if (!operation_over(state_.t - h))
      recorder_.add(state_.t, h, phase(), sample);
    else if (sample)
      recorder_.keep(state_.t);
    if (tangents_ && !tangents_->note(state_, h, recorder_, clock_, sample)) tangents_ = nullptr;
  }

  // To time t in one step of h, or in halves of it where that does not converge.
  bool advance(double t, double h) {
    double step = h;
    int halvings = 0;
    while (state_.t < t - 1e-9 * h) {
      // A step that ends within rounding of t keeps its length, and with it the kept factorisation.
      if (t - state_.t < step * (1.0 - 1e-9)) step = t - state_.t;
      clock_.drives_at(state_.t + step, drives_);
      ++out_.steps;
      if (tangents_) tangents_->begin_step(state_);
      if (stepper_.step(state_, step, drives_)) {
        if (lost()) return false;
        if (tangents_) tangents_->end_step(state_, step);
        continue;
      }
      if (++halvings > kHalvings) {
        const int body = std::max(0, stepper_.failed_body());
        diverged("Newton's method does not converge (largest correction: body '" + model_.system().bodies[body].name +
                 "')");
        return false;
      }
      step *= 0.5;
    }
    state_.t = t;  // no drift of the clock over half a million additions
    return true;
  }

  bool lost() {
    for (std::size_t i = 0; i < state_.body.size(); ++i) {
      if (state_.body[i].p_WC.allFinite() && state_.body[i].p_WC.cwiseAbs().maxCoeff() < kLost) continue;
      diverged("body '" + model_.system().bodies[i].name + "' has left the scene, more than " +
               std::to_string(std::lround(kLost / 1e3)) + " km from the origin");
      return true;
    }
    return false;
  }

  void diverged(const std::string& what) {
    out_.message = "diverged at t = " + number_text(state_.t) + " s in phase '" + out_.phases.back().name +
                   "': " + what;
  }

  const Model& model_;
  const RunOptions& options_;
  Trajectory& out_;
  SystemState state_;
  HhtStepper stepper_;
  ChannelBoard board_;
  Recorder recorder_;
  const Operation& operation_;
  OperationClock clock_;
  std::vector<DriveState> drives_;
  TangentPass* tangents_ = nullptr;
};

}  // namespace

Trajectory simulate(const Model& model, const Operation& operation, const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Trajectory out;
  out.static_poses = operation.static_poses;
  Run(model, operation, options, out).go();
  out.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

Trajectory simulate_with_tangents(const Model& model, const Operation& operation, const RunOptions& options,
                                  const std::vector<LiftTwin>& twins, const TangentOptions& wanted,
                                  Tangents& tangents) {
  const auto begin = std::chrono::steady_clock::now();
  Trajectory out;
  out.static_poses = operation.static_poses;
  Run run(model, operation, options, out);
  TangentPass pass(model, run.stepper(), twins, wanted, out, tangents, options.from != nullptr);
  run.carry(pass);
  run.go();
  pass.close(run.state(), out.status == RunStatus::completed);
  out.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace stillhook
