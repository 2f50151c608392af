// How many samples a time budget is enough for, before the render has begun.
#pragma once

#include <cstdint>

#include "src/render/train/training_pass.h"

namespace lanelight {

/// By the speed of a few thousand samples with roulette on the throughput, in this
/// process; rounded down to a power of two, so that runs on one machine mostly agree. At
/// least 1. It takes about 20 ms.
std::uint64_t SamplesWithin(double seconds, TrainingPass pass);

}  // namespace lanelight
