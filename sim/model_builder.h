// The making of a model, in the order of its steps: bodies and joints, wire lengths and elements (build_model.cpp), the
// static equilibrium that it starts from (build_equilibrium.cpp), the hydrodynamics of the hulls as they float there
// (build_hull_forces.cpp).
#pragma once

#include "sim/element_site.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/model.h"
#include "sim/multibody/equilibrium.h"

namespace stillhook {

class ModelBuilder {
 public:
  ModelBuilder(const Specification& specification, const HydroProgress& progress, const Model* other = nullptr);
  Model build();

 private:
  const Specification& spec() const { return model_.specification_; }
  MultibodySystem& system() { return model_.system_; }
  SystemState& state() { return model_.initial_state_; }
  const SystemState& state() const { return model_.initial_state_; }

  // What it is made of.
  void place_bodies();
  void join_bodies();
  void hold_to_the_sea();
  void choose_lengths();
  void rebuild_wires();
  void add_elements();
  void add_own_elements();
  void start();
  void set_velocities();

  // The equilibrium it starts from.
  void begin_at_other();
  EquilibriumReport try_to_settle();
  void settle();
  void refuse_what_cannot_float() const;
  void refuse_sunken_vessels() const;
  void find_equilibrium();
  void settle_without(std::vector<std::size_t>& loose);
  bool by_slack(std::size_t wire) const;
  void hold_joints(const std::vector<std::size_t>& wires, const std::vector<const Joint*>& joints);
  const Joint& joint_named(const WireSpec& w);
  void refuse_slack_supports();

  // Hydrodynamics.
  struct HydrodynamicsGroup {
    std::vector<HydrodynamicsBody> hulls;
    std::shared_ptr<const HydrodynamicCoefficients> set;
  };
  void add_hydrodynamics();
  std::unique_ptr<const ForceElement> element_of(const HydrodynamicsGroup& group);
  HydrodynamicsGroup prepare_group(const std::vector<std::size_t>& hulls, const std::vector<Mesh>& meshes);
  Vector6 critical_part(int hull);
  Matrix6 hydrostatic_stiffness(int hull);

  const HydroProgress& progress_;
  const Model* other_;
  bool taken_over_ = false;  // the other's equilibrium, so far
  Model model_;
  ElementSite site_{model_};
  std::vector<double> given_lengths_;  // of the wires, as the given pose has them
  SystemState given_;                  // with the joints closed
  std::size_t first_wire_ = 0;
};

}  // namespace stillhook
