// What workers are told before a run: which tiles there are, and what has been learned.
#pragma once

#include <string>
#include <vector>

#include "src/image/pixel_rect.h"
#include "src/wave/run_state.h"

namespace lanelight {

struct RunStart {
  std::vector<PixelRect> tiles;
  bool have_samples = false;  // the run goes on
  bool trained = false;       // with what follows
  std::string changes;
  std::vector<TrainedTable> tables;
};

/// As bytes, and back with the same bits.
std::string ToBytes(const RunStart& start);
RunStart RunStartFromBytes(const std::string& bytes);

}  // namespace lanelight
