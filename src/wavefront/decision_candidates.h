// What decide=pilot chooses from (src/wavefront/train_decision.cc).
#pragma once

namespace lanelight {

/// A change of the strategy that may pay.
struct DecisionCandidate {
  const char* changes;  // of roulette and guiding, as in --strategy
  /// Its variance times cost must be below so much of that without the change.
  double margin;
};

// Margins: costs are counted in rays, so that the choice hangs on nothing but the scene,
// and copies of paths and lookups of cells cost more than their rays; and a change that
// is made by mistake costs more than one that is missed.
//
// Left out: roulette=efficiency (where it gains adjoint does too, and it needs two more
// passes to learn its factors), roulette=none (its paths may not end).
inline constexpr DecisionCandidate kDecisionCandidates[] = {
    {"roulette=adjoint", 0.87},
    {"roulette=throughput:0:5", 0.95},
};

}  // namespace lanelight
