#include "src/measure/live/pass_renderer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/stopwatch.h"
#include "src/render/run/run.h"
#include "src/render/wave/profile.h"
#include "src/render/wave/tiles.h"
#include "src/scene/compiled/view.h"

namespace lanelight::live {
namespace {

// Errors are estimated when there are this many times the samples of the last time, and
// from so many on: with fewer there is seldom an interval, and to say how many more it
// would take costs several times as much as the estimate.
constexpr double kEstimateSampleRatio = 1.3;
constexpr std::uint64_t kFirstEstimateSpp = 8;
// Nothing can be done meanwhile: of images with more pixels than these, only when an
// estimate is this small a part of the time since the last one.
constexpr std::uint64_t kQuickPixels = 1u << 16;
constexpr double kMaxEstimateFraction = 0.1;

bool HasControl(const Plan& plan) {
  return SamplePlanes(plan.features).Has(PlaneGroup::kNumbers);
}

Job JobOf(const LiveScene& live_scene, const View& view, const Strategy& strategy) {
  Job job = live_scene.job;
  job.scene.view = std::make_shared<const CompiledView>(view);
  job.window = view.window;
  return WithStrategy(std::move(job), strategy);
}

}  // namespace

// Goes on from what the renderer has, and keeps what the pass comes to.
class PassRenderer::PassCheckpointer : public Checkpointer {
 public:
  PassCheckpointer(PassRenderer& renderer, FilmAccumulator* before,
                   PassObserver& observer)
      : renderer_(renderer), before_(before), observer_(observer) {}

  bool Restore(RunState& state) override {
    if (renderer_.record_.counts.samples == 0) return false;
    if (before_ != nullptr) CopyFilm(state.films);
    static_cast<RunRecord&>(state) = renderer_.record_;
    return true;
  }
  bool IsDue() const override { return observer_.IsDue(); }
  void Save(RunState& state) override {
    renderer_.record_ = std::move(static_cast<RunRecord&>(state));
    const Stopwatch watch;
    observer_.Observe();
    renderer_.observed_seconds_ += watch.CpuSeconds();
  }

 private:
  void CopyFilm(Films& films) {
    const auto from = before_->Columns(), to = films.Columns();
    LL_CHECK_EQ(from.size(), to.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      std::memcpy(to[i].data, from[i].data, from[i].Bytes());
    }
    films.film().AddShared(*before_);
  }

  PassRenderer& renderer_;
  FilmAccumulator* before_;  // null: the pass goes on with the film itself
  PassObserver& observer_;
};

PassRenderer::PassRenderer(const LiveScene& live_scene, View view,
                           const Strategy& strategy)
    : view_(std::move(view)),
      job_(JobOf(live_scene, view_, strategy)),
      film_(MakeFilm(job_)),
      has_control_(HasControl(job_.plan)),
      cost_(view_.film.width, view_.film.height) {}

void PassRenderer::Pass(std::uint64_t spp, PassObserver& observer,
                        const std::atomic<bool>& stop) {
  const bool resumes = record_.counts.samples > 0;
  std::optional<FilmAccumulator> before;
  if (has_control_ && resumes) {
    before = std::move(film_);
    film_ = MakeFilm(job_);
  }
  PassCheckpointer checkpointer(*this, before ? &*before : nullptr, observer);
  RunOptions options;
  options.spp = spp;
  options.seed = job_.seed;
  options.threads = job_.settings.threads;
  options.stop = &stop;
  options.checkpointer = &checkpointer;
  options.on_task = [this](const PixelRect& tile, const RunCounts& counts) {
    cost_.Add(tile, counts);
  };
  // Tasks of a pass of few samples are as large as those of a short render.
  options.tiles = MakePartition(view_.window, spp - spp_, strategy()).tiles;
  const double seconds_before = record_.counts.seconds;
  const std::uint64_t samples_before = record_.counts.samples;
  const RunResult result = Run(job_.scene, job_.plan, options, film_);
  record_.training.note = result.training.note;
  AddStages(result.stages, stages_);
  AddStages(result.parts, stages_);
  const double samples = double(record_.counts.samples - samples_before);
  const double seconds = record_.counts.seconds - seconds_before;
  if (samples > 0 && seconds > 0)
    rate_ = samples / double(view_.window.pixels()) / seconds;
  if (result.stop_reason != StopReason::kSamples) return;
  spp_ = spp;
  EstimateIfDue(stop);
}

void PassRenderer::Fit() {
  if (has_control_ && record_.counts.samples > 0) film_.FitControl();
}

void PassRenderer::EstimateIfDue(const std::atomic<bool>& stop) {
  if (spp_ < kFirstEstimateSpp) return;
  if (!snapshots_.empty()) {
    const EstimateSnapshot& last = snapshots_.back();
    if (double(spp_) < kEstimateSampleRatio * double(last.spp)) return;
    const double since = cpu_seconds() - last.seconds;
    if (view_.window.pixels() > kQuickPixels &&
        since * kMaxEstimateFraction < estimate_seconds_)
      return;
  }
  const Stopwatch watch;
  ErrorEstimate error = EstimateError(film_, &stop);
  estimate_seconds_ = watch.CpuSeconds();
  if (error.available) snapshots_.push_back({spp_, cpu_seconds(), std::move(error)});
}

std::size_t PassRenderer::Bytes() const {
  return view_.window.pixels() *
         FilmAccumulator::BytesPerPixel(film_.groups(), Auxiliary::kNone);
}

namespace {

int Cells(int pixels) { return (pixels + CostMap::kCell - 1) / CostMap::kCell; }

}  // namespace

CostMap::CostMap(int width, int height)
    : columns_(Cells(width)),
      cells_(static_cast<std::size_t>(columns_) *
             static_cast<std::size_t>(Cells(height))) {}

void CostMap::Add(const PixelRect& tile, const RunCounts& counts) {
  const double pixels = double(tile.pixels());
  for (int y = tile.y0 / kCell; y < Cells(tile.y1); ++y) {
    for (int x = tile.x0 / kCell; x < Cells(tile.x1); ++x) {
      const int w = std::min(tile.x1, (x + 1) * kCell) - std::max(tile.x0, x * kCell);
      const int h = std::min(tile.y1, (y + 1) * kCell) - std::max(tile.y0, y * kCell);
      const double fraction = double(w) * h / pixels;
      Cell& cell =
          cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(x)];
      cell.samples += fraction * double(counts.samples);
      cell.closest += fraction * double(counts.rays_closest);
      cell.shadow += fraction * double(counts.rays_shadow);
    }
  }
}

const CostMap::Cell& CostMap::At(int x, int y) const {
  return cells_[static_cast<std::size_t>(y / kCell) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(x / kCell)];
}

double CostMap::RaysPerSample(int x, int y) const {
  const Cell& cell = At(x, y);
  return cell.samples > 0 ? (cell.closest + cell.shadow) / cell.samples : 0;
}

double CostMap::SegmentsPerSample(int x, int y) const {
  const Cell& cell = At(x, y);
  return cell.samples > 0 ? cell.closest / cell.samples : 0;
}

}  // namespace lanelight::live
