// Environments as control=ambient sees them (src/prepare/ambient.h).
#ifndef LANELIGHT_CONTROL_AMBIENT_INL_H_
#define LANELIGHT_CONTROL_AMBIENT_INL_H_

#include "kernels/lights/light-inl.h"
#include "src/prepare/ambient.h"

LANELIGHT_BEGIN_KERNELS

// Three quadratics, one per channel, at unit direction d.
LANELIGHT_INLINE V3 EvalQuadratics(const Quadratic* q, V3 d) {
  const VF monomials[] = {d.x,
                          d.y,
                          d.z,
                          hn::Mul(d.x, d.y),
                          hn::Mul(d.y, d.z),
                          hn::Mul(d.z, d.x),
                          hn::Mul(d.z, d.z),
                          hn::Mul(hn::Sub(d.x, d.y), hn::Add(d.x, d.y))};
  VF out[3];
  for (int channel = 0; channel < 3; ++channel) {
    const float* c = q[channel].c;
    VF sum = Splat(c[0]);
    for (int i = 0; i < 8; ++i) sum = hn::MulAdd(Splat(c[i + 1]), monomials[i], sum);
    out[channel] = sum;
  }
  return {out[0], out[1], out[2]};
}

/// Radiance that control=ambient takes an environment for towards `at`, or the irradiance
/// from it with normal `at`: q, the one or the other three of `light`. A path's three
/// wavelengths see the spectrum of a constant environment; of an image they see its red,
/// green and blue, which is not what they meet, but keeps the two in their proportion,
/// and that is all that h and E[h] need.
LANELIGHT_INLINE V3 AmbientAt(const Wave& wave, const Slots& slots,
                              const AmbientLight& light, const Quadratic* q, V3 at) {
  const V3 color = EvalQuadratics(q, at);
  if (wave.scene->lights.lights[light.light].environment >= 0) return color;
  return AsCarried(wave, slots, hn::Set(DI(), static_cast<int32_t>(light.light)), color);
}

LANELIGHT_END_KERNELS

#endif
