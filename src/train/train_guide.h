// How training passes of a guide draw their numbers.
#pragma once

#include <cstdint>

namespace lanelight {

/// RunParameters::seed for pass 1, 2, ... of the training of a run with this seed: apart
/// from the image's, from that of other trainings, and from each other.
constexpr std::uint32_t GuidePassSeed(std::uint32_t seed, std::uint32_t pass) {
  return seed ^ (0x6a09e667u + pass * 0x9e3779b9u);
}

}  // namespace lanelight
