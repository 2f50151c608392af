// Stores the first hit as pbrt-v4's GBufferFilm does (Pharr, Jakob and Humphreys 2023,
// section 5.4.3). A miss leaves the zeros that the camera stage wrote.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/pixel_steps-inl.h"
#include "src/scene/compiled/camera.h"
#include "src/vocabulary/path/scene_kinds.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE V3 Rows(Vec3f x, Vec3f y, Vec3f z, V3 v) {
  return {Dot(SplatVec(x), v), Dot(SplatVec(y), v), Dot(SplatVec(z), v)};
}

HWY_INLINE V3 NormalIn(const GbufferSpace& space, V3 n) {
  return Normalize(Rows(space.normal_x, space.normal_y, space.normal_z, n));
}

// How much z changes from the pixel at p to the next, in the plane across ng.
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
HWY_NOINLINE FirstHit SeenAtStart(const Wave& wave, const Slots& slots, FirstHit hit) {
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
  const Queue& first =
      FilterQueue(wave, wave.queue(QueueId::kSurface), [&](const Slots& slots) HWY_ATTR {
        return hn::RebindMask(DF(), hn::Eq(Gather(path.depth, slots), hn::Zero(DI())));
      });
  ForEachBatch(wave, first, [&](const StoreSlots& slots, MF) HWY_ATTR {
    FirstHit hit = LoadHit(wave, slots);
    if (with_camera) hit = SeenAtStart(wave, slots, hit);
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
