// Refills free slots with the next samples of the task, so that lanes stay full until the
// work runs out.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// A vector of samples of one pixel, from `sample` of the task on, in the slots on top of
// the stack of free ones; `top` is one past them.
HWY_INLINE void StartVector(const PathColumns& p, const TileWork& work, uint32_t sample,
                            const uint32_t* top, uint32_t* started) {
  const DI di;
  const DU du;
  const VU free = hn::LoadU(du, top - hn::Lanes(du));
  const Slots slots(hn::BitCast(di, hn::Reverse(du, free)));
  hn::StoreU(hn::BitCast(du, slots.index), du, started);
  const auto from = [&](uint32_t first)
                        HWY_ATTR { return hn::BitCast(di, hn::Iota(du, first)); };
  Scatter(hn::Set(di, static_cast<int32_t>(work.pixels[work.next_pixel])), p.pixel,
          slots);
  Scatter(from(work.first_sample + sample), p.sample, slots);
  Scatter(from(work.next_pixel * work.samples + sample), p.output, slots);
  Scatter(hn::Zero(di), p.depth, slots);
}

// Returns the slots taken, at most `max_new`.
template <bool kSplitting>
HWY_INLINE uint32_t StartSamples(Wave& wave, uint32_t max_new) {
  const PathColumns p = wave.path;
  const Queue free = wave.queue(QueueId::kFree);
  Queue& camera = wave.queue(QueueId::kCamera);
  TileWork work = wave.work;
  const uint32_t together = work.together;
  uint32_t* const started = camera.items + camera.size;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DU()));
  uint32_t num_started = 0;
  while (num_started + together <= max_new && !work.Done()) {
    const uint32_t end = HWY_MIN(work.next_sample + together, work.samples);
    uint32_t sample = work.next_sample;
    if constexpr (!kSplitting) {
      for (; sample + lanes <= end; sample += lanes, num_started += lanes) {
        StartVector(p, work, sample, free.items + free.size - num_started,
                    started + num_started);
      }
    }
    for (; sample < end; ++sample) {
      const uint32_t slot = free.items[free.size - 1 - num_started];
      p.pixel[slot] = work.pixels[work.next_pixel];
      p.sample[slot] = work.first_sample + sample;
      p.output[slot] = work.next_pixel * work.samples + sample;
      p.depth[slot] = 0;
      if constexpr (kSplitting) {
        p.output[slot] *= kMaxSplitPaths;
        p.branch[slot] = 0;
        p.budget[slot] = kMaxSplitPaths;
      }
      started[num_started++] = slot;
    }
    if (++work.next_pixel == work.num_pixels) {
      work.next_pixel = 0;
      work.next_sample += together;
    }
  }
  camera.size += num_started;
  wave.work = work;
  return num_started;
}

// Where paths split, as many are started as keep the live paths below a share of
// 1 / kMaxSplitPaths of the slots: none of them ever has a budget above kMaxSplitPaths,
// so a split always finds free slots.
template <bool kSplitting>
HWY_INLINE void Start(Wave& wave) {
  Queue& free = wave.queue(QueueId::kFree);
  Queue& camera = wave.queue(QueueId::kCamera);
  uint32_t max_new = free.size;
  if constexpr (kSplitting) {
    const uint32_t max_live = wave.capacity / kMaxSplitPaths;
    const uint32_t live = wave.queue(QueueId::kActive).size;
    max_new = live < max_live ? max_live - live : 0;
  }
  const uint32_t num_started = StartSamples<kSplitting>(wave, max_new);
  free.size -= num_started;
  CountBatches(wave, camera);
}

Stage GenerateStage() {
  return {.name = "generate",
          .meaning = "starts the next samples in free slots",
          .input = QueueId::kFree,
          .role = StageRole::kCamera,
          .writes = {Field::pixel, Field::sample, Field::output, Field::depth,
                     Field::branch, Field::budget},
          .resolve = ByFeature<Feature::kSplitting, Start<true>, Start<false>>};
}

LANELIGHT_END_KERNELS
