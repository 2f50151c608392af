// What the leader of a crew tells the others before a run: which tiles there are, and
// what a run that is gone on with has learned.
#pragma once

#include <string>
#include <vector>

#include "src/image/pixel_rect.h"
#include "src/wavefront/run_state.h"

namespace lanelight {

struct CrewStart {
  std::vector<PixelRect> tiles;
  std::uint64_t planned_samples = 0;  // that pilot passes are sized for
  bool restored = false;              // nobody trains; else every rank does
  bool trained = false;               // before: this is what came out
  std::string changes;
  std::vector<TrainedTable> tables;
};

/// As bytes, and back.
std::string ToBytes(const CrewStart& start);
CrewStart CrewStartFromBytes(const std::string& bytes);

/// A short text that is the same where the same has been learned, bit by bit.
std::string Fingerprint(const TrainingOutcome& training,
                        const std::vector<TrainedTable>& tables);

}  // namespace lanelight
