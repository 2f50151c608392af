// Runs that stop and resume, with their state in memory.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "src/render/wave/run_state.h"
#include "tests/render/run/render_fixture.h"
#include "tests/render/wave/column_copies.h"

namespace lanelight::resume {

inline constexpr int kWidth = 70, kHeight = 37;  // of the image

/// The state that a run leaves.
struct Rest : RunRecord {
  bool is_saved = false;
  std::vector<ColumnCopy> columns;
};

/// Puts the run down once it has been asked so often, and lets it end there or go on.
class InterruptingCheckpointer : public Checkpointer {
 public:
  InterruptingCheckpointer(Rest& rest, int max_calls, bool stops)
      : rest_(rest), limit_(max_calls), stops_(stops) {}

  bool Restore(RunState& state) override {
    if (!rest_.is_saved) return false;
    PutColumns(rest_.columns, state.films);
    static_cast<RunRecord&>(state) = rest_;
    return true;
  }
  bool IsDue() const override { return polls_.fetch_add(1) >= limit_; }
  void Save(RunState& state) override {
    rest_ = {state, true, CopyColumns(state.films)};
    kept_ += 1;
    polls_ = 0;
    if (stops_) stop_ = true;
  }

  const std::atomic<bool>& stop() const { return stop_; }
  int kept() const { return kept_; }

 private:
  Rest& rest_;
  int limit_;
  bool stops_;
  mutable std::atomic<int> polls_{0};
  int kept_ = 0;
  std::atomic<bool> stop_{false};
};

struct Request {
  std::string strategy;
  std::uint64_t spp = 0, seed = 1;
  double target = 0;
  int threads = 2;
  std::uint32_t wavefront = 0;
  Checkpointer* checkpointer = nullptr;
  const std::atomic<bool>* stop = nullptr;
  RankGroup* group = nullptr;  // of which this is a rank
};

/// A small scene: several tiles, whatever their size, and a few that are cut off.
Rendered Render(const Request& request);

/// In all but what clocks say.
bool Same(const RunResult& a, const RunResult& b);

/// Renders from rest to rest until `request` is met. The runs on the way want anything of
/// `ends`; `pauses` counts those that were stopped.
Rendered RenderInParts(const Request& request, const std::vector<Request>& ends,
                       Rest& rest, int& pauses, unsigned seed);

}  // namespace lanelight::resume
