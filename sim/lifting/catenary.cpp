#include "sim/lifting/catenary.h"

#include <algorithm>
#include <cmath>

namespace stillhook {

namespace {

constexpr double kTolerance = 1e-12;  // of the length
constexpr double kLowest = 1e-6;      // of the length: least height above the seabed
constexpr int kNewtonSteps = 60;
constexpr int kHalvings = 30;

// Position of the upper end under a load, and its derivatives with respect to (H, V).
struct Span {
  double x, z;
  double x_H, x_V, z_H, z_V;
};

// A buoyant line upside down: its weight hangs from the anchor, which then is the upper end of the picture.
CatenaryLine turned_over(CatenaryLine line) {
  line.weight = -line.weight;
  line.on_seabed = false;
  return line;
}

bool partly_grounded(const CatenaryLine& line, double V) { return line.weight > 0.0 && line.on_seabed && V < line.weight * line.length; }

Span suspended_span(const CatenaryLine& line, double H, double V) {
  const double w = line.weight, L = line.length, EA = line.axial_stiffness;
  const double Va = V - w * L, S = std::hypot(H, V), Sa = std::hypot(H, Va);
  // Differences of the two ends, written without cancellation for a taut line.
  const double difference = w * L * (V + Va) / (S + Sa);       // S - Sa
  const double end = Va >= 0.0 ? Va + Sa : H * H / (Sa - Va);  // H exp(asinh Va/H)
  const double arc = std::log1p((w * L + difference) / end);   // asinh V/H - asinh Va/H
  const double sine = V / S - Va / Sa;
  Span span;
  span.x = H / w * arc + H * L / EA;
  span.z = difference / w + (V - 0.5 * w * L) * L / EA;
  span.x_H = (arc - sine) / w + L / EA;
  span.x_V = H / w * (1.0 / S - 1.0 / Sa);
  span.z_H = span.x_V;
  span.z_V = sine / w + L / EA;
  return span;
}

Span grounded_span(const CatenaryLine& line, double H, double V) {
  const double w = line.weight, L = line.length, EA = line.axial_stiffness, mu = line.seabed_friction;
  const double S = std::hypot(H, V), LB = L - V / w, arc = std::asinh(V / H);
  Span span;
  span.x = LB + H / w * arc + H * L / EA;
  span.z = V * V / (S + H) / w + V * V / (2.0 * EA * w);
  span.x_H = (arc - V / S) / w + L / EA;
  span.x_V = (H / S - 1.0) / w;
  span.z_H = span.x_V;
  span.z_V = V / (S * w) + V / (EA * w);
  if (mu > 0.0) {
    const double held = std::max(0.0, LB - H / (mu * w));  // length next to the anchor without tension
    span.x -= mu * w / (2.0 * EA) * (LB - held) * (LB + held);
    span.x_H -= held / EA;
    span.x_V += mu * (LB - held) / EA;
  }
  return span;
}

Span span_under(const CatenaryLine& line, double H, double V) {
  return partly_grounded(line, V) ? grounded_span(line, H, V) : suspended_span(line, H, V);
}

// z grows with V: the V that lifts the upper end to z under H, by bisection.
double vertical_load(const CatenaryLine& line, double H, double z) {
  double low = 0.0, high = line.weight * line.length;
  if (!line.on_seabed)
    for (low = -high; span_under(line, H, low).z > z;) low *= 2.0;
  while (span_under(line, H, high).z < z) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-16 * std::abs(high); ++i) {
    const double V = 0.5 * (low + high);
    (span_under(line, H, V).z < z ? low : high) = V;
  }
  return 0.5 * (low + high);
}

// x grows with H at constant z: bisection in log H. Slow and certain, for what Newton's method does not finish.
void bracket_load(const CatenaryLine& line, double x, double z, double& H, double& V) {
  const auto reach = [&](double force) { return span_under(line, force, vertical_load(line, force, z)).x; };
  double low = line.weight * line.length, high = low;
  while (reach(low) > x && low > 1e-280) low *= 0.1;
  while (reach(high) < x) high *= 10.0;
  for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
    const double middle = std::sqrt(low * high);
    (reach(middle) < x ? low : high) = middle;
  }
  H = std::sqrt(low * high);
  V = vertical_load(line, H, z);
}

// Starting values of Jonkman (2007), Eq. 2-37; beyond the length those of a straight elastic line.
void first_guess(const CatenaryLine& line, double x, double z, double& H, double& V) {
  const double w = line.weight, L = line.length, chord = std::hypot(x, z);
  if (chord >= L) {
    const double T = std::max(line.axial_stiffness * (chord / L - 1.0), w * L);
    H = T * x / chord;
    V = T * z / chord + 0.5 * w * L;
    return;
  }
  const double lambda = std::sqrt(std::max(3.0 * ((L * L - z * z) / (x * x) - 1.0), 1e-12));
  H = std::abs(0.5 * w * x / lambda);
  V = 0.5 * w * (z / std::tanh(lambda) + L);
}

bool newton_load(const CatenaryLine& line, double x, double z, double& H, double& V) {
  const double goal = kTolerance * std::max(line.length, std::hypot(x, z));
  const auto miss = [&](const Span& s) { return std::max(std::abs(s.x - x), std::abs(s.z - z)); };
  Span span = span_under(line, H, V);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double before = miss(span);
    if (before <= goal) return true;
    const double det = span.x_H * span.z_V - span.x_V * span.z_H;
    const double dH = ((x - span.x) * span.z_V - (z - span.z) * span.x_V) / det;
    const double dV = ((z - span.z) * span.x_H - (x - span.x) * span.z_H) / det;
    if (!std::isfinite(dH) || !std::isfinite(dV)) return false;
    double share = 1.0;  // keep H, and on the seabed V, positive
    if (dH < -0.9 * H) share = std::min(share, -0.9 * H / dH);
    if (line.on_seabed && dV < -0.9 * V) share = std::min(share, -0.9 * V / dV);
    int halvings = 0;
    for (; halvings < kHalvings; ++halvings, share *= 0.5) {
      span = span_under(line, H + share * dH, V + share * dV);
      if (miss(span) < before) break;
    }
    if (halvings == kHalvings) return false;
    H += share * dH;
    V += share * dV;
  }
  return miss(span) <= goal;
}

}  // namespace

CatenaryLoad solve_catenary(const CatenaryLine& line, double x, double z, double H_guess, double V_guess) {
  if (line.weight < 0.0) {
    CatenaryLoad load = solve_catenary(turned_over(line), x, -z, H_guess, -V_guess);
    load.V = -load.V;
    load.stiffness(0, 1) = -load.stiffness(0, 1);
    load.stiffness(1, 0) = -load.stiffness(1, 0);
    return load;
  }
  CatenaryLoad load;
  const double w = line.weight, EA = line.axial_stiffness;
  const double lowest = kLowest * line.length;
  const bool lying = line.on_seabed && z < lowest;
  if (lying) z = lowest;
  if (line.on_seabed) {
    const double hanging = 2.0 * z / (1.0 + std::sqrt(1.0 + 2.0 * w * z / EA));
    if (x <= line.length - hanging) {
      load.V = w * hanging;
      load.grounded_length = line.length - hanging;
      if (!lying) load.stiffness(1, 1) = w / (1.0 + load.V / EA);
      return load;
    }
  }
  load.H = H_guess;
  load.V = V_guess;
  if (!(H_guess > 0.0) || (line.on_seabed && !(V_guess > 0.0))) first_guess(line, x, z, load.H, load.V);
  if (!newton_load(line, x, z, load.H, load.V)) bracket_load(line, x, z, load.H, load.V);
  if (partly_grounded(line, load.V)) load.grounded_length = line.length - load.V / w;
  const Span span = span_under(line, load.H, load.V);
  const double det = span.x_H * span.z_V - span.x_V * span.z_H;
  load.stiffness << span.z_V / det, -span.x_V / det, -span.z_H / det, span.x_H / det;
  if (lying) load.stiffness.col(1).setZero();
  return load;
}

double catenary_distance(const CatenaryLine& line, double H, double z) {
  if (line.weight < 0.0) return catenary_distance(turned_over(line), H, -z);
  if (line.on_seabed) z = std::max(z, kLowest * line.length);
  return span_under(line, H, vertical_load(line, H, z)).x;
}

double catenary_overhang(const CatenaryLine& line, const CatenaryLoad& load) {
  // The lowest point lies inside the line where the vertical force changes its sign along it. From there to the end with
  // the vertical force F: (sqrt(H^2 + F^2) - H)/w + F^2/(2 EA w).
  const double w = std::abs(line.weight), upper = line.weight < 0.0 ? -load.V : load.V;
  const double at_anchor = upper - w * line.length;
  if (!(upper > 0.0 && at_anchor < 0.0) || partly_grounded(line, load.V)) return 0.0;
  const double F = line.weight < 0.0 ? upper : at_anchor;
  return F * F / (w * (std::hypot(load.H, F) + load.H)) + F * F / (2.0 * line.axial_stiffness * w);
}

double catenary_energy(const CatenaryLine& line, const CatenaryLoad& load, double x, double z) {
  // U = H x + V z - P with the complementary energy P(H, V): x = dP/dH, z = dP/dV. G is the integral of S over V.
  if (line.weight < 0.0) {
    CatenaryLoad turned = load;
    turned.V = -load.V;
    return catenary_energy(turned_over(line), turned, x, -z);
  }
  const double w = line.weight, L = line.length, EA = line.axial_stiffness, H = load.H, V = load.V;
  const auto G = [H](double force) {
    return 0.5 * (force * std::hypot(H, force) + (H > 0.0 ? H * H * std::asinh(force / H) : 0.0));
  };
  if (line.on_seabed) z = std::max(z, kLowest * L);
  double complementary;
  if (H == 0.0 && line.on_seabed) {
    return V * z - (G(V) / w + V * V * V / (6.0 * EA * w));
  } else if (partly_grounded(line, V)) {
    complementary = H * (L - V / w) + G(V) / w + H * H * L / (2.0 * EA) + V * V * V / (6.0 * EA * w);
  } else {
    const double weight = w * L;
    complementary = (G(V) - G(V - weight)) / w + H * H * L / (2.0 * EA) +
                    (V * V - V * weight + weight * weight / 3.0) * L / (2.0 * EA);
  }
  return H * x + V * z - complementary;
}

}  // namespace stillhook
