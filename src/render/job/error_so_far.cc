#include "src/render/job/error_so_far.h"

#include <algorithm>
#include <cmath>

#include "src/render/films/accumulator.h"

namespace lanelight {
void ErrorSoFar::Listen(std::uint64_t pixels, RunOptions& options) {
  if (!options.samples_needed) {
    options.on_film = [this, pixels](const FilmAccumulator& film) {
      if (SampledPixels(film) < pixels) return;
      Set(EstimateError(film), TotalSamples(film), 0);
    };
    return;
  }
  options.samples_needed = [this, pixels](const FilmAccumulator& film,
                                          std::uint64_t done) {
    const ErrorEstimate error = EstimateError(film);
    const double needed = SamplesNeeded(target_, error, done);
    Set(error, double(done) * double(pixels), needed * double(pixels));
    return needed;
  };
}

void ErrorSoFar::Set(const ErrorEstimate& error, double samples, double needed) {
  const std::lock_guard lock(mutex_);
  error_ = error;
  samples_ = samples;
  needed_ = needed;
}

RenderProgress ErrorSoFar::At(const Progress& progress) const {
  RenderProgress all;
  static_cast<Progress&>(all) = progress;
  const std::lock_guard lock(mutex_);
  all.error = error_;
  if (all.error && samples_ > 0 && double(progress.samples) > samples_) {
    Interval& relmse = all.error->relmse;
    const double part = samples_ / double(progress.samples);
    for (double* end : {&relmse.value, &relmse.low, &relmse.high}) *end *= part;
  }
  if (needed_ > 0 && std::isfinite(needed_) && progress.samples > 0) {
    const double times = needed_ / double(progress.samples);
    all.target_seconds = std::max(0.0, (times - 1) * progress.seconds);
  }
  return all;
}

}  // namespace lanelight
