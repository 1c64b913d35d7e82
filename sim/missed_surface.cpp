#include "sim/missed_surface.h"

#include <algorithm>
#include <cstdio>

#include "sim/lifting/contact.h"

namespace stillhook {

std::string missed_surface(const MultibodySystem& system, const SystemState& state) {
  const Contact* nearest = nullptr;
  Contact::Missed missed;
  for (const auto& element : system.elements) {
    const auto* contact = dynamic_cast<const Contact*>(element.get());
    if (!contact) continue;
    const Contact::Missed here = contact->missed(state.instant());
    if (here.count == 0 || here.beside > std::max(contact->options().length, contact->options().breadth)) continue;
    if (nearest && here.beside >= missed.beside) continue;
    nearest = contact;
    missed = here;
  }
  if (!nearest) return {};
  char text[256];
  std::snprintf(text, sizeof text,
                "; of the %zu points of contact '%s', %d lie lower than its surface and beside its edges, the nearest "
                "(point %d) by %.3g m: look at the pose of the load and at surface_centre_m, surface_length_m and "
                "surface_breadth_m",
                nearest->options().points.size(), nearest->name().c_str(), missed.count, missed.point + 1, missed.beside);
  return text;
}

}  // namespace stillhook
