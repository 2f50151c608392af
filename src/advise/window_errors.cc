#include "src/advise/window_errors.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "src/prepare/groups.h"
#include "src/prepare/parameters.h"
#include "src/prepare/use_strategy.h"
#include "src/core/clock.h"
#include "src/estimate/estimate.h"

namespace lanelight {
namespace {

constexpr int kSide = 8;
constexpr std::uint64_t kSpp = 128;
// Pilot passes inside a window's run, which a long render has too but hardly notices: so
// many times the window's samples are what they take a share of.
constexpr std::uint64_t kPlannedRuns = 12;
// A run that renders next to nothing: samples per pixel of one window; what its pilot is
// sized for. And what is left of a run's time at least without it.
constexpr std::uint64_t kSetUpSpp = 4, kSetUpPlanned = 64;
constexpr double kLeastShare = 0.25;
// The robust error leaves out this share of the pixels of a round.
constexpr double kTrimmed = 0.02;

// Of the whole process: unlike the wall clock it does not count other programs.
// Means of windows of `size` values each, without values above `limit`.
std::vector<double> WindowMeans(const std::vector<double>& values, std::size_t size,
                                double limit) {
  std::vector<double> means(values.size() / size);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] <= limit) means[i / size] += values[i] / double(size);
  }
  return means;
}

// Enough for an interval, of two windows at least.
std::size_t Batches(std::size_t windows) {
  return std::max<std::size_t>(1, std::min<std::size_t>(windows / 2, 8));
}

void Append(const std::vector<double>& more, std::vector<double>& values) {
  values.insert(values.end(), more.begin(), more.end());
}

double Limit(std::vector<double> values) {
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>((1 - kTrimmed) * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

WindowSequence::WindowSequence(const PixelRect& image)
    : image_(image),
      side_(std::min({kSide, image.width(), image.height()})),
      columns_(image.width() / side_),
      rows_(image.height() / side_) {}

std::vector<PixelRect> WindowSequence::Next(std::size_t count) {
  // 1 / g and 1 / g^2 with g^3 = g + 1.
  constexpr double kX = 0.7548776662466927, kY = 0.5698402909980532;
  std::vector<PixelRect> windows;
  for (std::size_t i = 0; i < count; ++i, ++index_) {
    const double n = static_cast<double>(index_) + 0.5;
    const int column = static_cast<int>(std::fmod(n * kX, 1.0) * columns_);
    const int row = static_cast<int>(std::fmod(n * kY, 1.0) * rows_);
    const int x = image_.x0 + column * side_, y = image_.y0 + row * side_;
    windows.push_back({x, y, x + side_, y + side_});
  }
  return windows;
}

WindowRenderer::WindowRenderer(Job& job, std::vector<Strategy> strategies,
                               const std::atomic<bool>* stop)
    : job_(job),
      strategies_(std::move(strategies)),
      stop_(stop),
      sequence_(job.window),
      seed_(job.seed),
      set_up_(strategies_.size(), INFINITY) {}

FilmAccumulator WindowRenderer::FilmOf(const std::vector<PixelRect>& windows) const {
  const int side = windows.front().width(), count = static_cast<int>(windows.size());
  return FilmAccumulator(0, 0, side * count, side, GroupsOf(job_.scene.strategy),
                         Auxiliary::kNone);
}

double WindowRenderer::RunWindows(const Plan& plan, const std::vector<PixelRect>& windows,
                                  std::uint64_t spp, std::uint64_t planned_samples,
                                  FilmAccumulator& film) {
  RunOptions options;
  options.spp = spp;
  options.seed = seed_;
  options.stop = stop_;
  options.profile = false;
  options.windows = windows;
  options.planned_samples = planned_samples;
  const double start = ProcessCpuSeconds();
  const RunResult run = Run(job_.scene, plan, options, film);
  const double seconds = ProcessCpuSeconds() - start;
  // The share of pilot passes is not the strategy's cost in a long render.
  return run.seconds > 0 ? seconds * (1 - run.pilot_seconds / run.seconds) : seconds;
}

WindowRenderer::Rendered WindowRenderer::Render(std::size_t strategy,
                                                const std::vector<PixelRect>& windows,
                                                std::size_t planned) {
  UseStrategy(strategies_[strategy], job_.scene);
  PlanOptions plan_options = job_.plan.options;
  plan_options.auxiliary = Auxiliary::kNone;
  const Plan plan = MakePlan(job_.scene, plan_options);
  // Nor is what a run takes before its first sample, and with caches that another
  // strategy has filled: on fast scenes that is as much as a window takes, the same for
  // all strategies, and hides what the slow ones cost.
  const std::vector<PixelRect> one = {windows.front()};
  FilmAccumulator next_to_nothing = FilmOf(one);
  const double set_up = RunWindows(plan, one, kSetUpSpp, kSetUpPlanned, next_to_nothing);
  set_up_[strategy] = std::min(set_up_[strategy], set_up);
  FilmAccumulator film = FilmOf(windows);
  const int side = film.height();
  const double whole = RunWindows(
      plan, windows, kSpp,
      kPlannedRuns * kSpp * planned * static_cast<std::uint64_t>(side * side), film);
  Rendered out;
  const double seconds = std::max(whole - set_up_[strategy], kLeastShare * whole);
  out.seconds.assign(windows.size(), seconds / double(windows.size()));
  for (int x = 0; x < film.width(); ++x) {
    for (int y = 0; y < side; ++y) {
      for (int c = 0; c < 3; ++c) {
        out.mean.push_back(film.Mean(x, y)[c]);
        out.variance.push_back(film.Variance(x, y)[c]);
      }
    }
  }
  return out;
}

std::vector<WindowErrors> WindowRenderer::operator()(
    const std::vector<std::size_t>& candidates, std::size_t windows, double& elapsed) {
  const std::vector<PixelRect> rects = sequence_.Next(windows);
  ++seed_;
  std::vector<Rendered> rendered(candidates.size());
  const std::size_t batches = Batches(windows);
  for (std::size_t b = 0; b < batches; ++b) {
    const std::vector<PixelRect> batch(rects.begin() + b * windows / batches,
                                       rects.begin() + (b + 1) * windows / batches);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      Rendered part = Render(candidates[i], batch, windows);
      if (stop_ != nullptr && *stop_) return {};
      Append(part.mean, rendered[i].mean);
      Append(part.variance, rendered[i].variance);
      Append(part.seconds, rendered[i].seconds);
      rendered[i].batch.resize(rendered[i].seconds.size(), b);
    }
  }
  std::vector<double> scale(rendered.front().mean.size());
  for (const Rendered& r : rendered) {
    for (std::size_t i = 0; i < scale.size(); ++i) {
      scale[i] += r.mean[i] / double(rendered.size());
    }
  }
  std::vector<WindowErrors> out;
  for (Rendered& r : rendered) {
    for (std::size_t i = 0; i < scale.size(); ++i) {
      r.variance[i] /= scale[i] * scale[i] + kRelativeEpsilon;
    }
    const std::size_t size = scale.size() / windows;
    out.push_back({WindowMeans(r.variance, size, INFINITY),
                   WindowMeans(r.variance, size, Limit(r.variance)), r.seconds, r.batch});
  }
  const auto now = std::chrono::steady_clock::now();
  elapsed = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  return out;
}

}  // namespace lanelight
