// How often ranks exchange their status while they render.
#pragma once

#include <algorithm>
#include <chrono>

#include "src/base/core/rank_group.h"
#include "src/base/core/stopwatch.h"

namespace lanelight {

/// At most 100 ms: a fraction of the time that a signal leaves to a rank, and long enough
/// to cost nothing. Shorter towards the end of a round, so that no rank sleeps through
/// it. All ranks compute the interval from the same sums, so they meet at about the same
/// time.
class PollInterval {
 public:
  std::chrono::duration<double> UntilNext() const {
    return std::chrono::duration<double>(until_next_);
  }
  /// Takes the sum of the status of all ranks.
  void Update(const RankStatus& all) {
    const double seconds = since_.Lap(), taken = left_ - double(all.left);
    left_ = double(all.left);
    const double remaining = taken > 0 ? seconds * left_ / taken : kLongest;
    until_next_ = std::clamp(remaining / 4, kShortest, kLongest);
  }

 private:
  static constexpr double kShortest = 0.002, kLongest = 0.1;  // seconds

  double left_ = 0;  // samples
  double until_next_ = kShortest;
  Stopwatch since_;
};

}  // namespace lanelight
