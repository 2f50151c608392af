// Decides whether hits are right: against double precision on a sample, and against the
// peer.
#pragma once

#include "bench/intersect/compare.h"

namespace lanelight::bench {

/// `hits`: ours of every ray. `peer` may be null.
Agreement CheckHits(const CompiledScene& scene, const RaySet& set,
                    const std::vector<BenchHit>& hits, Peer* peer, int wave);

}  // namespace lanelight::bench
