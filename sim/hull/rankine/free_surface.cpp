#include "sim/hull/rankine/free_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook::rankine {
namespace {

using Point = Eigen::Vector2d;

struct Segment {
  Point a, b;
};

/// Edges of hull panels in the water plane.
std::vector<Segment> waterline(const HullPanels& hulls) {
  std::vector<Segment> segments;
  for (const FlatPanel& panel : hulls.panels)
    for (int i = 0; i < panel.corners; ++i) {
      const Vector3 &a = panel.v[i], &b = panel.v[(i + 1) % panel.corners];
      const double tolerance = 1e-7 * (1.0 + panel.reach);
      if (std::abs(a.z()) < tolerance && std::abs(b.z()) < tolerance && (b - a).norm() > tolerance)
        segments.push_back({a.head<2>(), b.head<2>()});
    }
  return segments;
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

class Waterplane {
 public:
  explicit Waterplane(std::vector<Strip> strips) : strips_(std::move(strips)) {}

  double distance(const Point& p) const { return distance_to(strips_, p); }

  /// Convex parts of the rectangle that are outside.
  std::vector<std::vector<Vector3>> outside(const Point& low, const Point& high) const {
    std::vector<std::vector<Vector3>> parts{
        {{low.x(), low.y(), 0.0}, {high.x(), low.y(), 0.0}, {high.x(), high.y(), 0.0}, {low.x(), high.y(), 0.0}}};
    for (const Strip& strip : strips_) {
      if (strip[0].x() >= high.x() || strip[1].x() <= low.x()) continue;
      std::vector<std::vector<Vector3>> left;
      for (std::vector<Vector3>& part : parts) subtract(std::move(part), strip, left);
      parts = std::move(left);
    }
    return parts;
  }

 private:
  static void subtract(std::vector<Vector3> part, const Strip& strip, std::vector<std::vector<Vector3>>& left) {
    std::vector<std::vector<Vector3>> off;
    const std::vector<Vector3> whole = part;
    for (int i = 0; i < 4 && part.size() >= 3; ++i) {
      const Point &a = strip[i], &b = strip[(i + 1) % 4];
      const Point d = b - a;
      if (d.norm() == 0.0) continue;
      const Vector3 outward = Vector3(d.y(), -d.x(), 0.0).normalized();
      const double offset = outward.head<2>().dot(a);
      std::vector<Vector3> beyond = clipped_polygon(part, outward, offset);
      if (beyond.size() >= 3) off.push_back(std::move(beyond));
      part = clipped_polygon(part, -outward, -offset);
    }
    if (part.size() < 3) {  // nothing of it is covered
      left.push_back(whole);
      return;
    }
    for (auto& piece : off) left.push_back(std::move(piece));
  }

  std::vector<Strip> strips_;
};

class Builder {
 public:
  Builder(const HullPanels& hulls, const FreeSurfaceGrid& grid)
      : grid_(grid), symmetry_(hulls.symmetry), waterplane_(waterplane_strips(hulls)) {
    low_ = Point::Constant(std::numeric_limits<double>::max());
    high_ = -low_;
    for (const Segment& s : waterline(hulls))
      for (const Point& p : {s.a, s.b}) {
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
      }
  }

  SurfacePanels build() {
    Point low = low_.array() - grid_.width, high = high_.array() + grid_.width;
    if (symmetry_.x) low.x() = 0.0;
    if (symmetry_.y) low.y() = 0.0;
    // Cells of the coarsest size, a power of two of the smallest, from the corner or the middle.
    double size = grid_.near;
    while (2.0 * size <= grid_.far) size *= 2.0;
    const int nx = static_cast<int>(std::ceil((high.x() - low.x()) / size)),
              ny = static_cast<int>(std::ceil((high.y() - low.y()) / size));
    if (!symmetry_.x) low.x() = 0.5 * (low.x() + high.x() - nx * size);
    if (!symmetry_.y) low.y() = 0.5 * (low.y() + high.y() - ny * size);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) divide(low + Point(i * size, j * size), size);
    join_slivers();
    return collect();
  }

 private:
  struct Cell {
    std::vector<FlatPanel> pieces;
    Vector3 centroid = Vector3::Zero();
    double area = 0.0, size = 0.0;
    void measure() {
      area = 0.0;
      centroid.setZero();
      for (const FlatPanel& piece : pieces) {
        area += piece.area;
        centroid += piece.area * piece.centroid;
      }
      centroid /= area;
    }
  };

  void divide(const Point& low, double size) {
    const Point middle = low.array() + 0.5 * size;
    const double s = std::max(0.0, waterplane_.distance(middle) - 0.71 * size);
    if (size > grid_.near * 1.0001 && size > grid_.largest(s)) {
      for (int k = 0; k < 4; ++k) divide(low + 0.5 * size * Point(k % 2, k / 2), 0.5 * size);
      return;
    }
    if (waterplane_.distance(middle) > grid_.width) return;
    Cell cell;
    cell.size = size;
    for (const auto& part : waterplane_.outside(low, low.array() + size))
      append_polygon(part, 1e-9 * size * size, cell.pieces);
    if (cell.pieces.empty()) return;
    cell.measure();
    cells_.push_back(std::move(cell));
  }

  void join_slivers() {
    constexpr double kSliver = 0.4;  // of a whole cell
    for (Cell& cell : cells_) {
      if (cell.area >= kSliver * cell.size * cell.size) continue;
      Cell* nearest = nullptr;
      double least = 4.0 * cell.size * cell.size;
      for (Cell& other : cells_) {
        if (&other == &cell || other.area < kSliver * other.size * other.size) continue;
        const double distance = (other.centroid - cell.centroid).squaredNorm();
        if (distance < least) {
          least = distance;
          nearest = &other;
        }
      }
      if (!nearest) continue;
      nearest->pieces.insert(nearest->pieces.end(), cell.pieces.begin(), cell.pieces.end());
      nearest->measure();
      cell.pieces.clear();
      cell.area = 0.0;
    }
  }

  /// The centroid; where that is not on the water, as round a hull's corner, the centroid of the largest piece.
  Vector3 collocation(const Cell& cell) const {
    if (cell.pieces.size() == 1 || waterplane_.distance(cell.centroid.head<2>()) > 0.0) return cell.centroid;
    return std::max_element(cell.pieces.begin(), cell.pieces.end(),
                            [](const FlatPanel& a, const FlatPanel& b) { return a.area < b.area; })
        ->centroid;
  }

  SurfacePanels collect() const {
    SurfacePanels result;
    for (const Cell& cell : cells_) {
      if (cell.pieces.empty()) continue;
      result.first.push_back(static_cast<int>(result.pieces.size()));
      result.pieces.insert(result.pieces.end(), cell.pieces.begin(), cell.pieces.end());
      result.point.push_back(collocation(cell));
      result.area.push_back(cell.area);
      result.distance.push_back(waterplane_.distance(result.point.back().head<2>()));
    }
    result.first.push_back(static_cast<int>(result.pieces.size()));
    return result;
  }

  FreeSurfaceGrid grid_;
  Symmetry symmetry_;
  Waterplane waterplane_;
  Point low_, high_;
  std::vector<Cell> cells_;
};

}  // namespace

double FreeSurfaceGrid::largest(double s) const {
  const double grown = std::min(far, near + growth * s);
  return reach > 0.0 ? std::min(grown, middle * std::pow(std::max(1.0, s / reach), 6)) : grown;
}

std::vector<Strip> waterplane_strips(const HullPanels& hulls) {
  const std::vector<Segment> segments = waterline(hulls);
  if (segments.empty()) throw MeshError("no panel reaches the still water plane: there is no waterline");
  std::vector<double> breaks;
  double scale = 0.0;
  for (const Segment& s : segments) {
    breaks.push_back(s.a.x());
    breaks.push_back(s.b.x());
    scale = std::max({scale, s.a.norm(), s.b.norm()});
  }
  std::sort(breaks.begin(), breaks.end());
  const double tolerance = 1e-6 * scale;
  std::vector<Strip> strips;
  double left = breaks.front();
  for (const double right : breaks) {
    if (right - left < tolerance) continue;
    const double middle = 0.5 * (left + right);
    std::vector<std::array<double, 3>> lines;  // y at the middle, left and right
    for (const Segment& s : segments) {
      if (std::abs(s.b.x() - s.a.x()) < 1e-3 * tolerance) continue;
      if (std::min(s.a.x(), s.b.x()) > middle || std::max(s.a.x(), s.b.x()) < middle) continue;
      const double slope = (s.b.y() - s.a.y()) / (s.b.x() - s.a.x());
      const auto y = [&](double x) { return s.a.y() + slope * (x - s.a.x()); };
      lines.push_back({y(middle), y(left), y(right)});
    }
    if (lines.size() % 2 == 1 && hulls.symmetry.y) lines.push_back({0.0, 0.0, 0.0});
    if (lines.size() % 2 == 1) throw MeshError("the waterline is not closed");
    std::sort(lines.begin(), lines.end());
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2)
      strips.push_back({Point(left, lines[i][1]), Point(right, lines[i][2]), Point(right, lines[i + 1][2]),
                        Point(left, lines[i + 1][1])});
    left = right;
  }
  return strips;
}

double distance_to(const std::vector<Strip>& strips, const Point& p) {
  double least = std::numeric_limits<double>::max();
  for (const Strip& strip : strips) {
    bool inside = true;
    for (int i = 0; i < 4; ++i) {
      const Point &a = strip[i], &b = strip[(i + 1) % 4];
      const Point along = b - a;
      inside = inside && cross(along, p - a) >= 0.0;
      const double length2 = along.squaredNorm();
      const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
      least = std::min(least, (p - a - t * along).norm());
    }
    if (inside) return 0.0;
  }
  return least;
}

double waterplane_area(const HullPanels& hulls) {
  double area = 0.0;
  for (const Strip& strip : waterplane_strips(hulls))
    area += 0.5 * (cross(strip[1] - strip[0], strip[2] - strip[0]) + cross(strip[2] - strip[0], strip[3] - strip[0]));
  return area * hulls.symmetry.images();
}

SurfacePanels free_surface(const HullPanels& hulls, const FreeSurfaceGrid& grid) {
  return Builder(hulls, grid).build();
}

}  // namespace stillhook::rankine
