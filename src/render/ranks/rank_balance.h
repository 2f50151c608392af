// Balances ranks while they render. Tiles cost unknown times, and cores have unknown
// speeds, so each rank compares itself in turn with its neighbours in a hypercube; the
// one that would end later hands over so much that both end together (dimension exchange:
// Cybenko 1989, "Dynamic load balancing for distributed memory multiprocessors"). What a
// rank sends does not grow with the number of ranks.
#pragma once

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>

#include "src/base/core/rank_group.h"
#include "src/base/core/stopwatch.h"

namespace lanelight {

struct RankLoad {
  std::uint64_t left = 0;  // samples of the round
  double speed = 0;        // samples a second so far; 0: not known
};

/// Returns the rank that `rank` compares itself with in this turn, or -1. Symmetric.
inline int BalancePartner(int rank, int ranks, std::uint64_t round) {
  const auto dimensions = std::bit_width(static_cast<unsigned>(std::max(ranks - 1, 1)));
  const int partner = rank ^ (1 << (round % static_cast<unsigned>(dimensions)));
  return partner < ranks ? partner : -1;
}

/// Balances that gain less time than this are not worth a message.
inline constexpr double kMinSecondsGained = 0.005;
/// Returns the samples that the first rank hands to the second so that both end together;
/// 0 if the second would end later, or if too little time is won.
inline std::uint64_t SamplesToTransfer(const RankLoad& from, const RankLoad& to) {
  if (from.speed <= 0) return 0;
  // A rank that has not ended a task yet, since it had none, is taken to be as fast.
  const double speed = to.speed > 0 ? to.speed : from.speed;
  const double excess =
      (double(from.left) * speed - double(to.left) * from.speed) / (from.speed + speed);
  return excess > kMinSecondsGained * from.speed ? std::uint64_t(excess) : 0;
}

/// The interval at which ranks exchange their status. At most 100 ms, a fraction of the
/// time that a signal leaves to a rank; shorter towards the end of a round. All ranks
/// compute it from the same sums, so they meet at about the same time.
class PollInterval {
 public:
  std::chrono::duration<double> TimeUntilNext() const {
    return std::chrono::duration<double>(until_next_);
  }
  /// Takes the sum of the status of all ranks.
  void Update(const RankStatus& all) {
    const double seconds = since_.Lap(), rendered = left_ - double(all.left);
    left_ = double(all.left);
    const double remaining = rendered > 0 ? seconds * left_ / rendered : kLongest;
    until_next_ = std::clamp(remaining / 4, kShortest, kLongest);
  }

 private:
  static constexpr double kShortest = 0.002, kLongest = 0.1;  // seconds

  double left_ = 0;  // samples
  double until_next_ = kShortest;
  Stopwatch since_;
};

}  // namespace lanelight
