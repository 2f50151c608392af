// Motion: when a path happens, and where a camera that moves is then. The points of the
// strategy have drawn a number for the time; all rays of the path are of that time.
//   estimator   uniform in the time that the shutter is open; the image is the mean
//   camera      its rays begin where it is when the shutter opens; the map from the scene
//               as seen from there to the scene as seen later moves them too
//   source      Cook, Porter and Carpenter 1984, "Distributed Ray Tracing"; pbrt-v4
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/motion-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

template <bool kCamera>
void Move(Wave& wave) {
  const CompiledCamera& camera = *wave.camera;
  const PathColumns& p = wave.path;
  const VF first = Splat(camera.time_first), rate = Splat(camera.time_rate);
  ForEachBatch(wave, wave.queue(QueueId::kCamera),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const VF open = hn::MulAdd(Gather(p.time, slots), rate, first);
                 const VF time = hn::Min(hn::Max(open, hn::Zero(DF())), Splat(1.0f));
                 if constexpr (kCamera) {
                   const Map34 map = SpaceAt(OneMotion{camera.motion}, time).Forward();
                   const V3 o = map.Point(Gather3(p.o_x, p.o_y, p.o_z, slots));
                   const V3 d = map.Vector(Gather3(p.d_x, p.d_y, p.d_z, slots));
                   Scatter3(o, p.o_x, p.o_y, p.o_z, slots);
                   Scatter3(Normalize(d), p.d_x, p.d_y, p.d_z, slots);
                 }
                 Scatter(time, p.time, slots);
               });
}

Stage MotionStage() {
  return {.name = "motion",
          .meaning = "samples the time of paths and moves the camera",
          .input = QueueId::kCamera,
          .role = StageRole::kCamera,
          .needs = {Feature::kMotion},
          .reads = fields::kRay | FieldSet{Field::time},
          .writes = fields::kRay | FieldSet{Field::time},
          .resolve = ByFeature<Feature::kMovingCamera, Move<true>, Move<false>>};
}

LANELIGHT_END_KERNELS
