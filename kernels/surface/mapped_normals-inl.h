// Makes shading normals of bump and normal maps valid.
//
// A shading normal can cause two kinds of directions that a real surface never shows:
// facets that face away from the viewer, and reflections into the surface. pbrt-v4
// follows both: paths enter the solid and are lost, which is black. Here
// - a normal that faces away from the viewer is turned, in the plane of the two, to a
//   grazing angle (cosine kMinCosine): neighbours would hide such a facet of a real
//   bump;
// - for materials that only mirror or refract (metals, glass), a normal is turned so
//   that the mirrored viewer is above the surface. The Iray renderer does so for all
//   materials (Keller et al. 2017, "The Iray Light Transport Simulation and Rendering
//   System").
// Other normals are those of pbrt-v4. Light that a diffuse bump scatters below the
// horizon of the surface continues there, as in pbrt-v4: (1 - cos theta) / 2 at a tilt of
// theta.
#ifndef LANELIGHT_SURFACE_MAPPED_NORMALS_INL_H_
#define LANELIGHT_SURFACE_MAPPED_NORMALS_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

/// The columns that stages read and write to change the shading normal.
inline constexpr FieldSet kMappedNormalReads =
    fields::kNormal | fields::kTangents | fields::kUv |
    FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::material};
inline constexpr FieldSet kMappedNormalWrites =
    fields::kTangent | FieldSet{Field::ns_x, Field::ns_y, Field::ns_z};

/// Least cosine of the viewer to a normal, and of the mirrored viewer to the surface.
inline constexpr float kMinCosine = 1.0f / 64;

/// The hits whose material has an entry >= 0 in `textures`.
HWY_INLINE const Queue& WithTexture(Wave& wave, const AlignedVector<int32_t>& textures) {
  const uint32_t* materials = wave.path.material;
  return FilterQueue(wave, wave.queue(QueueId::kSurface),
                     [&](const Slots& slots) HWY_ATTR {
                       const VI id = Lookup(textures, Gather(materials, slots));
                       return hn::RebindMask(DF(), hn::Gt(id, hn::Set(DI(), -1)));
                     });
}

/// Lanes whose material only mirrors or refracts.
HWY_INLINE MF MirrorsOrRefracts(const MaterialTable& table, VI material) {
  const VI kind = Lookup(table.kind, material);
  MF mask = hn::FirstN(DF(), 0);
  for (int k = 0; k < kNumShadeKinds; ++k) {
    const auto shade_kind = static_cast<ShadeKind>(k);
    if (!HasTrait(shade_kind, kMetallic) && !HasTrait(shade_kind, kClear)) continue;
    mask = hn::Or(mask, hn::RebindMask(DF(), hn::Eq(kind, hn::Set(DI(), k))));
  }
  return mask;
}

/// Unit normal on the side of the geometric one; `before` where it is not finite.
HWY_INLINE V3 Sided(V3 n, V3 ng, V3 before) {
  const VF length2 = Dot(n, n);
  const MF good = hn::And(hn::Gt(length2, Splat(0.5f)), hn::Lt(length2, Splat(2.0f)));
  n = IfThenElse(good, n, before);
  return Mul(n, hn::CopySign(Splat(1.0f), Dot(n, ng)));
}

/// Turns `n`, a unit normal on the side of `ng`, as the top of this file says. `wo`
/// points to the viewer and may be on either side.
HWY_INLINE V3 KeepInView(V3 n, V3 ng, V3 wo, MF mirrors) {
  const VF min_cosine = Splat(kMinCosine);
  wo = Mul(wo, hn::CopySign(Splat(1.0f), Dot(ng, wo)));
  const VF cosine = Dot(n, wo);
  const V3 across = MulAdd(wo, hn::Neg(cosine), n);
  const float sine = 0.99987792f;  // sqrt(1 - kMinCosine^2)
  const V3 grazed = MulAdd(across, hn::Mul(Splat(sine), Rsqrt(Dot(across, across))),
                           Mul(wo, min_cosine));
  n = IfThenElse(hn::Lt(cosine, min_cosine), grazed, n);
  // The mirrored viewer, lifted to the least height or to that of the viewer.
  const V3 mirrored = MulAdd(n, hn::Mul(Splat(2.0f), Dot(n, wo)), -wo);
  const VF height = Dot(mirrored, ng), wanted = hn::Min(min_cosine, Dot(wo, ng));
  const V3 lifted = Normalize(MulAdd(ng, hn::Sub(wanted, height), mirrored));
  const MF low = hn::And(mirrors, hn::Lt(height, wanted));
  return IfThenElse(low, Normalize(lifted + wo), n);
}

/// Writes the normal and the tangent from which FrameFromTangent makes the frame.
HWY_INLINE void StoreNormal(const Wave& wave, const StoreSlots& slots, V3 n, V3 ng,
                            V3 tangent) {
  const PathColumns& path = wave.path;
  const V3 wo = -Gather3(path.d_x, path.d_y, path.d_z, slots);
  const MF mirrors = MirrorsOrRefracts(*wave.materials, Gather(path.material, slots));
  Scatter3(KeepInView(n, ng, wo, mirrors), path.ns_x, path.ns_y, path.ns_z, slots);
  Scatter3(tangent, path.tg_x, path.tg_y, path.tg_z, slots);
}

LANELIGHT_END_KERNELS

#endif
