#include "sim/hull/hydrostatics.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/hull/mesh/clipped_panel.h"
#include "sim/hull/mesh/cut_panels.h"
#include "sim/hull/mesh/hull_mesh.h"
#include "sim/hull/rankine/panel_strips.h"
#include "sim/hull/wave_window.h"

namespace stillhook {

namespace {

using FroudeKrylov = HullSpec::FroudeKrylov;
using Dual = ceres::Jet<double, 6>;  // by the depths and the heads of a triangle's corners

// int h n dS and int h r n^T dS over the wet surface, in B about C: every force and moment follows from these.
struct HeadIntegral {
  Vector3 n = Vector3::Zero();   // m3
  Matrix3 rn = Matrix3::Zero();  // m4

  // int h r x n dS.
  Vector3 r_cross_n() const { return {rn(1, 2) - rn(2, 1), rn(2, 0) - rn(0, 2), rn(0, 1) - rn(1, 0)}; }
};

// No crest is higher and no trough deeper than `ever`; hardly one than `expected`, six standard deviations of the sea.
struct SurfaceReach {
  explicit SurfaceReach(const WaveField& waves) {
    double variance = 0.0;
    for (const WaveComponent& c : waves.components()) {
      ever += std::abs(c.amplitude);
      variance += 0.5 * c.amplitude * c.amplitude;
    }
    expected = std::min(ever, 6.0 * std::sqrt(variance));
  }
  /// Whether vertices that are out of the expected reach of the surface may be left out.
  bool enough(double highest) const { return expected == ever || highest < 0.8 * expected; }
  double ever = 0.0, expected = 0.0;  // m
};

class Hydrostatics final : public ForceElement {
 public:
  Hydrostatics(const BodySpec& body, int index, const Mesh& mesh, std::shared_ptr<const WaveField> waves,
               const SeaSpec& sea)
      : ForceElement(body.name + ".hydrostatics"),
        body_name_(body.name),
        body_(index),
        model_(body.hull.froude_krylov),
        weight_(sea.density * sea.gravity),
        waves_(std::move(waves)) {
    for (const Vector3& v : mesh.vertices) r_.push_back(v - body.cog);
    for (const auto& t : mesh.triangles) panels_.push_back({{t[0], t[1], t[2]}, area_vector(mesh, t)});
    sort_upwards(panels_, r_);
    strips_ = strips_of(panels_, r_);
    weights_ = head_weights(panels_, r_);
    coordinates_.resize(static_cast<Eigen::Index>(r_.size()), 3);
    for (std::size_t i = 0; i < r_.size(); ++i) coordinates_.row(static_cast<Eigen::Index>(i)) = r_[i].transpose();
    surface_.emplace(*waves_);
    window_.emplace(waves_, r_.size(), coordinates_.rowwise().norm().maxCoeff());
  }

  bool same_as(const ForceElement& other) const override {
    const auto* o = dynamic_cast<const Hydrostatics*>(&other);
    return o && o->weight_ == weight_ && o->model_ == model_ && o->r_ == r_ && *o->waves_ == *waves_;
  }
  int state_size() const override { return window_->state_size(); }
  int scratch_size() const override { return sample_size() + window_->scratch_size(); }
  // The window only helps to compute: where its nodes lie makes no difference worth knowing (wave_expansion.h).
  bool has_history() const override { return false; }
  bool advance_state_tangent(const Instant&, const Instant&, double, Memory, const BodyChange&, const BodyChange&,
                             Eigen::Ref<MatrixX>) const override {
    return true;
  }
  void start(const Instant&, Memory m) const override { window_->start(m.state); }
  void begin_step(const Instant& before, double h, Memory m) const override {
    window_->begin_step(before.t, h, before.body[body_], m.state);
  }

  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override {
    if (h == 0.0) m.state = {};  // statics: the pose may be anywhere
    const Samples s = sampled(now, model_, false, m);
    const Load load = load_of(integrate(s, now), now.body[body_].R_WB);
    out.add(body_, now.body[body_].R_WB * load.F_B, load.M_B);
  }

  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  double potential_energy(const Instant& now, Memory m) const override;

  std::vector<Channel> channels() const override {
    std::vector<Channel> channels = channels_of(body_name_, hull_channels::all);
    for (Channel& channel : channels) channel.samples_only = true;
    return channels;
  }

  void measure(const Instant& now, Memory m, std::span<double> out) const override {
    const Matrix3& R = now.body[body_].R_WB;
    const Samples s = sampled(now, model_, false, m);
    HeadIntegral I = integrate(s, now);
    out[0] = R.row(2).dot(load_of(I, R).F_B);
    if (model_ == FroudeKrylov::pressure) {
      std::ranges::transform(s.depth, s.head.begin(), [](double d) { return std::max(d, 0.0); });
      I = integrate(s, now);
    }
    out[1] = -R.row(2).dot(I.n);
  }

 private:
  // Views into scratch, one value a vertex; the last strips and their vertices are left out where they are dry.
  struct Samples {
    Samples(Memory m, double reach, int strip_count, std::size_t n) : surface(reach), strips(strip_count) {
      std::span<double>* all[] = {&depth, &depth_x, &depth_y, &head, &head_x, &head_y, &head_z};
      for (std::size_t i = 0; i < std::size(all); ++i) *all[i] = m.scratch.subspan(i * n, n);
      head_pose = m.scratch.subspan(std::size(all) * n, 6 * n);
    }
    double surface;  // m, up and down: strips and panels beyond are dry or wet
    int strips;
    std::span<double> depth, depth_x, depth_y;       // m, zeta - z; its derivative by z is -1
    std::span<double> head, head_x, head_y, head_z;  // the head is zero where the depth is negative
    std::span<double> head_pose;                     // of the head by xi: n x 6, a coordinate after the other
  };
  struct Load {
    Vector3 F_B, M_B;  // N in B, N m about C in B
  };

  Samples reachable(const Instant& now, double surface, Memory m) const;
  Samples sampled(const Instant& now, FroudeKrylov model, bool gradients, Memory m) const;
  int sample_size() const { return 13 * static_cast<int>(r_.size()); }
  std::span<const Panel> panels(const Samples& s) const {
    return {panels_.data(), static_cast<std::size_t>(s.strips > 0 ? strips_[s.strips - 1].end_panel : 0)};
  }
  double sample(const Instant& now, FroudeKrylov model, bool gradients, Memory m, Samples& s) const;
  HeadIntegral integrate(const Samples& s, const Instant& now) const;
  template <typename Visitor>
  void for_cut_panels(const Samples& s, const Instant& now, Visitor visit) const;
  void integrate_cut_panels(const Samples& s, bool tips, CutPanels& cut, LaneIntegrals& I) const;
  Load load_of(const HeadIntegral& I, const Matrix3& R_WB) const;
  void differentiate_heads(const Matrix3& R_WB, Samples& s) const;
  Matrix6 linear_sensitivity(const Samples& s, const Vector3& k_B) const;
  void add_cut_panel(const Samples& s, const Panel& panel, const Matrix3& R_WB, int wet, Matrix6& sum) const;

  // Area vector that the pressure acts on: the whole of it, or its vertical part.
  Vector3 effective(const Vector3& S_B, const Vector3& k_B) const {
    return model_ == FroudeKrylov::pressure ? S_B : Vector3(S_B.dot(k_B) * k_B);
  }

  std::string body_name_;
  int body_;
  FroudeKrylov model_;
  double weight_;  // N/m3, rho g
  std::shared_ptr<const WaveField> waves_;
  std::vector<Vector3> r_;  // m, vertices relative to C, in B
  std::vector<Panel> panels_;
  std::vector<PanelStrip> strips_;
  MatrixX weights_;                                       // see head_weights
  Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates_;  // r_, an axis a column
  std::optional<SurfaceReach> surface_;
  std::optional<WaveWindow> window_;
};

Hydrostatics::Samples Hydrostatics::reachable(const Instant& now, double surface, Memory m) const {
  const Vector3 up = now.body[body_].R_WB.row(2);
  const double z = now.body[body_].p_WC.z();
  int strips = static_cast<int>(strips_.size());
  for (; strips > 0; --strips) {
    const PanelStrip& s = strips_[strips - 1];
    if (z + up.dot(s.centre) - up.cwiseAbs().dot(s.half) <= surface) break;
  }
  return {m, surface, strips, static_cast<std::size_t>(strips > 0 ? strips_[strips - 1].vertices : 0)};
}

double Hydrostatics::sample(const Instant& now, FroudeKrylov model, bool gradients, Memory m, Samples& s) const {
  const std::size_t n = s.depth.size();
  WaveSamples wanted{s.depth, s.depth_x, s.depth_y, s.head, s.head_x, s.head_y, s.head_z};
  if (model == FroudeKrylov::volume) wanted.head = {};
  const Memory of_window{m.state, m.scratch.subspan(static_cast<std::size_t>(sample_size()))};
  const double highest = window_->sample(now.t, now.body[body_], coordinates_.topRows(static_cast<Eigen::Index>(n)),
                                         gradients, of_window, wanted);
  if (model == FroudeKrylov::pressure) {
    for (std::size_t i = 0; i < n; ++i) s.head[i] = s.depth[i] > 0.0 ? s.head[i] : 0.0;
    return highest;
  }
  for (std::size_t i = 0; i < n; ++i) s.head[i] = std::max(s.depth[i], 0.0);
  if (!gradients) return highest;
  std::ranges::copy(s.depth_x, s.head_x.begin());
  std::ranges::copy(s.depth_y, s.head_y.begin());
  std::ranges::fill(s.head_z, -1.0);
  return highest;
}

Hydrostatics::Samples Hydrostatics::sampled(const Instant& now, FroudeKrylov model, bool gradients, Memory m) const {
  Samples s = reachable(now, surface_->expected, m);
  if (surface_->enough(sample(now, model, gradients, m, s))) return s;
  s = reachable(now, surface_->ever, m);
  sample(now, model, gradients, m, s);
  return s;
}

// What cut panels have more than the linear sum gives them.
void Hydrostatics::integrate_cut_panels(const Samples& s, bool tips, CutPanels& cut, LaneIntegrals& I) const {
  if (cut.count == 0) return;
  cut.fill();
  Lanes d[3], h[3], m[3], moment[3];
  for (int c = 0; c < 3; ++c) {
    d[c] = cut.gathered(s.depth.data(), c);
    h[c] = cut.gathered(s.head.data(), c);
    m[c].setZero();
  }
  if (tips)
    clipped_panel::add_tip(d, h, 0, 1, 2, m);
  else
    clipped_panel::add_quadrilateral(d, h, 1, 2, 0, m);
  const Lanes sum = h[0] + h[1] + h[2];
  for (int c = 0; c < 3; ++c) m[c] -= (sum + h[c]) / 12.0;
  const Lanes total = m[0] + m[1] + m[2];
  for (int axis = 0; axis < 3; ++axis) {
    const double* r = coordinates_.col(axis).data();
    moment[axis] = m[0] * cut.gathered(r, 0) + m[1] * cut.gathered(r, 1) + m[2] * cut.gathered(r, 2);
  }
  for (int j = 0; j < 3; ++j) {
    I.n[j] += total * cut.S[j];
    for (int i = 0; i < 3; ++i) I.rn[i][j] += moment[i] * cut.S[j];
  }
  cut.count = 0;
}

// Calls visit(panel, wet_corners) for the panels that the surface cuts.
template <typename Visitor>
void Hydrostatics::for_cut_panels(const Samples& s, const Instant& now, Visitor visit) const {
  const Vector3 up = now.body[body_].R_WB.row(2);
  const double z = now.body[body_].p_WC.z();
  for (int i = 0; i < s.strips; ++i) {
    const PanelStrip& strip = strips_[i];
    const double middle = z + up.dot(strip.centre), half = up.cwiseAbs().dot(strip.half);
    if (middle + half < -s.surface || middle - half > s.surface) continue;
    for (int k = strip.first_panel; k < strip.end_panel; ++k) {
      const Panel& panel = panels_[k];
      const double d[3] = {s.depth[panel.corner[0]], s.depth[panel.corner[1]], s.depth[panel.corner[2]]};
      if (const int wet = clipped_panel::wet_corners(d); wet != 0 && wet != 7) visit(panel, wet);
    }
  }
}

HeadIntegral Hydrostatics::integrate(const Samples& s, const Instant& now) const {
  HeadIntegral I;
  if (s.strips == 0) return I;
  const Eigen::Index n = static_cast<Eigen::Index>(s.head.size());
  Eigen::Matrix<double, 12, 1> sums;
  sums.noalias() = weights_.topRows(n).transpose() * VectorX::Map(s.head.data(), n);
  I.n = sums.head<3>();
  I.rn = Eigen::Map<const Matrix3>(sums.data() + 3);
  CutPanels tips, quadrilaterals;
  LaneIntegrals cut;
  for_cut_panels(s, now, [&](const Panel& panel, int wet) {
    const bool tip = wet == 1 || wet == 2 || wet == 4;
    if ((tip ? tips : quadrilaterals).add(panel, kLoneCorner[wet]))
      integrate_cut_panels(s, tip, tip ? tips : quadrilaterals, cut);
  });
  integrate_cut_panels(s, true, tips, cut);
  integrate_cut_panels(s, false, quadrilaterals, cut);
  for (int j = 0; j < 3; ++j) {
    I.n[j] += cut.n[j].sum();
    for (int i = 0; i < 3; ++i) I.rn(i, j) += cut.rn[i][j].sum();
  }
  return I;
}

Hydrostatics::Load Hydrostatics::load_of(const HeadIntegral& I, const Matrix3& R_WB) const {
  if (model_ == FroudeKrylov::pressure) return {-weight_ * I.n, -weight_ * I.r_cross_n()};
  const Vector3 k = R_WB.row(2);
  return {-weight_ * k.dot(I.n) * k, -weight_ * (I.rn * k).cross(k)};
}

// Chain to the pose: d(value at a vertex) = g_W . dp + (r x g_B) . dtheta. The head of a dry vertex is zero whatever
// moves.
void Hydrostatics::differentiate_heads(const Matrix3& R, Samples& s) const {
  const Eigen::Index n = static_cast<Eigen::Index>(s.depth.size());
  const auto r = coordinates_.topRows(n).array();
  const auto wet = (VectorX::Map(s.depth.data(), n).array() > 0.0).cast<double>();
  Eigen::Map<MatrixX> pose(s.head_pose.data(), n, 6);
  const std::span<double> slope[] = {s.head_x, s.head_y, s.head_z};
  for (int i = 0; i < 3; ++i) pose.col(i).array() = wet * VectorX::Map(slope[i].data(), n).array();
  const auto g_x = pose.col(0).array(), g_y = pose.col(1).array(), g_z = pose.col(2).array();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    pose.col(3 + i).array() = r.col(j) * (R(0, k) * g_x + R(1, k) * g_y + R(2, k) * g_z) -
                              r.col(k) * (R(0, j) * g_x + R(1, j) * g_y + R(2, j) * g_z);
  }
}

// Of sum S m_i and sum (m_i r_i) x S by the pose, S held, as if no panel were cut: as in integrate() the heads times
// constants of the vertices.
Matrix6 Hydrostatics::linear_sensitivity(const Samples& s, const Vector3& k_B) const {
  const Eigen::Index n = static_cast<Eigen::Index>(s.depth.size());
  const Eigen::Map<const MatrixX> pose(s.head_pose.data(), n, 6);
  Eigen::Matrix<double, 12, 6> sums;
  sums.noalias() = weights_.topRows(n).transpose() * pose;
  Matrix6 result;
  for (int c = 0; c < 6; ++c) {
    HeadIntegral I;
    I.n = sums.col(c).head<3>();
    I.rn = Eigen::Map<const Matrix3>(sums.col(c).data() + 3);
    if (model_ == FroudeKrylov::pressure)
      result.col(c) << I.n, I.r_cross_n();
    else
      result.col(c) << k_B.dot(I.n) * k_B, (I.rn * k_B).cross(k_B);
  }
  return result;
}

// What a cut panel has more: on a wet panel dm_i/dh_j is 1/12, and 1/6 for i = j; the depths do not matter.
void Hydrostatics::add_cut_panel(const Samples& s, const Panel& panel, const Matrix3& R, int wet, Matrix6& sum) const {
  Dual depth[3], head[3], m[3];
  for (int i = 0; i < 3; ++i) {
    depth[i] = Dual(s.depth[panel.corner[i]], i);
    head[i] = Dual(s.head[panel.corner[i]], 3 + i);
  }
  clipped_panel::moments(wet, depth, head, m);
  const Eigen::Index n = static_cast<Eigen::Index>(s.depth.size());
  const Eigen::Map<const MatrixX> pose(s.head_pose.data(), n, 6);
  Vector6 by_pose[3] = {Vector6::Zero(), Vector6::Zero(), Vector6::Zero()};  // of m_i
  for (int j = 0; j < 3; ++j) {
    const int v = panel.corner[j];
    const Vector3 slope(s.depth_x[v], s.depth_y[v], -1.0);
    Vector6 depth_by_pose;
    depth_by_pose << slope, r_[v].cross(R.transpose() * slope);
    const Vector6 head_by_pose = pose.row(v).transpose();
    const double linear = wet & (1 << j) ? 1.0 / 12.0 : 0.0;
    for (int i = 0; i < 3; ++i)
      by_pose[i] += m[i].v[j] * depth_by_pose + (m[i].v[3 + j] - (i == j ? 2.0 : 1.0) * linear) * head_by_pose;
  }
  const Vector3 S = effective(panel.S_B, R.row(2));
  sum.topRows<3>() += S * (by_pose[0] + by_pose[1] + by_pose[2]).transpose();
  for (int i = 0; i < 3; ++i) sum.bottomRows<3>() += r_[panel.corner[i]].cross(S) * by_pose[i].transpose();
}

void Hydrostatics::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  if (h == 0.0) m.state = {};
  const Matrix3& R = now.body[body_].R_WB;
  const Vector3 k = R.row(2);
  Samples s = sampled(now, model_, true, m);
  differentiate_heads(R, s);
  Matrix6 K = linear_sensitivity(s, k);
  for_cut_panels(s, now, [&](const Panel& panel, int wet) { add_cut_panel(s, panel, R, wet, K); });

  const HeadIntegral I = integrate(s, now);
  if (model_ == FroudeKrylov::volume) {
    // The vertical turns in B as well: dk = k x dtheta, and S_eff = (S . k) k.
    const Matrix3 dk = cross_matrix(k);
    K.topRightCorner<3, 3>() += (k * I.n.transpose() + I.n.dot(k) * Matrix3::Identity()) * dk;
    K.bottomRightCorner<3, 3>() += (cross_matrix(I.rn * k) - cross_matrix(k) * I.rn) * dk;
  }
  K *= -weight_;
  // F_W = R F_B
  K.topRows<3>() = (R * K.topRows<3>()).eval();
  K.topRightCorner<3, 3>() -= R * cross_matrix(load_of(I, R).F_B);
  out.add_stiffness(body_, body_, K);
}

double Hydrostatics::potential_energy(const Instant& now, Memory m) const {
  // int d dV = -1/2 int d^2 n_z dS, and d^2 integrates to sum d_i m_i because d is linear.
  const Samples s = sampled(now, FroudeKrylov::volume, false, m);
  const Vector3 k = now.body[body_].R_WB.row(2);
  double moment = 0.0;
  for (const Panel& panel : panels(s)) {
    double d[3], mi[3];
    for (int i = 0; i < 3; ++i) d[i] = s.depth[panel.corner[i]];
    const int wet = clipped_panel::wet_corners(d);
    if (wet == 0) continue;
    clipped_panel::moments(wet, d, d, mi);
    moment -= 0.5 * k.dot(panel.S_B) * (d[0] * mi[0] + d[1] * mi[1] + d[2] * mi[2]);
  }
  return weight_ * moment;
}

}  // namespace

std::unique_ptr<ForceElement> build_hydrostatics(const BodySpec& body, int index,
                                                 std::shared_ptr<const WaveField> waves, const SeaSpec& sea) {
  const std::string entry = "bodies." + body.name;
  if (body.hull.shape == HullSpec::Shape::none) throw SpecificationError(entry, "hull", "the body has no hull");
  const Mesh mesh = hull_mesh_in(body, *waves);
  return std::make_unique<Hydrostatics>(body, index, mesh, std::move(waves), sea);
}

}  // namespace stillhook
