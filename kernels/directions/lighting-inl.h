// What light samples are compared with, and what scattered rays must know for that.
#ifndef LANELIGHT_DIRECTIONS_LIGHTING_INL_H_
#define LANELIGHT_DIRECTIONS_LIGHTING_INL_H_

#include "kernels/directions/heuristic-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Light samples count in full, and scattered rays find no light that is sampled.
struct UnweightedLighting {
  static constexpr bool kWeighs = false;
  static LANELIGHT_INLINE VF Weight(const MisParameters&, VF, VF) { return Splat(1.0f); }
};

/// Light samples and scattered rays are weighted against each other; the rays carry
/// their density (the bsdf_pdf column).
struct MisLighting {
  static constexpr bool kWeighs = true;
  static LANELIGHT_INLINE VF Weight(const MisParameters& mis, VF light_pdf,
                                    VF scattered_pdf) {
    return LightSampleWeight(mis, light_pdf, scattered_pdf);
  }
};

LANELIGHT_END_KERNELS

#endif
