#include "src/render/wave/wavefront.h"

#include <algorithm>
#include <cstddef>

#include "src/base/core/check.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {
namespace {

constexpr std::size_t kLanesPerLine = kCacheLine / sizeof(std::uint32_t);

// Returns the lanes from one column to the next: padded by a full vector, on whole cache
// lines, and an odd number of lines. Strides are then never multiples of 2 KiB: loads and
// stores whose addresses agree in the low 12 bits block each other.
std::size_t ColumnStride(std::uint32_t capacity) {
  const std::size_t lines = (capacity + kLanesPerLine - 1) / kLanesPerLine + 1;
  return (lines | 1) * kLanesPerLine;
}

#ifndef NDEBUG
// A NaN as a float and an absurd index as an integer, so that reads of unwritten columns
// show up at once.
constexpr std::uint32_t kPoison = 0x7fdeadffu;
#endif

template <typename T>
void Place(T*& column, Field field, const Plan& plan, std::uint32_t*& next,
           std::size_t stride) {
  const auto& live = plan.live_fields;
  if (std::ranges::find(live, field) == live.end()) {
    column = nullptr;
    return;
  }
  column = reinterpret_cast<T*>(next);
  next += stride;
}

}  // namespace

float ExposureOf(const PreparedScene& scene) {
  return float(scene.view->film.imaging_ratio);
}

RunParameters MakeRunParameters(const PreparedScene& scene, const Plan& plan) {
  RunParameters run;
  run.width = std::uint32_t(scene.view->film.width);
  run.height = std::uint32_t(scene.view->film.height);
  const Strategy strategy = PlannedStrategy(scene, plan.options);
  run.sampler = MakeSamplerParameters(strategy.sampler);
  run.sampler.by_tile = plan.features.HasAll({Feature::kReuse, Feature::kSpectral});
  run.pairs = strategy.pairs == Pairs::kAntithetic;
  run.mis = MakeMisParameters(strategy);
  run.roulette = MakeRouletteParameters(strategy);
  run.candidates = CandidatesOf(strategy, plan.features);
  run.max_depth = plan.options.max_depth;
  run.exposure = ExposureOf(scene);
  run.features = plan.features;
  run.planes = SamplePlanes(plan.features);
  return run;
}

Wavefront::Wavefront(const PreparedScene& scene, const Plan& plan,
                     const RunParameters& run) {
  LL_CHECK_GT(plan.slots, 0u);
  const std::size_t stride = ColumnStride(plan.slots);
  const std::size_t columns = plan.live_fields.size() + kNumQueues;
#ifdef NDEBUG
  memory_.resize(stride * columns);
#else
  memory_.assign(stride * columns, kPoison);
#endif
  std::uint32_t* next = memory_.data();
#define X(type, name, ...) Place(wave_.path.name, Field::name, plan, next, stride);
  LANELIGHT_PATH_FIELDS(X)
#undef X
  for (Queue& queue : wave_.queues) {
    queue.items = next;
    next += stride;
  }
  wave_.lists = ColumnLists(wave_.path, plan.features);
  if (plan.features.Has(Feature::kOtherEvents)) wave_.vertices = QueueId::kVertex;
  wave_.kernels = plan.ray_kernels;
  static_cast<SceneParts&>(wave_) = scene.Parts();
  wave_.run = &run;
  wave_.capacity = plan.slots;
  wave_.Reset();
}

Wave Wavefront::Narrowed(const FeatureSet& features) const {
  Wave wave = wave_;
#define X(type, name, ...) \
  if (!IsLive(Field::name, features)) wave.path.name = nullptr;
  LANELIGHT_PATH_FIELDS(X)
#undef X
  wave.lists = ColumnLists(wave.path, features);
  return wave;
}

void SumSplitPaths(float* values, std::uint32_t rows, const SamplePlanes& planes) {
  const std::size_t samples = rows / kMaxSplitPaths;
  LL_CHECK_EQ(samples * kMaxSplitPaths, rows);
  const auto fold = [&](int plane, bool sums) {
    const float* from = values + std::size_t(plane) * rows;
    float* to = values + std::size_t(plane) * samples;
    for (std::size_t i = 0; i < samples; ++i) {
      float sum = from[i * kMaxSplitPaths];
      for (std::uint32_t c = 1; c < kMaxSplitPaths && sums; ++c) {
        sum += from[i * kMaxSplitPaths + c];
      }
      to[i] = sum;
    }
  };
  for (int g = 0; g < kNumPlaneGroups; ++g) {
    const auto group = static_cast<PlaneGroup>(g);
    if (!planes.Has(group)) continue;
    for (int p = 0; p < NumPlanes(group); ++p) {
      fold(planes.First(group) + p, SamplePlanes::Sums(group));
    }
  }
}

}  // namespace lanelight
