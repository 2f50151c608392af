#include "src/prepare/guide_fraction.h"

#include <algorithm>
#include <cstddef>

namespace lanelight {
namespace {

// Records that the cell around counts for.
constexpr double kBorrowed = 8;
// A guide must promise this much less second moment: it takes time.
constexpr double kLeastGain = 0.95;
constexpr double kFractionStep = 0.1;
constexpr double kUntried = 0.5, kUntriedRecords = 16;

}  // namespace

void FractionSums::Add(const GuideRecord& record) {
  const double g = double{record.guide}, p = double{record.material};
  const double mass = record.Mass();
  if (!(g > 0) || !(p > 0)) return;
  for (std::size_t i = 0; i < kFractions; ++i) {
    const double c = kFractionStep * double(i);
    sums_[i] += mass * mass / (c * g + (1 - c) * p);
  }
  const double plain = mass * mass / p;
  squares_ += plain * plain;
}

FractionSums FractionSums::Blend(const FractionSums& around) const {
  if (!(squares_ > 0)) return around;
  const double effective = sums_[0] * sums_[0] / squares_;
  const double share = around.sums_[0] > 0 ? effective / (effective + kBorrowed) : 1;
  FractionSums blend;
  for (std::size_t i = 0; i < kFractions; ++i) {
    blend.sums_[i] = share * sums_[i] / sums_[0] + (1 - share) * around.sums_[i];
  }
  return blend;
}

FractionSums::Choice FractionSums::Best(double effective) const {
  if (!(sums_[0] > 0)) {
    return {kUntried * effective / (effective + kUntriedRecords), 1};
  }
  const auto best = std::min_element(sums_.begin(), sums_.end());
  if (*best > kLeastGain * sums_[0]) return {0, 1};
  return {kFractionStep * double(best - sums_.begin()), *best / sums_[0]};
}

}  // namespace lanelight
