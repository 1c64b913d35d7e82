#include "sim/element_site.h"

#include "sim/model.h"
#include "sim/multibody/point.h"

namespace stillhook {

int ElementSite::body(const std::string& name) const { return model_.body_index(name); }
int ElementSite::drive(const std::string& name) const { return model_.drive_index(name); }
const Specification& ElementSite::specification() const { return model_.specification(); }
std::shared_ptr<const WaveField> ElementSite::waves() const { return model_.shared_waves(); }

BodyPoint ElementSite::point(const std::string& name, const Vector3& p_B) const {
  const int i = model_.body_index(name);
  return {i, i == kWorld ? p_B : Vector3(p_B - specification().bodies[i].cog)};
}

}  // namespace stillhook
