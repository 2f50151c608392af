// Chooses the next work of a session: previews while the camera moves, then passes in
// turn.
#include <algorithm>
#include <cmath>

#include "src/base/core/stopwatch.h"
#include "src/measure/live/session.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/train/training.h"
#include "src/scene/description/film.h"

namespace lanelight::live {
namespace {

using Clock = std::chrono::steady_clock;

// Maximum time of a preview, which has to end before the next move of the mouse.
constexpr double kPreviewSeconds = 0.04;
// The first one, of which no rate is known.
constexpr double kFirstPreviewSamples = 16384;
constexpr int kMaxReduction = 16;

// Returns the samples per pixel after the next pass of `seconds`: at most twice as many,
// since rates are uncertain at first.
std::uint64_t NextSpp(const PassRenderer& renderer, double seconds) {
  const std::uint64_t unit = renderer.film().groups().unit, spp = renderer.spp();
  const double step = std::min(renderer.rate() * seconds, std::max(1.0, double(spp)));
  const auto units = static_cast<std::uint64_t>(std::max(1.0, step / double(unit)));
  return spp + units * unit;
}

}  // namespace

int Session::PreviewFactor(const Slot& slot) const {
  const double samples =
      slot.preview_rate > 0 ? slot.preview_rate * kPreviewSeconds : kFirstPreviewSamples;
  const double pixels =
      double(RenderedPixels(live_scene_.job.loaded->description.film).pixels());
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(pixels / samples))), 1,
                    kMaxReduction);
}

std::optional<Work> Session::Next() {
  if (auto preview = NextPreview()) return preview;
  if (paused_ || Clock::now() < settled_) return std::nullopt;
  return NextPass();
}

// If the first pass is as fast as a preview, it replaces the preview. The whole film is
// made later, because that takes longer than a preview.
std::optional<Work> Session::NextPreview() {
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.strategy || slot.previewed) continue;
    if (slot.renderer && slot.renderer->spp() > 0) {
      slot.previewed = true;
      continue;
    }
    const int factor = PreviewFactor(slot);
    const auto reduced = [&](const Strategy& strategy) {
      return std::make_shared<PassRenderer>(
          live_scene_, MakeView(live_scene_, pose_, std::max(2, factor)), strategy);
    };
    if (factor == 1 && !slot.renderer) slot.renderer = Make(i);
    auto preview = factor == 1 ? slot.renderer : reduced(*slot.strategy);
    // Training would take too long for a preview.
    if (NeedsTraining(preview->plan())) preview = reduced(Strategy{});
    const std::uint64_t unit = preview->film().groups().unit;
    return Work{std::move(preview), unit, i, true};
  }
  return std::nullopt;
}

std::optional<Work> Session::NextPass() {
  const auto cost = [&](const PassRenderer& c) {
    return pace_ == Pace::kTime ? c.cpu_seconds() : double(c.spp());
  };
  std::optional<Work> work;
  double other_spp = 0;
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.strategy) continue;
    if (!slot.renderer) slot.renderer = Make(i);
    other_spp = std::max(other_spp, double(slot.renderer->spp()));
    if (work && cost(*work->renderer) <= cost(*slot.renderer)) continue;
    work = Work{slot.renderer, 0, i, false};
  }
  if (!work) return work;
  const double elapsed = SecondsSince(began_);
  work->spp = NextSpp(*work->renderer, std::clamp(elapsed / 4, 0.2, 2.0));
  const auto max_spp = static_cast<std::uint64_t>(other_spp);
  if (pace_ == Pace::kSamples && work->renderer->spp() < max_spp) {
    work->spp = std::min(work->spp, max_spp);
  }
  if (work->spp > kMaxSamplesPerPixel) return std::nullopt;
  return work;
}

void Session::FinishWork(const Work& work, bool stopped) {
  if (!work.preview || stopped) return;
  Slot& slot = slots_[static_cast<std::size_t>(work.slot)];
  slot.previewed = true;
  const double pixels = double(work.renderer->view().window.pixels());
  if (work.renderer->rate() > 0) slot.preview_rate = work.renderer->rate() * pixels;
  SendPreview(work);
}

}  // namespace lanelight::live
