// The data that a stage works on: the columns of one wavefront, its queues of path slots,
// the scene. A wavefront belongs to one task; nothing here is shared or locked.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/fields.h"
#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/path/scene_parts.h"
#include "src/vocabulary/path/shade_kinds.h"

namespace lanelight {

/// Counts samples that were not finite, or negative where they must not be. Each is
/// replaced by zero.
struct Health {
  std::uint64_t nan = 0, infinite = 0, negative = 0;
  std::uint64_t Total() const { return nan + infinite + negative; }
};

struct Block;        // src/vocabulary/path/block.h
struct LightSplats;  // src/vocabulary/path/light_splats.h

// Queues hold path slots. Stages append and read; the driver
// (src/render/wave/phase_driver.h) clears all but kFree, and kActive, which it takes from
// kScattered, before a wave. X(name, meaning)
#define LANELIGHT_QUEUES(X)                                        \
  X(kFree, "slots without a path")                                 \
  X(kCamera, "paths that need a camera ray")                       \
  X(kActive, "paths with a ray to intersect")                      \
  X(kMiss, "paths whose ray left the scene")                       \
  X(kHit, "paths whose ray hit something")                         \
  X(kSurface, "hits that will scatter")                            \
  X(kVertex, "paths that will scatter: at surfaces and elsewhere") \
  X(kLit, "surfaces that connect to a light")                      \
  X(kShadow, "paths with a shadow ray in ls_* carrying sh_*")      \
  X(kScattered, "paths with a new ray after shading")              \
  X(kPassed, "paths that go through an interface")                 \
  X(kDone, "paths whose radiance is complete")                     \
  X(kScratch, "filtered sub-queue, valid inside one stage call")

enum class QueueId : std::uint8_t {
#define X(name, meaning) name,
  LANELIGHT_QUEUES(X)
#undef X
      kShade,  // + ShadeKind: one queue per kind of material
  kCount = kShade + static_cast<int>(ShadeKind::kCount)
};
inline constexpr int kNumQueues = static_cast<int>(QueueId::kCount);
constexpr QueueId ShadeQueue(ShadeKind kind) {
  return static_cast<QueueId>(static_cast<int>(QueueId::kShade) + static_cast<int>(kind));
}

/// Slots of paths. `items` has room for the wavefront plus one full vector: kernels pad
/// the tail with the last valid slot (kernels/queue/batch-inl.h).
struct Queue {
  std::uint32_t* items = nullptr;
  std::uint32_t size = 0;
};

/// Occupancy of the stage that is running; kernels count through the batch loop.
struct LaneCounters {
  std::uint64_t items = 0;    // paths processed
  std::uint64_t vectors = 0;  // vector iterations
};

/// Samples of this task: every pixel of the tile, sample indices [first_sample,
/// first_sample + samples). Started pixel by pixel within one sample index, so that
/// neighbouring lanes hold neighbouring pixels.
struct TileWork {
  const std::uint32_t* pixels = nullptr;  // y * width + x, in the order to start them
  std::uint32_t num_pixels = 0;
  std::uint32_t first_sample = 0, samples = 0;
  std::uint32_t together = 1;  // samples of a pixel in adjacent slots; even for pairs
  std::uint32_t next_pixel = 0, next_sample = 0;  // cursor; done when >= samples
  /// pixel-samples=shared: a sample has the same place in the filters of all pixels of a
  /// tile, by the numbers of one of them. Kept here for each sample, in bins of the
  /// filter's tables: along x for all, then along y.
  std::uint32_t tile_pixel = 0;
  float* filter_places = nullptr;

  bool Done() const { return next_sample >= samples; }
};

/// Storage of finished samples: a plane-major buffer of the task's tile. Plane p of
/// sample `output` is at samples[p * stride + output]. A pixel's samples are consecutive.
struct SampleBuffer {
  float* samples = nullptr;
  std::uint32_t stride = 0;  // samples of one plane
};

/// Live columns that are treated alike.
struct ColumnList {
  std::uint32_t* columns[kNumFields];
  std::uint32_t count = 0;

  void Add(std::uint32_t* column) { columns[count++] = column; }
};

/// The lifetimes and first values of fields (src/vocabulary/path/fields.h), resolved for
/// a plan.
struct ColumnLists {
  ColumnList carried;                      // to the next wave
  ColumnList copied;                       // to a copy of a path
  ColumnList begun;                        // by the camera stage, ...
  std::uint32_t first_values[kNumFields];  // ... with these bits, in the same order
  ColumnList begun_by_split_paths;         // by a copy of a path ...
  std::uint32_t copy_values[kNumFields];   // ... with these

  ColumnLists() = default;
  ColumnLists(const PathColumns& path, const FeatureSet& features);
};

struct Wave;
using StageFn = void (*)(Wave&);

/// Kernels of the plan that find the nearest surface of a ray, what it is like there, and
/// whether anything blocks a shadow ray: for stages that send rays of their own.
struct RayKernels {
  static constexpr std::uint32_t kMaxKernels = 8;
  StageFn closest[kMaxKernels] = {}, surface[kMaxKernels] = {}, shadow[kMaxKernels] = {};
  std::uint32_t num_closest = 0, num_surface = 0, num_shadow = 0;
};

struct Wave : SceneParts {
  PathColumns path;
  ColumnLists lists;  // of `path`
  const RunParameters* run = nullptr;
  RayKernels kernels;                   // with kInterfaces or kReuse
  Block* block = nullptr;               // with kReuse
  LightSplats* light_splats = nullptr;  // with kLightPaths
  Queue queues[kNumQueues];
  std::uint32_t capacity = 0;
  TileWork work;
  SampleBuffer buffer;
  LaneCounters lanes;
  Health health;
  std::uint64_t rays_closest = 0, rays_shadow = 0;

  /// The queue that is kVertex: where only surfaces scatter, theirs.
  QueueId vertices = QueueId::kSurface;

  Queue& queue(QueueId id) {
    return queues[static_cast<int>(id == QueueId::kVertex ? vertices : id)];
  }

  /// Empties every queue and frees every slot.
  void Reset();
  /// Resets the queues, and takes work and the buffer for its samples.
  void Begin(const TileWork& new_work, const SampleBuffer& new_buffer);
  /// Returns whether samples are left to start, or paths to continue.
  bool HasWork() { return !work.Done() || queue(QueueId::kScattered).size > 0; }
  /// Makes the scattered rays those to intersect next, and empties all other queues but
  /// that of free slots.
  void BeginWave();
};

}  // namespace lanelight
