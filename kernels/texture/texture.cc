// The texture stage: material parameters of every surface hit, from the material's
// constants or its textures.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/texture/levels-inl.h"
#include "src/compiled/scene.h"
#include "src/core/check.h"

LANELIGHT_BEGIN_KERNELS

// What bounds a colour parameter from above: reflectances end at 1, indices do not.
HWY_INLINE VF ColorLimit(const MaterialTable& materials, VI material) {
  const DI di;
  const DF df;
  const VI kind = Lookup(materials.kind, material);
  const auto is = [&](ShadeKind k) HWY_ATTR {
    return hn::Eq(kind, hn::Set(di, static_cast<int32_t>(k)));
  };
  const auto index_of_refraction = hn::Or(
      hn::Or(is(ShadeKind::kConductorSmooth), is(ShadeKind::kConductorRough)),
      hn::Or(is(ShadeKind::kCoatedConductor), is(ShadeKind::kCoatedConductorMedium)));
  return hn::IfThenElse(hn::RebindMask(df, index_of_refraction), Splat(3e38f),
                        Splat(1.0f));
}

HWY_INLINE V3 ClampColor(V3 c, VF limit) {
  const VF zero = Splat(0.0f);
  return {hn::Min(hn::Max(c.x, zero), limit), hn::Min(hn::Max(c.y, zero), limit),
          hn::Min(hn::Max(c.z, zero), limit)};
}

// GGX alpha: the constant, or from the texture as the material asks. pbrt's floor of
// 1e-4.
template <class Point>
HWY_INLINE VF Alpha(const CompiledScene& scene, VI material, const Point& at,
                    const AlignedVector<float>& constants,
                    const AlignedVector<int32_t>& textures) {
  const DI di;
  const VI id = Lookup(textures, material);
  const VF constant = Lookup(constants, material);
  const auto textured = hn::Gt(id, hn::Set(di, -1));
  if (hn::AllFalse(di, textured)) return constant;
  const VF roughness = hn::Max(EvalFloats(scene.textures, id, at, constant), Splat(0.0f));
  const VI remap = Lookup(scene.materials.alpha_remap, material);
  const auto remapped = hn::RebindMask(DF(), hn::Ne(remap, hn::Zero(di)));
  const VF alpha = hn::IfThenElse(remapped, hn::Sqrt(roughness), roughness);
  return hn::IfThenElse(hn::RebindMask(DF(), textured), hn::Max(alpha, Splat(1e-4f)),
                        constant);
}

// The colours and the roughness of a batch at `at`.
template <bool kRoughness, bool kColor1, class Point>
HWY_INLINE void EvalParameters(const CompiledScene& scene, const PathColumns& path,
                               const StoreSlots& slots, VI material, const Point& at) {
  const MaterialTable& m = scene.materials;
  const VF limit = ColorLimit(m, material);
  const V3 color0 =
      EvalTextures(scene.textures, Lookup(m.color0_texture, material), at,
                   V3{Lookup(m.color0_r, material), Lookup(m.color0_g, material),
                      Lookup(m.color0_b, material)});
  Scatter3(ClampColor(color0, limit), path.color0_r, path.color0_g, path.color0_b, slots);
  if constexpr (kColor1) {
    const V3 color1 =
        EvalTextures(scene.textures, Lookup(m.color1_texture, material), at,
                     V3{Lookup(m.color1_r, material), Lookup(m.color1_g, material),
                        Lookup(m.color1_b, material)});
    Scatter3(ClampColor(color1, limit), path.color1_r, path.color1_g, path.color1_b,
             slots);
  }
  if constexpr (kRoughness) {
    Scatter(Alpha(scene, material, at, m.alpha_x, m.alpha_x_texture), path.alpha_x,
            slots);
    Scatter(Alpha(scene, material, at, m.alpha_y, m.alpha_y_texture), path.alpha_y,
            slots);
  }
}

template <bool kRoughness, bool kColor1>
HWY_INLINE void Textures(Wave& wave) {
  const PathColumns& path = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kSurface), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI material = Gather(path.material, slots);
        const UvPoint at = {Gather(path.uv_u, slots), Gather(path.uv_v, slots)};
        EvalParameters<kRoughness, kColor1>(*wave.scene, path, slots, material, at);
      });
}

// The layers of coats.
template <class Point>
HWY_INLINE void EvalCoat(const CompiledScene& scene, const PathColumns& path,
                         const StoreSlots& slots, VI material, const Point& at) {
  const MaterialTable& m = scene.materials;
  Scatter(Alpha(scene, material, at, m.alpha2_x, m.alpha2_x_texture), path.alpha2_0,
          slots);
  Scatter(Alpha(scene, material, at, m.alpha2_y, m.alpha2_y_texture), path.alpha2_1,
          slots);
  const VF thickness = EvalFloats(scene.textures, Lookup(m.thickness_texture, material),
                                  at, Lookup(m.coat_thickness, material));
  Scatter(hn::Max(thickness, hn::Zero(DF())), path.coat_thickness, slots);
}

template <class Point>
HWY_INLINE void EvalCoatMedium(const CompiledScene& scene, const PathColumns& path,
                               const StoreSlots& slots, VI material, const Point& at) {
  const MaterialTable& m = scene.materials;
  const V3 albedo = EvalTextures(
      scene.textures, Lookup(m.coat_albedo_texture, material), at,
      V3{Lookup(m.coat_albedo_r, material), Lookup(m.coat_albedo_g, material),
         Lookup(m.coat_albedo_b, material)});
  Scatter3(ClampColor(albedo, Splat(1.0f)), path.coat_albedo_r, path.coat_albedo_g,
           path.coat_albedo_b, slots);
  const VF g = EvalFloats(scene.textures, Lookup(m.coat_g_texture, material), at,
                          Lookup(m.coat_g, material));
  const VF limit = Splat(kMostCoatAsymmetry);
  Scatter(hn::Max(hn::Neg(limit), hn::Min(g, limit)), path.coat_g, slots);
}

// Everything that the plan has columns for: for the few scenes that need it.
template <class Point>
HWY_INLINE void AllTextures(Wave& wave) {
  const CompiledScene& scene = *wave.scene;
  const PathColumns& path = wave.path;
  const auto point = [&](const StoreSlots& slots) HWY_ATTR {
    const VF u = Gather(path.uv_u, slots), v = Gather(path.uv_v, slots);
    if constexpr (Point::kHasPlace) {
      Point at;
      at.u = u, at.v = v;
      at.p = Gather3(path.p_x, path.p_y, path.p_z, slots);
      at.n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
      if constexpr (Point::kHasFootprint) at.spread = LoadFootprint(path, slots);
      return at;
    } else {
      return Point{u, v};
    }
  };
  ForEachBatch(wave, wave.queue(QueueId::kSurface),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const VI material = Gather(path.material, slots);
                 const auto at = point(slots);
                 if (path.alpha_x != nullptr && path.color1_r != nullptr) {
                   EvalParameters<true, true>(scene, path, slots, material, at);
                 } else if (path.alpha_x != nullptr) {
                   EvalParameters<true, false>(scene, path, slots, material, at);
                 } else if (path.color1_r != nullptr) {
                   EvalParameters<false, true>(scene, path, slots, material, at);
                 } else {
                   EvalParameters<false, false>(scene, path, slots, material, at);
                 }
                 if (path.coat_thickness != nullptr)
                   EvalCoat(scene, path, slots, material, at);
                 if (path.coat_g != nullptr)
                   EvalCoatMedium(scene, path, slots, material, at);
               });
}

Stage TextureStage() {
  return {.name = "texture",
          .meaning = "textured material parameters of surface hits",
          .input = QueueId::kSurface,
          .needs = {Feature::kTextures},
          .reads = FieldSet{Field::material} | fields::kUv | fields::kPoint |
                   fields::kNormal | fields::kSpread,
          .writes = fields::kParameters,
          .resolve = [](const FeatureSet& features) -> StageFn {
            LL_CHECK(features.Has(Feature::kUv));
            if (features.Has(Feature::kTextureFootprints)) {
              return AllTextures<FilteredPoint>;
            }
            if (features.Has(Feature::kTexturePlaces)) {
              return AllTextures<PlacedPoint>;
            }
            if (features.HasAny({Feature::kTexturedCoat, Feature::kTexturedCoatMedium})) {
              return AllTextures<UvPoint>;
            }
            const bool roughness = features.Has(Feature::kTexturedRoughness);
            const bool color1 = features.Has(Feature::kTexturedColor1);
            if (roughness && color1) return Textures<true, true>;
            if (roughness) return Textures<true, false>;
            if (color1) return Textures<false, true>;
            return Textures<false, false>;
          }};
}

LANELIGHT_END_KERNELS
