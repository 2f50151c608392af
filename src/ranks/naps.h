// Naps between looks at the mail: nobody waits in MPI, so that a rank that waits leaves
// its core to others.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace lanelight {

/// Longer while nothing comes.
class Naps {
 public:
  /// `moved`: something has come, and more may follow soon.
  void Take(bool moved) {
    if (moved) {
      nap_ = kShortest;
      return;
    }
    std::this_thread::sleep_for(nap_);
    nap_ = std::min<std::chrono::microseconds>(2 * nap_, kLongest);
  }

 private:
  static constexpr auto kShortest = std::chrono::microseconds(50);
  static constexpr auto kLongest = std::chrono::microseconds(2000);
  std::chrono::microseconds nap_ = kShortest;
};

}  // namespace lanelight
