// Perlin noise and the sums of octaves that patterns are made of.
#ifndef LANELIGHT_TEXTURE_NOISE_INL_H_
#define LANELIGHT_TEXTURE_NOISE_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "kernels/texture/noise_table.h"

LANELIGHT_BEGIN_KERNELS

/// Frequency from octave to octave; not 2, so that the zeros of octaves do not coincide.
inline constexpr float kLacunarity = 1.99f;

/// One axis of the lattice: the cell modulo 256, the offset t in it, and the weight of
/// its far side, 6 t^5 - 15 t^4 + 10 t^3. Its first two derivatives vanish at both ends.
struct NoiseAxis {
  VI cell;
  VF t, weight;

  LANELIGHT_INLINE explicit NoiseAxis(VF x) {
    const VF low = hn::Floor(x);
    t = hn::Sub(x, low);
    // Modulo 256 in floats, exact however large x is; then fractions are 0 and so is the
    // noise.
    const VF turns = hn::Floor(hn::Mul(low, Splat(1.0f / 256)));
    const VF wrapped = hn::NegMulAdd(turns, Splat(256.0f), low);
    cell = hn::And(hn::ConvertTo(DI(), wrapped), hn::Set(DI(), 255));
    const VF shape =
        hn::MulAdd(t, hn::MulAdd(t, Splat(6.0f), Splat(-15.0f)), Splat(10.0f));
    weight = hn::Mul(hn::Mul(t, hn::Mul(t, t)), shape);
  }
};

/// Entry (i + offset) modulo 256 of the permutation.
LANELIGHT_INLINE VI Permuted(VI i, VI offset) {
  const VI at = hn::And(hn::Add(i, offset), hn::Set(DI(), 255));
  return Gather(kNoisePermutation, at);
}

/// Dot product of (x, y, z) with the lattice point's gradient: one of twelve directions
/// to the edges of a cube, chosen by four bits of `hash` (four directions are there
/// twice). pbrt's choice for 12 to 15, which differs from Perlin's.
LANELIGHT_INLINE VF LatticeGradient(VI hash, VF x, VF y, VF z) {
  const DF df;
  const DI di;
  const VI h = hn::And(hash, hn::Set(di, 15));
  const auto twice = hn::Eq(hn::And(h, hn::Set(di, 14)), hn::Set(di, 12));
  const auto below = [&](int32_t n) HWY_ATTR {
    return hn::RebindMask(df, hn::Or(hn::Lt(h, hn::Set(di, n)), twice));
  };
  const VF u = hn::IfThenElse(below(8), x, y), v = hn::IfThenElse(below(4), y, z);
  const VI sign_u = hn::ShiftLeft<31>(h);
  const VI sign_v = hn::ShiftLeft<30>(hn::And(h, hn::Set(di, 2)));
  return hn::Add(hn::Xor(u, hn::BitCast(df, sign_u)),
                 hn::Xor(v, hn::BitCast(df, sign_v)));
}

/// Gradient noise with mean 0, period 256, 0 at lattice points, within [-1.05, 1.05]
/// (Perlin 2002, "Improving Noise"; the gradients as in pbrt-v4). Error against real
/// arithmetic for |p| < 1e3: below 1e-5, besides that of p. Any input gives a finite
/// value, or NaN.
inline HWY_NOINLINE VF Noise(V3 p) {
  const VI zero = hn::Zero(DI()), one = hn::Set(DI(), 1);
  const VF unit = Splat(1.0f);
  const NoiseAxis x(p.x), y(p.y), z(p.z);
  const auto lerp = [](VF t, VF a, VF b)
                        HWY_ATTR { return hn::MulAdd(t, hn::Sub(b, a), a); };
  VF along_x[2][2];  // [z][y]
  const VI hash_x[2] = {Permuted(x.cell, zero), Permuted(x.cell, one)};
  for (int j = 0; j < 2; ++j) {
    const VI row = j == 0 ? y.cell : hn::Add(y.cell, one);
    const VI hash_0 = Permuted(hash_x[0], row), hash_1 = Permuted(hash_x[1], row);
    const VF ty = j == 0 ? y.t : hn::Sub(y.t, unit);
    for (int k = 0; k < 2; ++k) {
      const VI layer = k == 0 ? z.cell : hn::Add(z.cell, one);
      const VF tz = k == 0 ? z.t : hn::Sub(z.t, unit);
      along_x[k][j] =
          lerp(x.weight, LatticeGradient(Permuted(hash_0, layer), x.t, ty, tz),
               LatticeGradient(Permuted(hash_1, layer), hn::Sub(x.t, unit), ty, tz));
    }
  }
  return lerp(z.weight, lerp(y.weight, along_x[0][0], along_x[0][1]),
              lerp(y.weight, along_x[1][0], along_x[1][1]));
}

/// Fractional Brownian motion: sum of roughness^i Noise(1.99^i p) over `octaves` octaves.
LANELIGHT_INLINE VF FBm(V3 p, int32_t octaves, float roughness) {
  VF sum = hn::Zero(DF());
  float frequency = 1, amplitude = 1;
  for (int32_t i = 0; i < octaves; ++i) {
    sum = hn::MulAdd(Splat(amplitude), Noise(Mul(p, Splat(frequency))), sum);
    frequency *= kLacunarity;
    amplitude *= roughness;
  }
  return sum;
}

/// Returns the same sum of |Noise| (Perlin 1985), plus 0.2 roughness^octaves: pbrt-v4
/// adds the mean of the octave after the last one.
LANELIGHT_INLINE VF Turbulence(V3 p, int32_t octaves, float roughness) {
  VF sum = hn::Zero(DF());
  float frequency = 1, amplitude = 1;
  for (int32_t i = 0; i < octaves; ++i) {
    sum = hn::MulAdd(Splat(amplitude), hn::Abs(Noise(Mul(p, Splat(frequency)))), sum);
    frequency *= kLacunarity;
    amplitude *= roughness;
  }
  return hn::Add(sum, Splat(0.2f * amplitude));
}

LANELIGHT_END_KERNELS

#endif
