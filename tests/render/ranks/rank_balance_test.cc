// Ranks even out what is left to them by comparing themselves with one other at a time.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "src/render/ranks/rank_balance.h"

namespace lanelight {

TEST_CASE("balancing partners are symmetric and include all neighbours", "[ranks]") {
  for (int ranks : {1, 2, 3, 5, 8, 13, 1000}) {
    for (int rank = 0; rank < ranks; ++rank) {
      int met = 0;
      for (std::uint64_t round = 0; round < 10; ++round) {
        const int partner = BalancePartner(rank, ranks, round);
        met += partner >= 0;
        if (partner < 0) continue;
        CHECK(partner < ranks);
        CHECK(partner != rank);
        CHECK(BalancePartner(partner, ranks, round) == rank);
      }
      CHECK((met > 0) == (ranks > 1));
    }
  }
}

TEST_CASE("transferred samples let both ranks end at the same time", "[ranks]") {
  const RankLoad slow = {3000000, 1e6}, fast = {3000000, 2e6};
  const auto samples = SamplesToTransfer(slow, fast);
  CHECK(double(slow.left - samples) / slow.speed ==
        Approx(double(fast.left + samples) / fast.speed));
  CHECK(SamplesToTransfer(fast, slow) == 0);
  CHECK(SamplesToTransfer(slow, slow) == 0);
  // The speed of this rank and the time of the other are unknown.
  CHECK(SamplesToTransfer({3000000, 0}, fast) == 0);
  CHECK(SamplesToTransfer(slow, {0, 0}) == slow.left / 2);
  // A message for a millisecond.
  CHECK(SamplesToTransfer({2000, 1e6}, {0, 1e6}) == 0);
}

TEST_CASE("a few balancing rounds even out any number of ranks", "[ranks]") {
  for (int ranks : {2, 3, 6, 16, 37}) {
    std::vector<RankLoad> loads;
    for (int r = 0; r < ranks; ++r) loads.push_back({100000000, 1e6 * (1 + r % 7)});
    for (std::uint64_t round = 0; round < 40; ++round) {
      for (int r = 0; r < ranks; ++r) {
        const int partner = BalancePartner(r, ranks, round);
        if (partner < 0) continue;
        RankLoad& from = loads[static_cast<std::size_t>(r)];
        RankLoad& to = loads[static_cast<std::size_t>(partner)];
        const auto samples = SamplesToTransfer(from, to);
        from.left -= samples;
        to.left += samples;
      }
    }
    double minimum = 1e30, maximum = 0;
    for (const RankLoad& load : loads) {
      minimum = std::min(minimum, double(load.left) / load.speed);
      maximum = std::max(maximum, double(load.left) / load.speed);
    }
    INFO(ranks << " ranks");
    CHECK(maximum < 1.02 * minimum);
  }
}

}  // namespace lanelight
