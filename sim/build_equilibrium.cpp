// The static equilibrium that a model starts from, with the wire lengths that hold it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/crane_parts.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/mesh/mesh.h"
#include "sim/lifting/wire.h"
#include "sim/model_builder.h"
#include "sim/multibody/relaxation.h"
#include "sim/number_text.h"
#include "sim/start_pose.h"
#include "sim/static_goals.h"

namespace stillhook {
namespace {

constexpr double kBeforeTheSea = -1.0;  // s
constexpr double kAngleHeld = 1e-10;   // rad
constexpr double kLengthProbe = 1e-3;  // m
constexpr int kHoldRounds = 20;
constexpr double kOutOfTheWay = 5.0;  // m that a wire is too long by to take part in the search for the start

}  // namespace

// The pose of the other lift, if that is an equilibrium of this one and gives its wires the same lengths. Else the
// search begins there, with friction holding from the given pose as ever.
void ModelBuilder::begin_at_other() {
  SystemWorkspace work = system().make_workspace();
  system().start_elements(state(), work);
  const SystemState given = state();
  const std::vector<double> lengths = model_.initial_lengths_;
  const SystemState& there = other_->laid_out_;
  state() = there;
  model_.initial_lengths_ = other_->initial_lengths();
  rebuild_wires();
  taken_over_ = true;
  for (std::size_t i = 0; i < spec().wires.size() && taken_over_; ++i) {
    const WireSpec& w = spec().wires[i];
    if (!w.hold_joint.empty()) continue;  // the joint stands where the other's does
    const bool by_pose = by_slack(i) && lengths[i] != model_.initial_lengths_[i];
    const double length = by_pose ? end_distance(w, site_) + w.slack : lengths[i];
    taken_over_ = length == model_.initial_lengths_[i] && !(by_pose && w.slack < 0.0);
  }
  taken_over_ = taken_over_ && same_statics(system(), other_->system(), there);
  if (taken_over_) return;
  state() = given;
  state().body = there.body;
  state().lambda = there.lambda;
  for (std::size_t i = 0; i < spec().wires.size(); ++i)
    if (spec().wires[i].unstretched_length > 0.0) model_.initial_lengths_[i] = lengths[i];
  find_equilibrium();
}

EquilibriumReport ModelBuilder::try_to_settle() {
  state().t = kBeforeTheSea;
  const EquilibriumReport report = settle_stably(system(), state(), other_ != nullptr);
  state().t = 0.0;
  return report;
}

void ModelBuilder::settle() {
  const EquilibriumReport report = try_to_settle();
  if (report.converged) return;
  refuse_what_cannot_float();
  refuse_without_equilibrium(system(), state(), report, "bodies." + report.worst_body);
}

// The usual reason for having no equilibrium deserves its own sentence: more weight than the hulls can carry.
void ModelBuilder::refuse_what_cannot_float() const {
  double weight = 0.0, volume = 0.0;
  std::string hull;
  for (const BodySpec& b : spec().bodies) {
    if (b.moved_by_sea()) return;  // it carries whatever hangs on it
    weight += b.mass;
    if (!b.floats()) continue;
    volume += properties_of(build_hull_mesh(b.hull)).volume;
    if (hull.empty()) hull = b.name;
  }
  if (hull.empty() || weight <= spec().sea.density * volume) return;
  throw SpecificationError("bodies." + hull, "mass",
                           "does not float: the bodies weigh " + number_text(weight / 1000.0) +
                               " t, all hulls together carry at most " +
                               number_text(spec().sea.density * volume / 1000.0) + " t");
}

// Mooring lines, or a load that stands, can hold a vessel that went down: in balance, and no vessel any more.
void ModelBuilder::refuse_sunken_vessels() const {
  for (const std::string& name : crane_vessels(spec())) {
    const auto body =
        std::find_if(spec().bodies.begin(), spec().bodies.end(), [&](const BodySpec& b) { return b.name == name; });
    if (body == spec().bodies.end() || !body->floats()) continue;
    const BodyKinematics& k = state().body[static_cast<std::size_t>(body - spec().bodies.begin())];
    const MeshProperties box = properties_of(build_hull_mesh(body->hull));
    double top = -std::numeric_limits<double>::infinity();
    for (const double x : {box.low.x(), box.high.x()})
      for (const double y : {box.low.y(), box.high.y()})
        for (const double z : {box.low.z(), box.high.z()})
          top = std::max(top, (k.p_WC + k.R_WB * (Vector3(x, y, z) - body->cog)).z());
    if (top >= 0.0) continue;
    refuse_what_cannot_float();
    throw SpecificationError("bodies." + name, "mass",
                             "does not float: it comes to rest with its hull wholly under water, at least " +
                                 number_text(-top) +
                                 " m deep; make it lighter, its hull larger, or what it "
                                 "carries and what pulls it down less");
  }
}

// Newton's method on the lengths of the wires that hold a joint at its initial coordinate, with the wires of given
// slack out of the way; those get their lengths from the pose that comes out, at which they leave it alone. Wires
// that something falls without are left in: their lengths are those of the given pose.
void ModelBuilder::find_equilibrium() {
  std::vector<std::size_t> holding;
  std::vector<const Joint*> held;
  for (std::size_t i = 0; i < spec().wires.size(); ++i) {
    if (spec().wires[i].hold_joint.empty()) continue;
    holding.push_back(i);
    held.push_back(&joint_named(spec().wires[i]));
  }
  std::vector<std::size_t> loose;
  for (std::size_t i = 0; i < spec().wires.size(); ++i)
    if (by_slack(i) && !(other_ && other_->initial_lengths()[i] == given_lengths_[i])) loose.push_back(i);
  settle_without(loose);
  hold_joints(holding, held);
  bool taut = false;
  for (const std::size_t i : loose) {
    const WireSpec& w = spec().wires[i];
    model_.initial_lengths_[i] = end_distance(w, site_) + w.slack;
    taut = taut || w.slack < 0.0;
  }
  rebuild_wires();
  if (!taut) return;
  settle();
  hold_joints(holding, held);
}

// Settles with the `loose` wires out of the way, and takes from among them those that turn out to hold something.
void ModelBuilder::settle_without(std::vector<std::size_t>& loose) {
  SystemWorkspace work = system().make_workspace();
  if (state().element_state.empty()) system().start_elements(state(), work);
  const SystemState begin = state();
  for (;;) {
    for (std::size_t i = 0; i < spec().wires.size(); ++i)
      if (by_slack(i)) model_.initial_lengths_[i] = given_lengths_[i];
    for (const std::size_t i : loose) model_.initial_lengths_[i] += kOutOfTheWay;
    rebuild_wires();
    std::vector<std::size_t> hold;
    if (loose.empty())
      settle();
    else
      hold = try_to_settle().converged ? wires_that_hold(spec(), system(), loose, given_, state()) : loose;
    if (hold.empty()) return;
    std::erase_if(loose, [&](std::size_t i) { return std::find(hold.begin(), hold.end(), i) != hold.end(); });
    state() = begin;
  }
}

bool ModelBuilder::by_slack(std::size_t i) const {
  return spec().wires[i].unstretched_length <= 0.0 && spec().wires[i].hold_joint.empty();
}

void ModelBuilder::hold_joints(const std::vector<std::size_t>& wires, const std::vector<const Joint*>& joints) {
  const int n = static_cast<int>(wires.size());
  const auto miss = [&] {
    VectorX c(n);
    for (int i = 0; i < n; ++i) c[i] = joints[i]->coordinate(state().instant());
    return c;
  };
  const auto change_length = [&](int i, double by) {
    model_.initial_lengths_[wires[i]] += by;
    rebuild_wires();
  };
  for (int round = 0; round < kHoldRounds && n > 0; ++round) {
    const VectorX f = miss();
    if (f.cwiseAbs().maxCoeff() < kAngleHeld) return;
    const SystemState here = state();
    MatrixX slope(n, n);
    for (int j = 0; j < n; ++j) {
      change_length(j, kLengthProbe);
      settle();
      slope.col(j) = (miss() - f) / kLengthProbe;
      change_length(j, -kLengthProbe);
      state() = here;
    }
    VectorX step = -slope.fullPivLu().solve(f);
    step *= std::min(1.0, 1.0 / std::max(1e-12, step.cwiseAbs().maxCoeff()));
    for (int j = 0; j < n; ++j) change_length(j, step[j]);
    settle();
  }
  if (n > 0)
    throw SpecificationError("wires." + spec().wires[wires[0]].name, "hold_joint",
                             "no unstretched lengths found that hold the joints at their initial angles");
}

const Joint& ModelBuilder::joint_named(const WireSpec& w) {
  for (const Joint& j : system().joints)
    if (j.name == w.hold_joint) return j;
  throw SpecificationError("wires." + w.name, "hold_joint", "there is no joint '" + w.hold_joint + "'");
}

void ModelBuilder::refuse_slack_supports() {
  for (std::size_t i = 0; i < spec().wires.size(); ++i) {
    const WireSpec& w = spec().wires[i];
    // A sling may be: of four on a stiff load one often is, and over a load that stands all are.
    const bool supports = w.role == WireSpec::Role::luffing || w.role == WireSpec::Role::stay;
    const auto& element = static_cast<const Wire&>(*system().elements[first_wire_ + i]);
    if (supports && element.tension(state().instant()) <= 0.0)
      throw SpecificationError("wires." + w.name, "",
                               "is slack in the initial equilibrium, but it has to hold its body");
  }
}

}  // namespace stillhook
