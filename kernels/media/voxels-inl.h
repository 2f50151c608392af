// Values of media at a vector of points: dense voxels, sparse NanoVDB grids, and
// pbrt-v4's procedural cloud, which is noise whose threshold rises with the height.
#ifndef LANELIGHT_MEDIA_VOXELS_INL_H_
#define LANELIGHT_MEDIA_VOXELS_INL_H_

#include <limits>

#include "kernels/media/medium-inl.h"
#include "kernels/texture/noise-inl.h"
#include "src/base/core/sparse_grid.h"

LANELIGHT_BEGIN_KERNELS

/// Linear interpolation along one axis: the two samples and how much of the second.
struct AxisSamples {
  VI low;
  VF weight;
  MF has_low, has_high;  // they lie in the grid; others are zero

  LANELIGHT_INLINE AxisSamples(VF x, int32_t size) {
    const DI di;
    const VF at = hn::MulAdd(x, Splat(static_cast<float>(size)), Splat(-0.5f));
    const VF floor = hn::Floor(at);
    low = hn::ConvertTo(di, floor);
    weight = hn::Sub(at, floor);
    const VI last = hn::Set(di, size - 1), before = hn::Set(di, -1);
    has_low = hn::RebindMask(
        DF(), hn::And(hn::Gt(low, before), hn::Lt(low, hn::Set(di, size))));
    has_high =
        hn::RebindMask(DF(), hn::And(hn::Gt(low, hn::Set(di, -2)), hn::Lt(low, last)));
  }
};

/// Calls visit(voxel, weight) for the eight voxels around p in [0, 1]^3, which samples at
/// the centres of voxels are interpolated between; those outside have no weight.
template <class Visit>
LANELIGHT_INLINE void ForVoxelsAround(const int32_t size[3], V3 p, const Visit& visit) {
  const DI di;
  const AxisSamples axes[3] = {AxisSamples(p.x, size[0]), AxisSamples(p.y, size[1]),
                               AxisSamples(p.z, size[2])};
  for (int corner = 0; corner < 8; ++corner) {
    VI index = hn::Zero(di);
    VF weight = Splat(1.0f);
    MF inside = hn::FirstN(DF(), hn::Lanes(DF()));
    for (int a = 2; a >= 0; --a) {
      const bool high = (corner >> a & 1) != 0;
      const VI at = high ? hn::Add(axes[a].low, hn::Set(di, 1)) : axes[a].low;
      const VF fraction = axes[a].weight;
      index = hn::Add(hn::Mul(index, hn::Set(di, size[a])), at);
      weight = hn::Mul(weight, high ? fraction : hn::Sub(Splat(1.0f), fraction));
      inside = hn::And(inside, high ? axes[a].has_high : axes[a].has_low);
    }
    visit(hn::IfThenElseZero(hn::RebindMask(di, inside), index),
          hn::IfThenElseZero(inside, weight));
  }
}

/// Interpolates `channels` numbers for each voxel.
LANELIGHT_INLINE void Interpolate(const int32_t size[3], const float* values,
                                  int32_t channels, V3 p, VF* out) {
  for (int c = 0; c < channels; ++c) out[c] = hn::Zero(DF());
  ForVoxelsAround(size, p, [&](VI voxel, VF weight) HWY_ATTR {
    const VI index = hn::Mul(voxel, hn::Set(DI(), channels));
    for (int c = 0; c < channels; ++c) {
      out[c] = hn::MulAdd(weight, Gather(values + c, index), out[c]);
    }
  });
}

/// Returns the positions of the paths' wavelengths in the polynomials of VoxelSpectrum.
LANELIGHT_INLINE V3 Places(const Wave& wave, const Slots& slots) {
  return ByBin(wave.spectra->place.data(), Wavelengths(wave.path, slots).triple);
}

/// Interpolates kCount VoxelSpectrum for each voxel at three wavelengths, by their places
/// (SpectrumTable::place).
template <int kCount>
LANELIGHT_INLINE void InterpolateSpectra(const int32_t size[3], const float* values,
                                         V3 place, V3 p, V3* out) {
  const VF half = Splat(0.5f), one = Splat(1.0f);
  for (int k = 0; k < kCount; ++k) out[k] = Splat3(0, 0, 0);
  ForVoxelsAround(size, p, [&](VI voxel, VF weight) HWY_ATTR {
    const VI index = hn::Mul(voxel, hn::Set(DI(), 4 * kCount));
    for (int k = 0; k < kCount; ++k) {
      const V3 c = Gather3(values + 4 * k, values + 4 * k + 1, values + 4 * k + 2, index);
      const VF scale = Gather(values + 4 * k + 3, index);
      const auto at = [&](VF t) HWY_ATTR {
        const VF v = hn::MulAdd(hn::MulAdd(c.x, t, c.y), t, c.z);
        const VF of = hn::MulAdd(half, hn::Mul(v, Rsqrt(hn::MulAdd(v, v, one))), half);
        return hn::Mul(scale, of);
      };
      out[k] = MulAdd(V3{at(place.x), at(place.y), at(place.z)}, weight, out[k]);
    }
  });
}

/// p by a row-major 3x4 matrix.
LANELIGHT_INLINE V3 MapPoint(const float* m, V3 p) {
  const auto row = [&](int r) HWY_ATTR {
    const V3 linear = {Splat(m[4 * r]), Splat(m[4 * r + 1]), Splat(m[4 * r + 2])};
    return hn::Add(Dot(linear, p), Splat(m[4 * r + 3]));
  };
  return {row(0), row(1), row(2)};
}

/// Looks up a NanoVDB grid at p of the box, one lane of `mask` after the other; 0 in the
/// other lanes.
inline HWY_NOINLINE VF SparseValue(const PlacedSparseGrid& placed, V3 p, MF mask) {
  const DF df;
  HWY_ALIGN float x[hn::MaxLanes(df)], y[hn::MaxLanes(df)], z[hn::MaxLanes(df)];
  HWY_ALIGN float out[hn::MaxLanes(df)];
  const V3 at = MapPoint(placed.index_from_box, p);
  const VF none = Splat(std::numeric_limits<float>::quiet_NaN());
  hn::Store(hn::IfThenElse(mask, at.x, none), df, x);
  hn::Store(at.y, df, y);
  hn::Store(at.z, df, z);
  placed.grid->Interpolate(x, y, z, hn::Lanes(df), out);
  return hn::Load(df, out);
}

/// Differences of the noise over 0.01, as pbrt-v4 approximates its derivatives.
LANELIGHT_INLINE V3 NoiseSlope(V3 p) {
  const VF step = Splat(0.01f), per_step = Splat(1 / 0.01f), here = Noise(p);
  const auto slope = [&](V3 beside) HWY_ATTR {
    return hn::Mul(hn::Sub(Noise(beside), here), per_step);
  };
  return {slope({hn::Add(p.x, step), p.y, p.z}), slope({p.x, hn::Add(p.y, step), p.z}),
          slope({p.x, p.y, hn::Add(p.z, step)})};
}

/// Returns the density in [0, 1] at p of the box: five octaves of noise at a point that
/// two octaves have displaced, scaled by 1 - height, and solid below a height of 0.5.
inline HWY_NOINLINE VF CloudDensity(const CloudShape& cloud, V3 p) {
  const float *low = cloud.low, *size = cloud.size;
  const VF zero = Splat(0), one = Splat(1.0f);
  const VF height = hn::MulAdd(p.y, Splat(size[1]), Splat(low[1]));
  V3 at = Mul(V3{hn::MulAdd(p.x, Splat(size[0]), Splat(low[0])), height,
                 hn::MulAdd(p.z, Splat(size[2]), Splat(low[2]))},
              Splat(cloud.frequency));
  if (cloud.wispiness > 0) {
    float reach = 0.05f * cloud.wispiness, frequency = 10;
    for (int i = 0; i < 2; ++i) {
      at = at + Mul(NoiseSlope(Mul(at, Splat(frequency))), Splat(reach));
      reach *= 0.5f;
      frequency *= kLacunarity;
    }
  }
  const VF noise = hn::Mul(FBm(at, 5, 0.5f), Splat(0.5f));
  const VF amount = hn::Mul(hn::Sub(one, height), Splat(4.5f * cloud.density));
  const VF lumps = hn::Clamp(hn::Mul(amount, noise), zero, one);
  const VF solid = hn::Max(zero, hn::Sub(Splat(0.5f), height));
  return hn::Min(hn::MulAdd(Splat(2.0f), solid, lumps), one);
}

LANELIGHT_END_KERNELS

#endif
