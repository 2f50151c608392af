// The state of a wavefront before and after a stage, for tests that compare them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "src/vocabulary/path/wave.h"

namespace lanelight {

using Words = std::vector<std::uint32_t>;

/// Everything that a stage can change.
struct WaveState {
  Wave wave;
  std::vector<Words> columns, queues;
  std::vector<float> samples;
};

/// Where a path splits, its copies take over all that it has, whatever the columns: what
/// a stage writes into a slot that was free is no access of its own if it is a copy.
class SplitPaths {
 public:
  SplitPaths(const WaveState& before, const WaveState& after)
      : before_(before), after_(after) {
    for (std::uint32_t slot : Free(before)) used_.insert(slot);
    for (std::uint32_t slot : Free(after)) used_.erase(slot);
  }
  /// Returns whether the slot has just been taken and holds in the column what a path of
  /// the same sample had there.
  bool Explain(std::size_t column, std::size_t slot) {
    if (used_.count(static_cast<std::uint32_t>(slot)) == 0) return false;
    if (paths_.empty()) {
      for (std::uint32_t i = 0; i < after_.wave.capacity; ++i) {
        if (used_.count(i) == 0) paths_.emplace(SampleOf(i), i);
      }
    }
    const auto [first, last] = paths_.equal_range(SampleOf(slot));
    return std::any_of(first, last, [&](const auto& path) {
      return before_.columns[column][path.second] == after_.columns[column][slot];
    });
  }

 private:
  static const Words& Free(const WaveState& s) {
    return s.queues[static_cast<std::size_t>(QueueId::kFree)];
  }
  std::pair<std::uint32_t, std::uint32_t> SampleOf(std::size_t slot) const {
    const auto at = [&](Field f) {
      return after_.columns[static_cast<std::size_t>(f)][slot];
    };
    return {at(Field::pixel), at(Field::sample)};
  }

  const WaveState &before_, &after_;
  std::set<std::uint32_t> used_;
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> paths_;
};

}  // namespace lanelight
