// directions=mis, light: weights of the two techniques that can find the light along a
// direction.
//   estimator   sum over techniques of w_i f / p_i, w_i >= 0, sum w_i = 1
//   unbiased    if the weights sum to 1 wherever f > 0 and each technique can find all
//               light for which its weight is not 0; directions=light weights light
//               samples by 1
//   variance    power heuristic (exponent 2): at most about the better technique's, plus
//               a term that falls with the number of samples; balance heuristic: no
//               other heuristic is better by more than (1/min n_i - 1/sum n_i) I^2
//   cost        one division
//   source      Veach and Guibas 1995, "Optimally Combining Sampling Techniques"
#ifndef LANELIGHT_DIRECTIONS_HEURISTIC_INL_H_
#define LANELIGHT_DIRECTIONS_HEURISTIC_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/run_parameters.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the weight of the technique of density `mine` > 0 against `other`, in a form
/// that neither overflows nor divides zero by zero. Which heuristic: see MisParameters.
LANELIGHT_INLINE VF HeuristicWeight(const MisParameters& mis, VF mine, VF other) {
  const VF ratio = hn::Min(hn::Div(other, mine), Splat(1e18f));
  const VF rest = hn::MulAdd(Splat(mis.square), ratio, Splat(mis.linear));
  return hn::Div(Splat(1.0f), hn::MulAdd(ratio, rest, Splat(1.0f)));
}

/// Returns the weight of a light sample whose direction scattering has density bsdf_pdf.
/// Delta lights (light_pdf = 0), which scattering cannot find, have weight 1.
LANELIGHT_INLINE VF LightSampleWeight(const MisParameters& mis, VF light_pdf,
                                      VF bsdf_pdf) {
  const VF one = Splat(1.0f);
  const MF delta = hn::Eq(light_pdf, hn::Zero(DF()));
  const VF weight = HeuristicWeight(mis, hn::IfThenElse(delta, one, light_pdf), bsdf_pdf);
  return hn::IfThenElse(delta, one, weight);
}

/// Returns the weight of emission met by a scattered ray: 1 after the camera or a
/// specular event (bsdf_pdf = 0), where no light sample could have found it.
LANELIGHT_INLINE VF EmissionWeight(const MisParameters& mis, VF bsdf_pdf, VF light_pdf) {
  const VF one = Splat(1.0f);
  const MF specular = hn::Eq(bsdf_pdf, hn::Zero(DF()));
  const VF weight =
      HeuristicWeight(mis, hn::IfThenElse(specular, one, bsdf_pdf), light_pdf);
  return hn::IfThenElse(specular, one, hn::Mul(Splat(mis.hits), weight));
}

LANELIGHT_END_KERNELS

#endif
