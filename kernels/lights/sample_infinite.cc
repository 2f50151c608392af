// Light samples of environments: constant ones, images, and images seen through a portal.
#include "kernels/simd/each_target-inl.h"

#include <limits>

#include "kernels/lights/environment-inl.h"
#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/lights/portal-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// Writes the sample to the lanes `mine`; a density of 0 brings no light.
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

// Samples the lights of `shape`, one of `maps` maps after the other. `number_at` is the
// offset of the map's number in the light's record. draw(number, slots) -> MapSample.
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

// Constant environments: uniform over the sphere of directions, pdf_sa = pmf / (4 pi).
template <bool kMany>
void SampleInfiniteConstant(Wave& wave) {
  const PathColumns& p = wave.path;
  const float inv_four_pi = 0.0795774715459476679f;
  ForEachLit<kMany>(
      wave, LightShape::kInfiniteConstant,
      [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const VF z = hn::NegMulAdd(Splat(2.0f), Gather(p.u_light_0, slots), Splat(1.0f));
        const VF ring = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, Splat(1.0f)), Splat(0)));
        const auto [sine, cosine] = SinCos2Pi(Gather(p.u_light_1, slots));
        const VF pdf = hn::Mul(Pmf(wave, slots, index), Splat(inv_four_pi));
        StoreLightSample(p, slots,
                         {{hn::Mul(ring, cosine), hn::Mul(ring, sine), z},
                          Splat(std::numeric_limits<float>::infinity()),
                          Mul(light.Radiance(), hn::Div(Splat(1.0f), pdf)),
                          pdf,
                          hn::Gt(pdf, Splat(0))});
      });
}

Stage SampleInfiniteConstantStage() {
  return SampleLightStage("light_infinite_constant", "samples constant environments",
                          Feature::kInfiniteConstant,
                          ByFeature<Feature::kManyLights, SampleInfiniteConstant<true>,
                                    SampleInfiniteConstant<false>>);
}

// Environment images: a texel with probability proportional to its luminance, then
// uniform inside it (the map has equal area everywhere): pdf_sa = pmf P(texel) size^2 /
// (4 pi).
template <bool kMany>
void SampleInfiniteImage(Wave& wave) {
  const PathColumns& p = wave.path;
  SampleMaps<kMany>(wave, LightShape::kInfiniteImage, wave.chances->environments.size(),
                    offsetof(LightRecord, environment),
                    [&](std::size_t map, const StoreSlots& slots) HWY_ATTR {
                      return SampleEnvironment(wave, map, Gather(p.u_light_0, slots),
                                               Gather(p.u_light_1, slots));
                    });
}

Stage SampleInfiniteImageStage() {
  return SampleLightStage("light_infinite_image", "samples environment images",
                          Feature::kInfiniteImage,
                          ByFeature<Feature::kManyLights, SampleInfiniteImage<true>,
                                    SampleInfiniteImage<false>>);
}

// Environments seen through a portal: a point of the part of the map that the portal
// shows, with density proportional to luminance times solid angle of its texel.
template <bool kMany>
void SamplePortalLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const std::vector<Portal>& portals = wave.lights->portals;
  SampleMaps<kMany>(
      wave, LightShape::kPortal, portals.size(), offsetof(LightRecord, image),
      [&](std::size_t map, const StoreSlots& slots) HWY_ATTR {
        return SamplePortal(portals[map], Gather3(p.p_x, p.p_y, p.p_z, slots),
                            Gather(p.u_light_0, slots), Gather(p.u_light_1, slots));
      });
}

Stage SamplePortalLightStage() {
  return SampleLightStage(
      "light_portal", "samples environments through portals", Feature::kPortals,
      ByFeature<Feature::kManyLights, SamplePortalLight<true>, SamplePortalLight<false>>);
}

LANELIGHT_END_KERNELS
