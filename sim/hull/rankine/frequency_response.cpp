#include "sim/hull/rankine/frequency_response.h"


#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "sim/sea/dispersion.h"

namespace stillhook::rankine {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;

constexpr int kMostIterations = 400;

/// N X for complex X, both parts in one real product, in single precision: its 1e-7 is far below what GMRES is asked for,
/// and half the memory is read. Rows of N are shared out in blocks of a fixed size, so the result does not depend on the
/// number of threads.
class SharedProduct {
 public:
  explicit SharedProduct(const MatrixX& N) : N_(N.cast<float>()) {}

  void operator()(const std::vector<VectorXc>& X, std::vector<VectorXc>& Y) {
    const int n = static_cast<int>(X.size()), rows = static_cast<int>(N_.rows());
    in_.resize(N_.cols(), 2 * n);
    out_.resize(rows, 2 * n);
    for (int k = 0; k < n; ++k) {
      in_.col(2 * k) = X[k].real().cast<float>();
      in_.col(2 * k + 1) = X[k].imag().cast<float>();
    }
    constexpr int kBlock = 192;
    const int blocks = (rows + kBlock - 1) / kBlock;
#pragma omp parallel for schedule(dynamic, 1)
    for (int b = 0; b < blocks; ++b) {
      const int first = b * kBlock, count = std::min(kBlock, rows - first);
      out_.middleRows(first, count).noalias() = N_.middleRows(first, count) * in_;
    }
    Y.resize(n);
    for (int k = 0; k < n; ++k) {
      Y[k].resize(rows);
      Y[k].real() = out_.col(2 * k).cast<double>();
      Y[k].imag() = out_.col(2 * k + 1).cast<double>();
    }
  }

 private:
  Eigen::MatrixXf N_, in_, out_;
};

/// One right-hand side of GMRES without restart: Arnoldi by modified Gram-Schmidt, Givens rotations.
class Krylov {
 public:
  Krylov(const VectorXc& b, double tolerance) : norm_(b.norm()), limit_(tolerance * b.norm()) {
    if (norm_ == 0.0) {
      done_ = true;
      return;
    }
    basis_.push_back(b / norm_);
    rhs_.push_back(norm_);
  }

  bool done() const { return done_; }
  int iterations() const { return static_cast<int>(basis_.size()) - 1; }
  const VectorXc& direction() const { return basis_.back(); }

  /// Takes A times direction().
  void advance(VectorXc w) {
    const int k = static_cast<int>(basis_.size());
    VectorXc h(k + 1);
    for (int i = 0; i < k; ++i) {
      h(i) = basis_[i].dot(w);
      w -= h(i) * basis_[i];
    }
    const double length = w.norm();
    h(k) = length;
    for (int i = 0; i + 1 < k; ++i) rotate(i, h(i), h(i + 1));
    const double r = std::hypot(std::abs(h(k - 1)), length);
    cosine_.push_back(h(k - 1) / r);
    sine_.push_back(length / r);
    h(k - 1) = r;
    rhs_.push_back(-sine_.back() * rhs_.back());
    rhs_[k - 1] = std::conj(cosine_.back()) * rhs_[k - 1];
    columns_.push_back(h.head(k));
    done_ = std::abs(rhs_.back()) <= limit_ || length == 0.0;
    basis_.push_back(length > 0.0 ? VectorXc(w / length) : w);
  }

  VectorXc solution(int size) const {
    const int k = static_cast<int>(columns_.size());
    VectorXc x = VectorXc::Zero(size);
    if (k == 0) return x;
    VectorXc y(k);
    for (int i = k - 1; i >= 0; --i) {
      Complex sum = rhs_[i];
      for (int j = i + 1; j < k; ++j) sum -= columns_[j](i) * y(j);
      y(i) = sum / columns_[i](i);
    }
    for (int i = 0; i < k; ++i) x += y(i) * basis_[i];
    return x;
  }

 private:
  void rotate(int i, Complex& a, Complex& b) const {
    const Complex first = std::conj(cosine_[i]) * a + sine_[i] * b;
    b = -sine_[i] * a + cosine_[i] * b;
    a = first;
  }

  double norm_, limit_;
  bool done_ = false;
  std::vector<VectorXc> basis_, columns_;
  std::vector<Complex> rhs_, cosine_;
  std::vector<double> sine_;
};

std::runtime_error not_converged(double frequency) {
  std::ostringstream sentence;
  sentence << "the panel method did not converge at " << frequency << " rad/s in " << kMostIterations << " iterations";
  return std::runtime_error(sentence.str());
}

/// One step after the other for some frequencies, all their columns together.
class Responses {
 public:
  Responses(const BoundaryClass& problem, const SurfacePanels& surface, const Beach& beach, double gravity)
      : problem_(problem), surface_(surface), beach_(beach), gravity_(gravity), product_(problem.N) {}

  void add(std::span<const double> frequencies, std::span<const MatrixXc> v, double tolerance,
           std::vector<FrequencyResponse>& responses) {
    std::vector<VectorXc> kappa;
    std::vector<Krylov> columns;
    std::vector<int> frequency_of;
    for (std::size_t f = 0; f < frequencies.size(); ++f) {
      kappa.push_back(kappa_at(frequencies[f]));
      for (int c = 0; c < v[f].cols(); ++c) {
        columns.emplace_back(problem_.R * v[f].col(c), tolerance);
        frequency_of.push_back(static_cast<int>(f));
      }
    }
    solve(frequencies, kappa, frequency_of, columns);
    int k = 0;
    for (std::size_t f = 0; f < frequencies.size(); ++f) {
      FrequencyResponse& response = responses.emplace_back();
      response.frequency = frequencies[f];
      response.hull.resize(problem_.C.rows(), v[f].cols());
      response.surface.resize(surface_.size(), v[f].cols());
      for (int c = 0; c < v[f].cols(); ++c, ++k) {
        response.surface.col(c) = columns[k].solution(surface_.size());
        const VectorXc q = kappa[f].cwiseProduct(response.surface.col(c));
        response.hull.col(c) = problem_.C * q + problem_.hull_response * v[f].col(c);
        response.iterations = std::max(response.iterations, columns[k].iterations());
      }
      if (!surface_.in_gap.empty()) response.taken_by_gap = taken_by_gap(frequencies[f], response.surface);
    }
  }

 private:
  /// kappa = w^2 (1 + i (beach + gap))^2/g: the gap's part of its imaginary part is 2 w^2 gap/g.
  MatrixX taken_by_gap(double frequency, const MatrixXc& surface) const {
    VectorX weight = VectorX::Zero(surface_.size());
    for (int i = 0; i < surface_.size(); ++i)
      if (surface_.in_gap[i]) weight(i) = 2.0 * frequency * frequency * beach_.gap / gravity_ * surface_.area[i];
    return (surface.transpose() * weight.asDiagonal() * surface.conjugate()).real();
  }

  VectorXc kappa_at(double frequency) const {
    VectorXc kappa(surface_.size());
    const double strength = beach_.strength * energy_speed(frequency, gravity_, beach_.depth);
    for (int i = 0; i < surface_.size(); ++i) {
      const double s = surface_.distance[i] / beach_.width;
      const double gap = !surface_.in_gap.empty() && surface_.in_gap[i] ? beach_.gap : 0.0;
      const Complex w(frequency, (strength * s * s + gap) * frequency);
      kappa(i) = w * w / gravity_;
    }
    return kappa;
  }

  void solve(std::span<const double> frequencies, const std::vector<VectorXc>& kappa,
             const std::vector<int>& frequency_of, std::vector<Krylov>& columns) {
    std::vector<VectorXc> in, out;
    for (int iteration = 0;; ++iteration) {
      std::vector<int> active;
      for (std::size_t k = 0; k < columns.size(); ++k)
        if (!columns[k].done()) active.push_back(static_cast<int>(k));
      if (active.empty()) return;
      if (iteration == kMostIterations) throw not_converged(frequencies[frequency_of[active.front()]]);
      in.resize(active.size());
      for (std::size_t a = 0; a < active.size(); ++a)
        in[a] = kappa[frequency_of[active[a]]].cwiseProduct(columns[active[a]].direction());
      product_(in, out);
#pragma omp parallel for schedule(dynamic, 1)
      for (std::size_t a = 0; a < active.size(); ++a) {
        Krylov& column = columns[active[a]];
        column.advance(column.direction() - out[a]);
      }
    }
  }

  const BoundaryClass& problem_;
  const SurfacePanels& surface_;
  const Beach& beach_;
  double gravity_;
  SharedProduct product_;
};

}  // namespace

double energy_speed(double frequency, double gravity, double depth) {
  if (std::isinf(depth)) return 1.0;
  return 2.0 * wave_number(frequency, gravity, depth) * group_velocity(frequency, gravity, depth) / frequency;
}

std::vector<FrequencyResponse> frequency_responses(const BoundaryClass& problem, const SurfacePanels& surface,
                                                   const Beach& beach, double gravity,
                                                   std::span<const double> frequencies, std::span<const MatrixXc> v,
                                                   double tolerance) {
  Responses solver(problem, surface, beach, gravity);
  std::vector<FrequencyResponse> responses;
  for (std::size_t first = 0; first < frequencies.size();) {
    std::size_t count = 1;
    Eigen::Index columns = v[first].cols();
    while (first + count < frequencies.size() && columns + v[first + count].cols() <= kColumnsAtOnce)
      columns += v[first + count++].cols();
    solver.add(frequencies.subspan(first, count), v.subspan(first, count), tolerance, responses);
    first += count;
  }
  return responses;
}

}  // namespace stillhook::rankine
