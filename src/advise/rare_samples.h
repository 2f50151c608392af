// Where rare bright samples carry the error, small windows miss them: a few samples of
// every pixel of the image show more of them.
#pragma once

#include <atomic>

#include "src/render/job.h"

namespace lanelight {

/// What renders of the whole image cost and how far they scattered; sums over renders.
struct WholeImage {
  double all = 0;      // mean over pixels of the variance over the squared mean + 0.01
  double trimmed = 0;  // the same without the worst kRareTrimmed of the pixels
  double seconds = 0;  // of processor time, pilot passes left out
};
inline constexpr double kRareTrimmed = 0.001;

/// Renders the image once with kRareSpp independent samples per pixel and adds what it
/// shows. What variances are relative to is the median of the means of a pixel and its
/// neighbours: a bright sample must not be what it is divided by. False: interrupted.
bool AddWholeImage(Job& job, const Strategy& strategy, std::uint64_t seed,
                   const std::atomic<bool>* stop, WholeImage& sum);
inline constexpr std::uint64_t kRareSpp = 4;

/// How many times as efficient `other` is: the smaller one of with and without the worst
/// pixels; 0 if there is nothing to compare.
double RareGain(const WholeImage& baseline, const WholeImage& other);

}  // namespace lanelight
