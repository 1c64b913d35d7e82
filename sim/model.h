// A lift that can be simulated: bodies, constraints, force elements, drives, sea. Immutable once built.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/multibody/force_element.h"
#include "sim/multibody/system.h"
#include "sim/sea/wave_field.h"
#include "sim/specification.h"

namespace stillhook {

class Model {
 public:
  const Specification& specification() const { return specification_; }
  const MultibodySystem& system() const { return system_; }
  const WaveField& waves() const { return *waves_; }
  std::shared_ptr<const WaveField> shared_waves() const { return waves_; }

  int body_index(const std::string& name) const;     // kWorld for "world"; throws SpecificationError if unknown
  int drive_index(const std::string& name) const;    // throws SpecificationError if unknown
  int element_index(const std::string& name) const;  // -1 if there is none

  /// Unstretched length of each wire at the start of the run, m, in the order of the specification.
  const std::vector<double>& initial_lengths() const { return initial_lengths_; }
  /// Static equilibrium in calm water with every drive at zero (or the given poses and velocities, if the case does
  /// not start in equilibrium).
  const SystemState& initial_state() const { return initial_state_; }
  /// The coefficient set that a body's hydrodynamics come from; null for none and for constant coefficients.
  struct BodyCoefficients {
    std::shared_ptr<const HydrodynamicCoefficients> set;
    int hull = 0;                   // the body's place in a set of several hulls
    double reference_height = 0.0;  // m, of the set's reference point above Bo
  };
  const BodyCoefficients& coefficients(int body) const { return coefficients_[body]; }
  /// Added mass of a body about its centre of gravity at a frequency (rad/s; infinity for A_inf), axes of its heading
  /// frame; constant where the case gives it, zero without hydrodynamics.
  Matrix6 added_mass(int body, double frequency) const;
  /// What a reader of results must know: energy of the sea that was left out, self-checks that failed and were accepted.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Joints that lost rows which other joints already imply: their share of the reactions is not determined.
  const std::vector<std::string>& redundant_joints() const { return redundant_joints_; }

 private:
  friend class ModelBuilder;
  Specification specification_;
  std::shared_ptr<const WaveField> waves_;
  MultibodySystem system_;
  std::vector<BodyCoefficients> coefficients_;
  std::vector<std::string> warnings_;
  std::vector<double> initial_lengths_;
  std::vector<std::string> redundant_joints_;
  SystemState initial_state_;
  SystemState laid_out_;  // where the initial lengths were found, before there were hydrodynamics
};

/// Builds the elements, assembles the joints, finds the initial static equilibrium, gets the hulls' coefficients.
/// `progress` hears of a panel computation, if there has to be one (coefficient_source.h). Throws SpecificationError.
Model build_model(const Specification& specification, const HydroProgress& progress = {});

/// The same for a specification that differs little from that of `other`. Its initial equilibrium is taken over if it is
/// one of this lift as well; else it is where the search begins.
Model build_model_like(const Specification& specification, const Model& other);

/// Every channel of the model at a state, by name (see trajectory.h for the names).
std::map<std::string, double> channel_values(const Model& model, const SystemState& state);

}  // namespace stillhook
