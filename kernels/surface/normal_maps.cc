// Normal maps as in pbrt-v4 (bilinear, repeated, no levels): texel c holds the shading
// normal 2 c - 1 in the frame of dp/du across the normal, n x dp/du, and the normal.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/relief-inl.h"
#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

// dp/du across n, unit; any direction across it where there is none.
HWY_INLINE V3 UnitTangent(V3 n, V3 tangent) {
  const V3 flat = MulAdd(n, hn::Neg(Dot(n, tangent)), tangent);
  const VF length2 = Dot(flat, flat);
  const MF usable = hn::Gt(length2, hn::Mul(Splat(1e-10f), Dot(tangent, tangent)));
  return IfThenElse(usable, Mul(flat, Rsqrt(length2)), FrameFromNormal(n).s);
}

void NormalMaps(Wave& wave) {
  const AlignedVector<int32_t>& textures = wave.materials->normal_map_texture;
  const PathColumns& path = wave.path;
  ForEachBatch(
      wave, WithTexture(wave, textures), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI texture = Lookup(textures, Gather(path.material, slots));
        const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
        const V3 ns = Gather3(path.ns_x, path.ns_y, path.ns_z, slots);
        const V3 x = UnitTangent(ns, Gather3(path.tg_x, path.tg_y, path.tg_z, slots));
        const V3 color = EvalTextures(*wave.textures, texture, Gather(path.uv_u, slots),
                                      Gather(path.uv_v, slots), Splat3(0, 0, 0));
        const V3 local = Normalize(Mul(color, Splat(2.0f)) - Splat3(1, 1, 1));
        const V3 n = ShadingFrame{x, Cross(ns, x), ns}.FromLocal(local);
        StoreNormal(wave, slots, Sided(n, ng, ns), ng, x);
      });
}

Stage NormalMapsStage() {
  return {.name = "normal_maps",
          .meaning = "shading normals of normal maps",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kNormalMaps, Feature::kScatters},
          .reads = kReliefReads,
          .writes = kReliefWrites,
          .resolve = Always<NormalMaps>};
}

LANELIGHT_END_KERNELS
