// Light samples of what lies infinitely far away, by maps of its directions.
#ifndef LANELIGHT_LIGHTS_MAP_SAMPLES_INL_H_
#define LANELIGHT_LIGHTS_MAP_SAMPLES_INL_H_

#include <limits>

#include "kernels/lights/light-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A direction drawn from a map.
struct MapSample {
  V3 direction, radiance;
  VF pdf_sa;  // the selection of the light not included
};

/// Writes the sample to the lanes `mine`; a density of 0 brings no light.
HWY_INLINE void KeepMapSample(const PathColumns& p, const StoreSlots& slots, MF mine,
                              const MapSample& s, VF pmf) {
  const VF pdf = hn::Mul(pmf, s.pdf_sa);
  const V3 value = Mul(s.radiance, hn::Div(Splat(1.0f), pdf));
  const V3 usable = IfThenElseZero(hn::Gt(pdf, Splat(0)), value);
  const auto keep = [&](VF v, float* column) HWY_ATTR {
    Scatter(hn::IfThenElse(mine, v, Gather(column, slots)), column, slots);
  };
  keep(s.direction.x, p.ls_x);
  keep(s.direction.y, p.ls_y);
  keep(s.direction.z, p.ls_z);
  keep(Splat(std::numeric_limits<float>::infinity()), p.ls_distance);
  keep(usable.x, p.ls_r);
  keep(usable.y, p.ls_g);
  keep(usable.z, p.ls_b);
  keep(pdf, p.ls_pdf);
}

/// Samples the lights of `shape`, one of `maps` maps after the other; `number_at`: the
/// word of the light's record that is its map's number. draw(number, slots) -> MapSample.
template <bool kMany, class Draw>
HWY_INLINE void SampleMaps(Wave& wave, LightShape shape, std::size_t maps,
                           std::size_t number_at, Draw&& draw) {
  for (std::size_t e = 0; e < maps; ++e) {
    ForEachLit<kMany>(wave, shape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
      const Lights light(wave, index);
      const VI number = hn::Set(DI(), static_cast<int32_t>(e));
      const MF mine = hn::RebindMask(DF(), hn::Eq(light.I(number_at), number));
      if (hn::AllFalse(DF(), mine)) return;
      const VF pmf = Pmf(wave, slots, index);
      KeepMapSample(wave.path, slots, mine, draw(e, slots), pmf);
    });
  }
}

LANELIGHT_END_KERNELS

#endif
