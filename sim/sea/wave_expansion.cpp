#include "sim/sea/wave_expansion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/sea/dispersion.h"
#include "sim/sea/wave_sums.h"

namespace stillhook {

namespace {

constexpr double kAccuracy = 1e-6;        // of the rms elevation, in time; of the head ten times as much
constexpr double kAccuracyAway = 1e-3;    // the same, off the expected path: waves push a hull a few centimetres off it
constexpr double kLongestInterval = 1.0;  // s

// Places of the terms.
enum Elevation { Z, Z_x, Z_y, Z_t, Z_xx, Z_xy, Z_yy, Z_xt, Z_yt, Z_tt, Z_xtt, Z_ytt, kElevationTerms };
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
  H_xtt,
  H_ytt,
  H_ztt,
  kTerms
};
static_assert(kTerms == kExpansionTerms);

// Sums of wave_sums.h. With E = C(s) cos th: E_ss = -E_xx - E_yy holds in any depth. E_tt = -g E_s, which does not,
// is not used.
enum ElevationSum { EC_1, EC_xx, EC_xy, EC_yy, EC_xt, EC_yt, EC_tt, ES_x, ES_y, ES_t, ES_xtt, ES_ytt, kOfElevation };
enum HeadSum {
  HC_1,
  HC_s,
  HC_xx,
  HC_xy,
  HC_yy,
  HC_xt,
  HC_yt,
  HC_tt,
  HC_stt,
  HC_xst,
  HC_yst,
  HS_x,
  HS_y,
  HS_t,
  HS_xs,
  HS_ys,
  HS_ts,
  HS_xtt,
  HS_ytt,
  HS_sst,
  kOfHead
};
static_assert(ES_x == kElevationCosines && kOfElevation == kElevationSums && HS_x == kHeadCosines &&
              kOfHead == kHeadSums);

// `bed`: exp(-2 k h). The head's factors hold what normalises cosh k(z' + h) / cosh kh.
std::array<double, kExpansionFactors> factors_of(const WaveComponent& c, double bed) {
  const double a = c.amplitude, k = c.wavenumber, w = c.frequency, x = k * c.cos_heading, y = k * c.sin_heading;
  // d/dx cos = -kx sin, d/dt cos = +w sin; d/dx sin = kx cos, d/dt sin = -w cos; d/ds = k.
  std::array<double, kExpansionFactors> f = {1.0,    -x * x,     -x * y,    -y * y,    x * w,     y * w,    -w * w,
                                             -x,     -y,         w,         x * w * w, y * w * w,  // elevation
                                             1.0,    k,          -x * x,    -x * y,    -y * y,    x * w,    y * w,
                                             -w * w, -w * w * k, x * k * w, y * k * w, -x,        -y,       w,
                                             -x * k, -y * k,     w * k,     x * w * w, y * w * w, k * k * w};
  for (int i = 0; i < kExpansionFactors; ++i)
    f[static_cast<std::size_t>(i)] *= i < kElevationSums ? a : a / (1.0 + bed);
  return f;
}

// Value and derivatives by (x, y, s or z, t) of a function at one point.
struct Series {
  double value;
  Eigen::Vector4d first;
  Eigen::Matrix4d second;
  Eigen::Vector3d curvature_slope;                       // of the second derivative by t, by x, y, s or z
  Eigen::Vector3d rate_slope = Eigen::Vector3d::Zero();  // of the derivative by s and t, by x, y, s

  // The product with r(t).
  Series ramped(double r, double rate, double curvature) const {
    Series f{r * value, r * first, r * second, r * curvature_slope, {}};
    f.rate_slope = r * rate_slope + rate * second.col(2).head<3>();
    f.curvature_slope += 2.0 * rate * second.col(3).head<3>() + curvature * first.head<3>();
    f.first[3] += rate * value;
    f.second.col(3) += rate * first;
    f.second.row(3) += rate * first.transpose();
    f.second(3, 3) += curvature * value;
    return f;
  }
};

// `v` holds the sums of one point, v[i * kWaveBlock].
Series elevation_of(const double* v) {
  const auto at = [&](ElevationSum i) { return v[i * kWaveBlock]; };
  Series f;
  f.value = at(EC_1);
  f.first << at(ES_x), at(ES_y), 0.0, at(ES_t);
  f.second << at(EC_xx), at(EC_xy), 0.0, at(EC_xt),  //
      at(EC_xy), at(EC_yy), 0.0, at(EC_yt),          //
      0.0, 0.0, 0.0, 0.0,                            //
      at(EC_xt), at(EC_yt), 0.0, at(EC_tt);
  f.curvature_slope << at(ES_xtt), at(ES_ytt), 0.0;
  return f;
}

Series head_of(const double* v) {
  const auto at = [&](HeadSum i) { return v[i * kWaveBlock]; };
  Series f;
  f.value = at(HC_1);
  f.first << at(HS_x), at(HS_y), at(HC_s), at(HS_t);
  f.second << at(HC_xx), at(HC_xy), at(HS_xs), at(HC_xt),       //
      at(HC_xy), at(HC_yy), at(HS_ys), at(HC_yt),               //
      at(HS_xs), at(HS_ys), -at(HC_xx) - at(HC_yy), at(HS_ts),  //
      at(HC_xt), at(HC_yt), at(HS_ts), at(HC_tt);
  f.curvature_slope << at(HS_xtt), at(HS_ytt), at(HC_stt);
  f.rate_slope << at(HC_xst), at(HC_yst), at(HS_sst);
  return f;
}

// Derivatives of the stretched height s(x, y, z, t), in the places of a Series.
struct StretchedHeight {
  Eigen::Vector4d first;
  Eigen::Matrix4d second;
  Eigen::Vector3d curvature_slope;
};

// s = z - zeta.
StretchedHeight shifted(const Series& zeta) {
  return {Eigen::Vector4d::UnitZ() - zeta.first, -zeta.second, -zeta.curvature_slope};
}

// s = h (z + h) / (h + zeta) - h.
StretchedHeight squeezed(const Series& zeta, double z, double h) {
  const double column = h + zeta.value, up = h / column, share = up * (z + h) / column;
  StretchedHeight s;
  s.first = -share * zeta.first;
  s.first[2] = up;
  s.second = -share * zeta.second + 2.0 * share / column * zeta.first * zeta.first.transpose();
  s.second.col(2) = -up / column * zeta.first;
  s.second.row(2) = s.second.col(2).transpose();
  s.curvature_slope = -share * zeta.curvature_slope;
  s.curvature_slope[2] = -up / column * zeta.second(3, 3);
  return s;
}

// h(x, y, z, t) = E(x, y, s(x, y, z, t), t).
Series stretched(const Series& E, const StretchedHeight& s) {
  Eigen::Vector4d e = E.first, mixed = E.second.col(2);
  const double e_s = e[2], e_ss = mixed[2];
  const Eigen::Vector3d e_si = mixed.head<3>();  // of E_s, by x, y, s
  e[2] = mixed[2] = 0.0;                         // E knows no z but through s
  Eigen::Matrix4d second = E.second;
  second.row(2).setZero();
  second.col(2).setZero();
  Series h;
  h.value = E.value;
  h.first = e + e_s * s.first;
  h.second = second + mixed * s.first.transpose() + s.first * mixed.transpose() +
             e_ss * s.first * s.first.transpose() + e_s * s.second;
  // Of h_tt = E_tt + 2 E_st s_t + E_ss s_t^2 + E_s s_tt, to the second order in the waves.
  const Eigen::Vector3d up = s.first.head<3>(), s_it = s.second.col(3).head<3>();
  h.curvature_slope = E.curvature_slope + E.curvature_slope[2] * (up - Eigen::Vector3d::UnitZ()) +
                      2.0 * s.first[3] * E.rate_slope + 2.0 * mixed[3] * s_it + s.second(3, 3) * e_si +
                      e_s * s.curvature_slope;
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
  put(Z_xtt, zeta.curvature_slope[0]);
  put(Z_ytt, zeta.curvature_slope[1]);
  for (int i = 0; i < 3; ++i) put(H_xtt + i, h.curvature_slope[i]);
}

}  // namespace

std::array<HermiteWeights, 3> hermite_weights(double s, double H) {
  // The cube of each instant's own quadratic, times the Taylor polynomial of its reciprocal there. e: from the instant.
  const auto outer = [H](double e, double sign) {
    const double q = (1.0 + e) * (1.0 + 0.5 * e), q3 = q * q * q;
    return HermiteWeights{q3 * (1.0 + e * (-4.5 + 12.0 * e)), sign * H * q3 * e * (1.0 - 4.5 * e),
                          0.5 * H * H * q3 * e * e};
  };
  const double q = 1.0 - s * s, q3 = q * q * q;
  return {outer(-s - 1.0, -1.0), {q3 * (1.0 + 3.0 * s * s), H * q3 * s, 0.5 * H * H * q3 * s * s}, outer(s - 1.0, 1.0)};
}

WaveExpansion::WaveExpansion(std::shared_ptr<const WaveField> waves) : waves_(std::move(waves)) {
  double energy = 0.0, ninth = 0.0, mixed = 0.0, third = 0.0, steep = 0.0;  // sums of a^2, (a w^9)^2, (a w^2 k)^2 ...
  for (const WaveComponent& c : waves_->components()) {
    const auto factors = factors_of(c, bed_reflection(c.wavenumber, waves_->depth()));
    factor_.insert(factor_.end(), factors.begin(), factors.end());
    const double a2 = c.amplitude * c.amplitude, w = c.frequency, k = c.wavenumber;
    energy += a2;
    ninth += a2 * std::pow(w, 18);
    mixed += a2 * std::pow(w * w * k, 2);
    third += a2 * std::pow(k, 6);
    steep += 0.5 * a2 * k * k;
  }
  if (!(energy > 0.0)) return;
  const auto rms = [energy](double sum) { return std::sqrt(sum / energy); };
  interval_ = std::min(std::pow(6.36e6 * kAccuracy / rms(ninth), 1.0 / 9.0), kLongestInterval);
  const double product = 0.06 * interval_ * interval_ * rms(mixed) * 2.0 * std::sqrt(steep);
  reach_ = std::min(kAccuracyAway / product, std::cbrt(6.0 * kAccuracyAway / rms(third)));
}

void WaveExpansion::expand(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
                           std::size_t stride, double* terms) const {
  const auto& components = waves_->components();
  const int count = static_cast<int>(components.size());
  std::array<FrozenWave, kMaxWaveComponents> frozen;
  for (int j = 0; j < count; ++j) {
    const WaveComponent& c = components[static_cast<std::size_t>(j)];
    frozen[j] = {1.0, c.wavenumber, c.wavenumber * c.cos_heading, c.wavenumber * c.sin_heading,
                 std::remainder(c.phase - c.frequency * t, 2.0 * std::numbers::pi),
                 bed_reflection(c.wavenumber, waves_->depth())};
  }
  // A sea without a ramp stands as it does before a run begins, too, where the first instant of a run may lie.
  const auto [r, rate, curvature] = waves_->ramp_derivatives(std::max(t, 0.0));
  ExpansionBlock block;
  for (std::size_t start = 0; start < x.size(); start += kWaveBlock) {
    const std::size_t n = std::min<std::size_t>(kWaveBlock, x.size() - start);
    for (std::size_t p = 0; p < kWaveBlock; ++p) {
      const std::size_t i = start + std::min(p, n - 1);
      block.x[p] = x[i], block.y[p] = y[i], block.z[p] = z[i];
    }
    if (waves_->deep())
      sum_expansions(frozen.data(), count, r, factor_.data(), block);
    else
      sum_expansions_over_bed(frozen.data(), count, r, waves_->depth(), factor_.data(), block);
    for (std::size_t p = 0; p < n; ++p) {
      const Series zeta = elevation_of(&block.elevation[0][p]).ramped(r, rate, curvature);
      const Series E = head_of(&block.head[0][p]).ramped(r, rate, curvature);
      const StretchedHeight s = waves_->deep() ? shifted(zeta) : squeezed(zeta, block.z[p], waves_->depth());
      store(zeta, stretched(E, s), stride, terms + start + p);
    }
  }
}

void WaveExpansion::add(const double* terms, std::size_t stride, const HermiteWeights& w, std::span<const double> dx,
                        std::span<const double> dy, std::span<const double> dz, const WaveSamples& out) {
  const auto n = static_cast<Eigen::Index>(dx.size());
  const auto term = [&](int i) {
    return Eigen::Map<const Eigen::ArrayXd>(terms + static_cast<std::size_t>(i) * stride, n);
  };
  const auto to = [&](std::span<double> v) { return Eigen::Map<Eigen::ArrayXd>(v.data(), n); };
  const Eigen::Map<const Eigen::ArrayXd> x(dx.data(), n), y(dy.data(), n), z(dz.data(), n);
  const double p0 = w.value, p1 = w.rate, p2 = w.curvature;

  to(out.elevation) +=
      p0 *
          (term(Z) + x * (term(Z_x) + 0.5 * x * term(Z_xx) + y * term(Z_xy)) + y * (term(Z_y) + 0.5 * y * term(Z_yy))) +
      p1 * (term(Z_t) + x * term(Z_xt) + y * term(Z_yt)) + p2 * (term(Z_tt) + x * term(Z_xtt) + y * term(Z_ytt));
  to(out.elevation_x) += p0 * (term(Z_x) + x * term(Z_xx) + y * term(Z_xy)) + p1 * term(Z_xt) + p2 * term(Z_xtt);
  to(out.elevation_y) += p0 * (term(Z_y) + x * term(Z_xy) + y * term(Z_yy)) + p1 * term(Z_yt) + p2 * term(Z_ytt);
  to(out.head) +=
      p0 * (term(H) + x * (term(H_x) + 0.5 * x * term(H_xx) + y * term(H_xy) + z * term(H_xz)) +
            y * (term(H_y) + 0.5 * y * term(H_yy) + z * term(H_yz)) + z * (term(H_z) + 0.5 * z * term(H_zz))) +
      p1 * (term(H_t) + x * term(H_xt) + y * term(H_yt) + z * term(H_zt)) +
      p2 * (term(H_tt) + x * term(H_xtt) + y * term(H_ytt) + z * term(H_ztt));
  to(out.head_x) +=
      p0 * (term(H_x) + x * term(H_xx) + y * term(H_xy) + z * term(H_xz)) + p1 * term(H_xt) + p2 * term(H_xtt);
  to(out.head_y) +=
      p0 * (term(H_y) + x * term(H_xy) + y * term(H_yy) + z * term(H_yz)) + p1 * term(H_yt) + p2 * term(H_ytt);
  to(out.head_z) +=
      p0 * (term(H_z) + x * term(H_xz) + y * term(H_yz) + z * term(H_zz)) + p1 * term(H_zt) + p2 * term(H_ztt);
}

}  // namespace stillhook
