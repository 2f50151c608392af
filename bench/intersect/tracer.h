// Ways to trace a ray set, ours and a peer's, all timed alike: rays are taken in waves;
// each wave is laid out as the tracer wants it (not timed, leaves it in the cache as the
// stages before do in a render), then traced (timed).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/intersect/ray_sets.h"

namespace lanelight::bench {

class OurTracer {
 public:
  OurTracer(const CompiledScene& scene, int wave) : scene_(scene), wave_(wave) {}
  /// Processor seconds in the intersect stage over all waves; `hits` may be null.
  double Trace(const RaySet& set, std::vector<BenchHit>* hits);

 private:
  WaveFixture& Fixture(const RaySet& set);

  const CompiledScene& scene_;
  int wave_;
  std::unique_ptr<WaveFixture> fixture_;
};

/// One way of a peer to trace rays.
struct PeerEntry {
  std::string name;  // e.g. "high 8 robust"
  bool robust = false;
};

class Peer {
 public:
  virtual ~Peer() = default;
  /// Name, version, instruction set.
  virtual std::string Name() const = 0;
  virtual std::vector<PeerEntry> Entries() const = 0;
  /// Processor seconds over all waves in the entry of that index; `hits` may be null.
  virtual double Trace(std::size_t entry, const RaySet& set, int wave,
                       std::vector<BenchHit>* hits) = 0;
};

/// Embree with the instruction set that comes nearest to our SIMD target `target`. Null
/// if Embree 3 was not found when this was built.
std::unique_ptr<Peer> MakeEmbree(const Mesh& mesh, const std::string& target,
                                 const std::string& config);

}  // namespace lanelight::bench
