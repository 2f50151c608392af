// When ranks hear of each other while they render.
#pragma once

#include <algorithm>
#include <chrono>

#include "src/base/core/rank_group.h"
#include "src/base/core/stopwatch.h"

namespace lanelight {

/// At most every 100 ms, a few times within what a signal leaves them, and seldom enough
/// to cost nothing; more often towards the end of a round, which no rank is to sleep
/// through. All of them know the same of the samples that are left, so that all of them
/// come at about the same time.
class Listening {
 public:
  std::chrono::duration<double> UntilNext() const {
    return std::chrono::duration<double>(until_next_);
  }
  /// Of all ranks together.
  void Hear(const RankStatus& all) {
    const double seconds = since_.Lap(), taken = left_ - double(all.left);
    left_ = double(all.left);
    const double remaining = taken > 0 ? seconds * left_ / taken : kLongest;
    until_next_ = std::clamp(remaining / 4, kShortest, kLongest);
  }

 private:
  static constexpr double kShortest = 0.002, kLongest = 0.1;  // seconds

  double left_ = 0;
  double until_next_ = kShortest;
  Stopwatch since_;
};

}  // namespace lanelight
