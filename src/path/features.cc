#include "src/path/features.h"

namespace lanelight {

const char* FeatureName(Feature f) {
  static constexpr const char* kNames[] = {
#define X(name, meaning) #name,
      LANELIGHT_FEATURES(X)
#undef X
  };
  return kNames[static_cast<int>(f)] + 1;
}

const char* FeatureMeaning(Feature f) {
  static constexpr const char* kMeanings[] = {
#define X(name, meaning) meaning,
      LANELIGHT_FEATURES(X)
#undef X
  };
  return kMeanings[static_cast<int>(f)];
}

}  // namespace lanelight
