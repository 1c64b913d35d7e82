#include "sim/element_site.h"

#include "sim/model.h"
#include "sim/multibody/point.h"
#include "sim/specification.h"

namespace stillhook {

int ElementSite::body(const std::string& name) const { return model_.body_index(name); }
int ElementSite::drive(const std::string& name) const { return model_.drive_index(name); }
int ElementSite::drive_or_none(const std::string& name) const { return name.empty() ? -1 : drive(name); }

int ElementSite::first_phase(const std::string& name, const std::string& entry) const {
  if (name.empty()) return 0;
  const auto& phases = specification().operation.phases;
  for (std::size_t i = 0; i < phases.size(); ++i)
    if (phases[i].name == name) return static_cast<int>(i);
  throw SpecificationError(entry, "active_from", "there is no phase '" + name + "'");
}

double ElementSite::distance(const BodyPoint& a, const BodyPoint& b) const {
  return (motion_of(a, now()).p - motion_of(b, now()).p).norm();
}

double ElementSite::initial_length(const std::string& wire) const {
  const std::vector<WireSpec>& wires = specification().wires;
  for (std::size_t i = 0; i < wires.size(); ++i)
    if (wires[i].name == wire) return model_.initial_lengths().at(i);
  throw SpecificationError("wires." + wire, "", "is not a wire of the lift");
}

Instant ElementSite::now() const { return model_.initial_state().instant(); }
const Specification& ElementSite::specification() const { return model_.specification(); }
std::shared_ptr<const WaveField> ElementSite::waves() const { return model_.shared_waves(); }

BodyPoint ElementSite::point(const std::string& name, const Vector3& p_B) const {
  const int i = model_.body_index(name);
  return {i, i == kWorld ? p_B : Vector3(p_B - specification().bodies[i].cog)};
}

}  // namespace stillhook
