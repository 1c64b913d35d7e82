#include "sim/start_pose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "sim/error.h"
#include "sim/hull/hydrostatics.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/wire.h"
#include "sim/multibody/assembly.h"
#include "sim/number_text.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kPoseRounding = 0.05;  // m: of poses in a case file
constexpr double kDraftError = 1.0;     // m: what a case may be wrong about how deep hulls float under a standing load
constexpr double kNotedMove = 0.5;      // m
constexpr double kNotedTurn = 5.0 * kDegree;

int body_named(const Specification& spec, const std::string& name) {
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    if (spec.bodies[i].name == name) return static_cast<int>(i);
  return kWorld;
}

struct Ends {
  int from, to;
  Vector3 p_from, p_to;  // m, W
  double distance() const { return (p_from - p_to).norm(); }
};

Ends ends_of(const Specification& spec, const MultibodySystem& system, const WireSpec& wire, const SystemState& at) {
  Ends e{body_named(spec, wire.from), body_named(spec, wire.to), wire.point_from, wire.point_to};
  if (e.from != kWorld) e.p_from = pose_of(at.body[e.from], system.bodies[e.from]) * wire.point_from;
  if (e.to != kWorld) e.p_to = pose_of(at.body[e.to], system.bodies[e.to]) * wire.point_to;
  return e;
}

double smallest_gap(const Contact& contact, const SystemState& at) {
  std::vector<double> memory(static_cast<std::size_t>(contact.state_size()), 0.0), scratch;
  const std::vector<Channel> channels = contact.channels();
  std::vector<double> values(channels.size());
  const Instant now = at.instant();
  contact.start(now, {memory, scratch});
  contact.measure(now, {memory, scratch}, values);
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == contact_channels::gap.of(contact.name())) return values[i];
  return kNaN;
}

// The body that `body`, or what is jointed to it, stands on in this pose; nothing if it does not stand.
std::optional<int> stands_on(const MultibodySystem& system, int body, const SystemState& at) {
  if (body == kWorld) return {};
  const std::vector<bool> together = jointed_to(system, body);
  for (const auto& element : system.elements) {
    const auto* contact = dynamic_cast<const Contact*>(element.get());
    if (!contact || contact->options().active_from_phase > 0) continue;
    const int points = contact->options().body;
    if (points != kWorld && together[static_cast<std::size_t>(points)] && smallest_gap(*contact, at) < kPoseRounding)
      return contact->options().surface.body;
  }
  return {};
}

std::string text_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A part of a distance: what rounding leaves of a part that is zero by symmetry is written as 0.
std::string millimetres(double metres) { return text_of("%.4g", std::round(metres * 1e3) / 1e3 + 0.0); }

class Reasons {
 public:
  Reasons(const Model& model, const SystemState& given, const SystemState& start)
      : spec_(model.specification()), model_(model), given_(given), start_(start) {}

  double moved(int body) const {
    const RigidBody& b = model_.system().bodies[static_cast<std::size_t>(body)];
    return (pose_of(start_.body[body], b).p - pose_of(given_.body[body], b).p).norm();
  }

  std::string why(int body) const {
    if (spec_.bodies[body].floats() && !hangs(body)) return "it floats there";
    if (const std::string wire = wire_of_another_length(body); !wire.empty()) return wire;
    if (const auto on = stands_on(model_.system(), body, start_))
      return "it stands on " + (*on == kWorld ? std::string("the ground") : "'" + spec_.bodies[*on].name + "'");
    const int leader = leader_of(body);
    if (leader != kWorld) return "it goes with '" + spec_.bodies[leader].name + "'";
    return "there its forces are in balance";
  }

 private:
  double tension(std::size_t wire) const {
    const int e = model_.element_index(spec_.wires[wire].name);
    return static_cast<const Wire&>(*model_.system().elements[static_cast<std::size_t>(e)]).tension(start_.instant());
  }

  bool hangs(int body) const {
    for (std::size_t i = 0; i < spec_.wires.size(); ++i)
      if (spec_.wires[i].role == WireSpec::Role::hoist && body_named(spec_, spec_.wires[i].to) == body &&
          tension(i) > 0.0)
        return true;
    return false;
  }

  // A taut wire whose length with its load is not the distance of its ends at the given pose.
  std::string wire_of_another_length(int body) const {
    std::string reason;
    double most = 0.5 * kNotedMove;
    for (std::size_t i = 0; i < spec_.wires.size(); ++i) {
      const Ends then = ends_of(spec_, model_.system(), spec_.wires[i], given_);
      const Ends now = ends_of(spec_, model_.system(), spec_.wires[i], start_);
      if ((now.from != body && now.to != body) || !(tension(i) > 0.0)) continue;
      const double off = std::abs(now.distance() - then.distance());
      if (off <= most) continue;
      most = off;
      reason = "wire '" + spec_.wires[i].name + "' is " + text_of("%.6g", model_.initial_lengths()[i]) +
               " m long without load and " + text_of("%.6g", now.distance()) + " m with it, its ends are " +
               text_of("%.6g", then.distance()) + " m apart at the given pose";
    }
    return reason;
  }

  // The body that this one is fastened to which has moved most.
  int leader_of(int body) const {
    int leader = kWorld;
    const auto consider = [&](int other) {
      if (other == kWorld || other == body || moved(other) < 0.5 * kNotedMove) return;
      if (leader == kWorld || moved(other) > moved(leader)) leader = other;
    };
    for (const Joint& joint : model_.system().joints) {
      if (joint.on_child.body == body) consider(joint.on_parent.body);
      if (joint.on_parent.body == body) consider(joint.on_child.body);
    }
    for (std::size_t i = 0; i < spec_.wires.size(); ++i) {
      const int from = body_named(spec_, spec_.wires[i].from), to = body_named(spec_, spec_.wires[i].to);
      if (tension(i) > 0.0 && to == body) consider(from);
      if (tension(i) > 0.0 && from == body) consider(to);
    }
    return leader;
  }

  const Specification& spec_;
  const Model& model_;
  const SystemState& given_;
  const SystemState& start_;
};

}  // namespace

std::vector<std::size_t> wires_that_hold(const Specification& spec, const MultibodySystem& system,
                                         const std::vector<std::size_t>& candidates, const SystemState& given,
                                         const SystemState& loose) {
  std::vector<std::size_t> hold, hold_from_above;
  for (const std::size_t i : candidates) {
    const Ends then = ends_of(spec, system, spec.wires[i], given), now = ends_of(spec, system, spec.wires[i], loose);
    const bool from_is_lower = then.p_from.z() < then.p_to.z();
    const int lower = from_is_lower ? then.from : then.to;
    const bool stands = stands_on(system, lower, given) && stands_on(system, lower, loose);
    if (now.distance() - then.distance() <= (stands ? kDraftError : kPoseRounding)) continue;
    hold.push_back(i);
    const double from_fell = then.p_from.z() - now.p_from.z(), to_fell = then.p_to.z() - now.p_to.z();
    if (from_is_lower ? from_fell > to_fell : to_fell > from_fell) hold_from_above.push_back(i);
  }
  return hold_from_above.empty() ? hold : hold_from_above;
}

void refuse_below_bed(const Specification& spec, const SystemState& start) {
  constexpr double kSettled = 0.5;  // m
  if (!(spec.sea.depth > 0.0)) return;
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    const BodySpec& body = spec.bodies[i];
    const BodyKinematics& k = start.body[i];
    double low = k.p_WC.z();
    if (body.hull.shape != HullSpec::Shape::none) {
      low = std::numeric_limits<double>::infinity();
      for (const Vector3& v : build_hull_mesh(body.hull).vertices)
        low = std::min(low, (k.p_WC + k.R_WB * (v - body.cog)).z());
    }
    if (low >= -spec.sea.depth - kSettled) continue;
    throw SpecificationError("bodies." + body.name, "position",
                             "lies " + number_text(std::round(100.0 * (-spec.sea.depth - low)) / 100.0) +
                                 " m below the sea bed, which sea.depth puts " + number_text(spec.sea.depth) +
                                 " m under the still water");
  }
}

std::vector<std::string> start_pose_notes(const Model& model, const SystemState& given, const SystemState& start) {
  std::vector<std::string> notes;
  const Reasons reasons(model, given, start);
  for (std::size_t i = 0; i < start.body.size(); ++i) {
    const int body = static_cast<int>(i);
    const RigidBody& b = model.system().bodies[i];
    const Pose then = pose_of(given.body[i], b), now = pose_of(start.body[i], b);
    const double turn = log_rotation(then.R.transpose() * now.R).norm();
    const Vector3 move = now.p - then.p;
    if (move.norm() <= kNotedMove && turn <= kNotedTurn) continue;
    std::string how;
    if (move.norm() > kNotedMove)
      how = text_of("%.4g", move.norm()) + " m (" + millimetres(move.x()) + ", " + millimetres(move.y()) + ", " +
            millimetres(move.z()) + ")";
    if (turn > kNotedTurn) how += (how.empty() ? "" : " and ") + text_of("%.4g", turn / kDegree) + " deg";
    notes.push_back("bodies." + b.name + ": starts " + how + " from its given pose: " + reasons.why(body));
  }
  return notes;
}

}  // namespace stillhook
