// The planes of a finished sample: what the kernels hand on to the films.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/features.h"

namespace lanelight {

/// Vertices of a path that a training pass records.
inline constexpr int kRecordedVertices = 4;

// X(name, planes, features of which all are needed, sums over copies, meaning). Without
// the last but one, a sample whose path has split keeps what its first copy brings.
// clang-format off
#define LANELIGHT_SAMPLE_PLANES(X)                                                        \
  X(Color, 3, ({}), true, "radiance, red, green, blue")                                   \
  X(Aov, 7, ({kAov}), false, "of the first hit: albedo, shading normal, depth")           \
  X(Gbuffer, 14, ({kGbuffer}), false, "of the first hit: whether there is one, point, geometric normal, shading normal, u, v, dz/dx, dz/dy") \
  X(Radiance, 3, ({kSpectralFilm}), true, "before the film makes a colour of it: at the long, the middle and the short wavelength of the path, weighed") \
  X(Triple, 1, ({kSpectralFilm}), false, "of bins that these wavelengths are of") \
  X(Numbers, 4, ({kRegressionControl}), false, "that drove a path (dimensions.h): position in the pixel, first scattered direction, its light sample, choices of lobes") \
  X(Record, 3 * kRecordedVertices + 5, ({kRecordsPaths}), false, "cell, throughput, gathered of each vertex; gathered at the end; depth; the three sums of the risk") \
  X(SinglePath, 2, ({kRecordsSinglePaths}), true, "brightness gathered; what its square would be with roulette on the throughput instead of splitting") \
  X(Weight, 1, ({kReuse}), false, "weight of the sample, which its colour does not have in it until its block has been connected")
// clang-format on

enum class PlaneGroup : std::uint8_t {
#define X(name, ...) k##name,
  LANELIGHT_SAMPLE_PLANES(X)
#undef X
      kCount
};
inline constexpr int kNumPlaneGroups = static_cast<int>(PlaneGroup::kCount);

/// Planes of a group.
constexpr int NumPlanes(PlaneGroup group) {
  constexpr int kPlanes[] = {
#define X(name, planes, ...) planes,
      LANELIGHT_SAMPLE_PLANES(X)
#undef X
  };
  return kPlanes[static_cast<int>(group)];
}
inline constexpr int kColorPlanes = NumPlanes(PlaneGroup::kColor);
inline constexpr int kAovPlanes = NumPlanes(PlaneGroup::kAov);
inline constexpr int kGbufferPlanes = NumPlanes(PlaneGroup::kGbuffer);

/// Auxiliary output of first hits: none; albedo, shading normal and depth (--aov); these
/// and their positions (--gbuffer).
enum class Auxiliary : std::uint8_t { kNone, kAov, kGbuffer };

/// The features that such a render has.
FeatureSet AuxiliaryFeatures(Auxiliary auxiliary);

/// Which planes a render has, one group after the other in the order of the list.
class SamplePlanes {
 public:
  SamplePlanes() = default;
  explicit SamplePlanes(const FeatureSet& features);

  bool Has(PlaneGroup group) const { return first_[static_cast<int>(group)] >= 0; }
  /// The group's first plane; -1 if there is none.
  int First(PlaneGroup group) const { return first_[static_cast<int>(group)]; }
  int count() const { return count_; }
  /// The copies of a path that has split are added up; else the first one counts.
  static bool Sums(PlaneGroup group);

 private:
  int first_[kNumPlaneGroups] = {0, -1, -1, -1, -1, -1, -1, -1, -1};
  int count_ = kColorPlanes;
};

}  // namespace lanelight
