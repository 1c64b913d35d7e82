#include "sim/hull/rankine/bed_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace stillhook::rankine {

/// A function of (x, s) with its slopes, all in depths.
struct ImageSum {
  double f = 0.0, x = 0.0, s = 0.0, xs = 0.0;
};

namespace {

constexpr double kTableStep = 0.1;  // of the tables, depths: cubics between values and slopes are then good to 1e-7/h
constexpr double kHeights = 2.0;    // depths: |s| is at most that
// Depths: up to this |s|, and for panels of at most this reach, the images n = +-1 are points far enough away to be in
// the table: at 1.5 depths or more, they are wrong by (reach/1.5 h)^2/8 < 4e-3 of themselves.
constexpr double kNear = 0.5, kSmall = 0.25;
constexpr double kPlane = 6.0;    // depths, beyond which P is a logarithm
constexpr double kNothing = 9.0;  // depths, beyond which P- is nothing
constexpr double kWhole = 0.5;    // depths: panels of a longer reach are taken in pieces
constexpr int kSummed = 40;       // images summed one by one; of the others the multipoles, to (9/80)^6

/// 1/sqrt(x^2 + s^2) times weight, added.
void add_source(double x, double s, double weight, ImageSum& v) {
  const double r2 = x * x + s * s, i1 = weight / std::sqrt(r2), i3 = i1 / r2;
  v.f += i1;
  v.x -= x * i3;
  v.s -= s * i3;
  v.xs += 3.0 * x * s * i3 / r2;
}

/// The multipoles of second and fourth order about x = s = 0 of sources at s = +-2n, with weights sum n^-3 and n^-5.
void add_multipoles(double x, double s, double third, double fifth, ImageSum& v) {
  const double a = 0.25 * third, b = 0.0625 * fifth, x2 = x * x, s2 = s * s;
  v.f += a * (s2 - 0.5 * x2) + b * (s2 * s2 - 3.0 * s2 * x2 + 0.375 * x2 * x2);
  v.x += -a * x + b * (-6.0 * s2 * x + 1.5 * x2 * x);
  v.s += 2.0 * a * s + b * (4.0 * s2 * s - 6.0 * s * x2);
  v.xs += -12.0 * b * s * x;
}

/// sum_{|n| >= first} 1/r_n - sum_{n > 0} 1/n, so that with the others it is ln(4/x) - gamma far away.
ImageSum even_rest(double x, double s, int first) {
  ImageSum v;
  for (int n = first; n <= kSummed; ++n) {
    add_source(x, s - 2.0 * n, 1.0, v);
    add_source(x, s + 2.0 * n, 1.0, v);
    v.f -= 1.0 / n;
  }
  for (int n = 1; n < first; ++n) v.f -= 1.0 / n;
  constexpr double N = kSummed + 0.5;  // Euler and Maclaurin: sum_{n > N} n^-p = (N + 1/2)^(1-p)/(p-1) (1 + O(N^-2))
  add_multipoles(x, s, 0.5 / (N * N) * (1.0 - 0.25 / (N * N)), 0.25 / std::pow(N, 4), v);
  return v;
}

/// sum_{|n| >= first} (-1)^n/r_n
ImageSum odd_rest(double x, double s, int first) {
  ImageSum v;
  for (int n = first; n <= kSummed; ++n) {
    const double sign = n % 2 ? -1.0 : 1.0;
    add_source(x, s - 2.0 * n, sign, v);
    add_source(x, s + 2.0 * n, sign, v);
  }
  static_assert(kSummed % 2 == 0);
  // sum_{n > N} (-1)^n n^-p = -(N + 1/2)^-p/2 (1 - p (p + 1)/8 (N + 1/2)^-2 + ...) for even N.
  constexpr double N = kSummed + 0.5;
  const auto rest = [&](double p) { return -0.5 * std::pow(N, -p) * (1.0 - p * (p + 1.0) / (8.0 * N * N)); };
  v.f += rest(1.0);
  add_multipoles(x, s, rest(3.0), rest(5.0), v);
  return v;
}

/// Beyond the tables: what the images |n| < first leave of a logarithm, or of nothing.
ImageSum beyond_table(double x, double s, bool even, int first) {
  ImageSum v;
  if (even) {
    v.f = std::log(4.0 / x) - std::numbers::egamma;
    v.x = -1.0 / x;
  }
  add_source(x, s, -1.0, v);
  for (int n = 1; n < first; ++n)
    for (const double shift : {-2.0 * n, 2.0 * n}) add_source(x, s + shift, even || n % 2 == 0 ? -1.0 : 1.0, v);
  return v;
}

}  // namespace

/// Cubic in both directions between values and slopes.
struct BedImages::Table {
  double width;  // depths
  bool even;
  int first;  // |n| of the nearest image that is in it
  int rows, columns;
  std::vector<ImageSum> node;

  Table(bool all_alike, int nearest)
      : width(all_alike ? kPlane : kNothing),
        even(all_alike),
        first(nearest),
        rows(static_cast<int>(std::lround(width / kTableStep)) + 1),
        columns(static_cast<int>(std::lround((nearest == 1 ? kNear : kHeights) / kTableStep)) + 1) {
    node.reserve(static_cast<std::size_t>(rows * columns));
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j)
        node.push_back(even ? even_rest(kTableStep * i, kTableStep * j, first)
                            : odd_rest(kTableStep * i, kTableStep * j, first));
  }

  static std::array<double, 4> weights(double q) {
    const double p = 1.0 - q;
    return {p * p * (1.0 + 2.0 * q), q * q * (1.0 + 2.0 * p), kTableStep * q * p * p, -kTableStep * q * q * p};
  }
  static std::array<double, 4> slopes(double q) {
    const double p = 1.0 - q;
    return {-6.0 * q * p / kTableStep, 6.0 * q * p / kTableStep, p * (p - 2.0 * q), q * (q - 2.0 * p)};
  }

  /// At s = 0, where panels and points of the water's surface are.
  ImageSum flat(int i, double t) const {
    const ImageSum &a = node[static_cast<std::size_t>(i * columns)],
                   &b = node[static_cast<std::size_t>((i + 1) * columns)];
    const std::array<double, 4> w = weights(t), dw = slopes(t);
    return {w[0] * a.f + w[1] * b.f + w[2] * a.x + w[3] * b.x, dw[0] * a.f + dw[1] * b.f + dw[2] * a.x + dw[3] * b.x,
            0.0, 0.0};
  }

  /// f and its slopes in x and s.
  ImageSum at(double x, double s) const {
    if (x >= width) return beyond_table(x, s, even, first);
    const double height = std::abs(s);
    const int i = std::min(static_cast<int>(x / kTableStep), rows - 2);
    const int j = std::min(static_cast<int>(height / kTableStep), columns - 2);
    const double t = x / kTableStep - i, u = height / kTableStep - j;
    if (s == 0.0) return flat(i, t);
    const std::array<double, 4> a = weights(t), da = slopes(t), b = weights(u), db = slopes(u);
    ImageSum v;
    for (int k = 0; k < 2; ++k)
      for (int l = 0; l < 2; ++l) {
        const ImageSum& n = node[static_cast<std::size_t>((i + k) * columns + j + l)];
        const double f = b[l] * n.f + b[2 + l] * n.s, fx = b[l] * n.x + b[2 + l] * n.xs;
        v.f += a[k] * f + a[2 + k] * fx;
        v.x += da[k] * f + da[2 + k] * fx;
        v.s += a[k] * (db[l] * n.f + db[2 + l] * n.s) + a[2 + k] * (db[l] * n.x + db[2 + l] * n.xs);
      }
    if (s < 0.0) v.s = -v.s;
    return v;
  }
};

BedImages::BedImages(const Bed& bed)
    : depth_(bed.depth),
      even_(std::make_unique<const Table>(true, 2)),
      odd_(std::make_unique<const Table>(false, 2)),
      near_even_(std::make_unique<const Table>(true, 1)),
      near_odd_(std::make_unique<const Table>(false, 1)) {
  // ln(R0/4h) + gamma, which is zero for R0 = 4 exp(-gamma) h.
  constant_ = std::max(0.0, std::log(bed.edge / (4.0 * depth_)) + std::numbers::egamma);
}

BedImages::~BedImages() = default;

/// The images of a table, without the constant.
Influence BedImages::rest_of(const FlatPanel& panel, const Vector3& x, const Table& table) const {
  Influence sum;
  const auto add = [&](const Vector3& centre, double area) {
    const Vector3 from = (x - centre) / depth_;
    const double R = std::hypot(from.x(), from.y());
    const ImageSum rest = table.at(R, from.z());
    sum.S += area * rest.f;
    // The slope along the source's normal is minus that along the distance.
    const double along = panel.normal.x() * from.x() + panel.normal.y() * from.y();
    sum.D -= area * ((R > 0.0 ? rest.x * along / R : 0.0) + rest.s * panel.normal.z());
  };
  if (panel.reach <= kWhole * depth_) {
    add(panel.centroid, panel.area);
  } else {
    const int cuts = static_cast<int>(std::ceil(panel.reach / (kWhole * depth_)));
    for (int i = 1; i + 1 < panel.corners; ++i) {
      const Vector3 u = (panel.v[i] - panel.v[0]) / cuts, v = (panel.v[i + 1] - panel.v[0]) / cuts;
      const double area = 0.5 * panel.normal.dot(u.cross(v));
      for (int a = 0; a < cuts; ++a)
        for (int b = 0; a + b < cuts; ++b) {
          const Vector3 corner = panel.v[0] + a * u + b * v;
          add(corner + (u + v) / 3.0, area);
          if (a + b + 1 < cuts) add(corner + (u + v) / 1.5, area);
        }
    }
  }
  return {sum.S / depth_, sum.D / (depth_ * depth_)};
}

/// P where it is a logarithm; from: from the centroid to the point, R: its horizontal length.
Influence BedImages::of_plane(const FlatPanel& panel, const Vector3& from, double R) const {
  const Matrix3& M = panel.moment;
  const double R2 = R * R, level = constant_ + std::log(4.0 * depth_ / R) - std::numbers::egamma;
  // The logarithm bends by -1/R^2 across R and 1/R^2 along it.
  const double along =
      (from.x() * from.x() * M(0, 0) + 2.0 * from.x() * from.y() * M(0, 1) + from.y() * from.y() * M(1, 1)) / R2;
  const double bend = (along - 0.5 * (M(0, 0) + M(1, 1))) / R2;
  const double normal = panel.normal.x() * from.x() + panel.normal.y() * from.y();
  return {(panel.area * level + bend) / depth_, panel.area * normal / (R2 * depth_)};
}

Influence BedImages::half(const FlatPanel& panel, const Vector3& x) const {
  const Vector3 from = x - panel.centroid;
  const double R = std::hypot(from.x(), from.y());
  if (R >= kPlane * depth_ + panel.reach && R >= kFar * panel.reach) return of_plane(panel, from, R);
  if (panel.reach <= kSmall * depth_ && std::abs(from.z()) <= kNear * depth_) {
    const Influence own = influence(panel, x), images = rest_of(panel, x, *near_even_);
    return {own.S + images.S + panel.area * constant_ / depth_, own.D + images.D};
  }
  Influence sum = rest_of(panel, x, *even_);
  sum.S += panel.area * constant_ / depth_;
  for (const double shift : {0.0, -2.0 * depth_, 2.0 * depth_}) {
    const Influence image = influence(panel, Vector3(x.x(), x.y(), x.z() + shift));
    sum.S += image.S;
    sum.D += image.D;
  }
  return sum;
}

Influence BedImages::alternating(const FlatPanel& panel, const Vector3& x) const {
  const Vector3 from = x - panel.centroid;
  if (std::hypot(from.x(), from.y()) >= kNothing * depth_ + panel.reach) return {};
  if (panel.reach <= kSmall * depth_ && std::abs(from.z()) <= kNear * depth_) {
    const Influence own = influence(panel, x), images = rest_of(panel, x, *near_odd_);
    return {own.S + images.S, own.D + images.D};
  }
  Influence sum = rest_of(panel, x, *odd_);
  for (const double n : {0.0, -1.0, 1.0}) {
    const Influence image = influence(panel, Vector3(x.x(), x.y(), x.z() + 2.0 * n * depth_));
    sum.S += n == 0.0 ? image.S : -image.S;
    sum.D += n == 0.0 ? image.D : -image.D;
  }
  return sum;
}

Influence BedImages::even(const FlatPanel& panel, const Vector3& x) const {
  const Influence a = half(panel, x), b = half(panel, Vector3(x.x(), x.y(), -x.z()));
  return {a.S + b.S, a.D + b.D};
}

Influence BedImages::odd(const FlatPanel& panel, const Vector3& x) const {
  const Influence a = alternating(panel, x), b = alternating(panel, Vector3(x.x(), x.y(), -x.z()));
  return {a.S - b.S, a.D - b.D};
}

}  // namespace stillhook::rankine
