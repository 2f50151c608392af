// What a trial chooses from: decide=pilot from the changes of roulette, `lanelight
// advise` from all (src/render/train/train_decision.cc, src/measure/advise/advise.cc).
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
/// likewise.
inline constexpr double kReusePrice = 1.2, kReusePriceSpread = 0.27;

// Costs are counted in rays, so that a choice hangs on nothing but the scene; prices make
// up for what rays do not say. They are means over 32 scenes, 96 pixels wide, 64 spp, one
// thread, AVX-512, and so are their spreads. What a sample costs beside its rays and what
// a shadow ray costs have no part in them: with a constant per sample, or other weights
// of shadow rays, they scatter as much.
//
// Left out: directions=bsdf and light, which differ from combining both most in rare
// bright samples that a trial does not see, and gain 1.3 at most (Veach and Guibas 1995:
// combining is never much worse than either, one alone can be); roulette=efficiency
// (where it gains adjoint does too, and it needs two more passes to learn its factors),
// and what has never won: roulette=luminance (0.66 to 1.03 on five scenes), control
// variates (0.35 to 0.98), points=pmj02 (0.85 to 0.98), uniform directions, antithetic
// pairs, which undo what strata gain, a constant roulette.
inline constexpr DecisionCandidate kDecisionCandidates[] = {
    {"roulette=adjoint", "pays where little of the scene carries the light", 1.17, 0.19},
    {"roulette=throughput:0:2:4", "pays where what paths bring late is worth their rays",
     1.0, 0.13},
    // Only those above may be chosen without being asked for. With the next but one paths
    // may not end.
    {"roulette=throughput:0:5", "pays where bright light arrives after a few events",
     1.02, 0.15},
    {"roulette=none", "pays where paths are short or end late on bright lights", 1.02,
     0.19},
    {"light-selection=tree", "pays with many lights, each near a part of the scene", 1.1,
     0.4},
};
inline constexpr std::size_t kDecidedUnasked = 2;  // the first ones

}  // namespace lanelight
