// The calls that trace rays with Embree 3. Bench only.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "bench/intersect/ray_sets.h"

namespace lanelight::bench {

enum class EmbreeCall {
  kOne,
  kFour,
  kEight,
  kSixteen,
  kStreamAos,
  kStreamPackets,
  kStreamPointers
};

/// Rays of one wave in the layout that a call wants: packets of kN rays in SoA (kN = 1:
/// RTCRayHit or RTCRay, kN = the wave: long columns).
class EmbreeWave {
 public:
  EmbreeWave(EmbreeCall call, bool shadow, std::size_t capacity);

  void CopyRays(const TestRay* rays, std::size_t count);
  /// Traces what was packed; this is what is timed.
  void Trace(RTCScene scene, bool coherent);
  void Unpack(BenchHit* hits) const;

 private:
  std::size_t words() const { return shadow_ ? 12 : 20; }  // per ray
  float* packet(std::size_t i) { return memory_.data() + i * words() * width_; }

  void TracePackets(RTCScene scene, RTCIntersectContext* context);
  void TraceStream(RTCScene scene, RTCIntersectContext* context);

  EmbreeCall call_;
  bool shadow_;
  unsigned width_;
  std::size_t rays_ = 0, packets_ = 0;
  AlignedVector<float> memory_;
};

}  // namespace lanelight::bench
