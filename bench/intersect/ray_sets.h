// The ray sets of the intersection benchmark.
#pragma once

#include <string>
#include <vector>

#include "bench/intersect/mesh.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::bench {

struct RaySet {
  std::string name;
  bool shadow = false;
  std::vector<TestRay> rays;
  /// Rays that are traced together, one after another; empty: all waves equally large.
  std::vector<std::size_t> waves;
};

/// The result of a tracer for a ray: infinite t = no hit, or not blocked.
struct BenchHit {
  float t = 0;
  std::uint32_t prim = 0;
};

/// Names of the sets that MakeRaySets makes.
inline const std::vector<std::string> kRaySets = {"primary", "shadow", "bounce1",
                                                  "bounce2", "mirror", "common"};

/// Rays of size x size pixels, found with our own kernels; all in the order of the camera
/// rays: tiles of 16 x 16 pixels, in them blocks of 4 x 4 pixels, one jittered sample per
/// pixel. From the hits of the camera rays go shadow rays to the light, diffuse bounces
/// (cosine-distributed), and perfect reflections; "bounce2" are diffuse bounces from the
/// hits of the first, "common" shadow rays from 16 hits of camera rays to one of these.
/// `size` is a multiple of 16. The same on every machine and target but for rounding.
std::vector<RaySet> MakeRaySets(const Mesh& mesh, const CompiledScene& scene, int size);

/// Calls body(begin, end) for the rays of each wave.
template <class Body>
void ForEachWave(const RaySet& set, std::size_t wave, Body&& body) {
  std::size_t at = 0;
  for (const std::size_t size : set.waves) {
    body(at, at + size);
    at += size;
  }
  for (; at < set.rays.size(); at += wave) {
    body(at, std::min(set.rays.size(), at + wave));
  }
}

/// The waves first, first + step, first + 2 step, ... of the set.
RaySet EveryWave(const RaySet& set, std::size_t wave, std::size_t step,
                 std::size_t first = 0);

/// The largest wave of a set.
std::size_t LargestWave(const RaySet& set, std::size_t wave);

}  // namespace lanelight::bench
