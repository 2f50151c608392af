// control=ambient: at every Lambertian vertex, h is the environment as if nothing were in
// front of it, with radiance L_h in place of the environment's: itself if it is constant,
// its spherical harmonics of degree 2 if it is an image.
//   estimator   f - c (h - E[h]) (the paper's equation 7 with the sign of c turned). At a
//               vertex of throughput beta, with the weights that f has:
//                 h = w_l beta (f cos) L_h / p of a light sample of an environment (here)
//                   + w_b beta' L_h of the scattered ray, beta' its throughput (in
//                     ambient_scattered.cc; the last event's ray sees the environment)
//               E[h] = beta (albedo / pi) E_h(n), E_h the cosine convolution of L_h,
//               which is exact for spherical harmonics; sheets add their other side
//   unbiased    for any c: sum w = 1 over the techniques that find a direction. With
//               directions=light an image must have no black texels, which light samples
//               never find; such an image takes no part (L_h = 0)
//   variance    0 for a constant environment that nothing hides, and directions=uniform
//               c=1; what stays is the environment's difference from L_h and what is
//               hidden. Little to gain with directions=bsdf or mis under a constant sky,
//               where h hardly varies
//   elsewhere   glossy and other materials: h = 0, f is left alone
//   cost        two quadratics per vertex and environment, no table
//   source      Ramamoorthi and Hanrahan 2001, "An Efficient Representation for
//               Irradiance Environment Maps"
#include "kernels/simd/each_target-inl.h"

#include "kernels/control/ambient-inl.h"
#include "kernels/control/apply-inl.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

// (f cos) L_h / p of the light sample, weighted, if it is of an environment.
template <class Bsdf, class Proposal>
HWY_INLINE V3 SampledAmbient(const Wave& wave, const DiffuseVertex<Bsdf>& vertex,
                             const Slots& slots) {
  const PathColumns& path = wave.path;
  const VI selected =
      path.ls_light != nullptr ? Gather(path.ls_light, slots) : hn::Zero(DI());
  const V3 direction = Gather3(path.ls_x, path.ls_y, path.ls_z, slots);
  V3 radiance = Splat3(0, 0, 0);
  MF is_ambient = hn::Lt(radiance.x, radiance.x);
  for (const AmbientLight& light : wave.run->tables->ambient) {
    const MF mine = hn::RebindMask(
        DF(), hn::Eq(selected, hn::Set(DI(), static_cast<int32_t>(light.light))));
    radiance = IfThenElse(mine, AmbientAt(wave, slots, light, light.radiance, direction),
                          radiance);
    is_ambient = hn::Or(is_ambient, mine);
  }
  const BsdfValue value = vertex.Eval(direction);
  const VF pdf = Gather(path.ls_pdf, slots);
  const MF usable = hn::And(is_ambient, hn::Gt(pdf, Splat(0)));
  VF weight = hn::Div(Splat(1.0f), hn::IfThenElse(usable, pdf, Splat(1.0f)));
  // The radiance of a candidate that was kept has this factor.
  if (path.kept_worth != nullptr)
    weight = hn::Mul(weight, Gather(path.kept_worth, slots));
  if (wave.run->features.Has(Feature::kMis)) {
    const Proposal proposal(wave, vertex.frame, slots);
    const V3 wi = vertex.frame.ToLocal(direction);
    const VF scattered =
        proposal.template Pdf<Bsdf>(vertex.material, vertex.wo, wi, value.pdf);
    weight = hn::Mul(weight, LightSampleWeight(wave.run->mis, pdf, scattered));
  }
  return IfThenElseZero(usable, Mul(Mul(value.f_cos, radiance), weight));
}

template <class Bsdf, ShadeKind kKind, class Proposal>
void Ambient(Wave& wave) {
  const SurfaceReader<Bsdf> reader(wave);
  const bool light_samples = wave.run->features.Has(Feature::kSampledHittableLights);
  ForEachBatch(wave, wave.queue(ShadeQueue(kKind)), [&](const Slots& slots, MF) HWY_ATTR {
    const DiffuseVertex<Bsdf> vertex(reader, slots);
    V3 above = Splat3(0, 0, 0), below = above;
    for (const AmbientLight& light : wave.run->tables->ambient) {
      const Quadratic* const arriving = light.irradiance;
      above = above + AmbientAt(wave, slots, light, arriving, vertex.normal);
      if constexpr (Bsdf::kTransmits) {
        below = below + AmbientAt(wave, slots, light, arriving, -vertex.normal);
      }
    }
    V3 difference = -vertex.Scattered(above, below);
    if (light_samples) {
      difference = difference + SampledAmbient<Bsdf, Proposal>(wave, vertex, slots);
    }
    ApplyControl(wave, slots,
                 IfThenElseZero(vertex.usable, Mul(vertex.beta, difference)));
  });
}

template <class Bsdf, ShadeKind kKind>
StageFn ResolveAmbient(const FeatureSet& features) {
  return features.Has(Feature::kGuided) ? Ambient<Bsdf, kKind, GuidedProposal>
                                        : Ambient<Bsdf, kKind, MaterialProposal>;
}

Stage AmbientDiffuseStage() {
  return SurfaceControlStage("control_ambient", "control by the unoccluded environment",
                             Feature::kAmbientControl, ShadeKind::kDiffuse,
                             ResolveAmbient<DiffuseBsdf, ShadeKind::kDiffuse>);
}
Stage AmbientTransmissionStage() {
  return SurfaceControlStage(
      "control_ambient_sheet", "control by the unoccluded environment on both sides",
      Feature::kAmbientControl, ShadeKind::kDiffuseTransmission,
      ResolveAmbient<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>);
}

LANELIGHT_END_KERNELS
