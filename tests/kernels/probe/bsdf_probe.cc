// Batch entries of the material policies; see bsdf_probe.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/kinds-inl.h"
#include "tests/kernels/probe/bsdf_probe.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE V3 Load3(const float* const a[3], std::uint32_t i) {
  const DF df;
  return {hn::LoadU(df, a[0] + i), hn::LoadU(df, a[1] + i), hn::LoadU(df, a[2] + i)};
}
HWY_INLINE void Store3(V3 v, float* const a[3], std::uint32_t i) {
  const DF df;
  hn::StoreU(v.x, df, a[0] + i);
  hn::StoreU(v.y, df, a[1] + i);
  hn::StoreU(v.z, df, a[2] + i);
}

/// Inputs of lanes i .. of the batch: the identity of a path is its place in the batch.
HWY_INLINE MaterialInputs ProbeInputs(const PathColumns& path, const BsdfBatch& batch,
                                      std::uint32_t i) {
  const DU du;
  const VI material = hn::Set(DI(), static_cast<std::int32_t>(batch.material));
  const LaneRandom random = {hn::Iota(du, i), hn::Zero(du), hn::Zero(du),
                             hn::Set(du, batch.seed)};
  return {*batch.materials, path, Slots(material), material, random};
}

/// The columns that materials read.
HWY_INLINE PathColumns ProbeColumns(const BsdfBatch& batch) {
  PathColumns path;
  path.uv_v = const_cast<float*>(batch.uv_v);
  path.wavelength = const_cast<float*>(batch.wavelength);
  return path;
}

template <class Bsdf>
void ProbeSample(const BsdfBatch& batch) {
  const DF df;
  const PathColumns path = ProbeColumns(batch);
  for (std::uint32_t i = 0; i < batch.n; i += hn::Lanes(df)) {
    const typename Bsdf::Params material = Bsdf::Load(ProbeInputs(path, batch, i));
    const V3 u = Load3(batch.u, i);
    const BsdfSample s = Bsdf::Sample(material, Load3(batch.wo, i), {u.x, u.y, u.z});
    Store3(s.wi, batch.wi, i);
    Store3(s.weight, batch.value, i);
    hn::StoreU(s.pdf, df, batch.pdf + i);
    hn::StoreU(s.eta_scale, df, batch.eta_scale + i);
  }
}

template <class Bsdf>
void ProbeEval(const BsdfBatch& batch) {
  const DF df;
  const PathColumns path = ProbeColumns(batch);
  for (std::uint32_t i = 0; i < batch.n; i += hn::Lanes(df)) {
    const typename Bsdf::Params material = Bsdf::Load(ProbeInputs(path, batch, i));
    const BsdfValue v = Bsdf::Eval(material, Load3(batch.wo, i), Load3(batch.wi, i));
    Store3(v.f_cos, batch.value, i);
    hn::StoreU(v.pdf, df, batch.pdf + i);
  }
}

template <class Bsdf>
BsdfProbe ProbeOf() {
  BsdfProbe probe;
  if constexpr (!Bsdf::kSpecular) probe.eval = ProbeEval<Bsdf>;
  probe.sample = ProbeSample<Bsdf>;
  return probe;
}

BsdfProbe ProbeOfKind(ShadeKind kind) {
  switch (kind) {
#define X(name, traits, meaning) \
  case ShadeKind::k##name:       \
    return ProbeOf<name##Bsdf>();
    LANELIGHT_SHADE_KINDS(X)
#undef X
    default:
      return {};
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include "src/base/core/check.h"

namespace lanelight {

HWY_EXPORT(ProbeOfKind);

BsdfProbe GetBsdfProbe(SimdTarget target, ShadeKind kind) {
  LL_CHECK(IsShaded(kind));
  return LANELIGHT_ON(target, ProbeOfKind)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
