#include "src/render/train/training_pass.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <optional>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/rank_passes.h"
#include "src/render/wave/block_reuse.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/phase_driver.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kSamplesPerTask = 4096;

// Pixels that are chosen together: a block of TilePixels, if there are enough of them.
// With many samples of each, these are traced together already.
std::uint64_t RunLength(std::uint64_t pixels, std::uint32_t spp) {
  return pixels >= 512 && spp < 16 ? 16 : 1;
}

// Measures what light subpaths bring to pixels, as relative variances.
class SubpathMeter {
 public:
  SubpathMeter(const PreparedScene& scene, const PilotImage& image, double scale)
      : window_(RenderedPixels(scene.view->film)),
        full_width_(std::uint32_t(scene.view->film.width)),
        image_(image),
        scale_(scale / 3) {}

  // Adds the splats of a vertex, of which camera paths have the MIS weight `share`.
  void Add(float share, const std::vector<PixelSplat>& splats,
           SubpathVariance& sum) const {
    double pixels = 0, squares = 0;
    std::vector<Square> sums;
    for (const PixelSplat& splat : splats) {
      Square& square = SquareOf(FullPixel(splat), sums);
      for (int c = 0; c < 3; ++c) {
        const double light = double(splat.light[c]);
        pixels += light * light * square.weight[c];
        square.light[c] += light;
      }
    }
    for (const Square& square : sums) {
      for (int c = 0; c < 3; ++c) {
        squares += square.light[c] * square.light[c] * square.weight[c];
      }
    }
    squares /= SubpathVariance::kSide * SubpathVariance::kSide;
    sum.by_pixels += float(pixels * scale_);
    sum.by_squares += float(squares * scale_);
    // Light that camera paths do not find is not compared.
    if (!(share > 0)) return;
    sum.camera_by_pixels += float(pixels * scale_ / double(share));
    sum.camera_by_squares += float(squares * scale_ / double(share));
  }

 private:
  struct Square {
    std::uint32_t place;
    Vec3d weight, light;
  };

  std::uint32_t FullPixel(const PixelSplat& splat) const {
    const auto width = std::uint32_t(window_.width());
    return (std::uint32_t(window_.y0) + splat.pixel / width) * full_width_ +
           std::uint32_t(window_.x0) + splat.pixel % width;
  }
  // Pixels of a square have the same weights (PilotImage).
  Square& SquareOf(std::uint32_t pixel, std::vector<Square>& squares) const {
    constexpr auto kSide = std::uint32_t{SubpathVariance::kSide};
    const std::uint32_t place =
        pixel / full_width_ / kSide * full_width_ + pixel % full_width_ / kSide;
    for (Square& square : squares) {
      if (square.place == place) return square;
    }
    Square& square = squares.emplace_back(Square{place, {}, {}});
    for (int c = 0; c < 3; ++c) square.weight[c] = image_.ErrorWeight(pixel, c);
    return square;
  }

  const PixelRect window_;
  const std::uint32_t full_width_;
  const PilotImage& image_;
  const double scale_;
};

class Pass {
 public:
  Pass(const TrainingPass& pass, const TrainingWork& work)
      : scene_(pass.scene),
        plan_(MakePlan(scene_, pass.options)),
        strategy_(PlannedStrategy(scene_, plan_.options)),
        has_own_sequences_(GroupsOf(strategy_).replicates),
        run_(Parameters(pass)),
        work_(work),
        ranks_(pass.ranks),
        watcher_(ranks_ != nullptr ? &ranks_->watcher() : pass.watcher),
        max_split_(plan_.features.Has(Feature::kSplitting) ? kMaxSplitPaths : 1),
        image_(pass.image) {
    threads_.resize(std::size_t(ThreadSlots()));
    samples_.colors.resize(work.samples());
    samples_.planes = run_.planes.count() - kColorPlanes;
    if (plan_.features.Has(Feature::kLightPaths)) {
      LL_CHECK(samples_.planes == 0 && pass.image != nullptr);
      samples_.planes = kSubpathPlanes;
    }
    samples_.observations = has_own_sequences_ ? kReplicates : work.spp;
    LL_CHECK(work.spp % samples_.observations == 0 && samples_.observations > 1);
    samples_.recorded.resize(work.samples() * std::size_t(samples_.planes));
  }

  TrainingSamples Run() {
    const std::vector<std::size_t> begins = Begins();
    ParallelFor(begins.size() - 1, [&](std::size_t task) {
      if (ranks_ != nullptr && !ranks_->Renders(task)) return;
      RunTask(task, begins[task], begins[task + 1] - begins[task]);
    });
    for (const auto& thread : threads_) {
      if (!thread) continue;
      samples_.rays_closest += thread->wavefront.wave().rays_closest;
      samples_.rays_shadow += thread->wavefront.wave().rays_shadow;
    }
    if (ranks_ != nullptr) ranks_->Exchange(SampleBegins(begins), samples_);
    return std::move(samples_);
  }

 private:
  // First pixels of tasks, and the end.
  std::vector<std::size_t> Begins() const {
    std::vector<std::size_t> begins = {0};
    if (!work_.tiles.empty()) {
      for (const PixelRect& t : work_.tiles) begins.push_back(begins.back() + t.pixels());
      return begins;
    }
    const std::size_t pixels = std::max<std::size_t>(kSamplesPerTask / work_.spp, 1);
    while (begins.back() < work_.pixels.size()) {
      begins.push_back(std::min(begins.back() + pixels, work_.pixels.size()));
    }
    return begins;
  }

  std::vector<std::size_t> SampleBegins(std::vector<std::size_t> begins) const {
    for (std::size_t& begin : begins) begin *= work_.spp;
    return begins;
  }

  RunParameters Parameters(const TrainingPass& pass) const {
    RunParameters run = MakeRunParameters(scene_, plan_);
    run.seed = pass.seed ^ 0x5bd1e995u;  // apart from the image's
    run.tables = pass.tables;
    // Without the strategy's points every sample is independent.
    if (!has_own_sequences_) run.sampler.group_shift = 0;
    return run;
  }

  void RunTask(std::size_t task, std::size_t first, std::size_t pixels) {
    auto& thread = threads_[std::size_t(ThreadIndex())];
    if (!thread) thread = std::make_unique<Thread>(scene_, plan_, run_);
    Wavefront* const wavefront = &thread->wavefront;
    TileWork work;
    work.pixels = work_.pixels.data() + first;
    work.num_pixels = std::uint32_t(pixels);
    work.samples = work_.spp;
    const std::uint32_t count = work.num_pixels * work_.spp, rows = count * max_split_;
    const auto planes = std::size_t(run_.planes.count());
    std::vector<float> values(rows * planes);
    std::optional<BlockReuse> reuse;
    if (plan_.features.Has(Feature::kReuse)) {
      reuse.emplace(plan_, strategy_);
      reuse->Begin(work, wavefront->wave());
    }
    wavefront->wave().Begin(work, {values.data(), rows});
    if (!RunPhase(wavefront->wave(), plan_.paths(), nullptr, watcher_)) return;
    if (reuse) reuse->Connect(work_.tiles[task], wavefront->wave(), nullptr);
    if (thread->light_paths) TraceSubpaths(first, work, *thread);
    if (max_split_ > 1) SumSplitPaths(values.data(), rows, run_.planes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t sample = first * work_.spp + i;
      samples_.colors[sample] = {values[i], values[count + i], values[2 * count + i]};
      for (std::size_t p = kColorPlanes; p < planes; ++p) {
        samples_.recorded[sample * (planes - kColorPlanes) + p - kColorPlanes] =
            values[p * count + i];
      }
    }
  }

  // Memory of a thread.
  struct Thread {
    Thread(const PreparedScene& scene, const Plan& plan, const RunParameters& run)
        : wavefront(scene, plan, run) {
      if (!plan.features.Has(Feature::kLightPaths)) return;
      light_paths.emplace(scene, plan, RenderedPixels(scene.view->film), wavefront);
    }
    Wavefront wavefront;
    std::optional<LightSubpaths> light_paths;
    std::vector<PixelSplat> splats;
  };

  // Traces the subpaths of the pixels of a task.
  void TraceSubpaths(std::size_t first, const TileWork& work, Thread& thread) {
    LightSubpaths& subpaths = *thread.light_paths;
    subpaths.Trace(work, thread.wavefront.wave(), nullptr, thread.splats);
    const std::size_t each = subpaths.PathsOf(0, work.samples);
    const double n = strategy_.light_path_samples, unit = SplatUnit(scene_);
    const SubpathMeter meter(scene_, *image_, n * n * unit * unit / work.samples);
    std::vector<SubpathVariance> sums(work.num_pixels);
    subpaths.ForEachVertex(
        each * work.num_pixels,
        [&](std::size_t path, float share, const std::vector<PixelSplat>& splats) {
          meter.Add(share, splats, sums[path / each]);
        });
    for (std::size_t i = 0; i < sums.size(); ++i) {
      std::memcpy(&samples_.recorded[(first + i) * work_.spp * kSubpathPlanes], &sums[i],
                  sizeof(sums[i]));
    }
  }

  const PreparedScene& scene_;
  const Plan plan_;
  const Strategy strategy_;
  const bool has_own_sequences_;
  const RunParameters run_;
  const TrainingWork& work_;
  RankPasses* const ranks_;
  const TaskWatcher* const watcher_;
  const std::uint32_t max_split_;
  const PilotImage* const image_;
  std::vector<std::unique_ptr<Thread>> threads_;
  TrainingSamples samples_;
};

}  // namespace

TrainingWork MakeTrainingWork(const PreparedScene& scene, std::uint64_t samples,
                              std::uint32_t spp) {
  std::vector<std::uint32_t> all;
  // Blocks of neighbours first, so that an even choice of them is even in both axes.
  TilePixels(RenderedPixels(scene.view->film), scene.view->film.width, &all);
  const std::uint64_t count = std::max<std::uint64_t>(samples / spp, 1);
  if (count >= all.size()) {
    const std::uint64_t more = std::max<std::uint64_t>(samples / all.size(), spp);
    return {std::move(all), {}, std::uint32_t(more)};
  }
  // Whole blocks, if there are enough: rays of neighbours are traced together.
  const std::uint64_t run = RunLength(count, spp), runs = count / run;
  TrainingWork work;
  work.spp = spp;
  std::uint64_t jitter = 0;
  for (std::uint64_t i = 0; i < runs; ++i) {
    // One of each of equal stretches, at a place of its own in each.
    const std::uint64_t begin = i * (all.size() / run) / runs;
    const std::uint64_t end = (i + 1) * (all.size() / run) / runs;
    jitter = jitter * 6364136223846793005u + 1442695040888963407u;
    const std::uint64_t at = (begin + (jitter >> 33) % (end - begin)) * run;
    for (std::uint64_t k = 0; k < run; ++k) work.pixels.push_back(all[at + k]);
  }
  return work;
}

TrainingWork MakeTileWork(const PreparedScene& scene, std::uint64_t samples,
                          std::uint32_t spp) {
  const std::vector<PixelRect> all =
      TilesOf(RenderedPixels(scene.view->film), kReuseTile);
  const std::uint64_t wanted = samples / spp / (kReuseTile * kReuseTile);
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, all.size());
  TrainingWork work;
  work.spp = spp;
  std::uint64_t jitter = 0x9e3779b97f4a7c15u;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * all.size() / count, end = (i + 1) * all.size() / count;
    jitter = jitter * 6364136223846793005u + 1442695040888963407u;
    work.tiles.push_back(all[begin + (jitter >> 33) % (end - begin)]);
    std::vector<std::uint32_t> pixels;
    TilePixels(work.tiles.back(), scene.view->film.width, &pixels);
    work.pixels.insert(work.pixels.end(), pixels.begin(), pixels.end());
  }
  return work;
}

TrainingWork FewOf(const TrainingWork& work) {
  // At least 16 pixels or blocks, if there are as many.
  const std::size_t run = RunLength(work.pixels.size(), work.spp);
  const std::size_t step = std::clamp<std::size_t>(work.pixels.size() / run / 16, 1, 16);
  TrainingWork few;
  few.spp = std::max(work.spp * std::uint32_t(step) / 16, TrainingWork::kMinSpp);
  for (std::size_t i = 0; i < work.pixels.size(); ++i) {
    if (i / run % step == 0) few.pixels.push_back(work.pixels[i]);
  }
  return few;
}

TrainingSamples RunTrainingPass(TrainingPass pass, const TrainingWork& work) {
  pass.options.auxiliary = Auxiliary::kNone;
  if (!pass.options.training) pass.options.training = FeatureSet{};
  return Pass(pass, work).Run();
}

}  // namespace lanelight
