#include "src/vocabulary/path/sample_planes.h"

namespace lanelight {

SamplePlanes::SamplePlanes(const FeatureSet& features) : count_(0) {
  using enum Feature;
#define X(name, planes, needs, ...) FeatureSet needs,
  static constexpr FeatureSet kNeeds[] = {LANELIGHT_SAMPLE_PLANES(X)};
#undef X
  for (int i = 0; i < kNumPlaneGroups; ++i) {
    const bool here = features.HasAll(kNeeds[i]);
    first_[i] = here ? count_ : -1;
    if (here) count_ += NumPlanes(static_cast<PlaneGroup>(i));
  }
}

FeatureSet AuxiliaryFeatures(Auxiliary auxiliary) {
  FeatureSet features;
  if (auxiliary >= Auxiliary::kAov) features.Add(Feature::kAov);
  if (auxiliary >= Auxiliary::kGbuffer) features.Add(Feature::kGbuffer);
  return features;
}

bool SamplePlanes::Sums(PlaneGroup group) {
  constexpr bool kSums[] = {
#define X(name, planes, needs, sums, meaning) sums,
      LANELIGHT_SAMPLE_PLANES(X)
#undef X
  };
  return kSums[static_cast<int>(group)];
}

}  // namespace lanelight
