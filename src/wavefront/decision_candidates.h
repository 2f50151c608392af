// What decide=pilot chooses from (src/wavefront/train_decision.cc).
#pragma once

namespace lanelight {

/// A change of the strategy that may pay.
struct DecisionCandidate {
  const char* changes;  // of roulette and guiding, as in --strategy
  /// Its variance times cost must be below so much of that without the change.
  double margin;
};

// Costs are counted in rays, so that the choice hangs on nothing but the scene; margins
// make up for what rays do not say. Processor time per ray over that of the default, 256
// pixels wide, one thread:
//   roulette=adjoint        1.11 (veach-ajar), 1.22 (coffee), 1.27 (spaceship): copies of
//                           paths, lookups of cells, emptier wavefronts. Counted as 1.2
//   roulette=throughput:..  1.02 to 1.09 (the same scenes)
// Beyond that a change must gain 5 percent: one that is made by mistake costs more than
// one that is missed.
//
// Left out: roulette=efficiency (where it gains adjoint does too, and it needs two more
// passes to learn its factors), roulette=none (its paths may not end).
inline constexpr DecisionCandidate kDecisionCandidates[] = {
    {"roulette=adjoint", 0.79},
    {"roulette=throughput:0:5", 0.92},
};

}  // namespace lanelight
