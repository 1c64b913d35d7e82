#include "sim/model.h"

#include <limits>

#include "sim/hull/hydrodynamics.h"
#include "sim/recorder.h"

namespace stillhook {

int Model::body_index(const std::string& name) const {
  if (name == "world") return kWorld;
  for (std::size_t i = 0; i < specification_.bodies.size(); ++i)
    if (specification_.bodies[i].name == name) return static_cast<int>(i);
  throw SpecificationError("bodies", "name", "there is no body '" + name + "'");
}

int Model::drive_index(const std::string& name) const {
  for (std::size_t i = 0; i < specification_.drives.size(); ++i)
    if (specification_.drives[i].name == name) return static_cast<int>(i);
  throw SpecificationError("drives", "name", "there is no drive '" + name + "'");
}

int Model::element_index(const std::string& name) const {
  for (std::size_t i = 0; i < system_.elements.size(); ++i)
    if (system_.elements[i]->name() == name) return static_cast<int>(i);
  return -1;
}

Matrix6 Model::added_mass(int body, double frequency) const {
  const BodySpec& spec = specification_.bodies[body];
  if (spec.hydrodynamics.kind == HydrodynamicsSpec::Kind::constant)
    return about_point(spec.hydrodynamics.added_mass, spec.cog);
  const BodyCoefficients& from = coefficients_[body];
  if (!from.set) return Matrix6::Zero();
  const Vector3 cog = spec.cog - Vector3(0.0, 0.0, from.reference_height);
  const HydrodynamicsSpec& h = spec.hydrodynamics;
  const Matrix6 A_inf = added_mass_at(*from.set, from.hull, cog, std::numeric_limits<double>::infinity());
  return h.added_mass_factor * A_inf +
         h.radiation_factor * (added_mass_at(*from.set, from.hull, cog, frequency) - A_inf);
}

std::map<std::string, double> channel_values(const Model& model, const SystemState& state) {
  SystemState copy = state;
  SystemWorkspace work = model.system().make_workspace();
  if (static_cast<int>(copy.element_state.size()) != model.system().element_state_size())
    model.system().start_elements(copy, work);
  VectorX unused;
  model.system().forces(copy, 0.0, work, unused);  // some elements measure from what they last computed
  ChannelBoard board(model);
  board.measure(copy, work, copy.phase, true);
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < board.channels().size(); ++i) values[board.channels()[i].name] = board.values()[i];
  return values;
}

}  // namespace stillhook
