#include "sim/modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"

namespace stillhook {
namespace {

constexpr double kCalm = -1.0;  // s: before the waves start
constexpr int kMaxFrequencySteps = 60;
constexpr double kFrequencyTolerance = 1e-6;   // of a frequency, relative
constexpr double kSlowest = 1e-3;     // rad/s: below this a motion has no restoring stiffness
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRedundant = 1e-10;  // of the largest constraint: beyond rounding, far below any lever arm
constexpr double kNamedShare = 0.15;  // of the kinetic energy: what a label names

struct Eigensystem {
  VectorX square;  // w^2, ascending
  MatrixX shape;   // columns, in all coordinates
};

Eigensystem solve(const MatrixX& K, const MatrixX& M, const MatrixX& Z) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(K, Z.transpose() * M * Z);
  return {solver.eigenvalues(), Z * solver.eigenvectors()};
}

// The mode of `in` most like the given one, by the mass-weighted correlation.
int nearest(const Eigensystem& in, const MatrixX& M, const VectorX& shape) {
  const VectorX Ms = M * shape;
  int best = 0;
  double largest = -1.0;
  for (int i = 0; i < in.square.size(); ++i) {
    const VectorX other = in.shape.col(i);
    const double product = other.dot(Ms), likeness = product * product / other.dot(M * other);
    if (likeness > largest) largest = likeness, best = i;
  }
  return best;
}

// Strain below which a wire is taken as slack. A wire that just touches ("slack_m = 0") is on the one side or the other by
// rounding, and its whole stiffness with it; nothing that carries a load is stretched so little.
constexpr double kJustTaut = 1e-9;

bool is_left_out(const ForceElement& element, const Instant& now, bool with_taglines) {
  if (const auto* wire = dynamic_cast<const Wire*>(&element))
    return wire->tension(now) < kJustTaut * wire->options().axial_stiffness;
  return !with_taglines && dynamic_cast<const Tagline*>(&element) != nullptr;
}

// dQ/dxi of the elements that take no part in small motions.
MatrixX stiffness_left_out(const MultibodySystem& system, SystemState& state, SystemWorkspace& work,
                           bool with_taglines) {
  JacobianSum sum(static_cast<int>(system.bodies.size()));
  for (std::size_t e = 0; e < system.elements.size(); ++e)
    if (is_left_out(*system.elements[e], state.instant(), with_taglines))
      system.elements[e]->add_jacobian(state.instant(), 0.0, system.memory(static_cast<int>(e), state, work), sum);
  return sum.stiffness();
}

double frequency_of(double square) { return square > kSlowest * kSlowest ? std::sqrt(square) : 0.0; }

std::string label_of(const VectorX& share, const std::vector<RigidBody>& bodies) {
  static constexpr std::array<const char*, 6> kNames = {" x", " y", " z", " roll", " pitch", " yaw"};
  std::vector<int> order(share.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return share[a] > share[b]; });
  std::string label;
  for (std::size_t i = 0; i < order.size() && i < 3; ++i) {
    if (i > 0 && share[order[i]] < kNamedShare) break;
    label += (i > 0 ? ", " : "") + bodies[order[i] / 6].name + kNames[order[i] % 6];
  }
  return label;
}

Mode mode_of(double square, const VectorX& shape, const MatrixX& M, const std::vector<RigidBody>& bodies) {
  Mode mode;
  mode.frequency = frequency_of(square);
  mode.period =
      mode.frequency > 0.0 ? 2.0 * std::numbers::pi / mode.frequency : std::numeric_limits<double>::infinity();
  mode.share = shape.cwiseProduct(M * shape) / shape.dot(M * shape);
  int largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  mode.shape = shape / shape[largest];
  mode.label = label_of(mode.share, bodies);
  return mode;
}

}  // namespace

ModalAnalysis::ModalAnalysis(const Model& model) : model_(model) {
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!model.coefficients(static_cast<int>(i)).set) continue;
    Hull hull;
    hull.body = static_cast<int>(i);
    hull.R_WH = heading_rotation(model.initial_state().body[i].R_WB);
    hulls_.push_back(std::move(hull));
  }
}

MatrixX ModalAnalysis::mass_at(double frequency, int phase) const {
  MatrixX M = model_.system().mass(phase);
  for (const Hull& hull : hulls_) {
    Matrix6 T = Matrix6::Identity();
    T.topLeftCorner<3, 3>() = hull.R_WH.transpose();
    M.block<6, 6>(6 * hull.body, 6 * hull.body) +=
        T.transpose() * (model_.added_mass(hull.body, frequency) - model_.added_mass(hull.body, kInfinity)) * T;
  }
  return M;
}

std::vector<Mode> ModalAnalysis::at(const SystemState& equilibrium, bool with_taglines) const {
  const MultibodySystem& system = model_.system();
  SystemState state = equilibrium;
  state.t = kCalm;
  SystemWorkspace work = system.make_workspace();
  VectorX Q;
  system.forces(state, 0.0, work, Q);
  system.jacobian(state, 0.0, work);
  MatrixX Z = MatrixX::Identity(system.coordinates(), system.coordinates());
  if (system.constraints() > 0) {
    MatrixX C_q;
    system.constraint_jacobian(state, C_q);
    // Constraints may say the same twice, as two clamps of one body do: their rank counts.
    Eigen::ColPivHouseholderQR<MatrixX> qr(C_q.transpose());
    qr.setThreshold(kRedundant);
    Z = MatrixX(qr.householderQ()).rightCols(system.coordinates() - qr.rank());
  }
  if (Z.cols() == 0) return {};  // nothing can move
  const MatrixX by_motion =
      work.jacobian.stiffness() - stiffness_left_out(system, state, work, with_taglines);
  MatrixX K = -Z.transpose() * by_motion * Z;
  K = (0.5 * (K + K.transpose())).eval();  // friction and winch laws apart it is symmetric in equilibrium

  const MatrixX& M_start = system.mass(state.phase);
  const Eigensystem start = solve(K, M_start, Z);
  std::vector<Mode> modes;
  for (int i = 0; i < start.square.size(); ++i) {
    double square = start.square[i];
    VectorX shape = start.shape.col(i);
    MatrixX M = M_start;
    bool converged = hulls_.empty() || frequency_of(square) == 0.0;
    for (int k = 0; k < kMaxFrequencySteps && !converged; ++k) {
      M = mass_at(std::sqrt(std::max(square, kSlowest * kSlowest)), state.phase);
      const Eigensystem next = solve(K, M, Z);
      const int j = nearest(next, M, shape);
      converged = std::abs(next.square[j] - square) < 2.0 * kFrequencyTolerance * std::abs(square);
      square = next.square[j];
      shape = next.shape.col(j);
    }
    modes.push_back(mode_of(square, shape, M, system.bodies));
    modes.back().converged = converged;
  }
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  return modes;
}

std::vector<Mode> natural_modes(const Model& model, const SystemState& equilibrium) {
  return ModalAnalysis(model).at(equilibrium);
}

double period_of(const std::vector<Mode>& modes, int body, int coordinate) {
  if (modes.empty()) return kInfinity;
  const auto less = [&](const Mode& a, const Mode& b) {
    return a.share[6 * body + coordinate] < b.share[6 * body + coordinate];
  };
  return std::max_element(modes.begin(), modes.end(), less)->period;
}

}  // namespace stillhook
