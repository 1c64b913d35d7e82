#include "results/pose_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "results/html.h"

namespace stillhook {
namespace {

using Point = Eigen::Vector2d;

constexpr double kWidth = 360.0, kGap = 10.0, kTitle = 20.0, kMargin = 6.0;  // user units
constexpr double kSmallest = 4.0;                                            // m, the least that a view shows
constexpr double kNear = 15.0;                                               // m, how much of a support is shown
constexpr double kTallest = 1.6;                                             // height of a view over its width
constexpr double kDeepest = -30.0;                                           // m, what lies deeper is cut off

/// Which two world coordinates a view shows.
struct View {
  int across, up;
};
constexpr View kElevation{0, 2}, kPlan{0, 1};

Point project(const Vector3& p_W, View view) { return {p_W[view.across], p_W[view.up]}; }

Vector3 world(const StaticPose& pose, int body, const Vector3& p_B) {
  return body < 0 || static_cast<std::size_t>(body) >= pose.bodies.size()
             ? p_B
             : pose.bodies[static_cast<std::size_t>(body)] * p_B;
}

/// Counter-clockwise hull of points in a plane (Andrew's monotone chain).
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  if (points.size() < 3) return points;
  const auto turns_left = [](const Point& a, const Point& b, const Point& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0.0;
  };
  std::vector<Point> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= first + 2 && !turns_left(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// World coordinates to a panel of the drawing, both axes to one scale.
struct Frame {
  double scale;  // user units per m
  Point low;     // m, shown at the lower left corner
  double left, bottom;
  Point operator()(const Point& p) const {
    return {left + scale * (p.x() - low.x()), bottom - scale * (p.y() - low.y())};
  }
};

const char* fill_of(SceneBody::Kind kind) {
  switch (kind) {
    case SceneBody::Kind::crane:
      return "#c5ced6";
    case SceneBody::Kind::vessel:
      return "#dcd5ca";
    case SceneBody::Kind::load:
      return "#e3a48f";
    case SceneBody::Kind::member:
      break;
  }
  return "#e8d9a8";
}

std::string draw_body(const SceneBody& body, const StaticPose& pose, int index, View view, const Frame& f) {
  std::string out = "<g><title>" + escape_html(readable_name(body.name)) + "</title>";
  for (const SceneBody::Member& m : body.pedestals) {
    const Point a = f(project(world(pose, index, m.from), view)), b = f(project(world(pose, index, m.to), view));
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#8b97a3\" stroke-width=\"{:.1f}\"/>", a.x(),
                       a.y(), b.x(), b.y(), std::max(1.5, 2.0 * m.radius * f.scale));
  }
  for (const SceneBody::Member& m : body.members) {
    const Point a = f(project(world(pose, index, m.from), view)), b = f(project(world(pose, index, m.to), view));
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#9a7a1c\" stroke-width=\"{:.1f}\"/>", a.x(),
                       a.y(), b.x(), b.y(), std::max(1.5, 0.8 * m.radius * f.scale));
  }
  for (const Mesh* mesh : {&body.mesh, &body.envelope}) {
    if (mesh->vertices.empty()) continue;
    std::vector<Point> points;
    for (const Vector3& v : mesh->vertices) points.push_back(project(world(pose, index, v), view));
    std::string d;
    for (const Point& p : convex_hull(std::move(points)))
      d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", f(p).x(), f(p).y());
    out += fmt::format("<path d=\"{}z\" fill=\"{}\" fill-opacity=\".85\" stroke=\"#1c2329\" stroke-width=\".8\"/>", d,
                       mesh == &body.mesh ? fill_of(body.kind) : "none");
  }
  return out + "</g>";
}

/// The bodies in the order in which they are painted: what floats first, what is lifted above it; in plan the higher
/// one above the lower.
std::vector<std::size_t> painting_order(const Scene& scene, const StaticPose& pose, View view) {
  const auto floats = [&](std::size_t i) {
    return scene.bodies[i].kind == SceneBody::Kind::crane || scene.bodies[i].kind == SceneBody::Kind::vessel;
  };
  const auto top = [&](std::size_t i) {
    double z = world(pose, static_cast<int>(i), Vector3::Zero()).z();
    for (const Vector3& v : scene.bodies[i].mesh.vertices) z = std::max(z, world(pose, static_cast<int>(i), v).z());
    for (const SceneBody::Member& m : scene.bodies[i].members)
      for (const Vector3& v : {m.from, m.to}) z = std::max(z, world(pose, static_cast<int>(i), v).z());
    return z;
  };
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    order.emplace_back(floats(i) ? -std::numeric_limits<double>::infinity() : view.up == 2 ? 0.0 : top(i), i);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::size_t> indices;
  for (const auto& [height, index] : order) indices.push_back(index);
  return indices;
}

std::string draw_lines(const Scene& scene, const StaticPose& pose, View view, const Frame& f) {
  std::string d;
  for (const SceneLine& line : scene.lines) {
    if (line.kind == SceneLine::Kind::tagline) continue;
    const Point a = f(project(world(pose, line.from, line.point_from), view));
    const Point b = f(project(world(pose, line.to, line.point_to), view));
    d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
  }
  return d.empty() ? "" : "<path d=\"" + d + "\" stroke=\"#005c94\" stroke-width=\"1.1\" fill=\"none\"/>";
}

std::string draw_surfaces(const Scene& scene, const StaticPose& pose, View view, const Frame& f) {
  std::string out;
  for (const SceneSurface& s : scene.surfaces) {
    std::vector<Point> points;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        points.push_back(project(world(pose, s.body, s.centre + Vector3(x * s.length, y * s.breadth, 0.0)), view));
    std::string d;
    for (const Point& p : convex_hull(std::move(points)))
      d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", f(p).x(), f(p).y());
    out += fmt::format("<path d=\"{}z\" fill=\"none\" stroke=\"#00603a\" stroke-width=\"1.4\"/>", d);
  }
  return out;
}

std::string draw_panel(const Scene& scene, const StaticPose& pose, const Vector3& target, View view, const Frame& f,
                       const Point& high) {
  const Point top = f(high), corner = f(f.low);
  std::string out = fmt::format(  // an <svg> of its own cuts off what lies outside
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" viewBox=\"{0:.1f} {1:.1f} {2:.1f} "
      "{3:.1f}\">",
      corner.x(), top.y(), top.x() - corner.x(), corner.y() - top.y());
  out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>", corner.x(),
                     top.y(), top.x() - corner.x(), corner.y() - top.y(), view.up == 2 ? "#fff" : "#eef4f7");
  if (view.up == 2) {
    const double water = f({0.0, 0.0}).y();
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#dbe8ee\"/>",
                       corner.x(), water, top.x() - corner.x(), std::max(0.0, corner.y() - water));
  }
  bool afloat = true;
  for (const std::size_t i : painting_order(scene, pose, view)) {
    const SceneBody::Kind kind = scene.bodies[i].kind;
    if (afloat && kind != SceneBody::Kind::crane && kind != SceneBody::Kind::vessel) {
      out += draw_surfaces(scene, pose, view, f);
      afloat = false;
    }
    out += draw_body(scene.bodies[i], pose, static_cast<int>(i), view, f);
  }
  if (afloat) out += draw_surfaces(scene, pose, view, f);
  out += draw_lines(scene, pose, view, f);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"7\" fill=\"#56626c\">{}</text>", corner.x() + 3.0,
                     top.y() + 9.0, view.up == 2 ? "elevation from starboard" : "plan");
  const Point cross = f(project(target, view));
  return out + fmt::format("<path d=\"M{:.1f} {:.1f}h10m-5 -5v10\" stroke=\"#00603a\" fill=\"none\"/></svg>",
                           cross.x() - 5.0, cross.y());
}

/// A round length of about `wanted` m.
double nice_length(double wanted) {
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  return power * (wanted < 2.0 * power ? 1.0 : wanted < 5.0 * power ? 2.0 : 5.0);
}

/// Nothing would be seen to have moved: less than 0.1 m and 0.1 deg.
bool looks_like(const StaticPose& a, const StaticPose& b) {
  for (std::size_t i = 0; i < a.bodies.size() && i < b.bodies.size(); ++i)
    if ((a.bodies[i].p - b.bodies[i].p).norm() > 0.1 ||
        log_rotation(a.bodies[i].R.transpose() * b.bodies[i].R).norm() > 0.1 * std::numbers::pi / 180.0)
      return false;
  return true;
}

struct Extent {
  Vector3 low = Vector3::Constant(1e9), high = Vector3::Constant(-1e9);
  void add(const Vector3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

Extent extent_of(const Scene& scene, const std::vector<StaticPose>& poses, const Vector3& target) {
  Extent e;
  e.add(target);
  for (const StaticPose& pose : poses)
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      // A barge that is towed away may leave the drawing.
      if (scene.bodies[i].kind == SceneBody::Kind::vessel && &pose != &poses.front()) continue;
      const int index = static_cast<int>(i);
      for (const Vector3& v : scene.bodies[i].mesh.vertices) e.add(world(pose, index, v));
      for (const SceneBody::Member& m : scene.bodies[i].members)
        for (const Vector3& v : {m.from, m.to}) e.add(world(pose, index, v));
      if (scene.bodies[i].mesh.vertices.empty() && scene.bodies[i].members.empty())
        e.add(world(pose, index, Vector3::Zero()));
    }
  for (const SceneSurface& s : scene.surfaces)  // of a sea bed without end only what is near its middle
    for (const double side : {-1.0, 1.0})
      e.add(world(poses.front(), s.body,
                  s.centre + side * Vector3(std::min(kNear, 0.5 * s.length), std::min(kNear, 0.5 * s.breadth), 0.0)));
  const Vector3 room = Vector3::Constant(0.03 * (e.high - e.low).maxCoeff());
  e.low -= room;
  e.high += room;
  e.low.z() = std::min(std::max(e.low.z(), kDeepest), e.high.z());
  // All views share the x axis: a lift that is tall or wide, or has no size at all, gets room at its sides.
  const double across = std::max({kSmallest, (e.high.y() - e.low.y()) / kTallest, (e.high.z() - e.low.z()) / kTallest});
  for (const int axis : {0, 1, 2}) {
    const double wanted = axis == 0 ? across : kSmallest;
    const double missing = 0.5 * std::max(0.0, wanted - (e.high[axis] - e.low[axis]));
    e.low[axis] -= missing;
    e.high[axis] += missing;
  }
  return e;
}

}  // namespace

std::vector<PoseDrawing> draw_named_poses(const Scene& scene, const std::vector<StaticPose>& poses,
                                          const Vector3& target) {
  if (poses.empty() || scene.bodies.empty()) return {};
  const Extent e = extent_of(scene, poses, target);
  const double scale = (kWidth - 2.0 * kMargin) / (e.high.x() - e.low.x());
  const double elevation_height = scale * (e.high.z() - e.low.z()), plan_height = scale * (e.high.y() - e.low.y());
  const double plan_bottom = kTitle + elevation_height + kGap + plan_height, height = plan_bottom + 22.0;
  const double bar = nice_length((e.high.x() - e.low.x()) / 5.0);
  std::vector<PoseDrawing> drawings;
  const StaticPose* before = nullptr;
  for (const StaticPose& pose : poses) {
    if (before && looks_like(*before, pose)) continue;
    before = &pose;
    const std::string name = escape_html(readable_name(pose.name));
    std::string svg = fmt::format(
        "<svg class=\"pose\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "font-family=\"system-ui,'Segoe UI',Helvetica,Arial,sans-serif\" font-size=\"11\" fill=\"#1c2329\"><title>{}: "
        "elevation and plan</title><text x=\"{}\" y=\"13\" font-weight=\"600\">{}</text>",
        kWidth, height, name, kMargin, name);
    const Frame elevation{scale, {e.low.x(), e.low.z()}, kMargin, kTitle + elevation_height};
    const Frame plan{scale, {e.low.x(), e.low.y()}, kMargin, plan_bottom};
    svg += draw_panel(scene, pose, target, kElevation, elevation, {e.high.x(), e.high.z()});
    svg += draw_panel(scene, pose, target, kPlan, plan, {e.high.x(), e.high.y()});
    svg += fmt::format(
        "<path d=\"M{} {:.1f}v4h{:.1f}v-4\" stroke=\"#1c2329\" fill=\"none\"/><text x=\"{:.1f}\" "
        "y=\"{:.1f}\">{} m</text></svg>",
        kMargin, plan_bottom + 6.0, scale * bar, kMargin + scale * bar + 6.0, plan_bottom + 14.0, readable_number(bar));
    drawings.push_back({pose.name, std::move(svg)});
  }
  return drawings;
}

std::vector<std::string> draw_poses(const Scene& scene, const std::vector<StaticPose>& poses, const Vector3& target) {
  std::vector<std::string> drawings;
  for (PoseDrawing& drawing : draw_named_poses(scene, poses, target)) drawings.push_back(std::move(drawing.svg));
  return drawings;
}

}  // namespace stillhook
