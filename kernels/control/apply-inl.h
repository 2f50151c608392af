// What control variates on surfaces do with a difference h - E[h].
#ifndef LANELIGHT_CONTROL_APPLY_INL_H_
#define LANELIGHT_CONTROL_APPLY_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

/// `difference` is weighted with the throughput. A given coefficient is applied at once;
/// an estimated one is not known yet, so that the difference travels along.
LANELIGHT_INLINE void ApplyControl(const Wave& wave, const Slots& slots, V3 difference) {
  const PathColumns& p = wave.path;
  if (p.k_r != nullptr) {
    const V3 sum = Gather3(p.k_r, p.k_g, p.k_b, slots) + difference;
    Scatter3(sum, p.k_r, p.k_g, p.k_b, slots);
  } else {
    const VF factor = Splat(-wave.run->control_coefficient);
    const V3 sum = MulAdd(difference, factor, Gather3(p.l_r, p.l_g, p.l_b, slots));
    Scatter3(sum, p.l_r, p.l_g, p.l_b, slots);
  }
}

/// A Lambertian surface as shading will see it.
template <class Bsdf>
struct DiffuseVertex {
  V3 p, normal;  // normal: of shading, on wo's side
  V3 wo, beta;
  Frame frame;
  typename Bsdf::Params material;
  MF usable;  // wo has a side

  LANELIGHT_INLINE DiffuseVertex(const SurfaceReader<Bsdf>& reader, const Slots& slots) {
    const PathColumns& path = reader.wave.path;
    frame = reader.ShadingFrame(Gather3(path.ng_x, path.ng_y, path.ng_z, slots), slots);
    wo = frame.ToLocal(-Gather3(path.d_x, path.d_y, path.d_z, slots));
    normal = Mul(frame.n, hn::CopySign(Splat(1.0f), wo.z));
    usable = hn::Ne(wo.z, hn::Zero(DF()));
    p = Gather3(path.p_x, path.p_y, path.p_z, slots);
    beta = Gather3(path.beta_r, path.beta_g, path.beta_b, slots);
    material = Bsdf::Load(reader.Inputs(slots));
  }

  LANELIGHT_INLINE BsdfValue Eval(V3 direction) const {
    return Bsdf::Eval(material, wo, frame.ToLocal(direction));
  }

  /// Mean scattered light under irradiance `above` on wo's side and `below` on the other.
  LANELIGHT_INLINE V3 Scattered(V3 above, V3 below) const {
    const VF inv_pi = Splat(kInvPi);
    if constexpr (Bsdf::kTransmits) {
      const V3 sum =
          Mul(material.reflectance, above) + Mul(material.transmittance, below);
      return Mul(sum, inv_pi);
    } else {
      return Mul(Mul(material.albedo, above), inv_pi);
    }
  }
};

/// The control stages on surfaces run after the light samplers and before the shading
/// stage of their material.
inline Stage SurfaceControlStage(const char* name, const char* meaning, Feature control,
                                 ShadeKind kind, StageFn (*resolve)(const FeatureSet&)) {
  using namespace fields;
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  return {.name = name,
          .meaning = meaning,
          .input = ShadeQueue(kind),
          .needs = {control, ShadeFeature(kind), Feature::kScatters},
          .reads = direction | kThroughput | kRadiance | kPoint | kNormal | kParameters |
                   kLightSample | kControl |
                   FieldSet{Field::material, Field::ls_light, Field::guide_cell,
                            Field::kept_worth, Field::wavelength},
          .writes = kRadiance | kControl,
          .resolve = resolve};
}

LANELIGHT_END_KERNELS

#endif
