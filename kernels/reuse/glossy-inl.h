// Second vertices of reuse=block that are glossy: their materials, by kind.
#ifndef LANELIGHT_REUSE_GLOSSY_INL_H_
#define LANELIGHT_REUSE_GLOSSY_INL_H_

#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/reuse/block-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Evaluates the lobes whose light other pixels reuse.
template <class Bsdf>
HWY_INLINE BsdfValue EvalShared(const typename Bsdf::Params& material, V3 wo, V3 wi) {
  if constexpr (requires { &Bsdf::EvalShared; }) {
    return Bsdf::EvalShared(material, wo, wi);
  } else {
    return Bsdf::Eval(material, wo, wi);
  }
}

/// Surfaces of second vertices, and directions there, by record.
template <class Bsdf>
struct GlossyVertices {
  const Block& block;
  V3 at;
  ShadingFrame frame;
  typename Bsdf::Params material;

  HWY_INLINE GlossyVertices(const Block& from, const Slots& records) : block(from) {
    const SurfaceReader<Bsdf> reader(*block.glossy_surface);
    const PathColumns& p = reader.wave.path;
    const ReuseColumns& c = block.second;
    at = Gather3(c.x, c.y, c.z, records);
    const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, records);
    frame = reader.ReadFrame(ng, records);
    material = Bsdf::Load(reader.Inputs(records));
  }
  HWY_INLINE V3 ToLight(const Slots& records) const {
    const GlossyColumns& c = block.glossy;
    return frame.ToLocal(Gather3(c.light_x, c.light_y, c.light_z, records));
  }
  HWY_INLINE V3 ToNext(const Slots& records) const {
    const GlossyColumns& c = block.glossy;
    return frame.ToLocal(Gather3(c.next_x, c.next_y, c.next_z, records));
  }
  HWY_INLINE V3 ToFirst(const Slots& records) const {
    const PathColumns& p = block.first->path;
    const V3 to = Gather3(p.p_x, p.p_y, p.p_z, records) - at;
    return frame.ToLocal(Mul(to, Rsqrt(Dot(to, to))));
  }
};

/// body.operator()<Bsdf>() for the kind.
template <class Body>
HWY_INLINE void OfGlossyKind(uint32_t kind, Body&& body) {
  static_assert(kGlossyKinds == (1u << static_cast<int>(ShadeKind::kConductorRough) |
                                 1u << static_cast<int>(ShadeKind::kCoatedDiffuseSmooth) |
                                 1u << static_cast<int>(ShadeKind::kCoatedDiffuseRough)));
  switch (static_cast<ShadeKind>(kind)) {
    case ShadeKind::kConductorRough:
      return body.template operator()<ConductorRoughBsdf>();
    case ShadeKind::kCoatedDiffuseSmooth:
      return body.template operator()<CoatedDiffuseSmoothBsdf>();
    default:
      return body.template operator()<CoatedDiffuseRoughBsdf>();
  }
}

HWY_INLINE uint32_t GlossyKindOf(const Wave& wave, uint32_t record) {
  const uint32_t material = wave.block->glossy_surface->path.material[record];
  return static_cast<uint32_t>(wave.materials->kind[material]);
}

LANELIGHT_END_KERNELS

#endif
