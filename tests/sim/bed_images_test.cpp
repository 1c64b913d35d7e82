// The images of panels in the water plane and the bed, against the sums themselves.
#include "sim/hull/rankine/bed_images.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace stillhook;
using namespace stillhook::rankine;

namespace {

constexpr double kDepth = 12.0;  // m

FlatPanel square(const Vector3& centre, double side, const Vector3& u, const Vector3& v) {
  const double s = 0.5 * side;
  return flat_panel(std::array<Vector3, 4>{centre - s * u - s * v, centre + s * u - s * v, centre + s * u + s * v,
                                           centre - s * u + s * v});
}

/// A panel so small that it is a point of its area, upright and turned.
FlatPanel point_at(const Vector3& centre) {
  return square(centre, 1e-3, Vector3(0.8, 0.6, 0.0), Vector3(-0.36, 0.48, 0.8));
}

/// sum_n (1/r_n - 1/|2nh|), n = 0 whole: the sum that P has without its constant, which is ln(4h/R) - gamma far away.
/// Images beyond kImages by their mean slope: their sum is below 1e-9/h.
double direct_sum(double R, double s, bool alternating) {
  constexpr int kImages = 20000;
  double sum = 1.0 / std::hypot(R, s);
  for (int n = 1; n <= kImages; ++n) {
    const double pair = 1.0 / std::hypot(R, s - 2.0 * n * kDepth) + 1.0 / std::hypot(R, s + 2.0 * n * kDepth);
    if (alternating)
      sum += (n % 2 ? -1.0 : 1.0) * (n == kImages ? 0.5 : 1.0) * pair;  // half of the last: the mean of the two limits
    else
      sum += pair - 1.0 / (n * kDepth);
  }
  return sum;
}

}  // namespace

TEST_CASE("images of a panel in bed and surface are the sum over all of them", "[rankine]") {
  const double edge = 400.0;
  const BedImages bed({kDepth, edge});
  const double level = std::log(edge / (4.0 * kDepth)) + std::numbers::egamma;
  for (const double z0 : {-0.5, -5.0, -11.0})
    for (const double z : {0.0, -3.0, -10.5})
      for (const double R : {2.0, 9.0, 40.0, 71.0, 73.0, 107.0, 109.0, 300.0}) {
        INFO("R = " << R << ", z = " << z << ", z0 = " << z0);
        const FlatPanel panel = point_at({0.0, 0.0, z0});
        const Vector3 x(0.6 * R, -0.8 * R, z);
        const double even = direct_sum(R, z - z0, false) + direct_sum(R, z + z0, false) + 2.0 * level / kDepth;
        const double odd = direct_sum(R, z - z0, true) - direct_sum(R, z + z0, true);
        // The table's cubics: 1e-6/h is a millionth of the influence of a panel as near as the bed.
        CHECK(bed.even(panel, x).S / panel.area == Approx(even).margin(1e-6 / kDepth));
        CHECK(bed.odd(panel, x).S / panel.area == Approx(odd).margin(1e-6 / kDepth));
      }
  // The level is zero at the edge of the beach, for all heights: far away only the logarithm is left.
  CHECK(bed.half(point_at({0.0, 0.0, -3.0}), Vector3(edge, 0.0, -7.0)).S == Approx(0.0).margin(1e-15));
}

TEST_CASE("over the bed the flow along a panel's normal is the slope of its source", "[rankine]") {
  const BedImages bed({kDepth, 400.0});
  for (const double R : {3.0, 20.0, 100.0})
    for (const double z0 : {-2.0, -10.0}) {
      INFO("R = " << R << ", z0 = " << z0);
      const Vector3 centre(0.0, 0.0, z0), x(R, 1.0, -6.0);
      const FlatPanel panel = point_at(centre);
      constexpr double kStep = 1e-3;  // m: the difference of 1/r over it is good to (kStep/R)^2 = 1e-7
      const FlatPanel ahead = point_at(centre + kStep * panel.normal), behind = point_at(centre - kStep * panel.normal);
      const auto slope = [&](Influence (BedImages::*kernel)(const FlatPanel&, const Vector3&) const) {
        return ((bed.*kernel)(ahead, x).S - (bed.*kernel)(behind, x).S) / (2.0 * kStep);
      };
      const double scale = panel.area / (R * R);
      CHECK(bed.even(panel, x).D == Approx(slope(&BedImages::even)).margin(2e-5 * scale));
      CHECK(bed.odd(panel, x).D == Approx(slope(&BedImages::odd)).margin(2e-5 * scale));
    }
}

TEST_CASE("a panel longer than the water is deep is the sum of its parts", "[rankine]") {
  const BedImages bed({kDepth, 900.0});
  constexpr int kParts = 40;
  constexpr double kSide = 60.0;
  const FlatPanel whole = square(Vector3::Zero(), kSide, Vector3::UnitX(), Vector3::UnitY());
  for (const double x : {0.0, 31.0, 60.0, 130.0, 300.0}) {
    const Vector3 at(x, 4.0, -1.0);
    double parts = 0.0;
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; j < kParts; ++j) {
        const double step = kSide / kParts;
        parts += bed.half(square({(i + 0.5) * step - 0.5 * kSide, (j + 0.5) * step - 0.5 * kSide, 0.0}, step,
                                 Vector3::UnitX(), Vector3::UnitY()),
                          at)
                     .S;
      }
    INFO("x = " << x);
    // 1e-3 of a panel's own influence, about 3.5 times its side: what moments at five reaches leave is 2e-4.
    CHECK(bed.half(whole, at).S == Approx(parts).margin(1e-3 * 3.5 * kSide));
  }
}

TEST_CASE("a bed far below is no bed", "[rankine]") {
  const FlatPanel panel = square({1.0, 2.0, -3.0}, 2.0, Vector3::UnitX(), Vector3::UnitZ());
  const Vector3 x(9.0, -4.0, -1.0), mirrored(9.0, -4.0, 1.0);
  const BedImages bed({1e5, 50.0});
  const Influence direct = influence(panel, x), image = influence(panel, mirrored);
  // The images are 2e5 m away and their level is taken off: what is left of them varies as (R/h)^2/h.
  CHECK(bed.even(panel, x).S == Approx(direct.S + image.S).epsilon(1e-8));
  CHECK(bed.odd(panel, x).S == Approx(direct.S - image.S).epsilon(1e-8));
  CHECK(bed.even(panel, x).D == Approx(direct.D + image.D).epsilon(1e-8));
}
