// What a contact stores, turns into heat and records, and how it joins a model.
#include <algorithm>
#include <limits>
#include <memory>

#include "sim/element_site.h"
#include "sim/lifting/contact_touch.h"
#include "sim/lifting/unilateral.h"
#include "sim/specification.h"

namespace stillhook {

double Contact::potential_energy(const Instant& now, Memory m) const {
  if (!active(now)) return 0.0;
  const Surface s = surface(now);
  double energy = 0.0;
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (!t.touching()) continue;
    const double N = normal_force(t, now);
    const Grip g = grip(t, N, m.state.subspan(kStatesPerPoint * i, kStatesPerPoint));
    energy += unilateral_energy(t.depth, k_) + 0.5 * g.spring.squaredNorm() / k_;
  }
  return energy;
}

double Contact::dissipated_power(const Instant& now, Memory m) const {
  if (!active(now)) return 0.0;
  const Surface s = surface(now);
  double power = 0.0;
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (!t.touching()) continue;
    const double rate = -t.v_S.z();
    const double N = normal_force(t, now);
    const auto state = m.state.subspan(kStatesPerPoint * i, kStatesPerPoint);
    const Eigen::Vector2d slip(state[kSlipX], state[kSlipY]);
    const Grip g = grip(t, N, state);
    power += unilateral_dissipation(N, t.depth, rate, k_);
    // The slip is that of the last step: it may lag behind a force that has just turned.
    power += (g.spring - g.force).dot(t.v_S.head<2>()) + std::max(0.0, -g.spring.dot(slip));
  }
  return power;
}

std::vector<Channel> Contact::channels() const { return channels_of(name(), contact_channels::all); }

void Contact::measure(const Instant& now, Memory, std::span<double> out) const {
  const Surface s = surface(now);
  double force = 0.0, penetration = 0.0, gap = std::numeric_limits<double>::infinity();
  double approach = 0.0, nearest_approach = 0.0;
  int touching = 0;
  Vector3 sum = Vector3::Zero(), nearest = Vector3::Zero();
  for (const Vector3& point : options_.points) {
    const Touch t = touch(point, s, now);
    const double rate = -t.v_S.z();
    if (const double own = t.gap(now); now.on(own < gap)) {
      gap = own;
      nearest = t.motion.p;
      nearest_approach = now.on(rate > 0.0) ? rate : 0.0;
    }
    if (!active(now) || !now.on(t.touching())) continue;
    ++touching;
    sum += t.motion.p;
    force += normal_force(t, now);
    if (now.on(t.depth > penetration)) penetration = t.depth;
    if (now.on(rate > approach)) approach = rate;
  }
  const Vector3 place = touching > 0 ? Vector3(sum / touching) : nearest;
  out[0] = force;
  out[1] = penetration;
  out[2] = gap;
  out[3] = touching > 0 ? approach : nearest_approach;
  out[4] = place.x();
  out[5] = place.y();
  out[6] = place.z();
}

Contact::Missed Contact::missed(const Instant& now) const {
  Missed out;
  if (!active(now)) return out;
  const Surface s = surface(now);
  for (std::size_t i = 0; i < options_.points.size(); ++i) {
    const Touch t = touch(options_.points[i], s, now);
    if (t.depth <= 0.0 || t.beside == 0.0) continue;
    if (out.count == 0 || t.beside < out.beside) {
      out.point = static_cast<int>(i);
      out.beside = t.beside;
    }
    ++out.count;
  }
  return out;
}

std::unique_ptr<const ForceElement> make_element(const ContactSpec& c, const ElementSite& site) {
  ContactOptions o;
  o.name = c.name;
  o.body = site.body(c.body);
  for (const Vector3& p : c.points) o.points.push_back(site.point(c.body, p).c_B);
  o.surface = site.point(c.surface_body, c.surface_centre);
  o.length = c.surface_length;
  o.breadth = c.surface_breadth;
  o.stiffness = c.stiffness;
  o.damping = c.damping;
  o.damping_depth = c.damping_depth;
  o.friction = c.friction;
  o.active_from_phase = site.first_phase(c.active_from, "contacts." + c.name);
  return std::make_unique<const Contact>(o);
}

}  // namespace stillhook
