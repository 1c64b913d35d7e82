#include "sim/sea/wave_expansion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/sea/wave_kernel.h"

namespace stillhook {

namespace {

constexpr double kAccuracy = 1e-5;        // of the rms elevation, in time
constexpr double kAccuracyAway = 1e-3;    // the same, off the expected path: waves push a hull a few centimetres off it
constexpr double kLongestInterval = 1.0;  // s

// Places of the terms.
enum Elevation { Z, Z_x, Z_y, Z_t, Z_xx, Z_xy, Z_yy, Z_xt, Z_yt, Z_tt, kElevationTerms };
enum Head {
  H = kElevationTerms,
  H_x,
  H_y,
  H_z,
  H_t,
  H_xx,
  H_xy,
  H_yy,
  H_xz,
  H_yz,
  H_zz,
  H_xt,
  H_yt,
  H_zt,
  H_tt,
  kTerms
};
static_assert(kTerms == kExpansionTerms);

// Sums of the kernel: factors of the cosine first, then of the sine. With E = exp(k s) cos th:
// E_xx + E_yy + E_ss = 0 and E_tt = -g E_s are not used, so that waves of finite depth could come.
enum Sum { C_1, C_k, C_kk, C_xx, C_xy, C_yy, C_xt, C_yt, C_tt, S_x, S_y, S_t, S_xk, S_yk, S_tk, kSums };
constexpr int kCosines = S_x;

std::array<double, kSums> factors_of(const WaveComponent& c) {
  const double k = c.wavenumber, x = k * c.cos_heading, y = k * c.sin_heading, w = c.frequency;
  // d/dx cos = -kx sin, d/dt cos = +w sin; d/dx sin = kx cos, d/dt sin = -w cos.
  return {1.0, k, k * k, -x * x, -x * y, -y * y, x * w, y * w, -w * w, -x, -y, w, -x * k, -y * k, w * k};
}

// Value and derivatives by (x, y, s or z, t) of a function at one point.
struct Series {
  double value;
  Eigen::Vector4d first;
  Eigen::Matrix4d second;

  // The product with r(t).
  Series ramped(double r, double rate, double curvature) const {
    Series f{r * value, r * first, r * second};
    f.first[3] += rate * value;
    f.second.col(3) += rate * first;
    f.second.row(3) += rate * first.transpose();
    f.second(3, 3) += curvature * value;
    return f;
  }
};

// `v` holds the sums of one point, v[i * kWaveBlock].
Series series_of(const double* v, bool decaying) {
  const auto at = [&](Sum i) { return v[i * kWaveBlock]; };
  const double s = decaying ? 1.0 : 0.0;
  Series f;
  f.value = at(C_1);
  f.first << at(S_x), at(S_y), s * at(C_k), at(S_t);
  f.second << at(C_xx), at(C_xy), s * at(S_xk), at(C_xt),      //
      at(C_xy), at(C_yy), s * at(S_yk), at(C_yt),              //
      s * at(S_xk), s * at(S_yk), s * at(C_kk), s * at(S_tk),  //
      at(C_xt), at(C_yt), s * at(S_tk), at(C_tt);
  return f;
}

// h(x, y, z, t) = E(x, y, z - zeta(x, y, t), t).
Series stretched(const Series& E, const Series& zeta) {
  const Eigen::Vector4d s = Eigen::Vector4d::UnitZ() - zeta.first;
  Eigen::Vector4d e = E.first, mixed = E.second.col(2);
  const double e_s = e[2], e_ss = mixed[2];
  e[2] = mixed[2] = 0.0;  // E knows no z but through s
  Eigen::Matrix4d second = E.second;
  second.row(2).setZero();
  second.col(2).setZero();
  Series h;
  h.value = E.value;
  h.first = e + e_s * s;
  h.second = second + mixed * s.transpose() + s * mixed.transpose() + e_ss * s * s.transpose() - e_s * zeta.second;
  return h;
}

void store(const Series& zeta, const Series& h, std::size_t stride, double* to) {
  const auto put = [&](int term, double value) { to[static_cast<std::size_t>(term) * stride] = value; };
  const int z1[] = {Z_x, Z_y, -1, Z_t}, h1[] = {H_x, H_y, H_z, H_t};
  const int z2[4][4] = {{Z_xx, Z_xy, -1, Z_xt}, {-1, Z_yy, -1, Z_yt}, {-1, -1, -1, -1}, {-1, -1, -1, Z_tt}};
  const int h2[4][4] = {{H_xx, H_xy, H_xz, H_xt}, {-1, H_yy, H_yz, H_yt}, {-1, -1, H_zz, H_zt}, {-1, -1, -1, H_tt}};
  put(Z, zeta.value);
  put(H, h.value);
  for (int i = 0; i < 4; ++i) {
    if (z1[i] >= 0) put(z1[i], zeta.first[i]);
    put(h1[i], h.first[i]);
    for (int j = i; j < 4; ++j) {
      if (z2[i][j] >= 0) put(z2[i][j], zeta.second(i, j));
      put(h2[i][j], h.second(i, j));
    }
  }
}

}  // namespace

std::pair<HermiteWeights, HermiteWeights> quintic_hermite(double s, double H) {
  const auto end = [H](double u, double sign) {  // u from this end
    const double v = 1.0 - u, v3 = v * v * v;
    return HermiteWeights{v3 * (1.0 + u * (3.0 + 6.0 * u)), sign * H * u * v3 * (1.0 + 3.0 * u),
                          0.5 * H * H * u * u * v3};
  };
  return {end(s, 1.0), end(1.0 - s, -1.0)};
}

WaveExpansion::WaveExpansion(std::shared_ptr<const WaveField> waves) : waves_(std::move(waves)) {
  const auto& components = waves_->components();
  const std::size_t n = components.size();
  factor_.resize(kSums * n);
  double energy = 0.0, sixth = 0.0, mixed = 0.0, third = 0.0;  // sums of a^2, (a w^6)^2, (a w^2 k)^2, (a k^3)^2
  for (std::size_t j = 0; j < n; ++j) {
    const WaveComponent& c = components[j];
    const auto factors = factors_of(c);
    for (std::size_t i = 0; i < kSums; ++i) factor_[i * n + j] = factors[i];
    const double a2 = c.amplitude * c.amplitude, w = c.frequency, k = c.wavenumber;
    energy += a2;
    sixth += a2 * std::pow(w, 12);
    mixed += a2 * std::pow(w * w * k, 2);
    third += a2 * std::pow(k, 6);
  }
  if (!(energy > 0.0)) return;
  const auto rms = [energy](double sum) { return std::sqrt(sum / energy); };
  interval_ = std::min(std::pow(46080.0 * kAccuracy / rms(sixth), 1.0 / 6.0), kLongestInterval);
  reach_ = std::min(32.0 * kAccuracyAway / (interval_ * interval_ * rms(mixed)),
                    std::cbrt(6.0 * kAccuracyAway / rms(third)));
}

void WaveExpansion::expand(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
                           std::size_t stride, double* terms) const {
  const auto& components = waves_->components();
  const int count = static_cast<int>(components.size());
  std::array<FrozenWave, kMaxWaveComponents> frozen;
  for (int j = 0; j < count; ++j) {
    const WaveComponent& c = components[static_cast<std::size_t>(j)];
    frozen[j] = {c.amplitude, c.wavenumber, c.wavenumber * c.cos_heading, c.wavenumber * c.sin_heading,
                 std::remainder(c.phase - c.frequency * t, 2.0 * std::numbers::pi)};
  }
  const auto [r, rate, curvature] = waves_->ramp_derivatives(t);
  ExpansionBlock block;
  for (std::size_t start = 0; start < x.size(); start += kWaveBlock) {
    const std::size_t n = std::min<std::size_t>(kWaveBlock, x.size() - start);
    for (std::size_t p = 0; p < kWaveBlock; ++p) {
      const std::size_t i = start + std::min(p, n - 1);
      block.x[p] = x[i], block.y[p] = y[i], block.z[p] = z[i];
    }
    expand_waves(frozen.data(), count, r, factor_.data(), kCosines, kSums, block);
    for (std::size_t p = 0; p < n; ++p) {
      const Series zeta = series_of(&block.elevation[0][p], false).ramped(r, rate, curvature);
      const Series E = series_of(&block.head[0][p], true).ramped(r, rate, curvature);
      store(zeta, stretched(E, zeta), stride, terms + start + p);
    }
  }
}

void WaveExpansion::add(const double* terms, std::size_t stride, const HermiteWeights& w, std::span<const double> dx,
                        std::span<const double> dy, std::span<const double> dz, bool gradients,
                        const WaveSamples& out) {
  const auto n = static_cast<Eigen::Index>(dx.size());
  const auto term = [&](int i) {
    return Eigen::Map<const Eigen::ArrayXd>(terms + static_cast<std::size_t>(i) * stride, n);
  };
  const auto to = [&](std::span<double> v) { return Eigen::Map<Eigen::ArrayXd>(v.data(), n); };
  const Eigen::Map<const Eigen::ArrayXd> x(dx.data(), n), y(dy.data(), n), z(dz.data(), n);
  const double p0 = w.value, p1 = w.rate, p2 = w.curvature;

  to(out.elevation) += p0 * (term(Z) + x * (term(Z_x) + 0.5 * x * term(Z_xx) + y * term(Z_xy)) +
                             y * (term(Z_y) + 0.5 * y * term(Z_yy))) +
                       p1 * (term(Z_t) + x * term(Z_xt) + y * term(Z_yt)) + p2 * term(Z_tt);
  if (gradients) {
    to(out.elevation_x) += p0 * (term(Z_x) + x * term(Z_xx) + y * term(Z_xy)) + p1 * term(Z_xt);
    to(out.elevation_y) += p0 * (term(Z_y) + x * term(Z_xy) + y * term(Z_yy)) + p1 * term(Z_yt);
  }
  if (out.head.empty()) return;
  to(out.head) +=
      p0 * (term(H) + x * (term(H_x) + 0.5 * x * term(H_xx) + y * term(H_xy) + z * term(H_xz)) +
            y * (term(H_y) + 0.5 * y * term(H_yy) + z * term(H_yz)) + z * (term(H_z) + 0.5 * z * term(H_zz))) +
      p1 * (term(H_t) + x * term(H_xt) + y * term(H_yt) + z * term(H_zt)) + p2 * term(H_tt);
  if (!gradients) return;
  to(out.head_x) += p0 * (term(H_x) + x * term(H_xx) + y * term(H_xy) + z * term(H_xz)) + p1 * term(H_xt);
  to(out.head_y) += p0 * (term(H_y) + x * term(H_xy) + y * term(H_yy) + z * term(H_yz)) + p1 * term(H_yt);
  to(out.head_z) += p0 * (term(H_z) + x * term(H_xz) + y * term(H_yz) + z * term(H_zz)) + p1 * term(H_zt);
}

}  // namespace stillhook
