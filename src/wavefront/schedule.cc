#include "src/prepare/groups.h"
#include "src/wavefront/schedule.h"

#include <algorithm>
#include <cmath>

#include "src/core/check.h"
#include "src/prepare/parameters.h"

namespace lanelight {
namespace {

constexpr double kMostSamples = double(std::uint64_t{1} << 31);
constexpr double kTaskShare = 0.005;  // of the budget

std::uint64_t RoundUp(double samples, std::uint32_t group_size) {
  const double groups = std::ceil(std::min(samples, kMostSamples) / group_size);
  return static_cast<std::uint64_t>(std::max(groups, 1.0)) * group_size;
}

}  // namespace

std::uint32_t FirstGroupSize(const Strategy& strategy) {
  return GroupSize(strategy, strategy.pairs == Pairs::kAntithetic ? 2 : 1);
}

std::uint32_t ChooseGroupSize(const Strategy& strategy, double spp, std::uint64_t done) {
  if (strategy.points == Points::kIndependent) return FirstGroupSize(strategy);
  // GroupSize fits four groups or more into what it is given.
  auto wanted = static_cast<std::uint64_t>(std::clamp(0.6 * spp, 1.0, kMostSamples));
  while (GroupSize(strategy, wanted) <= done) wanted *= 2;
  return GroupSize(strategy, wanted);
}

std::uint64_t FirstLook(std::uint32_t group_size) {
  return RoundUp(std::max(16.0, 4.0 * group_size), group_size);
}

std::uint64_t NextLook(std::uint64_t done, double needed, std::uint32_t group_size) {
  constexpr double kMargin = 1.02;
  const double now = static_cast<double>(done);
  const double next = std::clamp(kMargin * needed, kMargin * now, 2 * now);
  return std::max(RoundUp(next, group_size), done + group_size);
}

std::uint32_t Pace::Whole(double samples) const {
  const double units = std::floor(samples / tasks_.unit);
  const double most = tasks_.most.per_task / tasks_.unit;
  return static_cast<std::uint32_t>(std::clamp(units, 1.0, std::max(1.0, most))) *
         tasks_.unit;
}

Round Pace::Next(double elapsed) const {
  if (speed_ == 0) return {tasks_.unit, 1};
  // Seconds of one sample of all pixels of a tile.
  const double tile = tasks_.threads / (speed_ * double(tasks_.tiles));
  const double most = Reach(elapsed) / 2;
  Round round;
  round.per_task = Whole(std::min(most, kTaskShare * budget_ / tile));
  round.chunks = static_cast<std::uint32_t>(
      std::clamp(most / round.per_task, 1.0, double(tasks_.most.chunks)));
  return round;
}

void Pace::Took(std::uint64_t samples, double seconds) {
  speed_ = double(samples) / std::max(seconds, 1e-6);
}

double Pace::Reach(double elapsed) const {
  return std::max(0.0, speed_ * (budget_ - elapsed));
}

}  // namespace lanelight
