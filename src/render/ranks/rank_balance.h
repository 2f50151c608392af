// Which rank gives work to which while they render. Their parts were to cost the same,
// but nobody knows that before: tiles cost what they show, and cores are as fast as what
// else runs on them leaves them. So each rank compares itself in turn with its neighbours
// in a hypercube, and the one that would end later gives the other so much that both end
// at the same time (dimension exchange: Cybenko 1989, "Dynamic load balancing for
// distributed memory multiprocessors"). What a rank sends does not grow with the number
// of ranks.
#pragma once

#include <cstdint>

namespace lanelight {

struct RankLoad {
  std::uint64_t left = 0;  // samples of the round
  double speed = 0;        // samples a second so far; 0: not known
};

/// With whom `rank` compares itself for the turn-th time; -1: with nobody. Both say so of
/// each other.
int BalancePartner(int rank, int ranks, std::uint64_t turn);

/// Samples that the first is to give to the second for both to end at the same time; 0
/// where the second would end later, or where too little time is won.
std::uint64_t SamplesToGive(const RankLoad& from, const RankLoad& to);

}  // namespace lanelight
