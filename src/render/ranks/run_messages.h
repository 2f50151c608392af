// What workers are told before a run: which tiles there are, and after the training, in
// which they take part, what has been learned.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

struct RunStart {
  std::vector<PixelRect> tiles;
  bool have_samples = false;           // the run goes on
  std::uint64_t planned_training = 0;  // TrainingOptions::planned_samples; 0: no training
};

struct RunTraining {
  bool trained = false;  // with what follows
  std::string changes;
  std::vector<TrainedTable> tables;
};

/// As bytes, and back with the same bits.
std::string ToBytes(const RunStart& start);
std::string ToBytes(const RunTraining& training);
RunStart RunStartFromBytes(const std::string& bytes);
RunTraining RunTrainingFromBytes(const std::string& bytes);

}  // namespace lanelight
