// The constants of a render that kernels read, and the planes of a finished sample, which
// the kernels write and the films read.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/dimensions.h"
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
  X(Gbuffer, 14, ({kGbuffer}), false, "of the first hit: 1 if there is one, point, geometric normal, shading normal, u, v, dz/dx, dz/dy") \
  X(Radiance, 3, ({kSpectralFilm}), true, "weighted radiance at the long, middle and short wavelength of the path, before the film converts it to a colour") \
  X(Triple, 1, ({kSpectralFilm}), false, "index of the wavelength bins of the path") \
  X(Numbers, 4, ({kRegressionControl}), false, "random numbers of a path (dimensions.h): position in the pixel, first scattered direction, its light sample, choices of lobes") \
  X(Record, 5 * kRecordedVertices + 1, ({kRecordsPaths}), false, "of each vertex: cell, throughput, radiance gathered, light sampled, radiance that it adds; then radiance at the end") \
  X(SinglePath, 2, ({kRecordsSinglePaths}), true, "brightness gathered; its square as if roulette on the throughput had replaced splitting") \
  X(Weight, 1, ({kReuse}), false, "weight of the sample; applied to its colour once its block has been connected")
// clang-format on

enum class PlaneGroup : std::uint8_t {
#define X(name, ...) k##name,
  LANELIGHT_SAMPLE_PLANES(X)
#undef X
      kCount
};
inline constexpr int kNumPlaneGroups = static_cast<int>(PlaneGroup::kCount);

/// Returns the number of planes of a group.
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

/// Returns the features of a render with such output.
FeatureSet AuxiliaryFeatures(Auxiliary auxiliary);

/// The planes of a render, one group after the other in the order of the list.
class SamplePlanes {
 public:
  SamplePlanes() = default;
  explicit SamplePlanes(const FeatureSet& features);

  bool Has(PlaneGroup group) const { return first_[static_cast<int>(group)] >= 0; }
  /// Returns the group's first plane; -1 if there is none.
  int First(PlaneGroup group) const { return first_[static_cast<int>(group)]; }
  int count() const { return count_; }
  /// Returns whether the copies of a split path are added up; otherwise the first one
  /// counts.
  static bool Sums(PlaneGroup group);

 private:
  int first_[kNumPlaneGroups] = {0, -1, -1, -1, -1, -1, -1, -1, -1};
  int count_ = kColorPlanes;
};

/// Sample points: a randomisation is a sequence of 2^group_shift points, which samples of
/// a pixel share as src/vocabulary/path/replicates.h says.
struct SamplerParameters {
  std::uint32_t group_shift = 0;
  bool by_tile = false;  // pixels of a tile share their wavelengths
};

/// Weight of a technique of density p against one of density q, with r = q / p:
///   1 / (1 + r (square r + linear)),
/// power heuristic (1, 0), balance heuristic (0, 1). directions=light has (0, 0): light
/// samples count in full, and `hits`, a factor on light that scattered rays hit, is 0.
struct MisParameters {
  float square = 1, linear = 0, hits = 1;
};

/// Copies that one camera sample may become, itself included. Every sample has as many
/// rows in the sample buffer.
inline constexpr std::uint32_t kMaxSplitPaths = 8;

/// First scattering event after which roulette=throughput is played, by default.
inline constexpr std::int32_t kThroughputFirst = 2;

struct RouletteParameters {
  float termination = 0;    // constant: probability of ending
  float floor = 0;          // throughput, luminance: least survival probability
  std::uint32_t first = 2;  // scattering events before the first decision
  float scale = 1;          // throughput: of it
};

/// Tables that some strategies need (src/scene/prepare/tables.h).
struct StrategyTables;

/// Constants of a render, made by src/scene/prepare/parameters.h.
struct RunParameters {
  std::uint32_t seed = 0;
  std::uint32_t width = 0, height = 0;  // full image
  std::uint32_t max_depth = 5;
  float exposure = 1;  // factor from radiance to film
  FeatureSet features;
  SamplePlanes planes;  // of a finished sample
  SamplerParameters sampler;
  bool pairs = false;  // samples 2k and 2k+1 share their numbers (pairs=antithetic)
  MisParameters mis;
  RouletteParameters roulette;
  std::uint32_t candidates = 1;  // light samples of which one is kept
  const StrategyTables* tables = nullptr;
};

}  // namespace lanelight
