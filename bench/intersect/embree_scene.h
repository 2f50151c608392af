// Embree 3 devices and scenes. Bench only.
#pragma once

#include <embree3/rtcore.h>

#include <string>

#include "bench/intersect/mesh.h"

namespace lanelight::bench {

/// Returns the configuration for rtcNewDevice: `threads` building threads, the
/// instruction set closest to our SIMD target (the best for AVX3), and `more`.
std::string EmbreeConfig(const std::string& target, int threads, const std::string& more);

/// A scene that is not committed yet: rtcCommitScene builds it.
RTCScene NewEmbreeScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality,
                        bool robust);

}  // namespace lanelight::bench
