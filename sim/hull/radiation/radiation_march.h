// The `direct` radiation model: the panel method marched along with the simulation.
//
// The march has nodes of its own, dt of rankine/panel_march.h apart, whatever the steps of the simulation are (but not
// shorter than they). It gives the force at the middles between nodes; the force in between and up to the next node is
// the parabola through the last three, so D of the interface is zero. The memory force is smooth: second order in dt.
// A motion that starts with a velocity is taken to have begun it at the start.
#pragma once

#include <memory>

#include "sim/hull/radiation/radiation.h"
#include "sim/hull/rankine/panel_march.h"

namespace stillhook {

class RadiationMarch final : public Radiation {
 public:
  /// `factor`: of each mode, on its velocity as the water feels it and on the force; the square scales a hull's memory.
  RadiationMarch(std::shared_ptr<const rankine::PanelMarch> march, const VectorX& factor);

  bool same_as(const Radiation& other) const override {
    const auto* o = dynamic_cast<const RadiationMarch*>(&other);
    return o && o->march_ == march_ && o->factor_ == factor_;
  }
  int state_size() const override;
  void start(std::span<const double> V, Memory m) const override;
  void begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const override;
  void end_step(std::span<const double> V, double h, Memory m) const override;
  void force(std::span<const double> V, Memory m, std::span<double> F) const override;
  void instantaneous_damping(std::span<double> D) const override;

 private:
  void force_at(const double* state, double time, std::span<double> F) const;

  /// The march by one of its steps with the velocity V at the new node.
  void step(std::span<const double> V, std::span<double> state) const;

  std::shared_ptr<const rankine::PanelMarch> march_;
  std::vector<double> factor_;
};

}  // namespace stillhook
