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

// Two sums in one pass over the values of all components.
void weighted_sums(const double* value, const double* w0, const double* w1, int count, double* out0, double* out1) {
  alignas(64) double a[B], b[B];
  for (int p = 0; p < B; ++p) a[p] = b[p] = 0.0;
  for (int j = 0; j < count; ++j) {
    const double* v = value + j * B;
#pragma omp simd
    for (int p = 0; p < B; ++p) {
      a[p] += w0[j] * v[p];
      b[p] += w1[j] * v[p];
    }
  }
  for (int p = 0; p < B; ++p) out0[p] = a[p], out1[p] = b[p];
}

// a cos and a sin of every component, B values each.
struct Phases {
  alignas(64) double c[kMaxWaveComponents * B];
  alignas(64) double s[kMaxWaveComponents * B];
};

// Not const: the compiler would take the values beyond `count` for forgotten.
void all_sums(Phases& of, const double* factor, int cosines, int sums, int count, double (*out)[B]) {
  for (int i = 0; i < sums; i += 2) {
    const int end = i < cosines ? cosines : sums;
    const int k = i + 1 < end ? i + 1 : i;  // the odd one out is summed twice
    weighted_sums(i < cosines ? of.c : of.s, factor + i * count, factor + k * count, count, out[i], out[k]);
    if (k == i) --i;
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

void expand_waves(const FrozenWave* waves, int count, double ramp, const double* factor, int cosines, int sums,
                  ExpansionBlock& b) {
  Phases of;
  for (int j = 0; j < count; ++j) {
    const FrozenWave& w = waves[j];
    alignas(64) double theta[B];
#pragma omp simd
    for (int p = 0; p < B; ++p) theta[p] = w.kx * b.x[p] + w.ky * b.y[p] + w.phase;
    cosines_of(theta, of.c + j * B);
    sines_of(theta, of.s + j * B);
#pragma omp simd
    for (int p = 0; p < B; ++p) {
      of.c[j * B + p] *= w.a;
      of.s[j * B + p] *= w.a;
    }
  }
  all_sums(of, factor, cosines, sums, count, b.elevation);
  for (int j = 0; j < count; ++j) {
    alignas(64) double e[B];
#pragma omp simd
    for (int p = 0; p < B; ++p) e[p] = std::exp(waves[j].k * (b.z[p] - ramp * b.elevation[0][p]));
#pragma omp simd
    for (int p = 0; p < B; ++p) {
      of.c[j * B + p] *= e[p];
      of.s[j * B + p] *= e[p];
    }
  }
  all_sums(of, factor, cosines, sums, count, b.head);
}

}  // namespace stillhook
