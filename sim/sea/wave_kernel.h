// The inner loops of wave_field.h: sums of sines, cosines and exponentials over (component, point).
//
// This is the one file that is compiled with -ffast-math, so that the loops use the vector functions of the C library
// (libmvec, at most 4 units in the last place). It therefore includes nothing but plain C++: an inline function of
// another header compiled here could replace its strict twin elsewhere. Nothing in it looks for NaN.
#pragma once

namespace stillhook {

/// Points handled together; the last block of a set is filled up, so a point's value never depends on its place.
inline constexpr int kWaveBlock = 16;
/// Most components of a wave field: bounds the kernel's working memory (256 kB of stack).
inline constexpr int kMaxWaveComponents = 1024;

/// One component at a fixed time: amplitude a (m, ramp included), wavenumber k and its parts along x and y (1/m),
/// phase (rad) so that theta = kx x + ky y + phase; bed = exp(-2 k h), which deep water does not look at.
struct FrozenWave {
  double a, k, kx, ky, phase, bed;
};

/// kWaveBlock points in, elevation (m) and stretched pressure head (m) with their gradients out.
struct alignas(64) WaveBlock {
  double x[kWaveBlock], y[kWaveBlock], z[kWaveBlock];
  double elevation[kWaveBlock], elevation_x[kWaveBlock], elevation_y[kWaveBlock];
  double head[kWaveBlock], head_x[kWaveBlock], head_y[kWaveBlock], head_z[kWaveBlock];
};

/// Evaluates `count` <= kMaxWaveComponents components at a block of points. The elevation is always computed; the head
/// when `head`; gradients of what is computed when `gradients`. depth (m): of the bed, 0 for deep water.
void evaluate_waves(const FrozenWave* waves, int count, double depth, bool head, bool gradients, WaveBlock& block);

}  // namespace stillhook
