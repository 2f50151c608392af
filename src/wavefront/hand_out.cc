#include "src/wavefront/hand_out.h"

#include <algorithm>

namespace lanelight {
namespace {

constexpr double kWeightOfLast = 0.2;  // in the moving average

}  // namespace

std::vector<TileRange> HandOut::Next(int threads) {
  const std::lock_guard lock(mutex_);
  const std::size_t left = ranges_.size() - next_;
  if (left == 0) return {};
  const auto team = static_cast<std::size_t>(threads);
  std::size_t count = team;
  if (cost_ > 0) {
    const double seconds = cost_ * double(ranges_[next_].samples);
    count =
        team * static_cast<std::size_t>(std::clamp(kBatchSeconds / seconds, 1.0, 1e6));
  }
  // Half of what would be everybody's share of the rest.
  const std::size_t share = left * team / (2 * static_cast<std::size_t>(threads_));
  // Less than one for each of its threads would leave some of them idle.
  count = std::min({count, std::max(share, team), left});
  const auto begin = ranges_.begin() + static_cast<std::ptrdiff_t>(next_);
  next_ += count;
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

std::vector<TileRange> HandOut::NextOne() {
  const std::lock_guard lock(mutex_);
  if (next_ == ranges_.size()) return {};
  return {ranges_[next_++]};
}

double HandOut::LongestSeconds() const {
  std::uint64_t most = 0;
  for (const TileRange& range : ranges_) most = std::max(most, range.samples);
  return cost() * double(most);
}

void HandOut::Took(std::uint64_t samples, double seconds, int threads) {
  if (samples == 0) return;
  const double cost = seconds * threads / double(samples);
  const std::lock_guard lock(mutex_);
  cost_ = cost_ > 0 ? (1 - kWeightOfLast) * cost_ + kWeightOfLast * cost : cost;
}

std::size_t HandOut::left() const {
  const std::lock_guard lock(mutex_);
  return ranges_.size() - next_;
}

double HandOut::cost() const {
  const std::lock_guard lock(mutex_);
  return cost_;
}

}  // namespace lanelight
