// g++ 12 takes the deliberately undefined operand of its own AVX-512 intrinsics for an uninitialised variable once
// FCL's templates are inlined (GCC bug 105593); the switch counts where the intrinsics' header is read, so it comes
// first.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include "results/clearance.h"

#include <fcl/fcl.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "sim/run_channels.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// A shape as FCL sees it: geometry centred on its own frame, and the pose of that frame in the body.
struct Solid {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  Pose X_BG;
};

Solid build_solid(const ClearanceSpec::Shape& shape) {
  Solid solid;
  solid.X_BG.p = 0.5 * (shape.from + shape.to);
  const Vector3 span = shape.to - shape.from;
  if (shape.radius <= 0.0) {
    solid.geometry = std::make_shared<fcl::Boxd>(span.cwiseAbs());
    return solid;
  }
  const double length = span.norm();
  if (length == 0.0) {
    solid.geometry = std::make_shared<fcl::Sphered>(shape.radius);
    return solid;
  }
  // FCL's capsule lies along z.
  solid.X_BG.R = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), span).toRotationMatrix();
  solid.geometry = std::make_shared<fcl::Capsuled>(shape.radius, length);
  return solid;
}

fcl::Transform3d transform(const Pose& X_WG) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = X_WG.R;
  t.translation() = X_WG.p;
  return t;
}

double solid_distance(const Solid& a, const Pose& X_WA, const Solid& b, const Pose& X_WB) {
  fcl::DistanceRequestd request;  // the default solver, libccd: the other one over-estimates distances
  request.distance_tolerance = 1e-6;
  fcl::DistanceResultd result;
  fcl::distance(a.geometry.get(), transform(X_WA * a.X_BG), b.geometry.get(), transform(X_WB * b.X_BG), request,
                result);
  return std::max(0.0, result.min_distance);
}

/// The recorded pose of a body by sample.
class BodyTrack {
 public:
  BodyTrack(const RunView& view, const std::string& body) : fixed_(body == "world") {
    if (fixed_) return;
    for (std::size_t i = 0; i < 6; ++i) series_[i] = view.series(body_channels::pose[i].of(body));
  }
  bool recorded() const {
    return fixed_ || std::none_of(series_, series_ + 6, [](const auto& s) { return s.empty(); });
  }
  Pose operator()(std::size_t i) const {
    if (fixed_) return {};
    return {rotation_from({series_[3][i], series_[4][i], series_[5][i]}),
            {series_[0][i], series_[1][i], series_[2][i]}};
  }

 private:
  bool fixed_;
  std::span<const double> series_[6];
};

/// A distance at some samples, with the smallest of every phase.
class DistanceSearch {
 public:
  DistanceSearch(const RunView& view, std::function<double(std::size_t)> distance)
      : view_(view),
        distance_(std::move(distance)),
        known_(view.run().time.size(), kNaN),
        least_(view.run().phases.size()) {
    for (const std::size_t p : view.all_phases()) ranges_.push_back(view.samples(p));
  }

  double look(std::size_t i) {
    known_[i] = distance_(i);
    for (std::size_t p = 0; p < ranges_.size(); ++p)
      if (i >= ranges_[p].first && i < ranges_[p].last) least_[p].take_smaller(known_[i], view_.run().time[i]);
    return known_[i];
  }
  /// True if a distance as low as this at sample i would be the smallest of a phase.
  bool could_matter(double lowest, std::size_t i) const {
    for (std::size_t p = 0; p < ranges_.size(); ++p)
      if (i >= ranges_[p].first && i < ranges_[p].last && !(lowest > least_[p].value)) return true;
    return false;
  }

  ClearanceSeries result(const std::string& name) const {
    ClearanceSeries out;
    out.name = name;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (std::isnan(known_[i])) continue;
      out.time.push_back(view_.run().time[i]);
      out.distance.push_back(known_[i]);
    }
    const auto lowest = std::min_element(out.distance.begin(), out.distance.end());
    out.minimum = *lowest;
    out.minimum_time = out.time[static_cast<std::size_t>(lowest - out.distance.begin())];
    out.by_phase = least_;
    return out;
  }

 private:
  const RunView& view_;
  std::function<double(std::size_t)> distance_;
  std::vector<double> known_;  // m, NaN where nobody has looked
  std::vector<RunView::Range> ranges_;
  std::vector<Peak> least_;
};

ClearanceSeries series_of(const RunView& view, const ClearanceSpec& pair, double spacing) {
  const std::vector<double>& time = view.run().time;
  const BodyTrack body_a(view, pair.a.body), body_b(view, pair.b.body);
  if (time.empty() || !body_a.recorded() || !body_b.recorded()) {
    ClearanceSeries none;
    none.name = pair.name;
    return none;
  }
  const Solid a = build_solid(pair.a), b = build_solid(pair.b);
  DistanceSearch search(view, [&](std::size_t i) { return solid_distance(a, body_a(i), b, body_b(i)); });

  std::vector<std::pair<std::size_t, double>> coarse;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (coarse.empty() || i + 1 == time.size() || time[i] - time[coarse.back().first] >= spacing * (1.0 - 1e-9))
      coarse.emplace_back(i, search.look(i));
  double fastest = 0.0;
  for (std::size_t k = 1; k < coarse.size(); ++k)
    fastest = std::max(fastest, std::abs(coarse[k].second - coarse[k - 1].second) /
                                    (time[coarse[k].first] - time[coarse[k - 1].first]));
  for (std::size_t k = 1; k < coarse.size(); ++k) {
    const auto& [i0, d0] = coarse[k - 1];
    const auto& [i1, d1] = coarse[k];
    // Two lines falling at the fastest rate from both ends meet at the lowest value the distance can have between.
    const double lowest = 0.5 * (d0 + d1 - fastest * (time[i1] - time[i0]));
    for (std::size_t i = i0 + 1; i < i1; ++i)
      if (search.could_matter(lowest, i)) search.look(i);
  }
  return search.result(pair.name);
}

}  // namespace

double shape_distance(const ClearanceSpec::Shape& a, const Pose& X_WA, const ClearanceSpec::Shape& b,
                      const Pose& X_WB) {
  return solid_distance(build_solid(a), X_WA, build_solid(b), X_WB);
}

std::vector<ClearanceSeries> compute_clearances(const Specification& specification, const Trajectory& trajectory,
                                                double spacing) {
  const RunView view(specification, trajectory);
  std::vector<ClearanceSeries> all;
  for (const ClearanceSpec& pair : specification.clearances) all.push_back(series_of(view, pair, spacing));
  return all;
}

}  // namespace stillhook
