#include "sim/hull/radiation/passivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/hull/mesh/least_distance.h"

namespace stillhook {
namespace {

using Complex = std::complex<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// How closely [0, infinity] is searched for minima: intervals of the grid, and steps of the search between them.
struct Search {
  int intervals, steps;
};
constexpr Search kThorough{400, 30}, kQuick{60, 6};
constexpr int kMaximumRounds = 60, kQuickRounds = 12;
constexpr double kCutAbove = 2.0;  // cuts ask for this many floors, so that finitely many reach one
constexpr double kNoticeable = 0.75;
// An eigenvalue this near to the negative real axis counts as on it. Noise is 1e-12; a model at twice the floor is
// much further away.
constexpr double kOnAxis = 1e-7;

/// Frequencies from rest to infinity, evenly spread about w0.
double on_grid(double w0, double u) { return u >= 1.0 ? kInfinity : w0 * u / (1.0 - u); }
double position(double w0, double w) { return std::isinf(w) ? 1.0 : w / (w + w0); }

/// What the residue c + i d of pole p adds to P: of_c c + of_d d. Two forms, because Re K cancels to order w^2 at rest
/// (where K(0) = 0 has been used) and to order w^-2 far above.
struct Share {
  double of_c, of_d;
};
Share share_of(const Complex& p, double w0, double w) {
  const double a = p.real(), b = p.imag(), size2 = std::norm(p);
  if (w <= w0) {
    const double weight = (w * w + w0 * w0) * (w * w + w0 * w0) / (w0 * w0);
    if (b == 0.0) return {weight / (a * (a * a + w * w)), 0.0};
    const double d2 = (size2 - w * w) * (size2 - w * w) + 4.0 * a * a * w * w;
    const double of_q = ((4.0 * a * a + w * w) / size2 - 1.0) * weight / d2;  // q = 2 (a c + b d)
    return {2.0 * a * of_q - 4.0 * a * weight / d2, 2.0 * b * of_q};
  }
  // In v = (w0/w)^2, so that infinity is a number.
  const double v = std::isinf(w) ? 0.0 : (w0 / w) * (w0 / w);
  const double weight = (1.0 + v) * (1.0 + v) / (w0 * w0), x = v / (w0 * w0);
  if (b == 0.0) return {-a / (1.0 + a * a * x) * weight, 0.0};
  const double d2 = (size2 * x - 1.0) * (size2 * x - 1.0) + 4.0 * a * a * x;
  const double of_q = (1.0 - size2 * x) * weight / d2;
  return {2.0 * a * of_q - 4.0 * a * weight / d2, 2.0 * b * of_q};
}

struct Least {
  double value;
  double u;
};

double least_eigenvalue(const MatrixX& P) {
  return P.rows() == 1 ? P(0, 0) : Eigen::SelfAdjointEigenSolver<MatrixX>(P, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

/// Local minima over frequency of the smallest eigenvalue of P, the ends among them.
std::vector<Least> local_minima(const PoleResidue& model, double w0, const std::vector<double>& also_at,
                                Search search = kThorough) {
  std::vector<double> u;
  for (int n = 0; n <= search.intervals; ++n) u.push_back(static_cast<double>(n) / search.intervals);
  // Where an eigenvalue crosses the floor twice between two points of the grid, the minimum lies between the crossings.
  for (std::size_t k = 0; k < also_at.size(); ++k) {
    u.push_back(position(w0, also_at[k]));
    if (k > 0) u.push_back(0.5 * (position(w0, also_at[k - 1]) + position(w0, also_at[k])));
  }
  std::sort(u.begin(), u.end());
  const auto value = [&](double x) { return least_eigenvalue(weighted_real_part(model, w0, on_grid(w0, x))); };
  std::vector<double> f;
  for (double x : u) f.push_back(value(x));
  std::vector<Least> minima;
  for (std::size_t k = 0; k < u.size(); ++k) {
    if ((k > 0 && f[k - 1] < f[k]) || (k + 1 < u.size() && f[k + 1] < f[k])) continue;
    // Golden section between the neighbours.
    double low = u[k > 0 ? k - 1 : k], high = u[k + 1 < u.size() ? k + 1 : k];
    Least best{f[k], u[k]};
    for (int n = 0; n < search.steps && high > low; ++n) {
      const double golden = 0.3819660112501051;
      const double x1 = low + golden * (high - low), x2 = high - golden * (high - low);
      const double f1 = value(x1), f2 = value(x2);
      if (f1 < best.value) best = {f1, x1};
      if (f2 < best.value) best = {f2, x2};
      (f1 < f2 ? high : low) = f1 < f2 ? x2 : x1;
    }
    minima.push_back(best);
  }
  return minima;
}

/// The eigenvalues x at which P(x) - floor is singular, as frequencies where they lie on the negative real axis.
std::vector<double> singular_frequencies(const PoleResidue& model, double w0, double floor) {
  const int m = model.size();
  std::vector<Complex> poles;
  std::vector<MatrixXc> residues;
  for (std::size_t k = 0; k < model.poles.size(); ++k) {
    poles.push_back(model.poles[k]);
    residues.push_back(model.residues[k]);
    if (model.poles[k].imag() == 0.0) continue;
    poles.push_back(std::conj(model.poles[k]));
    residues.push_back(model.residues[k].conjugate());
  }
  const int n = static_cast<int>(poles.size());
  const MatrixX at_infinity = weighted_real_part(model, w0, kInfinity) - floor * MatrixX::Identity(m, m);
  const Eigen::LDLT<MatrixX> solver(at_infinity);
  MatrixXc solved(m, n * m);  // (P_inf - floor)^-1 T
  for (int k = 0; k < n; ++k) {
    const Complex p = poles[k], shifted = p * p - w0 * w0;
    const MatrixXc T = residues[k] * (-shifted * shifted / (p * w0 * w0));
    solved.middleCols(k * m, m).real() = solver.solve(T.real());
    solved.middleCols(k * m, m).imag() = solver.solve(T.imag());
  }
  MatrixXc matrix(n * m, n * m);
  for (int k = 0; k < n; ++k) {
    matrix.middleRows(k * m, m) = -solved;
    matrix.block(k * m, k * m, m, m).diagonal().array() += poles[k] * poles[k];
  }
  const Eigen::VectorXcd eigenvalues = Eigen::ComplexEigenSolver<MatrixXc>(matrix, false).eigenvalues();
  std::vector<double> result;
  for (const Complex& x : eigenvalues)
    if (x.real() <= 0.0 && std::abs(x.imag()) <= kOnAxis * std::abs(x)) result.push_back(std::sqrt(-x.real()));
  std::sort(result.begin(), result.end());
  return result;
}

PoleResidue from_parameters(const PoleBasis& basis, const MatrixX& parameters, int m) {
  PoleResidue model{basis.poles(), {}};
  for (int k = 0; k < static_cast<int>(basis.poles().size()); ++k) {
    MatrixXc R(m, m);
    for (int i = 0, e = 0; i < m; ++i)
      for (int j = i; j < m; ++j, ++e) R(i, j) = R(j, i) = basis.residue(parameters.col(e), k);
    model.residues.push_back(R);
  }
  return model;
}

/// Strictly passive with these poles: s/((s - p)(s - conj p)) of each pair, the same of real poles two by two.
PoleResidue strictly_passive(const std::vector<Complex>& poles, int m) {
  PoleResidue model{poles, std::vector<MatrixXc>(poles.size(), MatrixXc::Zero(m, m))};
  const MatrixXc I = MatrixXc::Identity(m, m);
  int lone = -1;
  for (int k = 0; k < static_cast<int>(poles.size()); ++k) {
    const Complex p = poles[k];
    if (p.imag() != 0.0) {
      model.residues[k] += Complex(0.5, -p.real() / (2.0 * p.imag())) * I;
    } else if (lone < 0) {
      lone = k;
    } else {
      const double a = poles[lone].real(), b = p.real();
      model.residues[lone] += a / (a - b) * I;
      model.residues[k] += b / (b - a) * I;
      lone = -1;
    }
  }
  return model;
}

void add_least_multiple(PoleResidue& model, const PoleResidue& addend, double w0, double floor) {
  for (double factor = 0.01 * floor;; factor *= 2.0) {
    PoleResidue sum = model;
    for (std::size_t k = 0; k < sum.residues.size(); ++k) sum.residues[k] += factor * addend.residues[k];
    if (!test_passivity(sum, w0, floor).passive) continue;
    model = sum;
    return;
  }
}

/// The least squares problem in coordinates in which it is the distance to a point.
class ResidueProblem {
 public:
  ResidueProblem(const PoleBasis& basis, const TransferSamples& samples, int m, double w0)
      : basis_(basis), m_(m), w0_(w0), free_(basis.order() - 1), entries_(m * (m + 1) / 2) {
    if (static_cast<int>(samples.entries.size()) != entries_)
      throw std::invalid_argument("fit_passive_residues: entries and size do not match");
    const int n = static_cast<int>(samples.frequency.size());
    MatrixX M = MatrixX::Zero(2 * n + free_, free_), Y = MatrixX::Zero(2 * n + free_, entries_);
    for (int k = 0; k < n; ++k) {
      const double weight = std::sqrt(samples.weight[k]);
      const Eigen::RowVectorXcd f = weight * basis.functions({0.0, samples.frequency[k]}) * basis.zero_at_rest();
      M.row(k) = f.real();
      M.row(n + k) = f.imag();
      for (int e = 0; e < entries_; ++e) {
        Y(k, e) = weight * samples.entries[e][k].real();
        Y(n + k, e) = weight * samples.entries[e][k].imag();
      }
    }
    // A trace of damping keeps residues of nearly coinciding poles from growing against each other.
    const double damping = 1e-9 * M.norm();
    M.bottomRows(free_).diagonal().setConstant(damping);
    const Eigen::HouseholderQR<MatrixX> qr(M);
    R_ = qr.matrixQR().topRows(free_).triangularView<Eigen::Upper>();
    const MatrixX QtY = qr.householderQ().transpose() * Y;
    best_ = QtY.topRows(free_);
  }

  int size() const { return free_ * entries_; }
  /// Where the unconstrained minimum lies.
  VectorX best() const { return best_.reshaped(); }
  PoleResidue model(const VectorX& point) const {
    const MatrixX y = R_.triangularView<Eigen::Upper>().solve(point.reshaped(free_, entries_));
    return from_parameters(basis_, basis_.zero_at_rest() * y, m_);
  }
  /// v' P(w) v = (this row) . point
  VectorX row(double w, const VectorX& v) const {
    VectorX p(basis_.order());
    int first = 0;
    for (const Complex& pole : basis_.poles()) {
      const Share s = share_of(pole, w0_, w);
      p(first++) = s.of_c;
      if (pole.imag() != 0.0) p(first++) = s.of_d;
    }
    const VectorX q = R_.transpose().triangularView<Eigen::Lower>().solve(basis_.zero_at_rest().transpose() * p);
    VectorX result(size());
    for (int i = 0, e = 0; i < m_; ++i)
      for (int j = i; j < m_; ++j, ++e) result.segment(e * free_, free_) = (i == j ? 1.0 : 2.0) * v(i) * v(j) * q;
    return result;
  }
  /// Asks for `floor` where P falls noticeably below it. Returns the number of cuts.
  int add_cuts(const PoleResidue& model, const std::vector<Least>& minima, double floor, LeastDistance& to) const {
    int cuts = 0;
    for (const Least& minimum : minima) {
      if (minimum.value >= kNoticeable * floor) continue;
      const double w = on_grid(w0_, minimum.u);
      const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(weighted_real_part(model, w0_, w));
      for (int i = 0; i < m_ && eigen.eigenvalues()(i) < floor; ++i, ++cuts)
        to.add(row(w, eigen.eigenvectors().col(i)), floor);
    }
    return cuts;
  }

 private:
  const PoleBasis& basis_;
  int m_;
  double w0_;
  int free_, entries_;
  MatrixX R_, best_;
};

}  // namespace

MatrixX weighted_real_part(const PoleResidue& model, double w0, double w) {
  MatrixX P = MatrixX::Zero(model.size(), model.size());
  for (std::size_t k = 0; k < model.poles.size(); ++k) {
    const Share s = share_of(model.poles[k], w0, w);
    P += s.of_c * model.residues[k].real() + s.of_d * model.residues[k].imag();
  }
  return P;
}

PassivityTest test_passivity(const PoleResidue& model, double w0, double floor) {
  PassivityTest test;
  const double at_infinity = least_eigenvalue(weighted_real_part(model, w0, kInfinity));
  if (at_infinity > floor) test.crossings = singular_frequencies(model, w0, floor);
  test.least = kInfinity;
  for (const Least& minimum : local_minima(model, w0, test.crossings)) {
    if (minimum.value >= test.least) continue;
    test.least = minimum.value;
    test.frequency = on_grid(w0, minimum.u);
  }
  test.passive = at_infinity > floor && test.crossings.empty() && test.least >= floor;
  return test;
}

PassiveResidues fit_passive_residues(const PoleBasis& basis, const TransferSamples& samples, int m, double w0,
                                     double floor) {
  const ResidueProblem problem(basis, samples, m, w0);
  LeastDistance projection(problem.best());
  PassiveResidues result;
  for (int round = 0; round < kMaximumRounds; ++round) {
    result.model = problem.model(projection.point());
    result.test = test_passivity(result.model, w0, floor);
    if (result.test.passive) return result;
    result.constrained = true;
    const int added = problem.add_cuts(result.model, local_minima(result.model, w0, result.test.crossings),
                                       kCutAbove * floor, projection);
    result.cuts += added;
    if (added == 0 || !projection.solve()) break;
  }
  result.model = problem.model(projection.point());
  add_least_multiple(result.model, strictly_passive(basis.poles(), m), w0, floor);
  result.test = test_passivity(result.model, w0, floor);
  return result;
}

PoleResidue fit_nearly_passive_residues(const PoleBasis& basis, const TransferSamples& samples, int m, double w0,
                                        double floor) {
  const ResidueProblem problem(basis, samples, m, w0);
  LeastDistance projection(problem.best());
  for (int round = 0; round < kQuickRounds; ++round) {
    const PoleResidue model = problem.model(projection.point());
    const int added = problem.add_cuts(model, local_minima(model, w0, {}, kQuick), floor, projection);
    if (added == 0 || !projection.solve()) break;
  }
  return problem.model(projection.point());
}

}  // namespace stillhook
