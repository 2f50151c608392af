// What a trial chooses from: decide=pilot from the changes of roulette, `lanelight
// advise` from all (src/wavefront/train_decision.cc, src/advise/advise.cc).
#pragma once

#include <span>

namespace lanelight {

/// A change of the strategy that may pay.
struct DecisionCandidate {
  const char* changes;  // as in --strategy
  const char* reason;   // when it pays
  /// Processor time of a counted ray (TrainingSamples::Cost) over that without the
  /// change, and how far the logarithm of that scatters from scene to scene.
  double price, price_spread;
};

/// A change must be so many times as efficient to be chosen: one that is made by mistake
/// costs more than one that is missed.
inline constexpr double kMustGain = 1.05;

/// Processor time of a counted ray with reuse=block over that without, and its scatter,
/// likewise: 0.96 to 1.46 over 16 scenes.
inline constexpr double kReusePrice = 1.16, kReusePriceSpread = 0.13;

// Costs are counted in rays, so that a choice hangs on nothing but the scene; prices make
// up for what rays do not say. They are means over 28 scenes, 128 pixels wide, one
// thread, AVX-512: adjoint 0.95 to 1.38, throughput:0:2:4 0.81 to 1.17 (12 scenes),
// throughput:0:5 0.99 to 1.35, none 0.95 to 1.54, tree 0.99 to 2.06 (where lights are
// many and paths long).
//
// Left out: directions=bsdf and light, which differ from combining both most in rare
// bright samples that a trial does not see, and gain 1.3 at most (Veach and Guibas 1995:
// combining is never much worse than either, one alone can be); roulette=efficiency
// (where it gains adjoint does too, and it needs two more passes to learn its factors),
// and what has never won: roulette=luminance (0.66 to 1.03 on five scenes), control
// variates (0.35 to 0.98), points=pmj02 (0.85 to 0.98), uniform directions, antithetic
// pairs, which undo what strata gain, a constant roulette.
inline constexpr DecisionCandidate kDecisionCandidates[] = {
    {"roulette=adjoint", "pays where little of the scene carries the light", 1.15, 0.09},
    {"roulette=throughput:0:2:4", "pays where what paths bring late is worth their rays",
     1.03, 0.1},
    // Only those above may be chosen without being asked for. With the next but one paths
    // may not end.
    {"roulette=throughput:0:5", "pays where bright light arrives after a few events",
     1.07, 0.07},
    {"roulette=none", "pays where paths are short or end late on bright lights", 1.07,
     0.12},
    {"light-selection=tree", "pays with many lights, each near a part of the scene", 1.12,
     0.16},
};
inline constexpr std::size_t kDecidedUnasked = 2;  // the first ones

}  // namespace lanelight
