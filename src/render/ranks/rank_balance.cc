#include "src/render/ranks/rank_balance.h"

#include <algorithm>
#include <bit>

namespace lanelight {
namespace {

// Less than this is not worth a message.
constexpr double kLeastSeconds = 0.005;

}  // namespace

int BalancePartner(int rank, int ranks, std::uint64_t turn) {
  const auto dimensions = std::bit_width(static_cast<unsigned>(std::max(ranks - 1, 1)));
  const int partner = rank ^ (1 << (turn % static_cast<unsigned>(dimensions)));
  return partner < ranks ? partner : -1;
}

std::uint64_t SamplesToGive(const RankLoad& from, const RankLoad& to) {
  if (from.speed <= 0) return 0;
  // A rank that has not ended a task yet, since it had none, is taken to be as fast.
  const double speed = to.speed > 0 ? to.speed : from.speed;
  const double excess =
      (double(from.left) * speed - double(to.left) * from.speed) / (from.speed + speed);
  return excess > kLeastSeconds * from.speed ? static_cast<std::uint64_t>(excess) : 0;
}

}  // namespace lanelight
