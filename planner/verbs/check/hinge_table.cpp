#include "planner/verbs/check/hinge_table.h"

#include <algorithm>
#include <cmath>

#include "planner/text_number.h"
#include "sim/crane_parts.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kUprightAxis = 0.7;  // an axis closer to the vertical than 45 deg slews, any other luffs

constexpr double kAstern = -179.9995 * kDegree;  // what three decimals would show as -180.000

const JointSpec* hinge_of(const Specification& s, const std::string& body) {
  for (const JointSpec& joint : s.joints)
    if (joint.type == JointSpec::Type::revolute && joint.child == body) return &joint;
  return nullptr;
}

class HingedBody {
 public:
  HingedBody(const Model& model, const StaticPose& start, const BodySpec& body, const JointSpec& hinge)
      : model_(model), body_(body.name), parent_(hinge.parent), axis_(hinge.axis.normalized()) {
    vessel_ = vessel_under(model.specification(), body.name);
    slews_ = std::abs((R_of(start, parent_) * axis_).z()) > kUprightAxis;
    base_ = base_under(model, start, hinge);
    // Which way a luffing body looks at an angle of zero: the way of the x axis of what carries the hinges.
    const Vector3 along = R_of(start, base_).transpose() * ahead(start);
    ahead_sign_ = along.x() < -0.1 || (along.x() <= 0.1 && along.y() < 0.0) ? -1.0 : 1.0;
  }

  std::string title() const { return slews_ ? body_ + ", heading" : body_; }

  /// rad
  double angle(const StaticPose& pose) const {
    const Matrix3 R_VW = R_of(pose, vessel_).transpose();
    const Vector3 x_W = R_of(pose, body_).col(0), x_V = R_VW * x_W;
    if (slews_) {  // astern is 180 deg, and not -180 by rounding
      const double heading = std::atan2(x_V.y(), x_V.x());
      return heading < kAstern ? heading + kTwoPi : heading;
    }
    return std::atan2(x_V.z(), ahead_sign_ * ahead(pose).dot(x_W));
  }

 private:
  Matrix3 R_of(const StaticPose& pose, const std::string& name) const {
    const int index = model_.body_index(name);
    return index == kWorld ? Matrix3(Matrix3::Identity()) : pose.bodies[static_cast<std::size_t>(index)].R;
  }

  /// Square to the hinge, in the plane of the vessel's deck; in W.
  Vector3 ahead(const StaticPose& pose) const {
    const Vector3 up = R_of(pose, vessel_).col(2);
    return (R_of(pose, parent_) * axis_).cross(up).normalized();
  }

  /// The first body under the hinge that does not luff itself.
  static std::string base_under(const Model& model, const StaticPose& start, const JointSpec& hinge) {
    const Specification& s = model.specification();
    std::string name = hinge.parent;
    for (std::size_t step = 0; step < s.joints.size(); ++step) {
      const JointSpec* under = hinge_of(s, name);
      if (!under) break;
      const int parent = model.body_index(under->parent);
      const Vector3 axis = under->axis.normalized();
      const Vector3 axis_W =
          parent == kWorld ? axis : Vector3(start.bodies[static_cast<std::size_t>(parent)].R * axis);
      if (std::abs(axis_W.z()) > kUprightAxis) break;
      name = under->parent;
    }
    return name;
  }

  const Model& model_;
  std::string body_, parent_, vessel_, base_;
  Vector3 axis_;
  bool slews_ = false;
  double ahead_sign_ = 1.0;
};

}  // namespace

ReportTable hinge_table(const Model& model, const std::vector<StaticPose>& poses) {
  const Specification& s = model.specification();
  ReportTable table;
  table.title = "Hinged bodies";
  table.note =
      "Angle of the body's x axis above the vessel's deck, deg. Heading, of what slews: of the body's x axis from the "
      "bow, positive to port.";
  table.header = {"pose"};
  if (poses.empty()) return table;
  std::vector<HingedBody> bodies;
  for (const BodySpec& body : s.bodies)
    if (const JointSpec* hinge = hinge_of(s, body.name)) bodies.emplace_back(model, poses.front(), body, *hinge);
  for (const HingedBody& body : bodies) table.header.push_back(body.title());
  for (const StaticPose& pose : poses) {
    std::vector<std::string> row = {pose.name};
    for (const HingedBody& body : bodies) row.push_back(cell(body.angle(pose) / kDegree, 3));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace stillhook
