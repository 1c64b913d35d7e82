// Radiation forces behind one interface: constant damping, retardation functions, and later the reduced state space and
// the marched panel method.
//
// A model sees the velocities V of its modes (six a hull, see coefficients.h) at the converged instants and promises
// that within a step of length h the force is affine in the new velocity,
//
//   F(t + h) = past - D V(t + h),
//
// where `past` follows from the history and D (modes x modes) from h alone. A_inf is not in F: it is in the mass
// matrix. Every model here is linear, so a tangent of the history is the history of the tangents.
#pragma once

#include <span>

#include "sim/multibody/force_element.h"

namespace stillhook {

class Radiation {
 public:
  explicit Radiation(int modes) : modes_(modes) {}
  virtual ~Radiation() = default;
  Radiation(const Radiation&) = delete;
  Radiation& operator=(const Radiation&) = delete;

  int modes() const { return modes_; }
  virtual int state_size() const { return 0; }
  virtual int scratch_size() const { return 0; }
  /// True if the other gives the same forces from the same motion; false is always safe.
  virtual bool same_as(const Radiation&) const { return false; }
  /// True if begin_step and end_step are linear in (state, V), so that they advance a tangent as well: with the clock
  /// of the motion in the place of its own.
  virtual bool linear_in_state() const { return false; }
  /// The first entries of the state that only say when, and do not depend on the motion.
  virtual int clock_size() const { return 0; }

  /// A motion that was at rest until just now and has velocity V at this instant.
  virtual void start(std::span<const double> /*V*/, Memory) const {}
  /// Fills `past` (modes) and D (modes x modes, column after column) for a step of length h (s) from the instant the
  /// state belongs to. Leaves the state alone, so a failed step can be tried again with another h.
  virtual void begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const = 0;
  /// Advances the state by h to the velocity V.
  virtual void end_step(std::span<const double> /*V*/, double /*h*/, Memory) const {}
  /// The force at the instant the state belongs to.
  virtual void force(std::span<const double> V, Memory m, std::span<double> F) const = 0;
  /// What the model does at once with the velocity, F = -D V, when no step is under way (statics). modes x modes.
  virtual void instantaneous_damping(std::span<double> D) const = 0;
  /// Power carried away, W, where it follows from the velocity alone; 0 for models with memory, whose power has no
  /// sign at an instant.
  virtual double radiated_power(std::span<const double> /*V*/) const { return 0.0; }

 private:
  int modes_;
};

/// F = -B V.
class ConstantRadiation final : public Radiation {
 public:
  /// B: modes x modes, symmetric part positive semidefinite (N s/m ...).
  explicit ConstantRadiation(MatrixX B);

  bool same_as(const Radiation& other) const override {
    const auto* o = dynamic_cast<const ConstantRadiation*>(&other);
    return o && o->B_ == B_;
  }
  bool linear_in_state() const override { return true; }
  void begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const override;
  void force(std::span<const double> V, Memory m, std::span<double> F) const override;
  void instantaneous_damping(std::span<double> D) const override;
  double radiated_power(std::span<const double> V) const override;

 private:
  MatrixX B_;
};

}  // namespace stillhook
