// Prints the best of LANELIGHT_ALL_TARGETS (best first) that this machine runs, as
// Highway's run-time dispatch finds it; nothing if it runs none (cmake/targets.cmake).
#include <cstdio>
#include <cstring>

#include "hwy/targets.h"

#define LANELIGHT_TEXT(...) #__VA_ARGS__
#define LANELIGHT_NAMES(...) LANELIGHT_TEXT(__VA_ARGS__)

int main() {
  // Bits of better targets are lower.
  for (int bit = 0; bit < 63; ++bit) {
    const auto target = hwy::SupportedTargets() & (std::int64_t{1} << bit);
    if (target == 0) continue;
    const char* name = hwy::TargetName(target);
    const char* found = std::strstr("," LANELIGHT_NAMES(LANELIGHT_ALL_TARGETS) ",", name);
    // Whole names only: AVX3 is a part of AVX3_DL.
    if (found != nullptr && found[-1] == ',' && found[std::strlen(name)] == ',') {
      std::puts(name);
      return 0;
    }
  }
}
