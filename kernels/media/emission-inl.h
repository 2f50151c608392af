// Computes the factor of a medium's emission at a point.
#ifndef LANELIGHT_MEDIA_EMISSION_INL_H_
#define LANELIGHT_MEDIA_EMISSION_INL_H_

#include "hwy/contrib/math/math-inl.h"

#include "kernels/media/voxels-inl.h"
#include "src/base/core/spectral_constants.h"
#include "src/scene/compiled/media.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the colour of a black body of at least kMinKelvin.
LANELIGHT_INLINE V3 BlackbodyColor(const BlackbodyTable& table, VF kelvin) {
  const VF min_kelvin = Splat(kMinKelvin);
  const VF ratio = hn::Mul(hn::Max(kelvin, min_kelvin), Splat(1 / kMinKelvin));
  const VF at = hn::Mul(hn::Log(DF(), ratio), Splat(table.entries_per_log));
  // There are two entries at least.
  const auto last = static_cast<float>(table.colors.size() / 3 - 2);
  const VF low = hn::Clamp(hn::Floor(at), Splat(0), Splat(last));
  const VF fraction = hn::Sub(at, low);
  const VI entry = hn::Mul(hn::ConvertTo(DI(), low), hn::Set(DI(), 3));
  const auto channel = [&](int c) HWY_ATTR {
    const VF a = Gather(table.colors.data() + c, entry);
    const VF b = Gather(table.colors.data() + 3 + c, entry);
    return hn::MulAdd(fraction, hn::Sub(b, a), a);
  };
  return {channel(0), channel(1), channel(2)};
}

/// Returns the spectra of black bodies of `kelvin` over their maxima (Planck's law);
/// `planck` is the row kPlanck at the wavelengths.
LANELIGHT_INLINE V3 BlackbodySpectra(V3 planck, VF kelvin) {
  const VF safe = hn::Clamp(kelvin, Splat(kMinKelvin), Splat(1e9f));
  const auto one = [&](VF of) HWY_ATTR {
    const VF x = hn::Div(of, safe), q = hn::Mul(x, Splat(float(1 / kPlanckPeak)));
    const VF q2 = hn::Mul(q, q), q5 = hn::Mul(hn::Mul(q2, q2), q);
    // Expm1 overflows for cold bodies, whose light is below 1e-20.
    const VF e = hn::Expm1(DF(), hn::Min(x, Splat(80.0f)));
    return hn::Div(hn::Mul(q5, Splat(float(kPlanckAtPeak))), e);
  };
  return {one(planck.x), one(planck.y), one(planck.z)};
}

/// Emission over absorption of a heterogeneous medium, for a batch of paths.
struct GridEmission {
  const MediumGrid& grid;
  V3 scale;
  V3 planck = {};  // row kPlanck, of black bodies and wavelengths
  V3 place = {};   // of wavelengths, where colours are by voxel
  bool spectral;

  /// Medium `i` of the table, which has a grid.
  LANELIGHT_INLINE GridEmission(const Wave& wave, std::size_t i, const Slots& slots)
      : grid(wave.media->grids[static_cast<std::size_t>(wave.media->media[i].grid)]),
        spectral(wave.path.wavelength != nullptr) {
    const Media lanes(*wave.media, hn::Set(DI(), static_cast<int32_t>(i)));
    scale = lanes.Emission(wave, slots);
    if (spectral && grid.emission.heated()) planck = lanes.Planck(wave, slots);
    if (spectral && grid.emission.channels == 4) place = Places(wave, slots);
  }

  /// Returns the emission at p of the box, in the lanes of `mask`.
  LANELIGHT_INLINE V3 At(V3 p, MF mask) const {
    return grid.emission.empty() ? scale : Mul(scale, Factor(p, mask));
  }

 private:
  HWY_NOINLINE V3 Factor(V3 p, MF mask) const {
    const MediumEmission& emission = grid.emission;
    V3 factor = Splat3(1, 1, 1);
    if (emission.channels == 4) {
      InterpolateSpectra<1>(emission.size, emission.values.data(), place, p, &factor);
    } else if (!emission.values.empty()) {
      VF v[3];
      Interpolate(emission.size, emission.values.data(), emission.channels, p, v);
      factor = emission.channels == 1 ? V3{v[0], v[0], v[0]} : V3{v[0], v[1], v[2]};
    }
    if (!emission.heated()) return factor;
    VF t;
    if (emission.sparse.grid != nullptr) {
      t = SparseValue(emission.sparse, p, mask);
    } else {
      Interpolate(grid.size, emission.temperatures.data(), 1, p, &t);
    }
    const BlackbodyTable& table = emission.blackbody;
    const VF kelvin = hn::Mul(hn::Sub(t, Splat(table.offset)), Splat(table.scale));
    const V3 body =
        spectral ? BlackbodySpectra(planck, kelvin) : BlackbodyColor(table, kelvin);
    const MF glows = hn::Gt(kelvin, Splat(kMinKelvin));
    return Mul(factor, IfThenElseZero(glows, body));
  }
};

LANELIGHT_END_KERNELS

#endif
