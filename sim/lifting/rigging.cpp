#include "sim/lifting/rigging.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kTaut = 0.002;         // share of the weight that straightens the slings of a load that stands
constexpr double kStraightened = 1e-9;  // of the pull, the force out of balance that is left

const BodySpec& load_of(const RiggingSpec& rigging, const Specification& spec) {
  const auto load = std::ranges::find(spec.bodies, rigging.load, &BodySpec::name);
  if (load == spec.bodies.end())
    throw SpecificationError("rigging." + rigging.name, "load", "there is no body \"" + rigging.load + "\"");
  return *load;
}

/// The sum E with its derivatives, over the hook (3), the spreader's position and rotation (6) and the rotation of the
/// load about its centre of gravity (3).
class SlingBalance {
 public:
  SlingBalance(const RiggingSpec& rigging, const Specification& spec, double share, bool load_turns)
      : rigging_(rigging), load_(load_of(rigging, spec)), gravity_(spec.sea.gravity), load_turns_(load_turns) {
    places_.load = {rotation_from(load_.attitude), load_.position};
    pull_ = (share * load_.mass + rigging.spreader.mass) * gravity_;
    start();
  }

  bool has_spreader() const { return !rigging_.spreader.name.empty(); }
  int size() const { return turn_begin() + (load_turns_ ? 3 : 0); }

  /// Levenberg and Marquardt's iteration with the Hessian by differences of the gradient. False if it does not settle.
  bool settle() {
    double damping = 1.0;  // in units of the stiffest sling
    for (int k = 0; k < 2000; ++k) {
      const VectorX g = gradient();
      if (g.norm() < kStraightened * pull_) return true;
      MatrixX H = hessian();
      const double before = energy(), scale = stiffest() * damping;
      H.diagonal().array() += scale;
      const Places places = places_;
      const VectorX step = -H.ldlt().solve(g);
      const double longest = 2.0;  // m and rad: what is further is approached step by step
      move(step * std::min(1.0, longest / std::max(step.cwiseAbs().maxCoeff(), 1e-300)));
      if (energy() <= before) {
        damping = std::max(0.2 * damping, 1e-12);
        if (step.cwiseAbs().maxCoeff() < 1e-13) return true;
      } else {
        places_ = places;
        damping *= 8.0;
        if (damping > 1e12) return g.norm() < 1e-4 * pull_;  // as far as the digits go
      }
    }
    return false;
  }

  RiggingPose pose() const {
    RiggingPose result;
    result.hook = places_.hook;
    result.spreader = places_.spreader;
    result.load = places_.load;
    each_sling([&](const SlingSpec& s, const Vector3& upper, const Vector3& lower) {
      const Vector3 along = upper - lower;
      const double d = along.norm();
      result.slings.push_back({s.name, d, tension_of(s, d), std::asin(std::clamp(along.z() / d, -1.0, 1.0))});
    });
    // What the hook gives way by under a vertical force, everything else following.
    const MatrixX H = hessian();
    VectorX unit = VectorX::Zero(size());
    unit[2] = 1.0;
    const double flexibility = H.completeOrthogonalDecomposition().solve(unit)[2];
    result.vertical_stiffness = flexibility > 0.0 ? 1.0 / flexibility : 0.0;
    return result;
  }

 private:
  struct Places {
    Vector3 hook = Vector3::Zero();
    Pose spreader, load;  // X_WS, X_WL
  };

  int turn_begin() const { return has_spreader() ? 9 : 3; }
  static double length_of(const SlingSpec& s) { return s.length + s.length_error; }
  static double tension_of(const SlingSpec& s, double distance) {
    return s.axial_stiffness / length_of(s) * std::max(0.0, distance - length_of(s));
  }

  template <class Visit>
  void each_sling(const Visit& visit) const {
    for (const SlingSpec& s : rigging_.spreader.slings) visit(s, places_.hook, places_.spreader * s.to);
    for (const SlingSpec& s : rigging_.slings)
      visit(s, has_spreader() ? places_.spreader * s.from : places_.hook, places_.load * s.to);
  }

  double stiffest() const {
    double most = 0.0;
    each_sling([&](const SlingSpec& s, const Vector3&, const Vector3&) {
      most = std::max(most, s.axial_stiffness / length_of(s));
    });
    return most;
  }

  static Vector3 mean_end(const std::vector<SlingSpec>& slings, Vector3 SlingSpec::*end) {
    Vector3 sum = Vector3::Zero();
    for (const SlingSpec& s : slings) sum += s.*end;
    return sum / static_cast<double>(slings.size());
  }
  /// m, of the highest place that a hook on these slings reaches above the mean of their lower ends.
  static double height_of(const std::vector<SlingSpec>& slings) {
    const Vector3 middle = mean_end(slings, &SlingSpec::to);
    double least = std::numeric_limits<double>::infinity();
    for (const SlingSpec& s : slings) {
      const double out = (s.to - middle).head<2>().norm(), L = length_of(s);
      least = std::min(least, out < L ? std::sqrt(L * L - out * out) : 0.1 * L);
    }
    return least;
  }

  void start() {
    const Matrix3 heading = heading_rotation(places_.load.R);
    Vector3 under = places_.load * mean_end(rigging_.slings, &SlingSpec::to);
    if (has_spreader()) {
      double drop = std::numeric_limits<double>::infinity();
      for (const SlingSpec& s : rigging_.slings) drop = std::min(drop, length_of(s));
      places_.spreader.R = heading;
      places_.spreader.p = under + Vector3(0.0, 0.0, drop) - heading * mean_end(rigging_.slings, &SlingSpec::from);
      under = places_.spreader * mean_end(rigging_.spreader.slings, &SlingSpec::to);
      places_.hook = under + Vector3(0.0, 0.0, height_of(rigging_.spreader.slings));
    } else {
      places_.hook = under + Vector3(0.0, 0.0, height_of(rigging_.slings));
    }
  }

  double energy() const {
    double sum = -pull_ * places_.hook.z();
    if (has_spreader()) sum += rigging_.spreader.mass * gravity_ * (places_.spreader * rigging_.spreader.cog).z();
    each_sling([&](const SlingSpec& s, const Vector3& upper, const Vector3& lower) {
      const double stretch = std::max(0.0, (upper - lower).norm() - length_of(s));
      sum += 0.5 * s.axial_stiffness / length_of(s) * stretch * stretch;
    });
    return sum;
  }

  VectorX gradient() const {
    VectorX g = VectorX::Zero(size());
    g[2] = -pull_;
    const auto on_spreader = [&](const Vector3& point, const Vector3& slope) {
      g.segment<3>(3) += slope;
      g.segment<3>(6) += (point - places_.spreader.p).cross(slope);
    };
    if (has_spreader())
      on_spreader(places_.spreader * rigging_.spreader.cog, Vector3(0.0, 0.0, rigging_.spreader.mass * gravity_));
    const Vector3 centre = places_.load * load_.cog;
    std::size_t i = 0;
    each_sling([&](const SlingSpec& s, const Vector3& upper, const Vector3& lower) {
      const bool to_spreader = i < rigging_.spreader.slings.size();
      ++i;
      const double d = (upper - lower).norm();
      if (!(d > 0.0)) return;
      const Vector3 slope = tension_of(s, d) / d * (upper - lower);  // of E by the upper end
      if (to_spreader || !has_spreader())
        g.head<3>() += slope;
      else
        on_spreader(upper, slope);
      if (to_spreader)
        on_spreader(lower, -slope);
      else if (load_turns_)
        g.tail<3>() -= (lower - centre).cross(slope);
    });
    return g;
  }

  /// By differences of the gradient.
  MatrixX hessian() const {
    constexpr double kStep = 1e-6;  // m and rad
    MatrixX H(size(), size());
    for (int k = 0; k < size(); ++k) {
      SlingBalance ahead = *this, behind = *this;
      const VectorX change = kStep * VectorX::Unit(size(), k);
      ahead.move(change);
      behind.move(-change);
      H.col(k) = (ahead.gradient() - behind.gradient()) / (2.0 * kStep);
    }
    return 0.5 * (H + H.transpose()).eval();
  }

  void move(const VectorX& step) {
    places_.hook += step.head<3>();
    if (has_spreader()) {
      Pose& spreader = places_.spreader;
      spreader.p += step.segment<3>(3);
      spreader.R = orthonormalised(exp_rotation(step.segment<3>(6)) * spreader.R);
    }
    if (load_turns_) {
      Pose& load = places_.load;
      const Vector3 centre = load * load_.cog;
      load.R = orthonormalised(exp_rotation(step.tail<3>()) * load.R);
      load.p = centre - load.R * load_.cog;
    }
  }

  const RiggingSpec& rigging_;
  const BodySpec& load_;
  double gravity_, pull_ = 0.0;
  bool load_turns_;
  Places places_;
};

Matrix3 inertia_of_box(double mass, const Vector3& size) {
  const Vector3 squares = size.cwiseProduct(size);
  return (mass / 12.0 * (Vector3::Constant(squares.sum()) - squares)).asDiagonal();
}

WireSpec wire_of(const SlingSpec& s, const std::string& from, const Vector3& point_from, const std::string& to,
                 double carried) {
  WireSpec wire;
  wire.name = s.name;
  wire.role = WireSpec::Role::sling;
  wire.from = from;
  wire.to = to;
  wire.point_from = point_from;
  wire.point_to = s.to;
  wire.axial_stiffness = s.axial_stiffness;
  wire.damping_ratio = s.damping_ratio;
  wire.damping_mass = carried;
  wire.unstretched_length = s.length + s.length_error;
  wire.breaking_load = s.breaking_load;
  return wire;
}

}  // namespace

RiggingPose rigging_pose(const RiggingSpec& rigging, const Specification& spec, double share, RiggingLoad load) {
  SlingBalance balance(rigging, spec, share, load == RiggingLoad::turns);
  if (!balance.settle())
    throw SpecificationError("rigging." + rigging.name, "slings",
                             "find no place of the hook in which they carry the load");
  return balance.pose();
}

bool load_stands(const RiggingSpec& rigging, const Specification& spec) {
  return std::ranges::any_of(spec.contacts, [&](const ContactSpec& c) {
    return c.body == rigging.load && c.role == ContactSpec::Role::pickup && c.active_from.empty();
  });
}

void add_rigging(const RiggingSpec& rigging, Specification& spec) {
  const RiggingPose pose = rigging_pose(rigging, spec, load_stands(rigging, spec) ? kTaut : 1.0, RiggingLoad::held);
  const BodySpec load = load_of(rigging, spec);
  const bool spreader = !rigging.spreader.name.empty();

  BodySpec block;
  block.name = rigging.name;
  block.mass = rigging.mass;
  block.cog = rigging.cog;
  block.inertia = inertia_of_box(rigging.mass, rigging.size);
  block.position = pose.hook - rigging.hook;
  spec.bodies.push_back(block);
  if (spreader) {
    BodySpec body;
    body.name = rigging.spreader.name;
    body.mass = rigging.spreader.mass;
    body.cog = rigging.spreader.cog;
    body.inertia = inertia_of_box(rigging.spreader.mass, rigging.spreader.size);
    body.position = pose.spreader.p;
    body.attitude = roll_pitch_yaw(pose.spreader.R);
    spec.bodies.push_back(body);
    for (const SlingSpec& s : rigging.spreader.slings)
      spec.wires.push_back(wire_of(s, block.name, rigging.hook, body.name,
                                   load.mass / static_cast<double>(rigging.spreader.slings.size())));
  }
  for (const SlingSpec& s : rigging.slings)
    spec.wires.push_back(wire_of(s, spreader ? rigging.spreader.name : block.name, spreader ? s.from : rigging.hook,
                                 load.name, load.mass / static_cast<double>(rigging.slings.size())));
}

}  // namespace stillhook
