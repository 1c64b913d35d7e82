#include "sim/hull/coefficients/file_stiffness.h"

#include <cmath>
#include <sstream>

#include "sim/hull/linear_froude_krylov.h"

namespace stillhook {
namespace {

constexpr double kHeave = 0.05, kCentre = 0.02, kShorter = 0.05, kLonger = 0.01;

}  // namespace

std::string stiffness_difference(const HydrodynamicCoefficients& set, std::size_t n, const Mesh& mesh, double waterline,
                                 const Vector3& cog) {
  if (n >= set.stiffness.size()) return {};
  const Matrix6& C = set.stiffness[n].C;
  const Vector3& p = set.stiffness[n].about;
  const WaterplaneIntegrals I = LinearFroudeKrylov(mesh, waterline, set.density, set.gravity).waterplane();
  const double weight = set.density * set.gravity;
  std::ostringstream found;
  found.precision(4);
  const auto report = [&](const char* entry, double file, double hull, const char* unit) {
    found << (found.tellp() > 0 ? ", " : "") << entry << " is " << file << " " << unit << ", the hull has " << hull;
  };
  if (!(std::abs(C(2, 2) - weight * I.area) <= kHeave * weight * I.area))
    report("C(3,3)", C(2, 2), weight * I.area, "N/m");
  // C(3,4) and C(3,5) as the place of the water plane's centre, which is easier to judge.
  if (C(2, 2) > 0.0 && std::isfinite(C(2, 3)) && std::isfinite(C(2, 4))) {
    const double x = p.x() - C(2, 4) / C(2, 2), y = p.y() + C(2, 3) / C(2, 2);
    if (std::abs(x - I.x / I.area) > kCentre * set.length)
      report("the centre of the water plane by C(3,5)", x, I.x / I.area, "m along the hull");
    if (std::abs(y - I.y / I.area) > kCentre * set.length)
      report("the centre of the water plane by C(3,4)", y, I.y / I.area, "m to port");
  }
  const double yy = I.yy - 2.0 * p.y() * I.y + p.y() * p.y() * I.area;
  const double xx = I.xx - 2.0 * p.x() * I.x + p.x() * p.x() * I.area;
  const double buoyancy = I.depth + I.volume * (waterline - p.z());
  const double heavy = I.volume * (cog.z() - p.z());
  const double allowed = weight * (kShorter * std::min(xx, yy) + kLonger * std::max(xx, yy));
  if (std::isfinite(C(3, 3)) && std::isfinite(C(4, 4))) {
    const auto matches = [&](double lever) {
      return std::abs(C(3, 3) - weight * (yy + lever)) <= allowed &&
             std::abs(C(4, 4) - weight * (xx + lever)) <= allowed;
    };
    const bool alike = std::abs((C(3, 3) - weight * yy) - (C(4, 4) - weight * xx)) <= allowed;
    if (!alike && !matches(buoyancy) && !matches(buoyancy - heavy)) {
      report("C(4,4)", C(3, 3), weight * (yy + buoyancy - heavy), "N m");
      report("C(5,5)", C(4, 4), weight * (xx + buoyancy - heavy), "N m");
    }
  }
  if (found.tellp() == 0) return {};
  return set.source +
         ": the hydrostatic stiffness that comes with the coefficients is not that of the hull: " + found.str() +
         "; is it the same hull at the same draft, and is database_origin_m right?";
}

}  // namespace stillhook
