// A sequence grows by doubling. Let N = 2^k points be a (0,k,2)-net, and let digit d of a
// coordinate be its d-th binary digit after the point. In the finished net of 2N points,
// each box of k digits (j of u0 and k - j of u1, for any j) holds one old point and one
// new. These two differ in the next digit of either coordinate. So let a new point share
// box j with an old one. Its digits j + 1 of u0 and k - j + 1 of u1 are then the opposite
// of the old one's. Its digit j + 1 of u0 selects the box j + 1 that it is in. The old
// point of that box determines digit j + 2, and so on to digit k + 1. Digits of u1 follow
// in the same way, down to j = 0. So the old points determine all digits of the new
// points up to k + 1.
//
// It is a net: two boxes j that differ only in the last digit of u1 together are two
// boxes j + 1, which hold one old point each. Each of the two new points differs from the
// old one of its box j in digit j + 1 of u0, so they too lie in different boxes j + 1. By
// induction every box of every j holds one new point; and it lies in the half that is
// empty.
//
// The freedom is in the digits that are not determined: they are random. As many digits
// are free as in Owen's scrambling, so all scrambled nets can come out.
#include "src/scene/prepare/pmj02.h"

#include <array>
#include <bit>
#include <vector>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// A Weyl sequence through a mixing function: needs no quality but that of a table.
struct Random {
  std::uint64_t state;
  std::uint32_t operator()() {
    state += 0xd6f0b097a3023cebull;
    std::uint64_t v = state;
    v = (v ^ (v >> 31)) * 0x9425aaeb2f2cb27full;
    v = (v ^ (v >> 29)) * 0xfc5ee9e9bd880d0full;
    return static_cast<std::uint32_t>(v >> 32);
  }
};

using Point = std::array<std::uint32_t, 2>;

std::uint32_t Leading(std::uint32_t v, std::uint32_t digits) {
  return digits == 0 ? 0 : v >> (32 - digits);
}
std::uint32_t DigitMask(std::uint32_t d) { return 1u << (32 - d); }

// Maps boxes to the old points in them.
class Boxes {
 public:
  Boxes(const std::vector<Point>& points, std::uint32_t k)
      : points_(points), k_(k), boxes_((k + 1) << k) {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      for (std::uint32_t j = 0; j <= k; ++j) boxes_[Box(points[i], j)] = i;
    }
  }
  /// The old point that shares box j with `p`.
  const Point& In(const Point& p, std::uint32_t j) const {
    return points_[boxes_[Box(p, j)]];
  }

 private:
  std::uint32_t Box(const Point& p, std::uint32_t j) const {
    return (j << k_) + (Leading(p[0], j) << (k_ - j)) + Leading(p[1], k_ - j);
  }
  const std::vector<Point>& points_;
  std::uint32_t k_;
  std::vector<std::uint32_t> boxes_;
};

// Sets digit d and replaces those after it by random ones, which later steps overwrite.
void SetDigit(std::uint32_t& v, std::uint32_t d, std::uint32_t value, Random& random) {
  const std::uint32_t mask = DigitMask(d);
  v = (v & ~(mask | (mask - 1))) | (value & mask) | (random() & (mask - 1));
}

// Returns the new point that shares box j with `old`.
Point Partner(const Boxes& boxes, const Point& old, std::uint32_t j, std::uint32_t k,
              Random& random) {
  Point p = old;
  SetDigit(p[0], j + 1, ~old[0], random);
  SetDigit(p[1], k - j + 1, ~old[1], random);
  for (std::uint32_t i = j + 1; i <= k; ++i) {
    SetDigit(p[0], i + 1, ~boxes.In(p, i)[0], random);
  }
  for (std::uint32_t i = j; i-- > 0;) {
    SetDigit(p[1], k - i + 1, ~boxes.In(p, i)[1], random);
  }
  return p;
}

}  // namespace

void MakePmj02(std::uint64_t seed, std::span<std::uint32_t> out) {
  const std::size_t count = out.size() / 2;
  LL_CHECK(std::has_single_bit(count));
  Random random{seed};
  std::vector<Point> points = {{random(), random()}};
  points.reserve(count);
  for (std::uint32_t k = 0; points.size() < count; ++k) {
    // Square boxes, or oblong ones of a random side: the order of the points is the only
    // thing that depends on it.
    const std::uint32_t j = k / 2 + (k % 2 != 0 ? random() >> 31 : 0);
    const std::vector<Point> old = points;
    const Boxes boxes(old, k);
    for (const Point& p : old) points.push_back(Partner(boxes, p, j, k, random));
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[2 * i] = points[i][0];
    out[2 * i + 1] = points[i][1];
  }
}

std::span<const std::uint32_t> Pmj02Table() {
  static const std::vector<std::uint32_t> table = [] {
    std::vector<std::uint32_t> all(std::size_t{2} * kPmj02SequenceLength *
                                   kPmj02Sequences);
    for (std::uint32_t s = 0; s < kPmj02Sequences; ++s) {
      MakePmj02(0x7061746873ull + s,
                std::span(all).subspan(std::size_t{2} * kPmj02SequenceLength * s,
                                       std::size_t{2} * kPmj02SequenceLength));
    }
    return all;
  }();
  return table;
}

}  // namespace lanelight
