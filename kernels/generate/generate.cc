// Refills free slots with the next samples of the task, so that lanes stay full until the
// work runs out.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/generate/generate.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// Scalar on purpose: consecutive slots of the free list are arbitrary, and three stores
// per path are below 1 % of its cost.
void Generate(Wave& wave) {
  Queue& free = wave.queue(QueueId::kFree);
  Queue& camera = wave.queue(QueueId::kCamera);
  TileWork& work = wave.work;
  uint32_t taken = 0;
  while (taken + work.together <= free.size && !work.Done()) {
    const uint32_t end = HWY_MIN(work.next_sample + work.together, work.samples);
    for (uint32_t sample = work.next_sample; sample < end; ++sample) {
      const uint32_t slot = free.items[free.size - 1 - taken++];
      wave.path.pixel[slot] = work.pixels[work.next_pixel];
      wave.path.sample[slot] = work.first_sample + sample;
      wave.path.output[slot] = work.next_pixel * work.samples + sample;
      wave.path.depth[slot] = 0;
      camera.items[camera.size++] = slot;
    }
    if (++work.next_pixel == work.num_pixels) {
      work.next_pixel = 0;
      work.next_sample += work.together;
    }
  }
  free.size -= taken;
  CountBatches(wave, camera);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/wavefront/stage.h"

namespace lanelight {

HWY_EXPORT(Generate);

Stage GenerateStage() {
  return {"generate",
          "starts the next samples in free slots",
          QueueId::kFree,
          {},
          {},
          {Field::pixel, Field::sample, Field::output, Field::depth},
          [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(Generate); }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
