#include "sim/response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/hull/afloat.h"
#include "sim/hull/coefficients/rao_table.h"
#include "sim/hull/heading_frame.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/hull/hydrostatics.h"
#include "sim/sea/dispersion.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kCalm = -1.0;  // s: before the waves start
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kFewest = 4;  // frequencies of a table that is interpolated

/// Cubic Hermite interpolation of `of(entry)` with three-point slopes; w within the table.
template <class Part>
MatrixX interpolated(const std::vector<FrequencyCoefficients>& table, double w, Part of) {
  const auto above = std::upper_bound(table.begin(), table.end(), w,
                                      [](double value, const FrequencyCoefficients& f) { return value < f.frequency; });
  const int last = static_cast<int>(table.size()) - 1;
  const int i = std::clamp(static_cast<int>(above - table.begin()) - 1, 0, last - 1);
  const auto x = [&](int k) { return table[k].frequency; };
  const auto slope = [&](int k) -> MatrixX {
    if (k == 0 || k == last) {
      const int j = k == 0 ? 1 : last;
      return (of(table[j]) - of(table[j - 1])) / (x(j) - x(j - 1));
    }
    const double before = x(k) - x(k - 1), after = x(k + 1) - x(k);
    return ((of(table[k]) - of(table[k - 1])) * (after / before) +
            (of(table[k + 1]) - of(table[k])) * (before / after)) /
           (before + after);
  };
  const double h = x(i + 1) - x(i), t = (w - x(i)) / h, s = 1.0 - t;
  return (1.0 + 2.0 * t) * s * s * of(table[i]) + t * s * s * h * slope(i) +
         t * t * (3.0 - 2.0 * t) * of(table[i + 1]) - t * t * s * h * slope(i + 1);
}

bool within(const std::vector<FrequencyCoefficients>& table, double w) {
  return table.size() >= kFewest && w >= table.front().frequency && w <= table.back().frequency * (1.0 + 1e-9);
}

MatrixX added_mass_of(const HydrodynamicCoefficients& set, double w) {
  if (within(set.frequency, w))
    return interpolated(set.frequency, w, [](const auto& f) -> const MatrixX& { return f.A; });
  if (!set.retardation.empty()) return added_mass_from_kernels(set.A_inf, set.retardation, w);
  if (set.frequency.empty()) return set.A_inf;
  return w < set.frequency.front().frequency ? set.frequency.front().A : set.A_inf;
}

MatrixX damping_of(const HydrodynamicCoefficients& set, double w) {
  if (within(set.frequency, w))
    return interpolated(set.frequency, w, [](const auto& f) -> const MatrixX& { return f.B; });
  if (!set.retardation.empty()) return damping_from_kernels(set.retardation, set.modes(), w);
  return MatrixX::Zero(set.modes(), set.modes());
}

/// The hull (mesh relative to the reference point, in B) in the water as it floats at this pose, about the reference
/// point and in the heading frame: its draft, heel and trim may differ from those that its coefficients were computed for.
std::optional<LinearFroudeKrylov> as_it_floats(Mesh mesh, const Pose& X_WB, const Vector3& reference, const SeaSpec& sea,
                                               double depth) {
  const Matrix3 R_HB = heading_rotation(X_WB.R).transpose() * X_WB.R;
  const double waterline = -(X_WB.p + X_WB.R * reference).z();
  bool wet = false;
  for (Vector3& vertex : mesh.vertices) {
    vertex = R_HB * vertex;
    wet = wet || vertex.z() < waterline;
  }
  if (!wet) return std::nullopt;
  return LinearFroudeKrylov(mesh, waterline, sea.density, sea.gravity, depth);
}

}  // namespace

/// Hulls of one set, or a lone hull.
struct LinearResponse::Group {
  struct Hull {
    HeadingFrame frame;                // cog from the reference point
    std::optional<LinearFroudeKrylov> froude_krylov;  // about the reference point, as it floats; none out of the water
    Eigen::Vector2d reference;                        // m, in W
    double diffraction_factor = 1.0;
  };
  std::vector<Hull> hulls;
  std::shared_ptr<const HydrodynamicCoefficients> set;  // may be null
  Matrix6 constant_added_mass = Matrix6::Zero();        // of a hull without a set
  std::optional<DiffractionTable> diffraction;
  VectorX added_mass_factor, radiation_factor;  // a number a mode, see mode_factors()

  MatrixX added_mass(double frequency) const {
    if (!set) return constant_added_mass;
    const auto a = added_mass_factor.asDiagonal(), r = radiation_factor.asDiagonal();
    return a * set->A_inf * a + r * (added_mass_of(*set, frequency) - set->A_inf) * r;
  }
  MatrixX damping(double frequency) const {
    return radiation_factor.asDiagonal() * damping_of(*set, frequency) * radiation_factor.asDiagonal();
  }
  double heading() const { return hulls.front().frame.heading; }
  /// T^T M T of a matrix of all modes, added to the system's.
  void add(const MatrixX& M, MatrixX& to) const {
    for (std::size_t i = 0; i < hulls.size(); ++i)
      for (std::size_t j = 0; j < hulls.size(); ++j)
        to.block<6, 6>(6 * hulls[i].frame.body, 6 * hulls[j].frame.body) +=
            hulls[i].frame.transform().transpose() * M.block<6, 6>(6 * i, 6 * j) * hulls[j].frame.transform();
  }
};

/// A body that the sea moves, and the rows of its joint to the moving frame.
struct LinearResponse::SeaMoved {
  int body;
  RaoTable table;
  RaoFrame frame;
  Vector3 q;                // m, Q in W
  std::vector<int> rows;    // of C_q
  Matrix3 R_WH, R_WB;
  Vector3 to_cog;  // m, from Q, in H

  bool covers(double frequency, double heading) const {
    constexpr double kWidest = 45.5 * kDegree;  // as in rao_motion.h
    return frequency >= table.frequencies.front() * (1.0 - 1e-9) && frequency <= table.frequencies.back() * (1.0 + 1e-9) &&
           table.gap_at(heading - frame.heading) <= kWidest;
  }
  ResponseAmplitude::Vector6c motion(double frequency, double heading, double k) const {
    const Raos X = moved_by(table.between(frequency, heading - frame.heading), to_cog);
    const Complex wave = std::polar(1.0, k * (q.x() * std::cos(heading) + q.y() * std::sin(heading)));
    ResponseAmplitude::Vector6c xi;
    xi << R_WH.cast<Complex>() * Eigen::Vector3cd(X[0], X[1], X[2]) * wave,
        (R_WB.transpose() * R_WH).cast<Complex>() * Eigen::Vector3cd(X[3], X[4], X[5]) * wave;
    return xi;
  }
};

LinearResponse::~LinearResponse() = default;
LinearResponse::LinearResponse(LinearResponse&&) noexcept = default;

LinearResponse::LinearResponse(const Model& model, const SystemState& equilibrium)
    : model_(model), state_(equilibrium), highest_(kInfinity) {
  const MultibodySystem& system = model.system();
  const Specification& spec = model.specification();
  gravity_ = spec.sea.gravity;
  depth_ = spec.sea.wave_depth();
  state_.t = kCalm;
  SystemWorkspace work = system.make_workspace();
  VectorX Q;
  system.forces(state_, 0.0, work, Q);
  system.jacobian(state_, 0.0, work);
  stiffness_ = -work.jacobian.stiffness();
  // Radiation with a memory has no damping at rest, so that of the sets can be added at each frequency; constant
  // damping and the linear part of viscous damping are in.
  damping_ = -work.jacobian.damping();
  Z_ = MatrixX::Identity(system.coordinates(), system.coordinates());
  if (system.constraints() > 0) {
    system.constraint_jacobian(state_, C_q_);
    const Eigen::HouseholderQR<MatrixX> qr(C_q_.transpose());
    Z_ = MatrixX(qr.householderQ()).rightCols(system.coordinates() - system.constraints());
  }
  mass_ = MatrixX::Zero(system.coordinates(), system.coordinates());
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    mass_.block<3, 3>(6 * i, 6 * i) = system.bodies[i].mass * Matrix3::Identity();
    mass_.block<3, 3>(6 * i + 3, 6 * i + 3) = system.bodies[i].inertia;
  }
  for (const std::vector<std::size_t>& together : coupled_hulls(spec.bodies)) {
    std::vector<int> members;
    for (const std::size_t k : together)
      if (spec.bodies[k].floats()) members.push_back(static_cast<int>(k));
    if (members.empty()) continue;
    Group group;
    group.set = model.coefficients(members.front()).set;
    std::vector<LinearFroudeKrylov> incident;
    std::vector<double> headings;
    std::vector<const BodySpec*> bodies;
    for (const int k : members) {
      const BodySpec& body = spec.bodies[k];
      bodies.push_back(&body);
      const Pose X_WB = pose_of(state_.body[k], system.bodies[k]);
      const Vector3 reference(0.0, 0.0, model.coefficients(k).reference_height);
      Mesh mesh = build_hull_mesh(body.hull);
      for (Vector3& vertex : mesh.vertices) vertex -= reference;
      const double yaw = roll_pitch_yaw(X_WB.R).yaw;
      group.hulls.push_back({HeadingFrame(k, body.cog - reference, yaw), as_it_floats(mesh, X_WB, reference, spec.sea, depth_),
                             X_WB.p.head<2>(), body.hydrodynamics.diffraction_factor});
      // In water as deep as the set's.
      if (group.set) incident.emplace_back(mesh, group.set->waterline, group.set->density, gravity_, group.set->depth);
      headings.push_back(yaw);
    }
    group.added_mass_factor = mode_factors(bodies, &HydrodynamicsSpec::added_mass_factor);
    group.radiation_factor = mode_factors(bodies, &HydrodynamicsSpec::radiation_factor);
    if (group.set && !group.set->excitation.empty()) {
      group.diffraction.emplace(group.set->excitation, incident, headings, group.set->length);
      lowest_ = std::max(lowest_, group.set->excitation.frequencies.front());
      const double end = group.diffraction->highest_frequency();
      const bool as_in_deep_water = std::isinf(group.set->depth) && std::isfinite(depth_);
      highest_ = std::min(highest_, as_in_deep_water ? wave_frequency(end * end / gravity_, gravity_, depth_) : end);
    }
    const HydrodynamicsSpec& h = spec.bodies[members.front()].hydrodynamics;
    if (h.kind == HydrodynamicsSpec::Kind::constant) group.constant_added_mass = h.added_mass;
    groups_.push_back(std::move(group));
  }
  add_sea_moved();
}

void LinearResponse::add_sea_moved() {
  const MultibodySystem& system = model_.system();
  for (const Joint& joint : system.joints) {
    if (!joint.motion) continue;
    const int k = joint.on_child.body;
    const BodySpec& body = model_.specification().bodies[static_cast<std::size_t>(k)];
    if (!body.moved_by_sea()) continue;
    const RaoFrame frame(body);
    const Matrix3 R_WB = rotation_from(body.attitude);
    SeaMoved moved{k,    read_rao_table(body, gravity_, depth_), frame, body.position + R_WB * frame.q, {},
                   R_WB * frame.R_HB.transpose(), R_WB, frame.R_HB * (body.cog - frame.q)};
    for (int row = 0; row < system.constraints(); ++row)
      if (system.row_joint(row) == joint.name) moved.rows.push_back(row);
    lowest_ = std::max(lowest_, moved.table.frequencies.front());
    highest_ = std::min(highest_, moved.table.frequencies.back());
    moved_.push_back(std::move(moved));
  }
}

Eigen::VectorXcd LinearResponse::carried(double frequency, double heading) const {
  Eigen::VectorXcd asked = Eigen::VectorXcd::Zero(C_q_.rows());
  for (const SeaMoved& moved : moved_) {
    const ResponseAmplitude::Vector6c xi = moved.motion(frequency, heading, wave_number(frequency, gravity_, depth_));
    for (const int row : moved.rows)
      asked[row] = (C_q_.block<1, 6>(row, 6 * moved.body).cast<Complex>() * xi)(0);
  }
  const MatrixX square = C_q_ * C_q_.transpose();
  const auto factor = square.ldlt();
  const Eigen::VectorXcd y =
      factor.solve(asked.real()).cast<Complex>() + Complex(0.0, 1.0) * factor.solve(asked.imag()).cast<Complex>();
  return C_q_.transpose().cast<Complex>() * y;
}

MatrixX LinearResponse::potential_mass(double frequency) const {
  MatrixX M = MatrixX::Zero(mass_.rows(), mass_.cols());
  for (const Group& group : groups_) group.add(group.added_mass(frequency), M);
  return M;
}

MatrixX LinearResponse::potential_damping(double frequency) const {
  MatrixX B = MatrixX::Zero(mass_.rows(), mass_.cols());
  for (const Group& group : groups_)
    if (group.set) group.add(group.damping(frequency), B);
  return B;
}

bool LinearResponse::resolves(double frequency, double heading) const {
  for (const SeaMoved& moved : moved_)
    if (!moved.covers(frequency, heading)) return false;
  return std::all_of(groups_.begin(), groups_.end(), [&](const Group& group) {
    return !group.diffraction || group.diffraction->resolves(group.diffraction->frequency_of(frequency, depth_),
                                                             heading - group.heading());
  });
}

Eigen::VectorXcd LinearResponse::excitation(double frequency, double heading) const {
  const double k = wave_number(frequency, gravity_, depth_);
  const Eigen::Vector2d direction(std::cos(heading), std::sin(heading));
  Eigen::VectorXcd Q = Eigen::VectorXcd::Zero(mass_.rows());
  for (const Group& group : groups_) {
    Eigen::VectorXcd X_D = Eigen::VectorXcd::Zero(6 * group.hulls.size());
    if (group.diffraction)
      X_D =
          group.diffraction->at(std::min(group.diffraction->frequency_of(frequency, depth_),
                                         group.diffraction->highest_frequency()),
                                heading - group.heading());
    for (std::size_t i = 0; i < group.hulls.size(); ++i) {
      const Group::Hull& hull = group.hulls[i];
      ResponseAmplitude::Vector6c X = hull.diffraction_factor * X_D.segment<6>(6 * i);
      if (hull.froude_krylov) X += hull.froude_krylov->excitation(frequency, heading - hull.frame.heading);
      Q.segment<6>(6 * hull.frame.body) +=
          hull.frame.transform().transpose().cast<Complex>() * X * std::polar(1.0, k * direction.dot(hull.reference));
    }
  }
  return Q;
}

ResponseAmplitude LinearResponse::at(double frequency, double heading) const {
  if (!(frequency > 0.0) || !resolves(frequency, heading))
    throw std::invalid_argument("linear response: the coefficients do not know a wave of this frequency and heading");
  const Complex i(0.0, 1.0);
  const Eigen::MatrixXcd dynamic =
      (stiffness_ - frequency * frequency * (mass_ + potential_mass(frequency))).cast<Complex>() -
      i * frequency * (damping_ + potential_damping(frequency)).cast<Complex>();
  const Eigen::MatrixXcd Z = Z_.cast<Complex>();
  const Eigen::MatrixXcd reduced = Z.transpose() * dynamic * Z;
  Eigen::VectorXcd force = excitation(frequency, heading), xi = Eigen::VectorXcd::Zero(force.size());
  if (!moved_.empty()) {
    xi = carried(frequency, heading);
    force -= dynamic * xi;
  }
  if (Z.cols() > 0) xi += Z * reduced.partialPivLu().solve(Z.transpose() * force);
  ResponseAmplitude result{frequency, heading, {}};
  for (Eigen::Index k = 0; k < xi.size(); k += 6) result.body.push_back(xi.segment<6>(k));
  return result;
}

ResponseAmplitude::Vector6c LinearResponse::motion(const ResponseAmplitude& response, int body,
                                                   const Vector3& p_B) const {
  const BodyKinematics& b = state_.body[body];
  const ResponseAmplitude::Vector6c& xi = response.body[body];
  const Vector3 arm = b.R_WB * (p_B - model_.system().bodies[body].cog);
  const Eigen::Vector3cd turn = b.R_WB.cast<Complex>() * xi.tail<3>();
  const Eigen::Vector3cd move = xi.head<3>() - cross_matrix(arm).cast<Complex>() * turn;
  const Eigen::Matrix3cd R_HW = heading_rotation(b.R_WB).transpose().cast<Complex>();
  ResponseAmplitude::Vector6c result;
  result << R_HW * move, R_HW * turn;
  const Vector3 p_W = b.p_WC + arm;
  const double k = wave_number(response.frequency, gravity_, depth_);
  const double lead = k * (p_W.x() * std::cos(response.heading) + p_W.y() * std::sin(response.heading));
  return result * std::polar(1.0, -lead);
}

}  // namespace stillhook
