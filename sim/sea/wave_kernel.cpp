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

// Dynamic head and, for a fixed elevation, its derivatives by x and y (through the phase) and z.
void add_head(const FrozenWave& w, bool gradients, WaveBlock& b, const double* c, const double* s) {
  alignas(64) double e[B];
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const double depth = b.elevation[p] - b.z[p];
    e[p] = w.a * std::exp(-w.k * (depth > 0.0 ? depth : 0.0));
  }
#pragma omp simd
  for (int p = 0; p < B; ++p) b.head[p] += e[p] * c[p];
  if (!gradients) return;
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    b.head_x[p] -= w.kx * e[p] * s[p];
    b.head_y[p] -= w.ky * e[p] * s[p];
    b.head_z[p] += w.k * e[p] * c[p];
  }
}

void clear(double* v) {
  for (int p = 0; p < B; ++p) v[p] = 0.0;
}

}  // namespace

void evaluate_waves(const FrozenWave* waves, int count, bool head, bool gradients, WaveBlock& b) {
  alignas(64) double c[kMaxWaveComponents * B];
  alignas(64) double s[kMaxWaveComponents * B];
  clear(b.elevation), clear(b.elevation_x), clear(b.elevation_y);
  for (int j = 0; j < count; ++j) add_elevation(waves[j], gradients, b, c + j * B, s + j * B);
  if (!head) return;

  clear(b.head), clear(b.head_x), clear(b.head_y), clear(b.head_z);
  for (int j = 0; j < count; ++j) add_head(waves[j], gradients, b, c + j * B, s + j * B);
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const bool above = b.z[p] > b.elevation[p];
    const double still = above ? b.elevation[p] : b.head[p];
    b.head[p] = still - b.z[p];
  }
  if (!gradients) return;
    // Chain rule through the elevation: the stretched depth is zeta - z.
#pragma omp simd
  for (int p = 0; p < B; ++p) {
    const bool above = b.z[p] > b.elevation[p];
    const double hx = b.head_x[p] - b.head_z[p] * b.elevation_x[p];
    const double hy = b.head_y[p] - b.head_z[p] * b.elevation_y[p];
    b.head_x[p] = above ? b.elevation_x[p] : hx;
    b.head_y[p] = above ? b.elevation_y[p] : hy;
    b.head_z[p] = above ? -1.0 : b.head_z[p] - 1.0;
  }
}

}  // namespace stillhook
