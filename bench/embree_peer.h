// Embree 3 on the same triangles and rays, for comparison. Bench only.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/mesh.h"
#include "tests/wavefront/wave_fixture.h"

namespace lanelight::bench {

/// What a peer reports for a ray: infinite t = no hit (or not blocked).
struct PeerHit {
  float t = 0;
  std::uint32_t prim = 0;
};

class EmbreePeer {
 public:
  explicit EmbreePeer(const Mesh& mesh);
  ~EmbreePeer();
  /// The ways to trace rays, e.g. "high 8".
  std::vector<std::string> Modes(bool shadow, bool coherent) const;
  /// Traces the rays in `mode` and returns the seconds that took, conversion of the rays
  /// to Embree's layout apart.
  double Trace(const std::string& mode, bool shadow, const std::vector<TestRay>& rays,
               std::vector<PeerHit>* hits);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lanelight::bench
