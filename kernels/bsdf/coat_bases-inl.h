// The bases below a scattering medium (coated_medium-inl.h). Each has Load, Sample, Eval,
// says whether it is a mirror, and has the density proxy of the whole coat
// (coated_conductor-inl.h).
#ifndef LANELIGHT_BSDF_COAT_BASES_INL_H_
#define LANELIGHT_BSDF_COAT_BASES_INL_H_

#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A Lambertian base, met from above.
struct DiffuseLayer {
  V3 reflectance;

  LANELIGHT_INLINE static DiffuseLayer Load(const MaterialInputs& in) {
    return {in.Color0()};
  }
  LANELIGHT_INLINE static MF Smooth() { return hn::Ne(hn::Zero(DF()), hn::Zero(DF())); }
  LANELIGHT_INLINE LayerEvent Sample(V3, VF u0, VF u1) const {
    const V3 up = SampleCosineHemisphere(u0, u1);
    return {up, reflectance, PdfCosineHemisphere(up.z), hn::Gt(up.z, hn::Zero(DF()))};
  }
  LANELIGHT_INLINE LayerValue Eval(V3, V3 wi) const {
    return {Mul(reflectance, Splat(kInvPi)), PdfCosineHemisphere(wi.z)};
  }
  /// Mixes a lobe for the reflection of the interface with a cosine lobe.
  LANELIGHT_INLINE VF Proxy(const CoatLayer& coat, V3 wo, V3 wi) const {
    const VF f = DielectricInterface(wo.z, coat.eta).reflectance;
    const VF fraction = hn::IfThenZeroElse(coat.layer.smooth, hn::Mul(Splat(0.9f), f));
    const VF mirrored = hn::Mul(Splat(0.25f), coat.layer.Visible(wo, Normalize(wo + wi)));
    const VF even = PdfCosineHemisphere(wi.z);
    return hn::MulAdd(fraction, hn::Sub(mirrored, even), even);
  }
};

struct MetalBelowMedium {
  MetalLayer metal;

  LANELIGHT_INLINE static MetalBelowMedium Load(const MaterialInputs& in) {
    return {{Layer::FromAlpha(in.Alpha2X(), in.Alpha2Y()), in.Color0(), in.Color1()}};
  }
  LANELIGHT_INLINE MF Smooth() const { return metal.layer.smooth; }
  LANELIGHT_INLINE LayerEvent Sample(V3 wo, VF u0, VF u1) const {
    return metal.Sample(wo, u0, u1);
  }
  LANELIGHT_INLINE LayerValue Eval(V3 wo, V3 wi) const { return metal.Eval(wo, wi); }
  /// Returns the mean of the proxy without the medium and a cosine lobe.
  LANELIGHT_INLINE VF Proxy(const CoatLayer& coat, V3 wo, V3 wi) const {
    const CoatedConductorBsdf::Params clear = {coat, metal, {}, {}, {}};
    const VF half = Splat(0.5f), even = PdfCosineHemisphere(wi.z);
    return hn::Mul(half, hn::Add(CoatedConductorBsdf::Proxy(clear, wo, wi), even));
  }
};

LANELIGHT_END_KERNELS

#endif
