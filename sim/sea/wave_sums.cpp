#include "sim/sea/wave_sums.h"

namespace stillhook {

namespace {

#if defined(__AVX512F__)
constexpr int L = 8;
#elif defined(__AVX2__)
constexpr int L = 4;
#else
constexpr int L = 2;
#endif
typedef double Lanes __attribute__((vector_size(L * sizeof(double))));
typedef long long Bits __attribute__((vector_size(L * sizeof(double))));

constexpr double kShift = 0x1.8p52;  // added, it leaves the nearest integer in the low bits

inline Lanes load(const double* from) {
  Lanes v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

inline void store(const Lanes& v, double* to) { __builtin_memcpy(to, &v, sizeof v); }

inline Lanes all(double value) { return Lanes{} + value; }

// Cody & Waite's reduction to a quarter turn around zero and the polynomials of Moshier's Cephes library.
inline void sine_and_cosine(const Lanes& theta, Lanes& sine, Lanes& cosine) {
  const Lanes shifted = theta * 0x1.45f306dc9c883p-1 + kShift;  // 2 / pi
  const Bits quarter = (Bits)shifted;
  const Lanes n = shifted - kShift;
  Lanes r = theta - n * 0x1.921fb54442d18p0;
  r -= n * 0x1.1a62633145c07p-54;
  const Lanes q = r * r;
  Lanes s = q * 1.58962301576546568060e-10 - 2.50507477628578072866e-8;
  s = s * q + 2.75573136213857245213e-6;
  s = s * q - 1.98412698295895385996e-4;
  s = s * q + 8.33333333332211858878e-3;
  s = s * q - 1.66666666666666307295e-1;
  s = s * (q * r) + r;
  Lanes c = q * -1.13585365213876817300e-11 + 2.08757008419747316778e-9;
  c = c * q - 2.75573141792967388112e-7;
  c = c * q + 2.48015872888517045348e-5;
  c = c * q - 1.38888888888730564116e-3;
  c = c * q + 4.16666666666665929218e-2;
  c = c * (q * q) + (1.0 - 0.5 * q);
  const Bits odd = (quarter & 1) != 0;
  sine = (Lanes)((Bits)(odd ? c : s) ^ ((quarter & 2) << 62));
  cosine = (Lanes)((Bits)(odd ? s : c) ^ (((quarter + 1) & 2) << 62));
}

// 2^n times Taylor's polynomial of degree 11 on half an octave to either side: 6e-15.
inline Lanes exponential(const Lanes& argument) {
  const Lanes x = argument > -600.0 ? argument : all(-600.0);
  const Lanes shifted = x * 0x1.71547652b82fep0 + kShift;  // log2 e
  const Lanes n = shifted - kShift;
  Lanes r = x - n * 0x1.62e42fefa39efp-1;
  r -= n * 0x1.abc9e3b39803fp-56;
  Lanes p = r * (1.0 / 39916800.0) + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  return (Lanes)((Bits)p + ((Bits)shifted << 52));
}

template <int Cosines, int Sums>
inline void add_component(const double* factor, const Lanes& c, const Lanes& s, Lanes (&sum)[Sums]) {
#pragma GCC unroll 32
  for (int i = 0; i < Cosines; ++i) sum[i] += factor[i] * c;
#pragma GCC unroll 32
  for (int i = Cosines; i < Sums; ++i) sum[i] += factor[i] * s;
}

// The same with sinh, given as c_odd and s_odd, where it belongs.
inline void add_over_bed(const double* factor, const Lanes& c, const Lanes& s, const Lanes& c_odd, const Lanes& s_odd,
                         Lanes (&sum)[kHeadSums]) {
#pragma GCC unroll 32
  for (int i = 0; i < kHeadCosines; ++i) sum[i] += factor[i] * (kOddInDepth[i] ? c_odd : c);
#pragma GCC unroll 32
  for (int i = kHeadCosines; i < kHeadSums; ++i) sum[i] += factor[i] * (kOddInDepth[i] ? s_odd : s);
}

// L points of a block, from `first` on. depth: over a bed alone.
template <bool kBed>
void sum_lanes(const FrozenWave* waves, int count, double ramp, double depth, const double* factor, int first,
               ExpansionBlock& b) {
  Lanes c[kMaxWaveComponents], s[kMaxWaveComponents];
  const Lanes x = load(b.x + first), y = load(b.y + first), z = load(b.z + first);
  Lanes elevation[kElevationSums] = {};
  for (int j = 0; j < count; ++j) {
    const FrozenWave& w = waves[j];
    sine_and_cosine(w.kx * x + (w.ky * y + w.phase), s[j], c[j]);
    add_component<kElevationCosines>(factor + j * kExpansionFactors, c[j], s[j], elevation);
  }
  for (int i = 0; i < kElevationSums; ++i) store(elevation[i], b.elevation[i] + first);
  Lanes stretched = z - ramp * elevation[0];
  if (kBed) stretched *= depth / (depth + ramp * elevation[0]);
  Lanes head[kHeadSums] = {};
  for (int j = 0; j < count; ++j) {
    const Lanes e = exponential(waves[j].k * stretched);
    const double* of_head = factor + j * kExpansionFactors + kElevationSums;
    if (kBed) {
      const Lanes back = waves[j].bed / e, even = e + back, odd = e - back;
      add_over_bed(of_head, even * c[j], even * s[j], odd * c[j], odd * s[j], head);
    } else {
      add_component<kHeadCosines>(of_head, e * c[j], e * s[j], head);
    }
  }
  for (int i = 0; i < kHeadSums; ++i) store(head[i], b.head[i] + first);
}

inline Lanes phases(const double* wave, double x, double y, double t) {
  return load(wave) * x + load(wave + kPhaseBlock) * y - load(wave + 2 * kPhaseBlock) * t +
         load(wave + 3 * kPhaseBlock);
}

inline double total(const Lanes& sum) {
  double result = 0.0;
  for (int i = 0; i < L; ++i) result += sum[i];
  return result;
}

}  // namespace

void sum_expansions(const FrozenWave* waves, int count, double ramp, const double* factor, ExpansionBlock& block) {
  for (int first = 0; first < kWaveBlock; first += L)
    sum_lanes<false>(waves, count, ramp, 0.0, factor, first, block);
}

void sum_expansions_over_bed(const FrozenWave* waves, int count, double ramp, double depth, const double* factor,
                             ExpansionBlock& block) {
  for (int first = 0; first < kWaveBlock; first += L)
    sum_lanes<true>(waves, count, ramp, depth, factor, first, block);
}

void sum_force(const double* wave, const double* force, int blocks, double x, double y, double t, double* sums) {
  constexpr int kModes = 6;
  Lanes sum[3 * kModes] = {};
  for (int b = 0; b < blocks; ++b, wave += 4 * kPhaseBlock, force += 2 * kModes * kPhaseBlock)
    for (int part = 0; part < kPhaseBlock; part += L) {
      Lanes s, c;
      sine_and_cosine(phases(wave + part, x, y, t), s, c);
      const Lanes kx = load(wave + part), ky = load(wave + kPhaseBlock + part);
#pragma GCC unroll 6
      for (int m = 0; m < kModes; ++m) {
        const Lanes re = load(force + 2 * m * kPhaseBlock + part), im = load(force + (2 * m + 1) * kPhaseBlock + part);
        const Lanes quarter_turn = re * s + im * c;
        sum[m] += re * c - im * s;
        sum[kModes + m] -= kx * quarter_turn;
        sum[2 * kModes + m] -= ky * quarter_turn;
      }
    }
  for (int i = 0; i < 3 * kModes; ++i) sums[i] = total(sum[i]);
}

double sum_elevation(const double* wave, const double* amplitude, int blocks, double x, double y, double t) {
  Lanes sum = {};
  for (int b = 0; b < blocks; ++b)
    for (int part = 0; part < kPhaseBlock; part += L) {
      Lanes s, c;
      sine_and_cosine(phases(wave + 4 * kPhaseBlock * b + part, x, y, t), s, c);
      sum += load(amplitude + kPhaseBlock * b + part) * c;
    }
  return total(sum);
}

}  // namespace stillhook
