#include <algorithm>
#include <cmath>

#include "sim/hull/hydrostatics.h"
#include "sim/hull/rao_motion.h"
#include "sim/environment/streams.h"
#include "sim/lifting/wire.h"
#include "sim/model_builder.h"
#include "sim/multibody/assembly.h"
#include "sim/multibody/joint_drive.h"
#include "sim/number_text.h"
#include "sim/specification.h"
#include "sim/start_pose.h"

namespace stillhook {
namespace {

constexpr double kJointGap = 0.05;  // m, apart at the given poses: rounding in a case file, not a mistake
const HydroProgress kSilent;

}  // namespace

ModelBuilder::ModelBuilder(const Specification& specification, const HydroProgress& progress, const Model* other)
    : progress_(progress), other_(other) {
  model_.specification_ = specification;
  if (other_ && (other_->system().bodies.size() != spec().bodies.size() ||
                 other_->initial_lengths().size() != spec().wires.size()))
    other_ = nullptr;
}

Model ModelBuilder::build() {
  place_bodies();
  model_.waves_ = std::make_shared<const WaveField>(build_wave_field(spec().sea));
  for (std::string& note : current_notes(spec())) model_.warnings_.push_back(std::move(note));
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
    for (std::string& note : start_pose_notes(model_, given, state())) model_.warnings_.push_back(std::move(note));
  }
  refuse_below_bed(spec(), state());
  model_.laid_out_ = state();
  add_hydrodynamics();
  start();
  return std::move(model_);
}

void ModelBuilder::place_bodies() {
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

void ModelBuilder::add_own_elements() {
  for (const OwnElement& make : spec().own_elements) {
    auto element = make(site_);
    if (!element) throw SpecificationError("own element", "", "was not made: the program returned none");
    if (model_.element_index(element->name()) >= 0)
      throw SpecificationError(element->name(), "", "is the name of two elements");
    system().elements.push_back(std::move(element));
  }
}

void ModelBuilder::join_bodies() {
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
                                   j.parent + "' are " + number_text(gap) + " m apart (at most " +
                                   number_text(kJointGap) + " m is mended)");
  }
  hold_to_the_sea();
  system().finish();
  std::string joint;
  const double left = assemble_joints(system(), state(), joint);
  if (left > 1e-9)
    throw SpecificationError(
        "joints." + joint, "",
        "cannot be closed together with the other joints: " + number_text(left) + " m or rad remain");
  model_.redundant_joints_ = system().select_independent_rows(state());
}

// A vessel with displacement RAOs: fixed to a frame that the sea moves. After the other joints, which keep their rows.
void ModelBuilder::hold_to_the_sea() {
  for (std::size_t i = 0; i < spec().bodies.size(); ++i) {
    const BodySpec& b = spec().bodies[i];
    if (!b.moved_by_sea()) continue;
    if (!model_.waves_->calm() && !(spec().sea.ramp > 0.0))
      throw SpecificationError("sea", "ramp",
                               "must be > 0 s with '" + b.name +
                                   "', which moves by RAOs: without it the vessel would be torn into the motion at once; "
                                   "a wave period or two will do");
    const RaoTable table = read_rao_table(b, spec().sea.gravity, spec().sea.wave_depth());
    for (const std::string& odd : odd_in_long_waves(table, spec().sea.gravity, spec().sea.wave_depth()))
      model_.warnings_.push_back("bodies." + b.name + ".hydrodynamics.rao: " + odd +
                                 "; check the conventions that the case states for the file");
    Joint joint;
    joint.name = b.name + ".rao";
    joint.type = JointSpec::Type::fixed;
    joint.on_parent = {kWorld, b.cog};
    joint.on_child = {static_cast<int>(i), Vector3::Zero()};
    joint.motion = std::make_shared<const RaoMotion>(b, table, model_.waves_, model_.warnings_);
    system().joints.push_back(std::move(joint));
  }
}

// Unstretched lengths where the specification leaves them to the initial pose.
void ModelBuilder::choose_lengths() {
  for (const WireSpec& w : spec().wires) {
    const double distance = end_distance(w, site_);
    if (distance < 1e-6) throw SpecificationError("wires." + w.name, "", "its ends coincide at the initial pose");
    double length = w.unstretched_length > 0.0 ? w.unstretched_length : distance + w.slack;
    if (length <= 0.0)
      throw SpecificationError("wires." + w.name, "slack",
                               "leaves no length: the ends are " + number_text(distance) + " m apart");
    model_.initial_lengths_.push_back(length);
  }
  given_lengths_ = model_.initial_lengths_;
  given_ = state();
}

void ModelBuilder::rebuild_wires() {
  for (std::size_t i = 0; i < spec().wires.size(); ++i)
    system().elements[first_wire_ + i] = make_element(spec().wires[i], site_);
}

void ModelBuilder::add_elements() {
  auto& elements = system().elements;
  elements.clear();
  for (std::size_t i = 0; i < spec().bodies.size(); ++i) {
    const BodySpec& b = spec().bodies[i];
    if (b.floats())
      elements.push_back(build_hydrostatics(b, static_cast<int>(i), model_.waves_, spec().sea));
  }
  first_wire_ = elements.size();
  for_each_element_kind([&](const auto& kind) {
    for (const auto& entry : spec().*kind.entries) elements.push_back(make_element(entry, site_));
  });
  for (std::size_t j = 0; j < spec().joints.size(); ++j) {
    const JointSpec& joint = spec().joints[j];
    if (joint.stiffness > 0.0 || joint.damping > 0.0 || !joint.drive.empty())
      elements.push_back(std::make_unique<const JointDrive>(joint.name, system().joints[j], joint.stiffness,
                                                            joint.damping, joint.rest,
                                                            site_.drive_or_none(joint.drive)));
  }
  add_own_elements();
  system().finish();
  system().select_independent_rows(state());
}

void ModelBuilder::start() {
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
void ModelBuilder::set_velocities() {
  for (std::size_t i = 0; i < spec().bodies.size(); ++i) {
    BodyKinematics& k = state().body[i];
    k.w_B = spec().bodies[i].angular_velocity;
    k.v_WC = spec().bodies[i].velocity + k.R_WB * k.w_B.cross(spec().bodies[i].cog);
  }
}

Model build_model(const Specification& specification, const HydroProgress& progress) {
  return ModelBuilder(specification, progress).build();
}

Model build_model_like(const Specification& specification, const Model& other) {
  return ModelBuilder(specification, kSilent, &other).build();
}

}  // namespace stillhook
