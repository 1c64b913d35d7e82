#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/crane_parts.h"
#include "sim/element_builder.h"
#include "sim/hull/afloat.h"
#include "sim/hull/damping.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/immersion.h"
#include "sim/hull/parting_hydrodynamics.h"
#include "sim/hull/sea_band.h"
#include "sim/lifting/wire.h"
#include "sim/model.h"
#include "sim/multibody/assembly.h"
#include "sim/multibody/joint_drive.h"
#include "sim/multibody/relaxation.h"
#include "sim/number_text.h"
#include "sim/start_pose.h"
#include "sim/static_goals.h"

namespace stillhook {
namespace {

constexpr double kJointGap = 0.05;     // m, apart at the given poses: rounding in a case file, not a mistake
constexpr double kCalm = -1.0;         // s, before the waves start
constexpr double kAngleHeld = 1e-10;   // rad
constexpr double kLengthProbe = 1e-3;  // m
constexpr int kHoldRounds = 20;
const HydroProgress kSilent;
constexpr double kOutOfTheWay = 5.0;  // m that a wire is too long by to take part in the search for the start

}  // namespace

class ModelBuilder {
 public:
  ModelBuilder(const Specification& specification, const HydroProgress& progress, const Model* other = nullptr)
      : progress_(progress), other_(other) {
    model_.specification_ = specification;
    if (other_ && (other_->system().bodies.size() != spec().bodies.size() ||
                   other_->initial_lengths().size() != spec().wires.size()))
      other_ = nullptr;
  }

  Model build() {
    place_bodies();
    const SeaSpec& sea = spec().sea;
    const auto active =
        std::find_if(sea.states.begin(), sea.states.end(), [&](const SeaStateSpec& s) { return s.name == sea.active; });
    model_.waves_ = std::make_shared<const WaveField>(
        active == sea.states.end() ? WaveField() : build_wave_field(*active, sea.gravity, sea.ramp));
    join_bodies();
    choose_lengths();
    add_elements();
    if (spec().solver.static_start) {
      const SystemState given = state();
      if (other_)
        begin_at_other();
      else
        find_equilibrium();
      refuse_sunken_vessels();
      refuse_slack_supports();
      model_.warnings_ = start_pose_notes(model_, given, state());
    }
    model_.laid_out_ = state();
    add_hydrodynamics();
    start();
    return std::move(model_);
  }

 private:
  const Specification& spec() const { return model_.specification_; }
  MultibodySystem& system() { return model_.system_; }
  SystemState& state() { return model_.initial_state_; }
  const SystemState& state() const { return model_.initial_state_; }

  void place_bodies() {
    if (spec().bodies.empty()) throw SpecificationError("bodies", "", "a model needs at least one body");
    for (const BodySpec& b : spec().bodies) {
      system().bodies.push_back({b.name, b.mass, b.inertia, b.cog});
      BodyKinematics k;
      k.R_WB = rotation_from(b.attitude);
      k.p_WC = b.position + k.R_WB * b.cog;
      k.w_B = b.angular_velocity;
      k.v_WC = b.velocity + k.R_WB * k.w_B.cross(b.cog);
      state().body.push_back(k);
    }
    system().gravity = spec().sea.gravity;
    state().drive.resize(spec().drives.size());
  }

  void join_bodies() {
    const Instant now = state().instant();
    for (const JointSpec& j : spec().joints) {
      const int parent = model_.body_index(j.parent), child = model_.body_index(j.child);
      const auto cog = [&](int body) { return body == kWorld ? Vector3(Vector3::Zero()) : spec().bodies[body].cog; };
      system().joints.push_back(make_joint(j, parent, child, cog(parent), cog(child), now));
      Joint::Rows rows;
      system().joints.back().values(now, rows);
      const double gap = rows.head(system().joints.back().rows()).cwiseAbs().maxCoeff();
      if (gap > kJointGap)
        throw SpecificationError("joints." + j.name, "",
                                 "contradicts the given poses: its point on '" + j.child + "' and its point on '" +
                                     j.parent + "' are " + std::to_string(gap) + " m apart (at most " +
                                     std::to_string(kJointGap) + " m is mended)");
    }
    system().finish();
    std::string joint;
    const double left = assemble_joints(system(), state(), joint);
    if (left > 1e-9)
      throw SpecificationError(
          "joints." + joint, "",
          "cannot be closed together with the other joints: " + std::to_string(left) + " m or rad remain");
    model_.redundant_joints_ = system().select_independent_rows(state());
  }

  // Unstretched lengths where the specification leaves them to the initial pose.
  void choose_lengths() {
    for (const WireSpec& w : spec().wires) {
      const double distance = build_.end_distance(w);
      if (distance < 1e-6) throw SpecificationError("wires." + w.name, "", "its ends coincide at the initial pose");
      double length = w.unstretched_length > 0.0 ? w.unstretched_length : distance + w.slack;
      if (length <= 0.0)
        throw SpecificationError("wires." + w.name, "slack",
                                 "leaves no length: the ends are " + std::to_string(distance) + " m apart");
      model_.initial_lengths_.push_back(length);
    }
    given_lengths_ = model_.initial_lengths_;
    given_ = state();
  }

  void rebuild_wires() {
    for (std::size_t i = 0; i < spec().wires.size(); ++i)
      system().elements[first_wire_ + i] = build_.wire(spec().wires[i], model_.initial_lengths_[i]);
  }

  void add_elements() {
    auto& elements = system().elements;
    elements.clear();
    for (std::size_t i = 0; i < spec().bodies.size(); ++i) {
      const BodySpec& b = spec().bodies[i];
      if (b.hull.shape != HullSpec::Shape::none)
        elements.push_back(build_hydrostatics(b, static_cast<int>(i), model_.waves_, spec().sea));
    }
    first_wire_ = elements.size();
    for (std::size_t i = 0; i < spec().wires.size(); ++i)
      elements.push_back(build_.wire(spec().wires[i], model_.initial_lengths_[i]));
    for (const TaglineSpec& t : spec().taglines) elements.push_back(build_.tagline(t));
    for (const MooringSpec& m : spec().moorings) elements.push_back(build_.mooring(m));
    for (const ContactSpec& c : spec().contacts) elements.push_back(build_.contact(c));
    for (const BallastSpec& b : spec().ballast) elements.push_back(build_.ballast(b));
    for (std::size_t j = 0; j < spec().joints.size(); ++j) {
      const JointSpec& joint = spec().joints[j];
      if (joint.stiffness > 0.0 || joint.damping > 0.0 || !joint.drive.empty())
        elements.push_back(std::make_unique<const JointDrive>(joint.name, system().joints[j], joint.stiffness,
                                                              joint.damping, joint.rest,
                                                              build_.drive_or_none(joint.drive)));
    }
    system().finish();
    system().select_independent_rows(state());
  }

  // The pose of the other lift, if that is an equilibrium of this one and gives its wires the same lengths. Else the
  // search begins there, with friction holding from the given pose as ever.
  void begin_at_other() {
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
      const double length = by_pose ? build_.end_distance(w) + w.slack : lengths[i];
      taken_over_ = length == model_.initial_lengths_[i] && !(by_pose && w.slack < 0.0);
    }
    taken_over_ = taken_over_ && same_statics(system(), other_->system(), there);
    if (taken_over_) return;
    state() = given;
    state().body = there.body;
    state().lambda = there.lambda;
    find_equilibrium();
  }

  EquilibriumReport try_to_settle() {
    state().t = kCalm;
    const EquilibriumReport report = settle_stably(system(), state(), other_ != nullptr);
    state().t = 0.0;
    return report;
  }

  void settle() {
    const EquilibriumReport report = try_to_settle();
    if (report.converged) return;
    refuse_what_cannot_float();
    refuse_without_equilibrium(report, "bodies." + report.worst_body);
  }

  // The usual reason for having no equilibrium deserves its own sentence: more weight than the hulls can carry.
  void refuse_what_cannot_float() const {
    double weight = 0.0, volume = 0.0;
    std::string hull;
    for (const BodySpec& b : spec().bodies) {
      weight += b.mass;
      if (b.hull.shape == HullSpec::Shape::none) continue;
      volume += properties_of(build_hull_mesh(b.hull)).volume;
      if (hull.empty()) hull = b.name;
    }
    if (hull.empty() || weight <= spec().sea.density * volume) return;
    throw SpecificationError("bodies." + hull, "mass",
                             "does not float: the bodies weigh " + std::to_string(weight / 1000.0) +
                                 " t, all hulls together carry at most " +
                                 std::to_string(spec().sea.density * volume / 1000.0) + " t");
  }

  // Mooring lines, or a load that stands, can hold a vessel that went down: in balance, and no vessel any more.
  void refuse_sunken_vessels() const {
    for (const std::string& name : crane_vessels(spec())) {
      const auto body =
          std::find_if(spec().bodies.begin(), spec().bodies.end(), [&](const BodySpec& b) { return b.name == name; });
      if (body == spec().bodies.end() || body->hull.shape == HullSpec::Shape::none) continue;
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
  void find_equilibrium() {
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
      model_.initial_lengths_[i] = build_.end_distance(w) + w.slack;
      taut = taut || w.slack < 0.0;
    }
    rebuild_wires();
    if (!taut) return;
    settle();
    hold_joints(holding, held);
  }

  // Settles with the `loose` wires out of the way, and takes from among them those that turn out to hold something.
  void settle_without(std::vector<std::size_t>& loose) {
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

  bool by_slack(std::size_t i) const {
    return spec().wires[i].unstretched_length <= 0.0 && spec().wires[i].hold_joint.empty();
  }

  void hold_joints(const std::vector<std::size_t>& wires, const std::vector<const Joint*>& joints) {
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

  const Joint& joint_named(const WireSpec& w) {
    for (const Joint& j : system().joints)
      if (j.name == w.hold_joint) return j;
    throw SpecificationError("wires." + w.name, "hold_joint", "there is no joint '" + w.hold_joint + "'");
  }

  void refuse_slack_supports() {
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

  // Hydrodynamics come last: coefficients are those of the hulls as they float, and the share of critical damping is of
  // the modes about the equilibrium.
  void add_hydrodynamics() {
    const std::vector<BodySpec>& bodies = spec().bodies;
    std::vector<Mesh> meshes;
    for (const BodySpec& b : bodies) {
      std::string mended;
      meshes.push_back(b.hull.shape == HullSpec::Shape::none ? Mesh{} : build_hull_mesh(b.hull, &mended));
      if (!mended.empty()) model_.warnings_.push_back(mended);
    }
    model_.coefficients_.resize(bodies.size());
    std::vector<HydrodynamicsGroup> groups;
    for (const std::vector<std::size_t>& hulls : coupled_hulls(bodies)) groups.push_back(prepare_group(hulls, meshes));
    // The elements only now: the shares of critical damping were found with the system as it was laid out.
    for (const HydrodynamicsGroup& group : groups)
      if (auto element = element_of(group)) system().elements.push_back(std::move(element));
    system().finish();
    system().select_independent_rows(state());
  }

  struct HydrodynamicsGroup {
    std::vector<HydrodynamicsBody> hulls;
    std::shared_ptr<const HydrodynamicCoefficients> set;
  };

  std::unique_ptr<const ForceElement> element_of(const HydrodynamicsGroup& group) {
    auto together =
        build_hydrodynamics(group.hulls, group.set, model_.waves_, spec().sea, spec().panel_method, model_.warnings_);
    const std::string& until = group.hulls.front().afloat.body->hydrodynamics.coupled_until;
    if (until.empty() || group.hulls.size() == 1) return together;
    const std::vector<PhaseSpec>& phases = spec().operation.phases;
    const auto parting =
        std::find_if(phases.begin(), phases.end(), [&](const PhaseSpec& phase) { return phase.name == until; });
    if (parting == phases.end() || parting == phases.begin())
      throw SpecificationError("bodies." + group.hulls.front().afloat.body->name + ".hydrodynamics", "coupled_until",
                               "must be a phase of the operation after the first, got '" + until + "'");
    std::vector<std::unique_ptr<const ForceElement>> apart;
    for (const HydrodynamicsBody& hull : group.hulls) {
      const auto set = coefficient_set({&hull.afloat, 1}, spec().sea, spec().panel_method, model_.warnings_, progress_);
      apart.push_back(
          build_hydrodynamics({hull}, set, model_.waves_, spec().sea, spec().panel_method, model_.warnings_));
    }
    return std::make_unique<const PartingHydrodynamics>(std::move(together), std::move(apart),
                                                        static_cast<int>(parting - phases.begin()));
  }

  HydrodynamicsGroup prepare_group(const std::vector<std::size_t>& hulls, const std::vector<Mesh>& meshes) {
    HydrodynamicsGroup group;
    std::vector<HullAfloat> afloat;
    for (const std::size_t k : hulls)
      afloat.push_back(hull_afloat(spec(), model_.system_, state(), k, meshes[k]));
    if (model_.waves_)
      require_resolved_sea(afloat, *model_.waves_, spec().sea.gravity, spec().panel_method,
                           HydrodynamicsOptions().negligible_energy);
    group.set = coefficient_set(afloat, spec().sea, spec().panel_method, model_.warnings_, progress_);
    for (std::size_t k = 0; k < hulls.size(); ++k) {
      const int body = static_cast<int>(hulls[k]);
      model_.coefficients_[body] = {group.set, static_cast<int>(k), reference_height(afloat, afloat[k])};
      group.hulls.push_back({afloat[k], body, Vector6::Zero()});
      if (!spec().bodies[body].hydrodynamics.critical_fraction.isZero())
        group.hulls.back().critical_damping = critical_part(body);
    }
    return group;
  }

  // Linear damping that is the wanted share of critical for heave, roll and pitch of everything jointed to the hull,
  // each mode alone, with the added mass at its own frequency.
  Vector6 critical_part(int hull) {
    const BodySpec& body = spec().bodies[hull];
    Vector6 stiffness = hydrostatic_stiffness(hull).diagonal();
    Vector6 inertia;
    inertia << Vector3::Constant(body.mass), body.inertia.diagonal();
    const Vector3 C = state().body[hull].p_WC;
    const std::vector<bool> rigid = jointed_to(system(), hull);
    for (std::size_t i = 0; i < rigid.size(); ++i) {
      if (!rigid[i] || static_cast<int>(i) == hull) continue;
      const RigidBody& b = system().bodies[i];
      const Vector3 r = state().body[i].p_WC - C;
      const Matrix3 J = state().body[i].R_WB * b.inertia * state().body[i].R_WB.transpose() +
                        b.mass * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
      inertia.head<3>().array() += b.mass;
      inertia.tail<3>() += J.diagonal();
      stiffness.segment<2>(3).array() -= b.mass * system().gravity * r.z();  // weights above C tip the hull
    }
    for (int dof = 2; dof < 5; ++dof) {
      if (body.hydrodynamics.critical_fraction[dof] == 0.0) continue;
      if (stiffness[dof] <= 0.0)
        throw SpecificationError("bodies." + body.name, "critical_fraction",
                                 "the hull is not stable in this degree of freedom, so it has no critical damping");
      const double frequency = natural_frequency(stiffness[dof], inertia[dof],
                                                 [&](double w) { return model_.added_mass(hull, w)(dof, dof); });
      inertia[dof] = stiffness[dof] / (frequency * frequency);
    }
    return critical_damping(body.hydrodynamics.critical_fraction, stiffness, inertia);
  }

  // -dQ/dxi of the hull's pressure alone, about its C, in calm water.
  Matrix6 hydrostatic_stiffness(int hull) {
    const int e = model_.element_index(spec().bodies[hull].name + ".hydrostatics");
    if (e < 0) throw SpecificationError("bodies." + spec().bodies[hull].name, "critical_fraction", "needs a hull");
    SystemWorkspace work = system().make_workspace();
    SystemState calm = state();
    calm.t = kCalm;
    system().start_elements(calm, work);
    const Memory m = system().memory(e, calm, work);
    system().elements[e]->add_forces(calm.instant(), 0.0, m, work.forces);
    system().elements[e]->add_jacobian(calm.instant(), 0.0, m, work.jacobian);
    return -work.jacobian.stiffness().block<6, 6>(6 * hull, 6 * hull);
  }

  void start() {
    SystemWorkspace work = system().make_workspace();
    if (taken_over_ && system().elements.size() == other_->system().elements.size() &&
        same_statics(system(), other_->system(), other_->initial_state())) {
      state() = other_->initial_state();
      system().settle_elements(state(), work);
      set_velocities();
    } else if (spec().solver.static_start) {
      settle();
      set_velocities();
    } else {
      state().acceleration = VectorX::Zero(system().coordinates());
      state().lambda = VectorX::Zero(system().constraints());
      system().start_elements(state(), work);
    }
  }

  // A run may start from its equilibrium with the velocities of the case.
  void set_velocities() {
    for (std::size_t i = 0; i < spec().bodies.size(); ++i) {
      BodyKinematics& k = state().body[i];
      k.w_B = spec().bodies[i].angular_velocity;
      k.v_WC = spec().bodies[i].velocity + k.R_WB * k.w_B.cross(spec().bodies[i].cog);
    }
  }

  const HydroProgress& progress_;
  const Model* other_;
  bool taken_over_ = false;  // the other's equilibrium, so far
  Model model_;
  ElementBuilder build_{model_};
  std::vector<double> given_lengths_;  // of the wires, as the given pose has them
  SystemState given_;                  // with the joints closed
  std::size_t first_wire_ = 0;
};

Model build_model(const Specification& specification, const HydroProgress& progress) {
  return ModelBuilder(specification, progress).build();
}

Model build_model_like(const Specification& specification, const Model& other) {
  return ModelBuilder(specification, kSilent, &other).build();
}

}  // namespace stillhook
