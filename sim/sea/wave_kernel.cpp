#include "sim/sea/wave_kernel.h"

#include <cmath>

namespace stillhook {

namespace {

constexpr int B = kWaveBlock;

// Sine and cosine in loops of their own: asked for together they become one scalar call.
void cosines_of(const double* theta, double* c) {
#pragma omp simd
  for (int p = 0; p < B; ++p) c[p] = std::cos(theta[p]);
}

void sines_of(const double* theta, double* s) {
#pragma omp simd
  for (int p = 0; p < B; ++p) s[p] = std::sin(theta[p]);
}

void add_elevation(const FrozenWave& w, bool gradients, WaveBlock& b, double* c, double* s) {
  alignas(64) double theta[B];
#pragma omp simd
  for (int p = 0; p < B; ++p) theta[p] = w.kx * b.x[p] + w.ky * b.y[p] + w.phase;
  cosines_of(theta, c);
#pragma omp simd
  for (int p = 0; p < B; ++p) b.elevation[p] += w.a * c[p];
  if (!gradients) return;
  sines_of(theta, s);
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    b.elevation_x[p] -= w.a * w.kx * s[p];
    b.elevation_y[p] -= w.a * w.ky * s[p];
  }
}

// How far under the surface the stretched points lie, m: 0 above it.
void stretch(double depth, const WaveBlock& b, double* down) {
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const double under = b.elevation[p] - b.z[p];
    down[p] = under > 0.0 ? under : 0.0;
  }
  if (depth == 0.0) return;
#pragma omp simd
  for (int p = 0; p < B; ++p) down[p] *= depth / (depth + b.elevation[p]);
}

// Dynamic head and, for a fixed elevation, its derivatives by x and y (through the phase) and the stretched z.
template <bool kBed>
void add_head(const FrozenWave& w, bool gradients, WaveBlock& b, const double* down, const double* c, const double* s) {
  alignas(64) double e[B], slope[B];
  const double a = kBed ? w.a / (1.0 + w.bed) : w.a;
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const double fall = std::exp(-w.k * down[p]);
    if (kBed) {
      const double back = w.bed / fall;  // exp(-k (z' + 2 h))
      e[p] = a * (fall + back);
      slope[p] = a * (fall - back);
    } else {
      e[p] = a * fall;
    }
  }
  const double* of_z = kBed ? slope : e;
#pragma omp simd
  for (int p = 0; p < B; ++p) b.head[p] += e[p] * c[p];
  if (!gradients) return;
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    b.head_x[p] -= w.kx * e[p] * s[p];
    b.head_y[p] -= w.ky * e[p] * s[p];
    b.head_z[p] += w.k * of_z[p] * c[p];
  }
}

void clear(double* v) {
  for (int p = 0; p < B; ++p) v[p] = 0.0;
}

}  // namespace

void evaluate_waves(const FrozenWave* waves, int count, double depth, bool head, bool gradients, WaveBlock& b) {
  alignas(64) double c[kMaxWaveComponents * B];
  alignas(64) double s[kMaxWaveComponents * B];
  clear(b.elevation), clear(b.elevation_x), clear(b.elevation_y);
  for (int j = 0; j < count; ++j) add_elevation(waves[j], gradients, b, c + j * B, s + j * B);
  if (!head) return;

  clear(b.head), clear(b.head_x), clear(b.head_y), clear(b.head_z);
  alignas(64) double down[B];
  stretch(depth, b, down);
  for (int j = 0; j < count; ++j)
    depth == 0.0 ? add_head<false>(waves[j], gradients, b, down, c + j * B, s + j * B)
                 : add_head<true>(waves[j], gradients, b, down, c + j * B, s + j * B);
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const bool above = b.z[p] > b.elevation[p];
    const double still = above ? b.elevation[p] : b.head[p];
    b.head[p] = still - b.z[p];
  }
  if (!gradients) return;
  // Chain rule through the elevation: the stretched z is z - zeta, over a bed h (z + h) / (h + zeta) - h.
  alignas(64) double by_zeta[B], by_z[B];
  for (int p = 0; p < B; ++p) {
    const double down_to_bed = depth == 0.0 ? 1.0 : depth / (depth + b.elevation[p]);
    by_z[p] = down_to_bed;
    by_zeta[p] = depth == 0.0 ? 1.0 : down_to_bed * (b.z[p] + depth) / (depth + b.elevation[p]);
  }
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const bool above = b.z[p] > b.elevation[p];
    const double hx = b.head_x[p] - by_zeta[p] * b.head_z[p] * b.elevation_x[p];
    const double hy = b.head_y[p] - by_zeta[p] * b.head_z[p] * b.elevation_y[p];
    b.head_x[p] = above ? b.elevation_x[p] : hx;
    b.head_y[p] = above ? b.elevation_y[p] : hy;
    b.head_z[p] = above ? -1.0 : by_z[p] * b.head_z[p] - 1.0;
  }
}

}  // namespace stillhook
