#include "src/render/wave/task_runner.h"

#include <algorithm>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/render/wave/phase_driver.h"
#include "src/render/wave/profile.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

Workspace::Workspace(const PreparedScene& scene, const Plan& plan,
                     const RunParameters& run, const RunOptions& options,
                     const PixelRect& window)
    : wavefront(scene, plan, run) {
  if (options.profile) clock.emplace(plan.rows(), options.profiling);
  if (plan.features.Has(Feature::kReuse)) {
    reuse.emplace(plan, PlannedStrategy(scene, plan.options));
  }
  if (plan.features.Has(Feature::kLightPaths)) {
    light_paths.emplace(scene, plan, window, wavefront);
  }
  if (plan.features.Has(Feature::kSharedPixelSamples)) {
    sharing.emplace(scene.compiled->filter);
  }
  if (plan.Find(PhaseId::kVisibleLights) != nullptr) {
    visible_lights.emplace(scene, plan, run, wavefront);
  }
}

std::uint32_t SamplesTogether(const PreparedScene& scene, const Plan& plan) {
  constexpr std::uint32_t kMaxTogether = 16;
  const std::uint32_t together = std::min(kMaxTogether, plan.wavefront);
  return scene.strategy.pairs == Pairs::kAntithetic ? together & ~1u : together;
}

TaskRunner::TaskRunner(const PreparedScene& scene, const Plan& plan,
                       const RunParameters& run, const RunOptions& options,
                       const PixelRect& window)
    : scene_(scene),
      plan_(plan),
      run_(run),
      options_(options),
      window_(window),
      workspaces_(static_cast<std::size_t>(ThreadSlots())) {}

void TaskRunner::Begin(std::size_t tiles) {
  if (plan_.Find(PhaseId::kVisibleLights) == nullptr) return;
  visible_lights_ = std::make_unique<VisibleLightEdges>(scene_, tiles);
}

void TaskRunner::FindVisibleLights(std::size_t tile, const PixelRect& rect) {
  Workspace& space = ThreadWorkspace();
  visible_lights_->Find(tile, rect, *space.visible_lights, space.Clock());
}

Workspace& TaskRunner::ThreadWorkspace() {
  const std::size_t thread = std::size_t(ThreadIndex());
  LL_CHECK_LT(thread, workspaces_.size());
  if (!workspaces_[thread]) {
    workspaces_[thread] =
        std::make_unique<Workspace>(scene_, plan_, run_, options_, window_);
  }
  return *workspaces_[thread];
}

TileWork TaskRunner::SetUp(const SampleRange& range, const PixelRect& rect,
                           Workspace& space) const {
  TilePixels(rect, scene_.view->film.width, &space.pixels);
  TileWork work;
  work.pixels = space.pixels.data();
  work.num_pixels = std::uint32_t(space.pixels.size());
  work.first_sample = std::uint32_t(range.first % kSamplesPerSeed);
  work.samples = range.count;
  work.together = SamplesTogether(scene_, plan_);
  if (space.sharing) {
    space.filter_places.resize(std::size_t{2} * range.count);
    work.tile_pixel = space.pixels.front();
    work.filter_places = space.filter_places.data();
  }
  Wave& wave = space.wavefront.wave();
  wave.rays_closest = wave.rays_shadow = 0;
  wave.health = {};
  return work;
}

SampleBuffer TaskRunner::Buffer(const TileWork& work, TaskSamples& out) const {
  const bool splits = plan_.features.Has(Feature::kSplitting);
  const std::uint32_t rows =
      work.num_pixels * work.samples * (splits ? kMaxSplitPaths : 1);
  const std::size_t size = std::size_t{rows} * std::size_t(run_.planes.count());
  if (out.values.size() < size) out.values.resize(size);
  // A sample that has not split leaves the rows of its further copies alone.
  if (splits) std::fill_n(out.values.begin(), size, 0.0f);
  return {out.values.data(), rows};
}

bool TaskRunner::Run(const SampleRange& range, const PixelRect& rect,
                     const TaskWatcher& watcher, TaskSamples& out) {
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  const TileWork work = SetUp(range, rect, space);
  const SampleBuffer buffer = Buffer(work, out);
  if (space.reuse) space.reuse->Begin(work, space.wavefront.wave());
  LL_CHECK_LE(work.together, plan_.wavefront);  // they are generated at once, or never
  space.wavefront.wave().Begin(work, buffer);
  if (clock) {
    clock->FinishPart(TaskPart::kSetUp, std::uint64_t{work.num_pixels} * work.samples);
  }
  const bool ended = RunPhase(space.wavefront.wave(), plan_.paths(), clock, &watcher);
  out.count = ended ? range.count : 0;
  if (ended) {
    const std::uint32_t stride = work.num_pixels * work.samples;
    if (space.reuse) space.reuse->Connect(rect, space.wavefront.wave(), clock);
    if (space.light_paths) {
      space.light_paths->Trace(work, space.wavefront.wave(), clock, out.splats);
      out.light_paths = work.num_pixels * std::uint64_t{space.light_paths->PathsOf(
                                              work.first_sample, work.samples)};
    }
    const Wave& wave = space.wavefront.wave();
    out.counts = {stride, wave.rays_closest, wave.rays_shadow, wave.health};
    if (plan_.features.Has(Feature::kSplitting)) {
      SumSplitPaths(out.values.data(), buffer.stride, run_.planes);
      if (clock) clock->FinishPart(TaskPart::kCopies, stride);
    }
    ShareSamples(range, rect, out, space);
  }
  if (clock) out.cpu_seconds = clock->EndTask();
  return ended;
}

// Light that the camera sees at the edges of lamps has samples of its own, which are
// shared by themselves.
void TaskRunner::ShareSamples(const SampleRange& range, const PixelRect& rect,
                              TaskSamples& out, Workspace& space) const {
  const std::size_t stride = space.pixels.size() * range.count;
  const TilePlanes planes = {rect, space.pixels, range.count, out.values.data(), stride};
  const VisibleLightTask seen = {range.tile, planes, range.first % kSamplesPerSeed};
  StageClock* const clock = space.Clock();
  bool corrected = false;
  if (visible_lights_) {
    visible_lights_->Find(range.tile, rect, *space.visible_lights, clock);
    corrected = visible_lights_->RemoveOwn(seen, *space.visible_lights, clock);
    if (clock && corrected) clock->FinishPart(TaskPart::kVisibleLights, stride);
  }
  if (space.sharing) {
    space.sharing->Share(planes, space.filter_places.data());
    if (clock) clock->FinishPart(TaskPart::kSharing, stride);
  }
  if (!corrected) return;
  SampleSharing* const sharing = space.sharing ? &*space.sharing : nullptr;
  visible_lights_->AddOthers(seen, sharing, *space.visible_lights, clock);
  out.counts.rays_closest += visible_lights_->RaysOf(range.tile, range.count);
  if (clock) clock->FinishPart(TaskPart::kVisibleLights, stride);
}

void TaskRunner::Merge(const PixelRect& place, TaskSamples& samples, Films& films) {
  // Row length behind the indices of the film's pixels.
  const int width = options_.windows.empty()
                        ? scene_.view->film.width
                        : place.width() * int(options_.windows.size());
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  TilePixels(place, width, &space.pixels);
  films.Add({place, space.pixels, width, samples.values.data(), samples.count,
             &samples.splats, samples.light_paths});
  if (!clock) return;
  clock->FinishPart(TaskPart::kFilm, space.pixels.size() * samples.count);
  clock->EndTask();
}

void TaskRunner::AddCounts(RunResult& result) {
  for (const auto& space : workspaces_) {
    if (!space) continue;
    lanelight::AddCounts(space->wavefront, space->Clock(), plan_.options.target.lanes(),
                         result);
  }
}

}  // namespace lanelight
