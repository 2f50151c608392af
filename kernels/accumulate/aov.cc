// Auxiliary output of the first hit: albedo, shading normal, distance. A miss leaves the
// zeros that the camera stage wrote.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/spectra.h"

LANELIGHT_BEGIN_KERNELS

// Lanes whose kind has a trait.
HWY_INLINE MF HasTrait(VI kind, ShadeTraits trait) {
  MF mask = hn::FirstN(DF(), 0);
  for (int k = 0; k < kNumShadeKinds; ++k) {
    if (!lanelight::HasTrait(static_cast<ShadeKind>(k), trait)) continue;
    mask = hn::Or(mask, hn::RebindMask(DF(), hn::Eq(kind, hn::Set(DI(), k))));
  }
  return mask;
}

// Reflectance of a material seen head-on: color0 for the diffuse kinds, normal-incidence
// Fresnel ((eta-1)^2 + k^2) / ((eta+1)^2 + k^2) for metals, white for clear interfaces.
HWY_INLINE V3 AlbedoOf(VI kind, V3 color0, V3 k) {
  const auto fresnel = [](VF n, VF kk) HWY_ATTR {
    const VF k2 = hn::Mul(kk, kk);
    const VF a = hn::Sub(n, Splat(1.0f)), b = hn::Add(n, Splat(1.0f));
    return hn::Div(hn::MulAdd(a, a, k2), hn::MulAdd(b, b, k2));
  };
  const V3 metal = {fresnel(color0.x, k.x), fresnel(color0.y, k.y),
                    fresnel(color0.z, k.z)};
  return IfThenElse(HasTrait(kind, kClear), Splat3(1, 1, 1),
                    IfThenElse(HasTrait(kind, kMetallic), metal, color0));
}

template <bool kByPath, bool kNormals>
void Aov(Wave& wave) {
  const PathColumns& p = wave.path;
  const MaterialTable& m = *wave.materials;
  const Queue& first =
      FilterQueue(wave, wave.queue(QueueId::kSurface), [&](const Slots& slots) HWY_ATTR {
        return hn::RebindMask(DF(), hn::Eq(Gather(p.depth, slots), hn::Zero(DI())));
      });
  ForEachBatch(wave, first, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI material = Gather(p.material, slots);
    const V3 color0 = kByPath ? Gather3(p.color0_r, p.color0_g, p.color0_b, slots)
                              : Gather3(m.color0_r.data(), m.color0_g.data(),
                                        m.color0_b.data(), material);
    const V3 color1 =
        p.color1_r != nullptr
            ? Gather3(p.color1_r, p.color1_g, p.color1_b, slots)
            : Gather3(m.color1_r.data(), m.color1_g.data(), m.color1_b.data(), material);
    V3 albedo = AlbedoOf(Gather(m.kind.data(), material), color0, color1);
    if (p.wavelength != nullptr) {
      albedo = FilmColor(*wave.spectra, albedo, {p, slots});
    }
    Scatter3(albedo, p.aov_albedo_r, p.aov_albedo_g, p.aov_albedo_b, slots);
    const V3 n = kNormals ? Gather3(p.ns_x, p.ns_y, p.ns_z, slots)
                          : Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
    Scatter3(n, p.aov_n_x, p.aov_n_y, p.aov_n_z, slots);
    VF depth = Gather(p.t, slots);
    if (p.passed != nullptr) depth = hn::Add(depth, Gather(p.passed, slots));
    Scatter(depth, p.aov_depth, slots);
  });
}

StageFn ResolveAov(const FeatureSet& features) {
  const bool normals =
      features.HasAny({Feature::kVertexNormals, Feature::kBumps, Feature::kNormalMaps});
  if (features.HasAny({Feature::kTextures, Feature::kPlainSpectra})) {
    return normals ? Aov<true, true> : Aov<true, false>;
  }
  return normals ? Aov<false, true> : Aov<false, false>;
}

Stage AovStage() {
  return {.name = "aov",
          .meaning = "albedo, normal and depth of the first hit",
          .input = QueueId::kSurface,
          .role = StageRole::kAccumulate,
          .needs = {Feature::kAov, Feature::kScatters},
          .reads = fields::kNormal | fields::kParameters |
                   FieldSet{Field::depth, Field::t, Field::material, Field::passed,
                            Field::wavelength},
          .writes = fields::kAov,
          .resolve = ResolveAov};
}

LANELIGHT_END_KERNELS
