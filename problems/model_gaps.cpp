#include "problems/model_gaps.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "problems/shallow_water.h"
#include "sim/crane_parts.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/mesh/mesh.h"
#include "sim/lifting/wire.h"
#include "sim/modes.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// s: lines of a working mooring give periods of one to two minutes; what is slower than this no line holds.
constexpr double kHeld = 200.0;

/// Lowest and highest point of a body's hull in a pose, z in W; of a body without hull its contact points, or else its
/// origin and centre of gravity.
std::pair<double, double> heights(const Specification& s, const BodySpec& body, const Pose& X_WB) {
  std::vector<Vector3> points;
  if (body.hull.shape != HullSpec::Shape::none) {
    const MeshProperties box = properties_of(build_hull_mesh(body.hull));
    for (const double x : {box.low.x(), box.high.x()})
      for (const double y : {box.low.y(), box.high.y()})
        for (const double z : {box.low.z(), box.high.z()}) points.emplace_back(x, y, z);
  } else {
    points = {Vector3::Zero(), body.cog};
    for (const ContactSpec& contact : s.contacts)
      if (contact.body == body.name) points.insert(points.end(), contact.points.begin(), contact.points.end());
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3& p_B : points) {
    const double z = (X_WB * p_B).z();
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return {low, high};
}

void find_splash(const Specification& s, const Operation& operation, std::vector<std::string>& gaps) {
  const auto load =
      std::find_if(s.bodies.begin(), s.bodies.end(), [&](const BodySpec& b) { return b.name == s.operation.load; });
  if (load == s.bodies.end()) return;
  const std::size_t index = static_cast<std::size_t>(load - s.bodies.begin());
  bool in_air = false, in_water = false;
  std::string phase;
  for (std::size_t p = 0; p < operation.static_poses.size(); ++p) {
    if (index >= operation.static_poses[p].bodies.size()) return;
    const auto [low, high] = heights(s, *load, operation.static_poses[p].bodies[index]);
    const bool was_split = in_air && in_water;
    in_air = in_air || high > 0.0;
    in_water = in_water || low < 0.0;
    if (in_air && in_water && !was_split)
      phase = p == 0 ? "at the start" : "in phase " + operation.static_poses[p].name;
  }
  if (!in_air || !in_water) return;
  gaps.push_back(fmt::format(
      "{} goes through the surface ({}): there is no slamming, no drag on the velocity of the "
      "water, and its added mass and damping do not change with immersion; amplification and "
      "slack in the splash zone come out too favourable{}",
      load->name, phase, load->hull.shape == HullSpec::Shape::none ? ", and without a hull it has no buoyancy" : ""));
}

/// A phase that takes the load through the surface and a good way beyond: the static load of its moments, which goes
/// evenly from that of one end to that of the other, is then not the load's.
void find_long_splash(const Specification& s, const Operation& operation, std::vector<std::string>& gaps) {
  // In heights of the load: a phase of one follows the buoyancy nearly evenly, and a tenth is close enough to the
  // surface.
  constexpr double kBeyond = 1.5, kClose = 0.1;
  const auto load =
      std::find_if(s.bodies.begin(), s.bodies.end(), [&](const BodySpec& b) { return b.name == s.operation.load; });
  if (load == s.bodies.end() || load->hull.shape == HullSpec::Shape::none) return;
  const std::size_t index = static_cast<std::size_t>(load - s.bodies.begin());
  for (std::size_t p = 1; p < operation.static_poses.size(); ++p) {
    if (index >= operation.static_poses[p].bodies.size()) return;
    const auto [low_before, high_before] = heights(s, *load, operation.static_poses[p - 1].bodies[index]);
    const auto [low_after, high_after] = heights(s, *load, operation.static_poses[p].bodies[index]);
    const double height = high_after - low_after;
    const bool through =
        std::min(low_before, low_after) < -kClose * height && std::max(high_before, high_after) > kClose * height;
    if (!through || std::abs(low_after - low_before) <= kBeyond * height) continue;
    gaps.push_back(
        fmt::format("phase {} takes {} through the surface and beyond: its static load is taken to change "
                    "evenly over the phase, so daf and slack_ratio_min are wrong there; end one phase where "
                    "it meets the water and the next where it is under it",
                    operation.static_poses[p].name, load->name));
  }
}

/// A body with a hull that a pose of the operation puts under the sea bed, where nothing holds it up.
void find_under_bed(const Specification& s, const Operation& operation, std::vector<std::string>& gaps) {
  constexpr double kSettled = 0.5;  // m
  if (!(s.sea.depth > 0.0)) return;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    for (const StaticPose& pose : operation.static_poses) {
      if (i >= pose.bodies.size()) return;
      const double under = -s.sea.depth - heights(s, s.bodies[i], pose.bodies[i]).first;
      if (!(under > kSettled)) continue;
      gaps.push_back(fmt::format("{} lies {:.1f} m below the sea bed, {:.1f} m under the still water, {}: nothing but "
                                 "[[contacts]] holds it up there",
                                 s.bodies[i].name, under, s.sea.depth,
                                 pose.name == "start" ? "at the start" : "in phase " + pose.name));
      break;
    }
  }
}

/// A wire whose damping is a share of critical at its first length, and which is paid out to many times that: the
/// dashpot stays what it was, while the critical damping falls with the root of the length.
void find_long_payout(const Model& model, const Operation& operation, std::vector<std::string>& gaps) {
  constexpr double kLonger = 4.0;  // times: twice the share
  const std::vector<WireSpec>& wires = model.specification().wires;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const double first = model.initial_lengths()[i];
    if (!(wires[i].damping_ratio > 0.0) || !(first > 0.0)) continue;
    double longest = first;
    for (const StaticPose& pose : operation.static_poses)
      if (const auto length = pose.values.find(wire_channels::unstretched.of(wires[i])); length != pose.values.end())
        longest = std::max(longest, length->second);
    if (longest <= kLonger * first) continue;
    gaps.push_back(fmt::format(
        "wire {} is paid out from {:.4g} m to {:.4g} m: its damping stays that of damping_ratio "
        "{:.3g} at the first length, which is {:.3g} of critical at the last; give "
        "damping_kN_s_per_m for the length that counts",
        wires[i].name, first, longest, wires[i].damping_ratio, wires[i].damping_ratio * std::sqrt(longest / first)));
  }
}

void find_unheld(const Model& model, const Operation& operation, std::vector<std::string>& gaps) {
  const Specification& s = model.specification();
  const std::vector<std::string> vessels = operation_vessels(s);
  if (vessels.empty() || s.wires.empty() || operation.equilibria.empty() || !s.solver.static_start) return;
  const std::vector<Mode> modes = natural_modes(model, operation.equilibria.front());
  for (const std::string& vessel : vessels) {
    const int body = model.body_index(vessel);
    if (s.bodies[static_cast<std::size_t>(body)].moved_by_sea()) continue;
    for (const int axis : {0, 1}) {
      const double period = period_of(modes, body, axis);
      if (!(period > kHeld)) continue;
      const std::string how = std::isfinite(period) ? fmt::format("its period there is {:.0f} s", period)
                                                    : std::string("nothing brings it back");
      gaps.push_back(fmt::format(
          "{} is not held in {}: {}; waves and the moves of the crane carry it off, and what it "
          "sets down lands off the target. Give it [[moorings]] or a [[restoring]] spring that pull that way",
          vessel, axis == 0 ? "x" : "y", how));
    }
  }
}

void find_moved_by_sea(const Specification& s, std::vector<std::string>& gaps) {
  for (const BodySpec& body : s.bodies) {
    if (!body.moved_by_sea()) continue;
    gaps.push_back(
        fmt::format("{} moves by its displacement RAOs alone, about the pose of the case: it does not heel, "
                    "trim or sink under the lift, its lines and contacts do not hold it, it has no drift, and "
                    "the load does not change its motions. Where the load weighs more than a few per cent of "
                    "the vessel, give it a hull",
                    body.name));
  }
}

}  // namespace

std::vector<std::string> model_gaps(const Model& model, const Operation& operation) {
  std::vector<std::string> gaps = shallow_water_gaps(model);
  find_moved_by_sea(model.specification(), gaps);
  find_under_bed(model.specification(), operation, gaps);
  find_splash(model.specification(), operation, gaps);
  find_long_splash(model.specification(), operation, gaps);
  find_long_payout(model, operation, gaps);
  find_unheld(model, operation, gaps);
  return gaps;
}

}  // namespace stillhook
