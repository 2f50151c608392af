// Auxiliary output of the first hit, --aov and --gbuffer: albedo, shading normal,
// distance. A miss leaves the zeros that the camera stage wrote.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "kernels/surface/pixel_steps-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/spectra.h"
#include "src/vocabulary/path/scene_kinds.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE const Queue& FirstHits(Wave& wave) {
  return FilterQueue(wave, wave.queue(QueueId::kSurface),
                     [&](const Slots& slots) HWY_ATTR {
                       return hn::RebindMask(
                           DF(), hn::Eq(Gather(wave.path.depth, slots), hn::Zero(DI())));
                     });
}

// Returns the lanes whose kind has a trait.
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
  ForEachBatch(wave, FirstHits(wave), [&](const StoreSlots& slots, MF) HWY_ATTR {
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

// Stores the first hit as pbrt-v4's GBufferFilm does (Pharr, Jakob and Humphreys 2023,
// section 5.4.3). A miss leaves the zeros that the camera stage wrote.
HWY_INLINE V3 Rows(Vec3f x, Vec3f y, Vec3f z, V3 v) {
  return {Dot(SplatVec(x), v), Dot(SplatVec(y), v), Dot(SplatVec(z), v)};
}

HWY_INLINE V3 NormalIn(const GbufferSpace& space, V3 n) {
  return Normalize(Rows(space.normal_x, space.normal_y, space.normal_z, n));
}

// Returns the change of z from the pixel at p to the next, in the plane across ng.
HWY_INLINE VF Slope(const GbufferSpace& space, float scale, V3 ng, V3 sight, V3 step) {
  const VF change = Dot(SplatVec(space.z), InPlane(ng, sight, step));
  return Bounded(hn::Div(change, Splat(scale)));
}

// The stored values: point, geometric and shading normal, and their change to the next
// pixels.
struct FirstHit {
  V3 p, ng, ns;
  PixelSteps steps;
};

HWY_INLINE FirstHit LoadHit(const Wave& wave, const Slots& slots) {
  const PathColumns& path = wave.path;
  const V3 p = Gather3(path.p_x, path.p_y, path.p_z, slots);
  const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
  const V3 ns =
      path.ns_x == nullptr ? ng : Gather3(path.ns_x, path.ns_y, path.ns_z, slots);
  return {p, ng, ns, StepsOfPaths(wave, slots, p)};
}

// Returns the hit in the space of the camera at the start of its motion, as the moving
// camera sees it at the path's time.
HWY_NOINLINE FirstHit HitAtShutterStart(const Wave& wave, const Slots& slots,
                                        FirstHit hit) {
  const MovedSpace moved =
      SpaceAt(OneMotion{wave.camera->motion}, Gather(wave.path.time, slots));
  const Map34 forward = moved.Forward();
  const V3 p = moved.Back().Point(hit.p);
  return {p, forward.Transposed(hit.ng), forward.Transposed(hit.ns),
          StepsAt(*wave.footprint, p)};
}

void Gbuffer(Wave& wave) {
  const PathColumns& path = wave.path;
  const GbufferSpace& space = *wave.gbuffer;
  const PixelFootprint& footprint = *wave.footprint;
  const bool with_camera = wave.camera->moves && space.of_camera;
  ForEachBatch(wave, FirstHits(wave), [&](const StoreSlots& slots, MF) HWY_ATTR {
    FirstHit hit = LoadHit(wave, slots);
    if (with_camera) hit = HitAtShutterStart(wave, slots, hit);
    const auto& [p, ng, ns, steps] = hit;
    const V3 place =
        Rows(space.x, space.y, space.z, p - SplatVec(space.from)) + SplatVec(space.to);
    Scatter(Splat(1.0f), path.gb_hit, slots);
    Scatter3(place, path.gb_p_x, path.gb_p_y, path.gb_p_z, slots);
    Scatter3(NormalIn(space, ng), path.gb_ng_x, path.gb_ng_y, path.gb_ng_z, slots);
    Scatter3(NormalIn(space, ns), path.gb_ns_x, path.gb_ns_y, path.gb_ns_z, slots);
    Scatter(Gather(path.uv_u, slots), path.gb_uv_0, slots);
    Scatter(Gather(path.uv_v, slots), path.gb_uv_1, slots);
    Scatter(Slope(space, footprint.scale, ng, steps.sight, steps.x), path.gb_dz_0, slots);
    Scatter(Slope(space, footprint.scale, ng, steps.sight, steps.y), path.gb_dz_1, slots);
  });
}

Stage GbufferStage() {
  return {.name = "gbuffer",
          .meaning = "point, normals, coordinates and slopes of the first hit",
          .input = QueueId::kSurface,
          .role = StageRole::kAccumulate,
          .needs = {Feature::kGbuffer, Feature::kScatters},
          .reads = fields::kPoint | fields::kNormal | fields::kUv |
                   FieldSet{Field::depth, Field::time},
          .writes = fields::kGbuffer,
          .resolve = Always<Gbuffer>};
}

LANELIGHT_END_KERNELS
